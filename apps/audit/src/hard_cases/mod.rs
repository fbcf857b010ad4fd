//! Single functions where naive forms break, each measured beside its naive form.
//!
//! A lobe that is wrong in `eval` and `pdf` alike passes every law and every χ² test; only a
//! comparison with higher precision sees it. Each entry sweeps the inputs at which published
//! forms fail, compares `f32` with a reference in `f64`, and proves that it can fail: the naive
//! form, kept here as the counter-example, must exceed the bound over the same inputs.

mod artistic_conductor;
mod ashikhmin_shirley;
mod conductor;
mod cone;
mod cosine_hemisphere;
mod coupled;
mod eon_albedo;
mod erf_inv;
mod fresnel;
mod half_vector;
mod matched_dielectric;
mod mis_weights;
mod ndf;
mod oren_nayar;
mod smooth_limit;
mod solid_angle;
mod thin_slab;
mod total_reflection;
mod transmittance_table;
mod uniforms;
mod visible_normals;

use crate::measure::{Measurement, Outcome};

/// One hard case.
pub struct HardCase {
    /// Where it goes wrong, as the report and `--filter` name it.
    pub name: &'static str,
    /// The function audited.
    pub function: &'static str,
    /// What goes wrong there with the naive form, in one line.
    pub problem: &'static str,
    /// The form that holds, in one line.
    pub remedy: &'static str,
    /// Sweep over the form in use.
    pub sound: fn() -> Outcome,
    /// The same sweep over the naive form.
    pub naive: fn() -> Outcome,
}

/// All hard cases, in the order of the report.
pub const HARD_CASES: &[HardCase] = &[
    fresnel::CASE,
    conductor::CASE,
    artistic_conductor::CASE,
    matched_dielectric::CASE,
    smooth_limit::CONDUCTOR,
    smooth_limit::DIELECTRIC,
    ndf::GGX,
    ndf::BECKMANN,
    half_vector::CASE,
    visible_normals::CAP,
    visible_normals::DISK,
    visible_normals::BOUNDED_CAP,
    ashikhmin_shirley::EVAL,
    ashikhmin_shirley::POLAR,
    ashikhmin_shirley::AZIMUTH,
    oren_nayar::CASE,
    eon_albedo::CASE,
    coupled::CASE,
    thin_slab::CASE,
    total_reflection::CASE,
    transmittance_table::CASE,
    uniforms::CASE,
    cosine_hemisphere::CASE,
    erf_inv::CASE,
    mis_weights::CASE,
    cone::CASE,
    solid_angle::TRIANGLE,
    solid_angle::RECTANGLE,
];

/// What a hard case showed.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The sweep over the form in use; a failure also if the naive form passes, since then the sweep
    /// proves nothing.
    pub outcome: Outcome,
    /// The worst figure of the same sweep over the naive form.
    pub naive: Option<f64>,
}

impl HardCase {
    /// Both sweeps.
    pub fn audit(&self) -> Verdict {
        let naive = (self.naive)();
        let proves = naive.measurement().is_some_and(|m| !m.passed() && m.evaluations > 0);
        let outcome = if proves {
            (self.sound)()
        } else {
            Outcome::Measured(Measurement {
                worst: f64::INFINITY,
                bound: 0.0,
                unit: "",
                at: format!("the naive form passes: {naive:?}"),
                evaluations: 1,
            })
        };
        Verdict { outcome, naive: naive.measurement().map(|m| m.worst) }
    }
}

/// Relative error of an `f32`; infinite for NaN.
fn relative(got: f32, want: f64) -> f64 {
    let error = (f64::from(got) - want).abs() / want.abs().max(f64::from(f32::MIN_POSITIVE));
    if error.is_nan() { f64::INFINITY } else { error }
}

/// `n` numbers from 10^`low` to 10^`high`, evenly spaced in the exponent and exact in `f32`.
fn decades(low: f64, high: f64, n: u32) -> impl Iterator<Item = f32> {
    (0..n).map(move |i| {
        let exponent = low + (high - low) * f64::from(i) / f64::from(n - 1);
        etendue_math::Real::powf(10.0, exponent) as f32
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_hard_case_holds_and_its_naive_form_does_not() {
        for case in HARD_CASES {
            let verdict = case.audit();
            assert!(verdict.outcome.passed(), "{}: {verdict:?}", case.name);
        }
    }

    #[test]
    fn a_sweep_that_its_naive_form_passes_is_a_failure() {
        let lax = HardCase { naive: fresnel::CASE.sound, ..fresnel::CASE };
        assert!(!lax.audit().outcome.passed());
    }
}
