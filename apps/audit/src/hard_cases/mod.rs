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
mod uniforms;
mod visible_normals;

use crate::measure::{Measurement, Outcome};

/// One hard case.
pub struct HardCase {
    /// What goes wrong, as the report and `--filter` name it.
    pub name: &'static str,
    /// The function audited.
    pub function: &'static str,
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
    visible_normals::CASE,
    ashikhmin_shirley::EVAL,
    ashikhmin_shirley::POLAR,
    ashikhmin_shirley::AZIMUTH,
    oren_nayar::CASE,
    coupled::CASE,
    eon_albedo::CASE,
    thin_slab::CASE,
    total_reflection::CASE,
    uniforms::CASE,
    cosine_hemisphere::CASE,
    mis_weights::CASE,
    cone::CASE,
    solid_angle::TRIANGLE,
    solid_angle::RECTANGLE,
];

impl HardCase {
    /// The sweep over the form in use; a failure also if the naive form passes, since then the
    /// sweep proves nothing.
    pub fn audit(&self) -> Outcome {
        match (self.naive)() {
            Outcome::Measured(naive) if !naive.passed() && naive.evaluations > 0 => (self.sound)(),
            other => Outcome::Measured(Measurement {
                worst: f64::INFINITY,
                bound: 0.0,
                unit: "",
                at: format!("the naive form passes: {other:?}"),
                evaluations: 1,
            }),
        }
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
            let outcome = case.audit();
            assert!(outcome.passed(), "{}: {outcome:?}", case.name);
        }
    }

    #[test]
    fn a_sweep_that_its_naive_form_passes_is_a_failure() {
        let lax = HardCase { naive: fresnel::CASE.sound, ..fresnel::CASE };
        assert!(!lax.audit().passed());
    }
}
