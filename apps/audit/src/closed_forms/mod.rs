//! Functions and random walks that are no models, against what is known of them otherwise: closed forms,
//! published formulas read literally, definitions, exact limits.
//!
//! Models answer for the functions they are made of. What no model uses, or what a model uses in value
//! and albedo alike, answers here, in both precisions.

mod absorption;
mod artistic;
mod averages;
mod dispersion;
mod f82;
mod layers;
mod loss_tables;
mod merl;
mod radiometry;
mod random;
mod slabs;
mod walks;
mod warps;

use etendue_math::Real;

use crate::budget::Budget;
use crate::measure::Outcome;

/// What is asserted of one function.
pub struct ClosedForm {
    /// The function audited.
    pub function: &'static str,
    /// What is known of it, as the report and `--filter` name it.
    pub name: &'static str,
    /// The check in `f32`.
    pub single: fn(Budget) -> Outcome,
    /// The same in `f64`.
    pub double: fn(Budget) -> Outcome,
}

/// All of them, in the order of the report.
pub const CLOSED_FORMS: &[ClosedForm] = &[
    averages::EXACT,
    averages::FITS,
    f82::CURVE,
    f82::AVERAGE,
    artistic::FORWARD,
    artistic::BACK,
    absorption::CASE,
    radiometry::CASE,
    slabs::SERIES,
    dispersion::ANGLES,
    warps::JACOBIAN,
    warps::ROUND_TRIP,
    loss_tables::INTEGRAL,
    loss_tables::TABLE,
    loss_tables::AVERAGE,
    walks::FURNACE,
    walks::CONDUCTOR,
    walks::VALUES,
    walks::DIELECTRIC,
    walks::ETENDUE,
    layers::PLASTIC,
    layers::ABSORPTION,
    layers::ROUGH,
    merl::NEAREST,
    merl::TRILINEAR,
];

/// Relative error in units of the precision's ε.
fn ulps<T: Real>(got: T, want: f64) -> f64 {
    (got.to_f64() - want).abs() / (want.abs() * T::EPSILON.to_f64())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_closed_form_holds() {
        for form in CLOSED_FORMS {
            for outcome in [(form.single)(Budget::TEST), (form.double)(Budget::TEST)] {
                assert!(outcome.passed(), "{} {}: {outcome:?}", form.function, form.name);
            }
        }
    }
}
