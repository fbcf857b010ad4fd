//! OpenPBR's surface model without what lets light through.

mod base;
mod coat;
mod fuzz;
mod fuzz_table;
mod interface;
mod metal;
mod parameters;
pub(crate) mod surface;

pub use fuzz_table::FuzzTable;
pub use parameters::OpenPbrParameters;
pub use surface::OpenPbr;
