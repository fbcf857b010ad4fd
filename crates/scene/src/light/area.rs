//! Shapes that emit.

use etendue_brdf::Density;
use etendue_math::glam::Vec3;
use etendue_math::{Real, Spectrum, Vector3};

use super::LightSample;
use crate::color::Channels;
use crate::geometry::{Shape, ShapeId, SurfacePoint};
use crate::texture::{TextureId, Textures};

/// A shape that emits from its front side, with the same radiance into all directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AreaLight {
    /// The shape, one that is not part of a group.
    pub shape: ShapeId,
    /// Radiance L over the surface, in W sr⁻¹ m⁻².
    pub radiance: TextureId,
}

impl AreaLight {
    /// A point on one primitive of the shape, as [`Shape::sample_from`] draws it; `None` where it
    /// shows its back.
    #[inline(always)]
    pub(crate) fn sample<C: Channels>(
        self,
        shape: &Shape,
        textures: &Textures,
        primitive: u32,
        reference: Vec3,
        u: [f32; 2],
        channels: C,
    ) -> Option<LightSample<C::Color>> {
        let (point, pdf) = shape.sample_from(primitive, reference, u)?;
        let to_light = point.position - reference;
        // Written so that NaN is refused; the density is 0 where the length is.
        let shows_front = to_light.dot(point.normal) < 0.0;
        let radiance = textures.light(self.radiance, point.uv, channels);
        if !shows_front || radiance.is_black() {
            return None;
        }
        Some(LightSample {
            direction: Vector3::try_normalize(to_light)?,
            target: Some(point.seen_from(reference)),
            radiance,
            density: Density::Continuous(pdf),
        })
    }

    /// Radiance that leaves a point of the shape towards `direction`; `None` on its back.
    #[inline(always)]
    pub(crate) fn emitted<C: Channels>(
        self,
        textures: &Textures,
        point: &SurfacePoint,
        direction: Vec3,
        channels: C,
    ) -> Option<C::Color> {
        (direction.dot(point.normal) > 0.0)
            .then(|| textures.light(self.radiance, point.uv, channels))
    }

    /// Power Φ = π A L of an area A in m², with the mean of the texture, in W.
    pub(crate) fn power(self, textures: &Textures, area: f32) -> f32 {
        f32::PI * area * textures.mean(self.radiance).luminance()
    }
}
