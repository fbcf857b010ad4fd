//! Fresnel reflectance of smooth interfaces, and refraction.
//!
//! Scalar functions take the cosine of the angle of incidence in `[0, 1]`. Rounding may carry a
//! cosine a little above 1: up to 1.001 it counts as 1. Elsewhere, and for NaN, they give 0.
//!
//! | interface | exact | cheaper | average over the hemisphere |
//! | --- | --- | --- | --- |
//! | dielectric | [`dielectric`], [`dielectric_transmittance`] | [`schlick`] | [`dielectric_average`]; fits [`dielectric_average_fit`], [`dielectric_average_quotient_fit`] |
//! | conductor | [`conductor`], also by [`conductor_from_artistic`] | [`F82Tint`], [`schlick`] | [`conductor_average`]; fit [`conductor_average_fit`] |
//! | Schlick | [`schlick`], [`schlick_transmittance`] | [`schlick_gaussian`] | [`schlick_average`] |
//!
//! Indices may depend on the wavelength: [`Dispersion`], with real media in [`GLASSES`].
//!
//! [`dielectric_textbook`], [`conductor_textbook`], [`schlick_powf`] and [`schlick_gaussian`] are what other
//! programs use, here to be measured against: what they save and where they break.

mod artistic;
mod average;
mod conductor;
mod dielectric;
mod dispersion;
mod f82;
mod refraction;
mod relative_index;
mod schlick;
mod textbook;

pub use artistic::{artistic_from_conductor, conductor_from_artistic};
pub use average::{
    conductor_average, conductor_average_fit, dielectric_average, dielectric_average_fit,
    dielectric_average_quotient_fit, dielectric_average_transmittance, schlick_average,
};
pub use conductor::conductor;
pub(crate) use conductor::conductor_of_valid;
pub use dielectric::{dielectric, dielectric_polarized, dielectric_transmittance};
pub use dispersion::{Dispersion, GLASSES, Glass};
pub use f82::F82Tint;
pub(crate) use refraction::{Refraction, refract_at};
pub use refraction::{refract, refract_about};
pub(crate) use relative_index::RelativeIndex;
pub(crate) use schlick::schlick_of_versine;
pub use schlick::{f0_from_ior, ior_from_f0, schlick, schlick_transmittance};
pub use textbook::{conductor_textbook, dielectric_textbook, schlick_gaussian, schlick_powf};

use etendue_math::Real;

/// A cosine of incidence limited to 1, or `None` outside the domain.
#[inline(always)]
fn checked_cosine<T: Real>(cos: T) -> Option<T> {
    (cos >= T::ZERO && cos <= T::lit(1.001)).then(|| cos.min(T::ONE))
}
