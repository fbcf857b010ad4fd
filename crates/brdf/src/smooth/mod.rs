//! Surfaces without roughness: delta lobes alone.

pub(crate) mod absorbing_slab;
pub(crate) mod null;
pub(crate) mod smooth_conductor;
pub(crate) mod smooth_dielectric;
pub(crate) mod thin_dielectric;

pub use absorbing_slab::AbsorbingSlab;
pub use null::Null;
pub use smooth_conductor::SmoothConductor;
pub use smooth_dielectric::SmoothDielectric;
pub use thin_dielectric::ThinDielectric;
