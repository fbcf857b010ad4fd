//! Models put together from many lobes under artists' parameters: Disney's as Mitsuba defines them.

mod clearcoat;
mod diffuse;
mod domains;
mod facets;
mod fresnel;
mod gtr1;
mod sheen;
pub(crate) mod solid;
mod solid_parameters;
pub(crate) mod thin;
mod thin_parameters;

pub use solid::Principled;
pub use solid_parameters::PrincipledParameters;
pub use thin::PrincipledThin;
pub use thin_parameters::PrincipledThinParameters;
