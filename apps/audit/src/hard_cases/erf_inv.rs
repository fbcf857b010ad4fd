//! The inverse error function in double precision.

use etendue_math::special::{erf, erf_inv};

use super::{HardCase, decades};
use crate::measure::{Outcome, Worst};

/// The polynomials in use everywhere were fitted for single precision.
pub(super) const CASE: HardCase = HardCase {
    name: "in f64",
    function: "special::erf_inv",
    problem: "Giles' polynomial has the digits of single precision, and so have slopes drawn with it",
    remedy: "two Newton steps on erf after the polynomial",
    sound: || sweep(erf_inv::<f64>),
    naive: || sweep(|x| f64::from(erf_inv(x as f32))),
};

/// `erf(erf_inv(x)) = x` within 8 ulp of 1: what the last Newton step leaves of erf's own error.
fn sweep(form: fn(f64) -> f64) -> Outcome {
    let mut worst = Worst::default();
    for distance in decades(-6.0, 0.0, 500) {
        for x in [1.0 - f64::from(distance), f64::from(distance) - 1.0] {
            let error = (erf(form(x)) - x).abs() / f64::EPSILON;
            worst.observe(error, || format!("x {x:?}"));
        }
    }
    worst.within(8.0, "ulp of 1")
}
