//! Colours and spectra.

mod channels;
mod cie;
mod curve;
mod primaries;
mod spectrum;
mod wavelengths;

pub use channels::{Channels, Primaries};
pub use curve::Curve;
pub use spectrum::{SpectrumRole, equal_energy_white, spectrum_to_rgb};
pub use wavelengths::Wavelengths;
