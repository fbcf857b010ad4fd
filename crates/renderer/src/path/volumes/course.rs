//! The state of a path between surfaces: the medium it is in, and which channel distances are drawn by.

use etendue_math::glam::Vec3;
use etendue_sampling::Sampler;
use etendue_scene::color::Channels;
use etendue_scene::geometry::{Rays, SurfacePoint};
use etendue_scene::medium::Medium;

use crate::path::PathTracer;
use crate::path::dispersion::leading_channel;

/// Where a path is.
pub(super) struct Course<'s> {
    /// None in empty space.
    pub(super) medium: Option<&'s Medium>,
    /// The channel that distances are drawn by, once one is needed.
    leading: Option<usize>,
}

impl<'s> Course<'s> {
    pub(super) fn in_medium(medium: Option<&'s Medium>) -> Self {
        Self { medium, leading: None }
    }

    /// The channel that distances are drawn by: one for the whole path.
    #[inline]
    pub(super) fn leading<C: Channels, S: Sampler>(&mut self, points: &S) -> usize {
        *self.leading.get_or_insert_with(|| leading_channel::<C, S>(points))
    }
}

impl<'s, R: Rays, C: Channels> PathTracer<'_, 's, R, C> {
    /// The medium that the camera stands in.
    pub(super) fn around_camera(&self) -> Option<&'s Medium> {
        if !self.settings.volumes {
            return None;
        }
        self.scene.media.around_camera.and_then(|id| self.scene.media.get(id))
    }

    /// The medium on the side of a surface that a direction points to, `around` where it bounds none.
    #[inline]
    pub(super) fn beyond(
        &self,
        point: &SurfacePoint,
        direction: Vec3,
        around: Option<&'s Medium>,
    ) -> Option<&'s Medium> {
        match self.scene.surfaces[point.shape.0 as usize].boundary {
            Some(boundary) if self.settings.volumes => {
                let is_outside = direction.dot(point.normal) > 0.0;
                let side = if is_outside { boundary.exterior } else { boundary.interior };
                side.and_then(|id| self.scene.media.get(id))
            }
            _ => around,
        }
    }
}
