//! Cones of far lights.

use etendue_sampling::warp::cone::Cone;

use super::{HardCase, decades, relative};
use crate::measure::{Outcome, Worst};

/// `1 − √(1 − s²)` is wrong by 7 % at s = 1e-3 and by 100 % at 1e-4.
pub(super) const CASE: HardCase = HardCase {
    name: "small cones",
    function: "Cone::from_sine",
    problem: "1 − √(1 − s²): 7 % off at s = 1e-3, all of it at 1e-4",
    remedy: "s²/(1 + √(1 − s²))",
    sound: || sweep(|s| Cone::from_sine(s).one_minus_cos()),
    naive: || sweep(|s| 1.0 - (1.0 - s * s).sqrt()),
};

/// Bound: 4 ulp, a root, a quotient and three products.
fn sweep(form: fn(f32) -> f32) -> Outcome {
    let mut worst = Worst::default();
    for s in decades(-15.0, 0.0, 1000) {
        let wide = f64::from(s);
        let want = wide * wide / (1.0 + ((1.0 - wide) * (1.0 + wide)).sqrt());
        worst.observe(relative(form(s), want) / f64::from(f32::EPSILON), || format!("s {s:?}"));
    }
    worst.within(4.0, "ulp")
}
