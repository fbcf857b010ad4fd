//! Placements at keyframes.

use alloc::vec::Vec;

use super::Motion;
use super::segment::Segment;
use crate::geometry::Transform;

/// When the picture is taken: from the opening of the shutter to its closing, in the time of the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shutter {
    open: f64,
    close: f64,
}

/// Why a shutter is refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ShutterError {
    /// A time that is NaN or infinite.
    #[error("a time of the shutter is not finite")]
    NotFinite,
    /// It closes before it opens.
    #[error("the shutter closes at {close}, before it opens at {open}")]
    Order {
        /// When it opens.
        open: f64,
        /// When it closes.
        close: f64,
    },
}

impl Shutter {
    /// A shutter that is open from one time to another; never, for an instant, where they are the same.
    ///
    /// # Errors
    /// Times that are not finite, a closing before the opening.
    pub fn new(open: f64, close: f64) -> Result<Self, ShutterError> {
        if !(open.is_finite() && close.is_finite() && (close - open).is_finite()) {
            return Err(ShutterError::NotFinite);
        }
        if close < open {
            return Err(ShutterError::Order { open, close });
        }
        Ok(Self { open, close })
    }

    /// When it opens.
    pub fn open(&self) -> f64 {
        self.open
    }

    /// When it closes.
    pub fn close(&self) -> f64 {
        self.close
    }
}

/// Where something is while the shutter is open.
#[derive(Clone, Debug, PartialEq)]
pub enum Placement {
    /// In one place.
    Still(Transform),
    /// On its way.
    Moving(Motion),
}

impl Placement {
    /// Where the shutter opens, and how it goes on from there.
    pub fn into_parts(self) -> (Transform, Option<Motion>) {
        match self {
            Self::Still(transform) => (transform, None),
            Self::Moving(motion) => (*motion.opening(), Some(motion)),
        }
    }
}

/// Placements at increasing times; between two of them translation, rotation and stretch are interpolated apart, before
/// the first and after the last nothing moves.
///
/// ```text
/// M = T R S:  T and S linearly, R at a constant rate by the shorter way
/// ```
///
/// A half turn has two shortest ways: it is taken anticlockwise about the axis whose largest component is positive.
///
/// # Source
/// Shoemake, Duff, "Matrix Animation and Polar Decomposition", Graphics Interface 1992; Pharr, Jakob, Humphreys,
/// "Physically Based Rendering", 3rd ed., section 2.9. As in Mitsuba 0.6, which leaves out what `S` has beside its
/// diagonal.
///
/// # Examples
/// ```
/// use etendue_math::glam::{DVec3, Vec3};
/// use etendue_scene::geometry::{Animation, Placement, Shutter, Transform};
/// let turned = Transform::rotate(DVec3::Z, 90.0)?;
/// let animation = Animation::new(vec![(0.0, Transform::IDENTITY), (2.0, turned)])?;
/// let Placement::Moving(motion) = animation.during(Shutter::new(0.0, 1.0)?) else { panic!() };
/// // Half the turn while the shutter is open.
/// let at_closing = motion.at(1.0).point(Vec3::X);
/// assert!((at_closing - Vec3::new(0.5_f32.sqrt(), 0.5_f32.sqrt(), 0.0)).length() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Animation {
    keyframes: Vec<(f64, Transform)>,
}

/// Why keyframes are refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum AnimationError {
    /// There is none.
    #[error("an animation needs a keyframe")]
    Empty,
    /// A time is NaN or infinite.
    #[error("the time of a keyframe is not finite")]
    NotFinite {
        /// Which keyframe, counted from 0.
        keyframe: usize,
    },
    /// A keyframe does not come after the one before it.
    #[error("keyframes need increasing times, but {time} follows {previous}")]
    Order {
        /// Which keyframe, counted from 0.
        keyframe: usize,
        /// Its time.
        time: f64,
        /// That of the one before it.
        previous: f64,
    },
    /// One of two keyframes mirrors and the other does not.
    #[error(
        "the keyframes before and after differ in handedness: on the way from one to the other space would be flat"
    )]
    Handedness {
        /// The later of the two, counted from 0.
        keyframe: usize,
    },
}

impl AnimationError {
    /// The keyframe that is to blame, counted from 0, if there is one.
    pub fn keyframe(&self) -> Option<usize> {
        match *self {
            Self::Empty => None,
            Self::NotFinite { keyframe }
            | Self::Order { keyframe, .. }
            | Self::Handedness { keyframe } => Some(keyframe),
        }
    }
}

impl Animation {
    /// Keyframes: each a time and the placement then.
    ///
    /// # Errors
    /// None at all, times that are not finite or do not increase, neighbours of which only one mirrors.
    pub fn new(keyframes: Vec<(f64, Transform)>) -> Result<Self, AnimationError> {
        if keyframes.is_empty() {
            return Err(AnimationError::Empty);
        }
        if let Some(keyframe) = keyframes.iter().position(|(time, _)| !time.is_finite()) {
            return Err(AnimationError::NotFinite { keyframe });
        }
        let animation = Self { keyframes };
        for (keyframe, [(previous, before), (time, after)]) in (1..).zip(animation.neighbours()) {
            if time <= previous {
                let (time, previous) = (*time, *previous);
                return Err(AnimationError::Order { keyframe, time, previous });
            }
            if before.is_mirrored() != after.is_mirrored() {
                return Err(AnimationError::Handedness { keyframe });
            }
        }
        Ok(animation)
    }

    /// The keyframes.
    pub fn keyframes(&self) -> &[(f64, Transform)] {
        &self.keyframes
    }

    /// The placements while a shutter is open: a motion only if they differ.
    pub fn during(&self, shutter: Shutter) -> Placement {
        let Shutter { open, close } = shutter;
        let opening = self.at(open);
        let segments: Vec<_> = (self.neighbours())
            .filter(|[(start, before), (end, after)]| {
                before != after && *start < close && *end > open
            })
            .map(Segment::between)
            .collect();
        if segments.is_empty() || open == close {
            return Placement::Still(opening);
        }
        Placement::Moving(Motion { opening, segments, shutter })
    }

    /// The placement at a time: that of a keyframe to the bit.
    fn at(&self, time: f64) -> Transform {
        let later = self.keyframes.partition_point(|&(start, _)| start <= time);
        let Some(&(start, before)) = later.checked_sub(1).and_then(|i| self.keyframes.get(i))
        else {
            return self.keyframes[0].1;
        };
        match self.keyframes.get(later) {
            Some(end) if start < time && before != end.1 => {
                let way = Segment::between([&(start, before), end]);
                Transform::of_pose(way.at(way.parameter(time)))
            }
            _ => before,
        }
    }

    /// The first keyframe that is reached by a half turn, counted from 0.
    pub fn half_turn(&self) -> Option<usize> {
        let half_turns = self.neighbours().map(|pair| Segment::between(pair).is_half_turn());
        (1..).zip(half_turns).find(|(_, half)| *half).map(|(keyframe, _)| keyframe)
    }

    /// Each keyframe with the one after it.
    fn neighbours(&self) -> impl Iterator<Item = [&(f64, Transform); 2]> {
        self.keyframes.iter().zip(self.keyframes.iter().skip(1)).map(|(a, b)| [a, b])
    }
}
