//! What light falls on the surface.

use core::f32::consts::FRAC_1_SQRT_2;

use etendue_brdf::direction::reflect;
use etendue_math::{Real, Vec3, Vector3};

/// A source of light from all or from some directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lighting {
    /// Radiance 1 from everywhere: the mean of the estimator is the model's albedo.
    Furnace,
    /// A small light where a mirror would show it.
    MirrorLight,
    /// A small light 45° above the surface, at a right angle to the plane of view and normal.
    SideLight,
}

/// Angle from its axis, in degrees, at which the radiance of a small light has fallen to 1/e.
pub const LIGHT_DEGREES: f64 = 5.0;

impl Lighting {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Furnace, Self::MirrorLight, Self::SideLight];

    /// For programs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Furnace => "furnace",
            Self::MirrorLight => "mirror-light",
            Self::SideLight => "side-light",
        }
    }

    /// For people.
    pub fn heading(self) -> &'static str {
        match self {
            Self::Furnace => "White furnace",
            Self::MirrorLight => "Small light in the mirror direction",
            Self::SideLight => "Small light aside",
        }
    }
}

/// All lightings for one direction of view.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lights {
    mirror: Vec3<f32>,
    side: Vec3<f32>,
    sharpness: f32,
}

impl Lights {
    /// Those for a surface seen from `wo`.
    pub(super) fn seen_from(wo: Vec3<f32>) -> Self {
        let across = Vec3::<f32>::new(-wo.y(), wo.x(), 0.0).try_normalize();
        let [x, y] = across.map_or([0.0, 1.0], |w| [w.x(), w.y()]);
        let root = FRAC_1_SQRT_2;
        let angle = LIGHT_DEGREES.to_radians();
        Self {
            mirror: reflect(wo),
            side: Vec3::<f32>::new(x * root, y * root, root),
            sharpness: (1.0 / (1.0 - Real::cos(angle))) as f32,
        }
    }

    /// Radiance from `wi` under each of [`Lighting::ALL`].
    ///
    /// ```text
    /// furnace   L = 1
    /// lights    L = exp((w·axis − 1) / (1 − cos 5°))
    /// ```
    ///
    /// A lobe of von Mises and Fisher: smooth, so that every way of sampling has a variance that can be measured.
    #[inline]
    pub(super) fn radiance(&self, wi: Vec3<f32>) -> [f32; 3] {
        [1.0, self.lobe(self.mirror, wi), self.lobe(self.side, wi)]
    }

    #[inline]
    fn lobe(&self, axis: Vec3<f32>, wi: Vec3<f32>) -> f32 {
        Real::exp(self.sharpness * (axis.dot(wi) - 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lights_are_brightest_on_their_axes_and_fall_to_one_over_e() {
        let wo = Vec3::<f32>::new(0.6, 0.0, 0.8);
        let lights = Lights::seen_from(wo);
        let [_, mirror, _] = lights.radiance(Vec3::<f32>::new(-0.6, 0.0, 0.8));
        let [white, _, side] = lights.radiance(Vec3::<f32>::new(0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2));
        // The sharpness 263 times a few ε of the cosine.
        assert!((mirror - 1.0).abs() < 1e-4 && (side - 1.0).abs() < 1e-4 && white == 1.0);
        let angle = LIGHT_DEGREES.to_radians() as f32 + Real::acos(0.8_f32);
        let edge = Vec3::<f32>::new(-Real::sin(angle), 0.0, Real::cos(angle));
        let [_, edge, _] = lights.radiance(edge);
        assert!((edge - Real::exp(-1.0_f32)).abs() < 1e-3, "{edge}");
    }
}
