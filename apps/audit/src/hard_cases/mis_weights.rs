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

/// Weights lie in [0, 1] and those of two strategies sum to 1 within 2 ulp, unless neither can
/// draw the sample.
fn sweep(form: fn(f32, f32) -> f32) -> Outcome {
    let densities =
        [0.0, 1e-45, 1e-30, 1e-19, 1e-3, 1.0, 3.0, 1e3, 1e19, 1e30, f32::MAX, f32::INFINITY];
    let mut worst = Worst::default();
    for p in densities {
        for q in densities {
            let (w, v) = (form(p, q), form(q, p));
            let inside = (0.0..=1.0).contains(&w);
            // Two infinite densities have no ratio: any weights that are numbers will do.
            let summing = (p == 0.0 && q == 0.0) || (p == q && p == f32::INFINITY);
            let error = if !inside {
                f64::INFINITY
            } else if summing {
                0.0
            } else {
                (f64::from(w) + f64::from(v) - 1.0).abs() / f64::from(f32::EPSILON)
            };
            worst.observe(error, || format!("p {p:?}, q {q:?}: {w:?}"));
        }
    }
    worst.within(2.0, "ulp of 1")
}
