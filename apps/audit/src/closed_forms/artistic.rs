//! Metals by reflectivity and edge tint.

use etendue_brdf::fresnel::{artistic_from_conductor, conductor_from_artistic};
use etendue_math::Real;

use super::ClosedForm;
use crate::budget::Budget;
use crate::cases::textbook;
use crate::measure::{Outcome, Worst};
use crate::scalar::{Scalar, shared};

/// η and k as Gulbrandsen 2014 prints them, and the reflectance that was asked for.
pub(super) const FORWARD: ClosedForm = ClosedForm {
    function: "fresnel::conductor_from_artistic",
    name: "as published",
    single: forward::<f32>,
    double: forward::<f64>,
};

/// There and back.
pub(super) const BACK: ClosedForm = ClosedForm {
    function: "fresnel::artistic_from_conductor",
    name: "is the inverse",
    single: back::<f32>,
    double: back::<f64>,
};

fn metals<T: Scalar>() -> impl Iterator<Item = [T; 2]> {
    [0.2, 0.5, 0.8, 0.95].into_iter().flat_map(|r| [0.2, 0.5, 0.9].map(|g| [r, g].map(shared)))
}

/// Bound: 1e-9, which the published k² leaves of `f64`, and 16 ε, a dozen roundings.
fn forward<T: Scalar>(_: Budget) -> Outcome {
    let mut worst = Worst::default();
    for [r, g] in metals::<T>() {
        let [eta, k] = conductor_from_artistic(r, g).map(Real::to_f64);
        let (x, y, s) = (r.to_f64(), g.to_f64(), r.to_f64().sqrt());
        let n = y * (1.0 - x) / (1.0 + x) + (1.0 - y) * (1.0 + s) / (1.0 - s);
        let k2 = (x * Real::sqr(n + 1.0) - Real::sqr(n - 1.0)) / (1.0 - x);
        let normal = textbook::conductor(1.0, [eta, k]);
        for (got, want) in [(eta, n), (k, k2.sqrt()), (normal, x)] {
            worst.observe((got / want - 1.0).abs(), || format!("r {r:?}, g {g:?}: {got} {want}"));
        }
    }
    worst.within(1e-9 + 16.0 * T::EPSILON.to_f64(), "relative")
}

/// Bound: 32 ε, two dozen roundings; none of the differences in between cancels.
fn back<T: Scalar>(_: Budget) -> Outcome {
    let mut worst = Worst::default();
    for [r, g] in metals::<T>() {
        let [eta, k] = conductor_from_artistic(r, g);
        let [again, tint] = artistic_from_conductor(eta, k);
        for (got, want) in [(again, r), (tint, g)] {
            let ulp = super::ulps(got, want.to_f64());
            worst.observe(ulp, || format!("r {r:?}, g {g:?}: {got:?} {want:?}"));
        }
    }
    worst.within(32.0, "ulp")
}
