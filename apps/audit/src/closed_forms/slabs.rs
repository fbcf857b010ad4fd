//! Panes: what is reflected between their faces, term by term.

use etendue_brdf::{AbsorbingSlab, Bsdf, Density, Ior, OpticalDepth, ThinDielectric};
use etendue_math::{Real, Vec3, Vector3};

use super::ClosedForm;
use crate::budget::Budget;
use crate::cases::textbook::dielectric;
use crate::generators::from_angles;
use crate::measure::{Outcome, Worst};
use crate::scalar::{Scalar, shared};

/// What leaves a pane by its mirror image and straight through: the sum of everything that its faces
/// reflect and refract, with absorption on every crossing.
pub(super) const SERIES: ClosedForm = ClosedForm {
    function: "AbsorbingSlab",
    name: "series of reflections",
    single: series::<f32>,
    double: series::<f64>,
};

/// Bound: 1e-6 and 16 ε; the literal Fresnel term cancels, and the series ends where nothing is left of it.
fn series<T: Scalar>(_: Budget) -> Outcome {
    let mut worst = Worst::default();
    for eta in [1.1, 1.5, 2.4].map(shared::<T>) {
        let Ok(index) = Ior::new(eta) else { return worst.within(0.0, "") };
        for tau in [0.0, 0.1, 1.5].map(shared::<T>) {
            let Ok(depth) = OpticalDepth::new(tau) else { return worst.within(0.0, "") };
            for cos in [1.0, 0.6, 0.2] {
                let wo = from_angles::<T>(cos, 0.4);
                let want = literal(eta.to_f64(), tau.to_f64(), wo.z().to_f64());
                let got = shares(&AbsorbingSlab::<T>::new(index, depth), wo);
                let clear = shares(&ThinDielectric::<T>::new(index), wo);
                let clear = if tau == T::ZERO { clear } else { got };
                for k in 0..2 {
                    let error = (got[k] - want[k]).abs().max((clear[k] - want[k]).abs());
                    worst.observe(error, || {
                        format!("η {eta:?}, τ {tau:?}, cos {cos}: {got:?}, not {want:?}")
                    });
                }
            }
        }
    }
    worst.within(1e-6 + 16.0 * T::EPSILON.to_f64(), "of 1")
}

/// What is reflected and transmitted: weight times probability of either lobe.
fn shares<T: Scalar>(pane: &impl Bsdf<Color = T>, wo: Vec3<T>) -> [f64; 2] {
    [T::ZERO, T::ONE_MINUS_EPSILON].map(|u| {
        pane.sample(wo, u, [T::HALF; 2]).map_or(0.0, |sample| match sample.density {
            Density::Delta(p) => (sample.weight * p).to_f64(),
            Density::Continuous(_) => f64::NAN,
        })
    })
}

fn literal(eta: f64, tau: f64, cos: f64) -> [f64; 2] {
    let r = dielectric(cos, eta);
    let cos_t = (1.0 - (1.0 - cos * cos) / (eta * eta)).sqrt();
    let passed = Real::exp(-tau / cos_t);
    let (mut reflected, mut transmitted, mut inside) = (r, 0.0, 1.0 - r);
    for _ in 0..1000 {
        inside *= passed;
        transmitted += inside * (1.0 - r);
        inside *= r * passed;
        reflected += inside * (1.0 - r);
        inside *= r;
    }
    [reflected, transmitted]
}
