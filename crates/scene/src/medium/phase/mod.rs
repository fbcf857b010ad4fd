//! Where a medium scatters light to.

mod blend;
mod tabulated;

use alloc::boxed::Box;

use etendue_math::glam::Vec3;
use etendue_math::{Frame, Vector3};
use etendue_sampling::warp::henyey_greenstein::HenyeyGreenstein;
use etendue_sampling::warp::{rayleigh, uniform_sphere};

pub use blend::BlendPhase;
pub use tabulated::TabulatedPhase;

/// The density per steradian with which scattered light changes its direction.
///
/// All functions sample themselves exactly, so that what they scatter has weight 1.
#[derive(Clone, Debug)]
pub enum Phase {
    /// Everywhere alike: 1/4π.
    Isotropic,
    /// Forwards or backwards.
    HenyeyGreenstein(HenyeyGreenstein<f32>),
    /// Forwards and backwards alike, as by particles that are small beside a wavelength: 3(1 + cos² θ)/16π.
    Rayleigh,
    /// By a table over the cosine.
    Tabulated(TabulatedPhase),
    /// Two others in shares.
    Blend(Box<BlendPhase>),
}

impl Phase {
    /// Whether light is scattered everywhere alike.
    pub fn is_isotropic(&self) -> bool {
        matches!(self, Self::Isotropic)
    }

    /// The phase function at a point of the world and its density, which are the same, from the unit direction of
    /// travel `along` to the unit direction `to`.
    #[inline]
    pub fn eval(&self, position: Vec3, along: Vec3, to: Vec3) -> f32 {
        match self {
            Self::Isotropic => uniform_sphere::pdf(),
            Self::HenyeyGreenstein(lobe) => lobe.pdf_around(along, to),
            Self::Rayleigh => rayleigh::pdf(Vector3::dot(along, to)),
            Self::Tabulated(table) => table.eval(Vector3::dot(along, to)),
            Self::Blend(blend) => blend.eval(position, along, to),
        }
    }

    /// A direction by the phase function at a point of the world, and its density.
    #[inline]
    pub fn sample(&self, position: Vec3, along: Vec3, u: [f32; 2]) -> (Vec3, f32) {
        let around = |local: Vec3| Frame::<f32>::from_normal(along).to_world(local);
        match self {
            Self::Isotropic => (uniform_sphere::from_square(u), uniform_sphere::pdf()),
            Self::HenyeyGreenstein(lobe) => {
                let local = lobe.from_square(u);
                (around(local), lobe.pdf(local))
            }
            Self::Rayleigh => {
                let local = rayleigh::from_square(u);
                (around(local), rayleigh::pdf(local.z))
            }
            Self::Tabulated(table) => {
                let (local, density) = table.sample(u);
                (around(local), density)
            }
            Self::Blend(blend) => blend.sample(position, along, u),
        }
    }
}

#[cfg(test)]
mod tests;
