//! Schlick's curve with an edge tint at 82°.

use etendue_brdf::Reflectance;
use etendue_brdf::fresnel::F82Tint;
use etendue_math::Real;

use super::ClosedForm;
use crate::budget::Budget;
use crate::cases::textbook::cosine_average;
use crate::measure::{Outcome, Worst};
use crate::scalar::{Scalar, shared};

/// The published curve, `F − F(1/7) (1 − tint) c (1 − c)⁶ / ((1/7) (6/7)⁶)`, limited to `[0, 1]`.
pub(super) const CURVE: ClosedForm = ClosedForm {
    function: "fresnel::F82Tint",
    name: "as published",
    single: curve::<f32>,
    double: curve::<f64>,
};

/// Its average where the curve is not cut off at 0.
pub(super) const AVERAGE: ClosedForm = ClosedForm {
    function: "fresnel::F82Tint",
    name: "average is the integral",
    single: average::<f32>,
    double: average::<f64>,
};

fn published(f0: f64, tint: f64, c: f64) -> f64 {
    let schlick = |c| f0 + (1.0 - f0) * Real::powi(1.0 - c, 5);
    let peak = Real::powi(6.0 / 7.0, 6) / 7.0;
    let dip = schlick(1.0 / 7.0) * (1.0 - tint) * c * Real::powi(1.0 - c, 6) / peak;
    (schlick(c) - dip).clamp(0.0, 1.0)
}

fn metals<T: Scalar>() -> impl Iterator<Item = [T; 2]> {
    [0.04, 0.3, 0.9].into_iter().flat_map(|f0| [0.6, 0.8, 1.0].map(|tint| [f0, tint].map(shared)))
}

/// Bound: 8 ulp of 1, a dozen roundings of terms up to 2.
fn curve<T: Scalar>(_: Budget) -> Outcome {
    let mut worst = Worst::default();
    for [f0, tint] in metals::<T>() {
        let [f, t] = [f0, tint].map(Real::to_f64);
        let (color, edge) = (Reflectance::clamped(f0), Reflectance::clamped(tint));
        // The same metal, by its colour at 82°.
        let at_peak = Reflectance::clamped(T::lit(published(f, t, 1.0 / 7.0)));
        for metal in [F82Tint::new(color, edge), F82Tint::from_f82(color, at_peak)] {
            for i in 0..=200 {
                let c = shared::<T>(f64::from(i) / 200.0);
                let error = metal.reflectance(c).to_f64() - published(f, t, c.to_f64());
                let ulp = error.abs() / T::EPSILON.to_f64();
                worst.observe(ulp, || format!("F0 {f0:?}, tint {tint:?}, cos {c:?}"));
            }
        }
    }
    worst.within(8.0, "ulp of 1")
}

/// Bound: 1e-6, the error of the midpoint rule and of `f32`.
fn average<T: Scalar>(_: Budget) -> Outcome {
    let mut worst = Worst::default();
    for [f0, tint] in metals::<T>() {
        let [f, t] = [f0, tint].map(Real::to_f64);
        let want = cosine_average(|c| published(f, t, c));
        let metal = F82Tint::new(Reflectance::clamped(f0), Reflectance::clamped(tint));
        let error = metal.average().to_f64() - want;
        worst.observe(error.abs(), || format!("F0 {f0:?}, tint {tint:?}"));
    }
    worst.within(1e-6, "of 1")
}
