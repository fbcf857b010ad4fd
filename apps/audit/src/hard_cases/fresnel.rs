//! Dielectric Fresnel, η → 1.

use etendue_brdf::fresnel::{dielectric, dielectric_textbook};

use super::{HardCase, decades, relative};
use crate::measure::{Outcome, Worst};

/// The textbook quotients subtract `cos θi − η cos θt`, which all but cancel when η is close to 1.
pub(super) const CASE: HardCase = HardCase {
    name: "index near 1",
    function: "fresnel::dielectric",
    problem: "the quotients of cos θi − η cos θt cancel: 27 % off at η = 1 + 5e-7",
    remedy: "k = (η − 1)(η + 1), g = √(k + c²), rs = k/(g + c)²",
    sound: || sweep(dielectric),
    naive: || sweep(dielectric_textbook),
};

/// Bound: 7e-7 relative, about six ulp; the naive form is wrong by 27 % at η = 1 + 5e-7.
fn sweep(form: fn(f32, f32) -> f32) -> Outcome {
    let mut worst = Worst::default();
    for eta in decades(-6.5, 0.0, 200).map(|d| 1.0 + d) {
        for c in decades(-3.0, 0.0, 100) {
            // In f64 the textbook form loses 2⁻²⁹ of what it loses in f32: 5e-10 here.
            let want = dielectric_textbook(f64::from(c), f64::from(eta));
            worst.observe(relative(form(c, eta), want), || format!("η {eta:?}, cos {c:?}"));
        }
    }
    worst.within(7e-7, "relative")
}
