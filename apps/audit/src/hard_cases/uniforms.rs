//! Uniform numbers from integers.

use etendue_math::Real;

use super::HardCase;
use crate::measure::{Outcome, Worst};

/// `x · 2⁻³²` rounds to 1 for the last 128 values of x.
pub(super) const CASE: HardCase = HardCase {
    name: "never 1",
    function: "Real::from_random_bits",
    problem: "x · 2⁻³² rounds to 1 for the last 128 integers",
    remedy: "(x >> 8) · 2⁻²⁴",
    sound: || sweep(|bits| Real::from_random_bits(u64::from(bits) << 32)),
    naive: || sweep(|bits| bits as f32 * (1.0 / 4_294_967_296.0)),
};

/// Every number must be in `[0, 1)`; the figure is its excess over the largest of them.
fn sweep(form: fn(u32) -> f32) -> Outcome {
    let mut worst = Worst::default();
    for bits in (0..1000).chain((u32::MAX - 1000)..=u32::MAX) {
        let u = form(bits);
        let excess = if u >= 0.0 { f64::from(u) - f64::from(f32::ONE_MINUS_EPSILON) } else { 1.0 };
        worst.observe(excess, || format!("bits {bits:#x}: {u:?}"));
    }
    worst.within(0.0, "excess")
}
