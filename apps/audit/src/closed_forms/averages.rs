//! Averages of Fresnel reflectances over the hemisphere.

use etendue_brdf::fresnel::{
    conductor_average, conductor_average_fit, conductor_from_artistic, dielectric_average,
    dielectric_average_fit, dielectric_average_quotient_fit, dielectric_average_transmittance,
    schlick_average,
};
use etendue_math::Real;

use super::ClosedForm;
use crate::budget::Budget;
use crate::cases::textbook;
use crate::measure::{Outcome, Worst};
use crate::scalar::{Scalar, shared};

/// `2 ∫ F(c) c dc` of the textbook's reflectances.
pub(super) const EXACT: ClosedForm = ClosedForm {
    function: "fresnel::*_average",
    name: "is the integral",
    single: exact::<f32>,
    double: exact::<f64>,
};

/// The fits beside the exact averages.
pub(super) const FITS: ClosedForm = ClosedForm {
    function: "fresnel::*_average_fit",
    name: "as good as published",
    single: fits::<f32>,
    double: fits::<f64>,
};

/// Gold in red and in blue light, one with an edge as of total reflection, nearly glass.
const METALS: [[f64; 2]; 4] = [[0.143, 3.983], [1.442, 1.603], [0.8, 0.3], [3.0, 0.2]];

/// Bound: 4e-6, the error of the midpoint rule at the root of total reflection.
fn exact<T: Scalar>(_: Budget) -> Outcome {
    let mut worst = Worst::default();
    for eta in [0.2, 0.667, 0.9, 1.1, 1.5, 2.4, 10.0].map(shared::<T>) {
        let want = textbook::cosine_average(|c| textbook::dielectric(c, eta.to_f64()));
        worst.observe((dielectric_average(eta).to_f64() - want).abs(), || format!("η {eta:?}"));
        let transmitted = dielectric_average_transmittance(eta).to_f64();
        worst.observe((transmitted + want - 1.0).abs(), || format!("η {eta:?}, transmitted"));
    }
    for [eta, k] in METALS.map(|metal| metal.map(shared::<T>)) {
        let index = [eta, k].map(Real::to_f64);
        let want = textbook::cosine_average(|c| textbook::conductor(c, index));
        let error = (conductor_average(eta, k).to_f64() - want).abs();
        worst.observe(error, || format!("η {eta:?}, k {k:?}"));
    }
    for f0 in [0.0, 0.04, 0.6].map(shared::<T>) {
        let f = f0.to_f64();
        let want = textbook::cosine_average(|c| f + (1.0 - f) * Real::powi(1.0 - c, 5));
        worst.observe((schlick_average(f0).to_f64() - want).abs(), || format!("F0 {f0:?}"));
    }
    worst.within(4e-6, "of 1")
}

/// Bound: 0.012, the largest of their published errors; the fit of metals is that good up to an edge tint
/// of 0.75 and for reflectances from 0.2 on, that of glass up to the indices of glass.
fn fits<T: Scalar>(_: Budget) -> Outcome {
    let mut worst = Worst::default();
    for eta in [1.1, 1.33, 1.5, 1.9] {
        for eta in [eta, 1.0 / eta].map(shared::<T>) {
            let want = dielectric_average(eta.to_f64());
            for fit in [dielectric_average_fit(eta), dielectric_average_quotient_fit(eta)] {
                worst.observe((fit.to_f64() - want).abs(), || format!("η {eta:?}"));
            }
        }
    }
    for i in 0..=15 {
        for j in 0..=12 {
            let [r, g] = [0.2 + 0.05 * f64::from(i), f64::from(j) / 16.0].map(shared::<T>);
            let [eta, k] = conductor_from_artistic(r.to_f64(), g.to_f64());
            let error = conductor_average_fit(r, g).to_f64() - conductor_average(eta, k);
            worst.observe(error.abs(), || format!("r {r:?}, g {g:?}"));
        }
    }
    worst.within(0.012, "of 1")
}
