//! Agreement of the two precisions.

use etendue_math::{Real, Vec3};

use super::Context;
use crate::generators::pair;
use crate::measure::{Outcome, Worst};
use crate::scalar::{narrow, widen};
use crate::subject::{Case, Subject, Width, conditioned_ulp};

/// Asserts that `f32` gives what `f64` gives for the same numbers, as far as `f32` can.
///
/// ```text
/// |f32 − f64| ≤ 64 · scale
/// scale = `conditioned_ulp` over both directions, ε = 2⁻²³
/// ```
///
/// for `eval` and `pdf`, over pairs of which every second has its `wi` drawn by the sampler, so
/// that narrow lobes are met. Parameters are numbers that both precisions hold. Tolerance: an
/// error of a few tens on this scale is the rounding of some twenty operations; a form that
/// cancels exceeds it by powers of ten.
pub fn precision(single: &Subject<f32>, double: &Case<f64>, context: &Context) -> Outcome {
    const STREAM: u64 = 81;
    if !single.case.bsdf.lobes().continuous {
        return Outcome::NotApplicable("no continuous part");
    }
    let mut worst = Worst::default();
    for i in 0..context.budget.pairs as u64 {
        let [wo, mut wi] = pair(STREAM, i);
        if i % 2 == 1 {
            let Some(sample) = single.case.draw(wo, STREAM, i) else { continue };
            wi = sample.wi;
        }
        // Across the surface the half vector is wo + η wi, whose product is rounded before it
        // cancels: that moves it out of any lobe narrower than an ulp.
        if single.case.width == Width::Needle && wo.z * wi.z < 0.0 {
            continue;
        }
        let (f, pdf) = single.case.bsdf.eval_pdf(wo, wi);
        let [wo64, wi64] = [wo, wi].map(|w| narrow::<f64>(widen::<f32>(w)));
        let reference = &double.bsdf;
        for (got, error) in [
            (f, error_of(f, wo64, wi64, |wo, wi| reference.eval(wo, wi))),
            (pdf, error_of(pdf, wo64, wi64, |wo, wi| reference.pdf(wo, wi))),
        ] {
            worst.observe(error, || format!("{}: {got}", single.at(wo, wi)));
        }
    }
    worst.within(64.0, "ulp")
}

fn error_of(
    got: f32,
    wo: Vec3<f64>,
    wi: Vec3<f64>,
    exact: impl Fn(Vec3<f64>, Vec3<f64>) -> f64,
) -> f64 {
    let epsilon = f64::from(f32::EPSILON);
    let scale = conditioned_ulp(wo, epsilon, |wo| exact(wo, wi))
        + conditioned_ulp(wi, epsilon, |wi| exact(wo, wi))
        + <f32 as Real>::MIN_POSITIVE.to_f64();
    (f64::from(got) - exact(wo, wi)).abs() / scale
}

#[cfg(test)]
mod tests {
    use super::precision;
    use crate::broken::{Fault, case, context, laws};
    use crate::measure::Outcome;
    use crate::subject::Subject;

    fn verdict(fault: Fault) -> Outcome {
        let (single, laws) = (case::<f32>(fault), laws());
        precision(&Subject { laws: &laws, case: &single }, &case::<f64>(fault), &context())
    }

    #[test]
    fn a_sound_model_passes_and_a_cancelling_form_is_caught() {
        assert!(verdict(Fault::None).passed());
        assert!(!verdict(Fault::Cancels).passed());
    }
}
