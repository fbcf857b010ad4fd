//! Placements that change while the shutter is open.

mod animation;
mod pose;
mod segment;

use alloc::vec::Vec;

use etendue_math::glam::DAffine3;

use super::{Aabb, Transform};

pub use animation::{Animation, AnimationError, Placement, Shutter, ShutterError};
use segment::Segment;

/// What an [`Animation`] does while the shutter is open.
///
/// Its times are shares of the exposure: 0 where the shutter opens, 1 where it closes.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    opening: Transform,
    /// Those with a part in the exposure, in order; not empty. Between and around them nothing moves.
    segments: Vec<Segment>,
    shutter: Shutter,
}

impl Motion {
    /// The placement at the opening of the shutter; at a keyframe that of the file to the bit.
    pub fn opening(&self) -> &Transform {
        &self.opening
    }

    /// The placement at a share of the exposure; at the opening for a time below 0 or NaN, at the closing above 1.
    #[inline]
    pub fn at(&self, time: f32) -> Transform {
        let share = if time > 0.0 { f64::from(time.min(1.0)) } else { 0.0 };
        let (open, close) = (self.shutter.open(), self.shutter.close());
        let time = open + (close - open) * share;
        let later = self.segments.partition_point(|segment| segment.start() <= time);
        let segment = &self.segments[later.saturating_sub(1)];
        Transform::of_pose(segment.at(segment.parameter(time)))
    }

    /// The placements from which the others are interpolated: start and end of each part.
    pub fn ends(&self) -> impl Iterator<Item = Transform> {
        let ends = self.segments.iter().flat_map(|segment| [0.0, 1.0].map(|u| segment.at(u)));
        ends.map(Transform::of_pose)
    }

    /// The motion of what was reflected in the origin before: `x ↦ M(−x)`, which keeps handedness where this does not.
    #[must_use]
    pub fn reflected(mut self) -> Self {
        let DAffine3 { matrix3, translation } = *self.opening.affine();
        self.opening = Transform::of_pose(DAffine3 { matrix3: -matrix3, translation });
        for segment in &mut self.segments {
            segment.reflect();
        }
        self
    }

    /// A box that holds a box in every place that it has while the shutter is open.
    pub fn bounds(&self, of: &Aabb) -> Aabb {
        let exposure = [self.shutter.open(), self.shutter.close()];
        let boxes = self
            .segments
            .iter()
            .map(|segment| segment.bounds(of, exposure.map(|time| segment.parameter(time))));
        boxes.fold(Aabb::EMPTY, Aabb::union)
    }
}

#[cfg(test)]
mod tests;
