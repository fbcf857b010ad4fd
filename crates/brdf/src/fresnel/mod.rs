//! Fresnel reflectance of smooth interfaces, and refraction.
//!
//! Scalar functions take the cosine of the angle of incidence in `[0, 1]`. Rounding may carry a
//! cosine a little above 1: up to 1.001 it counts as 1. Elsewhere, and for NaN, they give 0.

mod average;
mod conductor;
mod dielectric;
mod refraction;
mod relative_index;
mod schlick;

pub use average::{dielectric_average, dielectric_average_fit, schlick_average};
pub use conductor::conductor;
pub(crate) use conductor::conductor_of_valid;
pub use dielectric::{dielectric, dielectric_polarized, dielectric_transmittance};
pub(crate) use refraction::{Refraction, refract_at};
pub use refraction::{refract, refract_about};
pub(crate) use relative_index::RelativeIndex;
pub use schlick::{f0_from_ior, ior_from_f0, schlick};

use etendue_math::Real;

/// A cosine of incidence limited to 1, or `None` outside the domain.
#[inline(always)]
fn checked_cosine<T: Real>(cos: T) -> Option<T> {
    (cos >= T::ZERO && cos <= T::lit(1.001)).then(|| cos.min(T::ONE))
}
