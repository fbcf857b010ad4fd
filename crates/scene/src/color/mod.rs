//! Colours from spectra.

mod cie;
mod spectrum;

pub use spectrum::{SpectrumRole, equal_energy_white, spectrum_to_rgb};
