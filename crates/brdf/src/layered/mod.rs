//! A base under an interface.

mod internal_scattering;
pub(crate) mod plastic;
pub(crate) mod rough_plastic;
mod stochastic;
mod transmittance_table;

pub use internal_scattering::{InternalReflectance, InternalScattering};
pub use plastic::{Plastic, PlasticInterface};
pub use rough_plastic::RoughPlastic;
pub use stochastic::StochasticLayers;
pub use transmittance_table::TransmittanceTable;
