//! Models made of other models.

pub(crate) mod blend;
pub(crate) mod mask;
pub(crate) mod two_sided;

pub use blend::Blend;
pub use mask::Mask;
pub use two_sided::TwoSided;
