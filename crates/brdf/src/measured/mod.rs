//! Reflection as it was measured.

mod half_difference;
pub(crate) mod merl;
mod table;
mod tabulate;

pub use merl::{Interpolation, Measured};
pub use table::{MerlError, MerlTable};
pub use tabulate::tabulate;
