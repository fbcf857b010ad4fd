//! Diffuse reflectors.

mod cosine;
pub(crate) mod lambert;
pub(crate) mod oren_nayar;
pub(crate) mod oren_nayar_qualitative;

pub use lambert::Lambert;
pub use oren_nayar::OrenNayar;
pub use oren_nayar_qualitative::OrenNayarQualitative;
