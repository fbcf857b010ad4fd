//! Combination weights of infinite, huge, tiny and zero densities.

use etendue_sampling::mis;

use super::HardCase;
use crate::measure::{Outcome, Worst};

/// `p²/(p² + q²)` is ∞/∞ for large and 0/0 for small densities.
pub(super) const CASE: HardCase = HardCase {
    name: "extreme densities",
    function: "mis::power",
    problem: "p²/(p² + q²) is ∞/∞ for large and 0/0 for small densities",
    remedy: "1/(1 + (q/p)²), ratio first",
    sound: || sweep(mis::power::<f32>),
    naive: || sweep(|p, q| p * p / (p * p + q * q)),
};

/// Weights against the definition in `f64`, where nothing overflows: 4 ulp, two quotients, a product
/// and a sum, or the smallest normal number. Those with an infinite density lie in [0, 1].
fn sweep(form: fn(f32, f32) -> f32) -> Outcome {
    let densities =
        [0.0, 1e-45, 1e-30, 1e-19, 1e-3, 1.0, 3.0, 1e3, 1e19, 1e30, f32::MAX, f32::INFINITY];
    let mut worst = Worst::default();
    for p in densities {
        for q in densities {
            let (w, [a, b]) = (form(p, q), [p, q].map(f64::from));
            let error = if !(0.0..=1.0).contains(&w) {
                f64::INFINITY
            } else if a + b == 0.0 {
                f64::from(w) // a sample that nobody draws counts for nothing
            } else if a + b < f64::INFINITY {
                let want = a * a / (a * a + b * b);
                let ulp = want * f64::from(f32::EPSILON) + f64::from(f32::MIN_POSITIVE);
                (f64::from(w) - want).abs() / ulp
            } else {
                0.0
            };
            worst.observe(error, || format!("p {p:?}, q {q:?}: {w:?}"));
        }
    }
    worst.within(4.0, "ulp")
}
