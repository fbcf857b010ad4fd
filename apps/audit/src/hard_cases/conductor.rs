//! Conductor Fresnel near the dielectric limit.

use etendue_brdf::fresnel::{conductor, conductor_textbook};

use super::{HardCase, decades, relative};
use crate::measure::{Outcome, Worst};

/// The common form takes the root of `√(t² + 4η²k²) + t`, which cancels for t < 0, and subtracts
/// `2 a cos θ` from a sum it almost equals.
pub(super) const CASE: HardCase = HardCase {
    name: "small k, index near 1",
    function: "fresnel::conductor",
    problem: "√(t² + 4η²k²) + t cancels for t < 0, and 2 a cos θ all but equals what it is taken from",
    remedy: "the larger part of the complex root, the smaller from their product; quotients without differences",
    sound: || sweep(conductor),
    naive: || sweep(conductor_textbook),
};

/// Bound: 3e-6 relative, some twenty ulp for a complex root and four quotients; the naive form is
/// off by more than its value.
fn sweep(form: fn(f32, f32, f32) -> f32) -> Outcome {
    let mut worst = Worst::default();
    let indices =
        decades(-6.0, -1.0, 12).flat_map(|d| [1.0 + d, 1.0 - d]).chain([0.0, 0.2, 1.5, 4.0]);
    for eta in indices {
        for k in decades(-5.0, 1.0, 25) {
            for c in decades(-3.0, 0.0, 30) {
                let want = exact(f64::from(c), f64::from(eta), f64::from(k));
                worst.observe(relative(form(c, eta, k), want), || {
                    format!("η {eta:?}, k {k:?}, cos {c:?}")
                });
            }
        }
    }
    worst.within(3e-6, "relative")
}

/// The definition by complex numbers: `q = √(n² − sin²θ)`, `rs = (c − q)/(c + q)`,
/// `rp = (n² c − q)/(n² c + q)`, in `f64`.
fn exact(c: f64, eta: f64, k: f64) -> f64 {
    let n2 = [(eta - k) * (eta + k), 2.0 * eta * k];
    let x = (eta - 1.0) * (eta + 1.0) - k * k + c * c;
    let modulus = (x * x + n2[1] * n2[1]).sqrt();
    let large = (0.5 * (modulus + x.abs())).sqrt();
    let small = if large > 0.0 { 0.5 * n2[1] / large } else { 0.0 };
    let q = if x >= 0.0 { [large, small] } else { [small, large] };
    let squared = |a: f64, b: f64| a * a + b * b;
    let rs = squared(c - q[0], q[1]) / squared(c + q[0], q[1]);
    let rp =
        squared(n2[0] * c - q[0], n2[1] * c - q[1]) / squared(n2[0] * c + q[0], n2[1] * c + q[1]);
    0.5 * (rs + rp)
}
