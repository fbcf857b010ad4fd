//! Where a medium scatters light to.

use etendue_math::Frame;
use etendue_math::glam::Vec3;
use etendue_sampling::warp::henyey_greenstein::HenyeyGreenstein;
use etendue_sampling::warp::uniform_sphere;

/// The density per steradian with which scattered light changes its direction.
///
/// Both functions sample themselves exactly, so that what they scatter has weight 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Phase {
    /// Everywhere alike: 1/4π.
    Isotropic,
    /// Forwards or backwards.
    HenyeyGreenstein(HenyeyGreenstein<f32>),
}

impl Phase {
    /// The phase function and its density, which are the same, from the unit direction of travel
    /// `along` to the unit direction `to`.
    #[inline]
    pub fn eval(&self, along: Vec3, to: Vec3) -> f32 {
        match self {
            Self::Isotropic => uniform_sphere::pdf(),
            Self::HenyeyGreenstein(lobe) => lobe.pdf_around(along, to),
        }
    }

    /// A direction by the phase function, and its density.
    #[inline]
    pub fn sample(&self, along: Vec3, u: [f32; 2]) -> (Vec3, f32) {
        match self {
            Self::Isotropic => (uniform_sphere::from_square(u), uniform_sphere::pdf()),
            Self::HenyeyGreenstein(lobe) => {
                let local = lobe.from_square(u);
                (Frame::<f32>::from_normal(along).to_world(local), lobe.pdf(local))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_density_of_a_sampled_direction_is_the_phase_function_there() {
        let forwards = HenyeyGreenstein::new(0.8).expect("in (−1, 1)");
        let along = Vec3::new(0.48, -0.6, 0.64);
        for phase in [Phase::Isotropic, Phase::HenyeyGreenstein(forwards)] {
            for i in 0..64 {
                let u = [(i % 8) as f32 / 8.0, (i / 8) as f32 / 8.0];
                let (to, density) = phase.sample(along, u);
                // Unit vectors rounded once: 1e-7 of 1 − cos θ + 0.02, cubed.
                assert!((phase.eval(along, to) / density - 1.0).abs() < 1e-4, "{phase:?} {u:?}");
            }
        }
    }
}
