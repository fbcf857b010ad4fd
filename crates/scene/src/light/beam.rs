//! Flat shapes that emit straight ahead.

use etendue_brdf::Density;
use etendue_math::Spectrum;
use etendue_math::glam::Vec3;

use super::LightSample;
use crate::Color;
use crate::geometry::{Shape, ShapeId};
use crate::texture::{TextureId, Textures};

/// A flat shape that emits along its normal only, so that its light is parallel and lights what is right in front of it.
///
/// No ray of a camera meets its light: it is sampled. Mitsuba's `directionalarea`, which only its particle tracer can see.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BeamLight {
    /// A rectangle or disk that is not part of a group.
    pub shape: ShapeId,
    /// Radiant exitance M over the surface, in W m⁻²; what a surface that faces the light receives.
    pub exitance: TextureId,
}

impl BeamLight {
    /// The light at a point: `E = M` of the point straight behind it; `None` where that is not on the shape.
    pub(crate) fn sample(
        self,
        shape: &Shape,
        textures: &Textures,
        reference: Vec3,
    ) -> Option<LightSample> {
        let foot = shape.foot(reference)?;
        let irradiance = textures.color(self.exitance, foot.uv);
        let arrives = !irradiance.is_black() && Spectrum::is_finite(irradiance);
        arrives.then(|| LightSample {
            direction: -foot.normal,
            target: Some(foot.seen_from(reference)),
            radiance: irradiance,
            density: Density::Delta(1.0),
        })
    }

    /// Power Φ = A M of an area A in m², with the mean of the texture, in W.
    pub(crate) fn power(self, textures: &Textures, area: f32) -> f32 {
        area * Color::luminance(textures.mean(self.exitance))
    }
}
