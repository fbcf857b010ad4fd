//! Error against cost of every function that can be computed in more than one way.
//!
//! ```text
//! FamilyInfo ── build ──► Family ── measure ──► Measured ── section ──► part of a Report
//!                           ├── Domain       the points at which values are compared, and sums that are energies
//!                           ├── Reference    what every variant is compared with, and how far that can be trusted
//!                           └── Variant      one way of computing it, in one precision
//! ```
//!
//! A variant is one closure: what is measured is what is timed. To add a family, write one file in `families` and
//! list it in [`FAMILIES`].

mod domain;
mod families;
mod family;
mod measure;
mod reference;
mod report;
mod variant;

pub use domain::{Domain, Probe};
pub use families::FAMILIES;
pub use family::{ErrorKind, Family, FamilyInfo, Setup};
pub use measure::{Errors, Measured, MeasuredVariant, measure};
pub use reference::{DoubleDouble, Effort, Reference, Uncertainty, VCavities};
pub use report::{introduction, section};
pub use variant::{Precision, Variant};
