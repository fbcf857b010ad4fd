//! Diffuse reflectors.

pub(crate) mod burley;
mod cltc;
mod cosine;
pub(crate) mod diffuse_transmitter;
pub(crate) mod eon;
pub mod fon;
pub(crate) mod lambert;
pub(crate) mod oren_nayar;
pub(crate) mod oren_nayar_fujii;
pub(crate) mod oren_nayar_qualitative;

pub use burley::Burley;
pub use cltc::ClippedCosine;
pub use diffuse_transmitter::DiffuseTransmitter;
pub use eon::{Eon, EonAlbedo, EonSampling};
pub use lambert::Lambert;
pub use oren_nayar::OrenNayar;
pub use oren_nayar_fujii::OrenNayarFujii;
pub use oren_nayar_qualitative::OrenNayarQualitative;
