//! A base under an interface.

pub(crate) mod any_coupled;
pub(crate) mod any_plastic;
pub(crate) mod coupled;
mod coupled_interface;
mod internal_scattering;
pub(crate) mod layered_fresnel;
pub(crate) mod layered_linear;
mod mirror_over_matte;
pub(crate) mod plastic;
pub(crate) mod rough_coupled;
pub(crate) mod rough_plastic;
mod stochastic;
mod transmittance_table;

pub use any_coupled::AnyCoupled;
pub use any_plastic::{AnyPlastic, PlasticSurface};
pub use coupled::Coupled;
pub use coupled_interface::CoupledInterface;
pub use internal_scattering::{InternalReflectance, InternalScattering};
pub use layered_fresnel::LayeredFresnel;
pub use layered_linear::LayeredLinear;
pub use mirror_over_matte::MirrorOverMatte;
pub use plastic::{Plastic, PlasticInterface};
pub use rough_coupled::RoughCoupled;
pub use rough_plastic::RoughPlastic;
pub use stochastic::StochasticLayers;
pub use transmittance_table::TransmittanceTable;
