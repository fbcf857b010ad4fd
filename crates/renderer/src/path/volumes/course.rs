//! The state of a path between surfaces: the medium it is in, and how its channels fare.

use etendue_math::Spectrum;
use etendue_math::glam::Vec3;
use etendue_sampling::{Decision, Dimension, Sampler};
use etendue_scene::geometry::SurfacePoint;
use etendue_scene::medium::Medium;
use etendue_scene::{Color, Scene};

/// Where a path is, and its density in each channel.
pub(super) struct Course<'s> {
    /// None in empty space.
    pub(super) medium: Option<&'s Medium>,
    /// The channel whose extinction distances are drawn by, once one is needed.
    channel: Option<usize>,
    /// The density of the path so far as if drawn by each channel, relative to the mean over the
    /// three, by which the throughput is divided.
    ratios: Color,
}

impl<'s> Course<'s> {
    pub(super) fn from_camera(scene: &'s Scene) -> Self {
        let medium = scene.media.around_camera.and_then(|id| scene.media.get(id));
        Self { medium, channel: None, ratios: Color::white() }
    }

    /// The channel that distances are drawn by: one for the whole path.
    #[inline]
    pub(super) fn channel<S: Sampler>(&mut self, points: &S) -> usize {
        *self.channel.get_or_insert_with(|| {
            let u: f32 = points.sample_1d(Dimension::camera(Decision::Wavelength));
            ((u * Color::CHANNELS as f32) as usize).min(Color::CHANNELS - 1)
        })
    }

    /// The factor of the throughput for an event drawn by one channel, with a density in each.
    ///
    /// ```text
    /// factor = densities / mean(ratios · densities),   ratios ← ratios · factor
    /// ```
    ///
    /// The balance heuristic over the channels. Densities need a common scale only.
    #[inline]
    pub(super) fn reweigh(&mut self, densities: Color) -> Color {
        let joint = self.ratios * densities;
        let per_mean = 1.0 / joint.mean();
        self.ratios = joint.scale(per_mean);
        densities.scale(per_mean)
    }

    /// Follows the path across a surface, or back from it.
    #[inline]
    pub(super) fn cross(&mut self, scene: &'s Scene, point: &SurfacePoint, direction: Vec3) {
        self.medium = beyond(scene, point, direction, self.medium);
    }
}

/// The medium on the side of a surface that a direction points to, `around` where it bounds none.
#[inline]
pub(super) fn beyond<'s>(
    scene: &'s Scene,
    point: &SurfacePoint,
    direction: Vec3,
    around: Option<&'s Medium>,
) -> Option<&'s Medium> {
    match scene.surfaces[point.shape.0 as usize].boundary {
        None => around,
        Some(boundary) => {
            let is_outside = direction.dot(point.normal) > 0.0;
            let side = if is_outside { boundary.exterior } else { boundary.interior };
            side.and_then(|id| scene.media.get(id))
        }
    }
}
