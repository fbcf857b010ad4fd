//! Reflection models.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(any(feature = "std", test))]
extern crate std;

mod bsdf;
mod conductor;
mod dielectric;
pub mod direction;
pub mod fresnel;
mod internal_scattering;
mod lambert;
#[cfg(test)]
mod laws;
mod mask;
pub mod microfacet;
mod null;
mod oren_nayar;
mod oren_nayar_qualitative;
mod param;
mod plastic;
pub mod quadrature;
mod rough_conductor;
mod rough_dielectric;
mod rough_plastic;
mod smooth_conductor;
mod smooth_dielectric;
mod thin_dielectric;
mod transmittance_table;
mod two_sided;

pub use bsdf::{Bsdf, BsdfReal, BsdfVec, Density, Lobes, Sample};
pub use conductor::Conductor;
pub use dielectric::Dielectric;
pub use internal_scattering::{InternalReflectance, InternalScattering};
pub use lambert::Lambert;
pub use mask::Mask;
pub use microfacet::{BeckmannLambda, Distribution, Masking, Microfacets};
pub use null::Null;
pub use oren_nayar::OrenNayar;
pub use oren_nayar_qualitative::OrenNayarQualitative;
pub use param::{Alpha, ComplexIor, Ior, Opacity, ParameterError, Reflectance, Sigma};
pub use plastic::{Plastic, PlasticInterface};
pub use rough_conductor::RoughConductor;
pub use rough_dielectric::RoughDielectric;
pub use rough_plastic::RoughPlastic;
pub use smooth_conductor::SmoothConductor;
pub use smooth_dielectric::SmoothDielectric;
pub use thin_dielectric::ThinDielectric;
pub use transmittance_table::TransmittanceTable;
pub use two_sided::TwoSided;
