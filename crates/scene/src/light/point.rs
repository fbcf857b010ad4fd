//! Lights without parameters of their own making: a point, a direction, a uniform sky.

use etendue_brdf::Density;
use etendue_math::glam::Vec3;
use etendue_math::{Real, Spectrum, Vector3};
use etendue_sampling::warp::uniform_sphere;

use super::{LightError, LightSample, is_emission};
use crate::Color;
use crate::geometry::is_unit;

/// Emits evenly into all directions from one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// Where.
    pub position: Vec3,
    /// Intensity I, in W sr⁻¹.
    pub intensity: Color,
}

impl PointLight {
    pub(crate) fn check(&self) -> Result<(), LightError> {
        match (self.position.is_finite(), is_emission(self.intensity)) {
            (false, _) => Err(LightError::Position),
            (_, false) => Err(LightError::Emission),
            _ => Ok(()),
        }
    }

    /// The light at a point: `E = I / d²`.
    #[inline]
    pub(crate) fn sample(&self, reference: Vec3) -> Option<LightSample> {
        from_point(self.position, reference, |_| self.intensity)
    }

    /// Power Φ = 4π I, in W.
    pub(crate) fn power(&self) -> f32 {
        4.0 * f32::PI * self.intensity.luminance()
    }
}

/// What a point with the given intensity towards a unit direction does at `reference`; `None` at
/// the point itself and where nothing arrives.
#[inline]
pub(super) fn from_point(
    position: Vec3,
    reference: Vec3,
    intensity: impl FnOnce(Vec3) -> Color,
) -> Option<LightSample> {
    let to_light = position - reference;
    let direction = Vector3::try_normalize(to_light)?;
    let radiance = intensity(-direction) * (1.0 / to_light.length_squared());
    let arrives = !radiance.is_black() && Spectrum::is_finite(radiance);
    arrives.then_some(LightSample {
        direction,
        target: Some(position),
        radiance,
        density: Density::Delta(1.0),
    })
}

/// Parallel light from infinitely far away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalLight {
    /// Where the light travels; of any length, a scene makes it 1.
    pub direction: Vec3,
    /// Irradiance E on a surface that faces it, in W m⁻².
    pub irradiance: Color,
}

impl DirectionalLight {
    pub(crate) fn normalized(self) -> Result<Self, LightError> {
        let direction = if is_unit(self.direction) {
            self.direction
        } else {
            Vector3::try_normalize(self.direction).ok_or(LightError::Direction)?
        };
        if is_emission(self.irradiance) {
            Ok(Self { direction, ..self })
        } else {
            Err(LightError::Emission)
        }
    }

    #[inline]
    pub(crate) fn sample(&self) -> Option<LightSample> {
        (!self.irradiance.is_black()).then_some(LightSample {
            direction: -self.direction,
            target: None,
            radiance: self.irradiance,
            density: Density::Delta(1.0),
        })
    }

    /// Power through a sphere: Φ = π R² E, in W.
    pub(crate) fn power(&self, radius: f32) -> f32 {
        f32::PI * radius * radius * self.irradiance.luminance()
    }
}

/// The same radiance from all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantLight {
    /// Radiance L, in W sr⁻¹ m⁻².
    pub radiance: Color,
}

impl ConstantLight {
    pub(crate) fn check(&self) -> Result<(), LightError> {
        if is_emission(self.radiance) { Ok(()) } else { Err(LightError::Emission) }
    }

    /// Uniform over the sphere.
    #[inline]
    pub(crate) fn sample(&self, u: [f32; 2]) -> Option<LightSample> {
        (!self.radiance.is_black()).then(|| LightSample {
            direction: uniform_sphere::from_square(u),
            target: None,
            radiance: self.radiance,
            density: Density::Continuous(self.pdf()),
        })
    }

    /// Density of every direction, 1/4π.
    #[inline]
    pub(crate) fn pdf(&self) -> f32 {
        if self.radiance.is_black() { 0.0 } else { 0.25 * f32::FRAC_1_PI }
    }

    /// Power through a sphere: Φ = 4π² R² L, in W.
    pub(crate) fn power(&self, radius: f32) -> f32 {
        4.0 * f32::PI * f32::PI * radius * radius * self.radiance.luminance()
    }
}
