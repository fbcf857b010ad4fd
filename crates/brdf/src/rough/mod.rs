//! Surfaces of microfacets, and the types that choose between smooth and rough.

pub(crate) mod conductor;
pub(crate) mod dielectric;
pub(crate) mod kulla_conty;
pub(crate) mod kulla_conty_dielectric;
pub(crate) mod rough_conductor;
pub(crate) mod rough_dielectric;
pub(crate) mod smooth_or_rough;
pub(crate) mod turquin;

pub use conductor::Conductor;
pub use dielectric::Dielectric;
pub use kulla_conty::KullaContyConductor;
pub use kulla_conty_dielectric::KullaContyDielectric;
pub use rough_conductor::RoughConductor;
pub use rough_dielectric::RoughDielectric;
pub use turquin::TurquinConductor;
