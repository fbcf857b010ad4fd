//! Beer and Lambert's law.

use etendue_brdf::{Absorption, OpticalDepth, Reflectance};
use etendue_math::Real;

use super::{ClosedForm, ulps};
use crate::budget::Budget;
use crate::measure::{Outcome, Worst};
use crate::scalar::{Scalar, shared};

/// `exp(−σ d)`, `−ln t / d`, and `exp(−τ / |cos θ|)` with its complement.
pub(super) const CASE: ClosedForm = ClosedForm {
    function: "Absorption",
    name: "Beer's law",
    single: check::<f32>,
    double: check::<f64>,
};

/// Bound: 64 ulp: exponents up to 17, rounded twice, make some 40 of them where the worst comes together.
fn check<T: Scalar>(_: Budget) -> Outcome {
    let mut worst = Worst::default();
    let mut observe = |what, got: T, want| {
        worst.observe(ulps(got, want), || format!("{what}: {got:?}, not {want:e}"));
    };
    for sigma in [1e-4, 0.3, 2.0].map(shared::<T>) {
        for distance in [0.01, 0.7, 5.0].map(shared::<T>) {
            let (Ok(medium), depth) = (Absorption::new(sigma), sigma.to_f64() * distance.to_f64())
            else {
                return Worst::default().within(0.0, "");
            };
            let t = medium.transmittance(distance);
            observe("transmittance", t, Real::exp(-depth));
            let color = shared::<T>(0.01 + 0.9 * Real::exp(-depth));
            let back = Absorption::from_transmittance(Reflectance::clamped(color), distance);
            let want = -Real::ln(color.to_f64()) / distance.to_f64();
            observe("σ of a colour", back.map_or(T::NAN, Absorption::value), want);
            for cos in [1.0, -0.5, 0.6].map(shared::<T>) {
                let path = depth / cos.to_f64().abs();
                let layers = [medium.depth(distance), OpticalDepth::new(sigma * distance)];
                for layer in layers.into_iter().flatten() {
                    observe("transmittance of a layer", layer.transmittance(cos), Real::exp(-path));
                    observe("absorptance", layer.absorptance(cos), -Real::exp_m1(-path));
                }
            }
        }
    }
    worst.within(64.0, "ulp")
}
