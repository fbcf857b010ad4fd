//! Metals given by colours, up to a reflectance of 1.

use etendue_brdf::fresnel::conductor_from_artistic;

use super::{HardCase, decades, relative};
use crate::measure::{Outcome, Worst};

/// The published form divides by `1 − √r`, which is 0 for r = 1, and takes the root of
/// `(r (η + 1)² − (η − 1)²)/(1 − r)`, which rounding makes negative for small edge tints.
pub(super) const CASE: HardCase = HardCase {
    name: "reflectance to 1, tint to 0",
    function: "fresnel::conductor_from_artistic",
    problem: "√((r (η + 1)² − (η − 1)²)/(1 − r)) divides by 0 for r = 1 and takes the root of a negative for g = 0",
    remedy: "factors that do not cancel, and the limits by name",
    sound: || sweep(conductor_from_artistic),
    naive: || sweep(published),
};

/// η and k against `f64`, 2e-6 relative: some fifteen roundings. At r = 1 they must be finite.
fn sweep(form: fn(f32, f32) -> [f32; 2]) -> Outcome {
    let mut worst = Worst::default();
    let below_one = decades(-7.0, -0.5, 60).map(|d| 1.0 - d);
    for r in decades(-6.0, -0.3, 40).chain(below_one).chain([1.0]) {
        for g in decades(-6.0, 0.0, 40) {
            let got = form(r, g);
            let want = conductor_from_artistic(f64::from(r), f64::from(g));
            for (got, want) in got.into_iter().zip(want) {
                let error = if r == 1.0 && got.is_finite() { 0.0 } else { relative(got, want) };
                worst.observe(error, || format!("r {r:?}, g {g:?}"));
            }
        }
    }
    worst.within(2e-6, "relative")
}

fn published(r: f32, g: f32) -> [f32; 2] {
    let s = r.sqrt();
    let eta = g * (1.0 - r) / (1.0 + r) + (1.0 - g) * (1.0 + s) / (1.0 - s);
    let [plus, minus] = [eta + 1.0, eta - 1.0];
    [eta, ((r * plus * plus - minus * minus) / (1.0 - r)).sqrt()]
}
