//! Densities integrate to one.

use super::Context;
use super::delta::lobes_of;
use crate::generators::viewers;
use crate::measure::{Outcome, Worst};
use crate::scalar::{Scalar, narrow};
use crate::subject::{Subject, Width};

/// Asserts that every draw is accounted for.
///
/// ```text
/// ∫ pdf(wo, wi) [f ≠ 0] dωi + Σ delta probabilities + P(no sample) = 1
/// ∫ pdf(wo, wi) dωi + Σ delta probabilities ≤ 1
/// ```
///
/// `P(no sample)` is counted, so that what visible normals lose below the horizon is not excused
/// beyond what is really lost; it is 0 for most models, and then the integral is held to 1.
///
/// Tolerance: 1e-3 (ten times what is asked of the cubature), plus the error it states for itself
/// (at most 1e-3), plus 5 standard deviations of the count.
pub(super) fn check<T: Scalar>(subject: &Subject<T>, context: &Context) -> Outcome {
    const STREAM: u64 = 31;
    let case = subject.case;
    if case.width != Width::Wide {
        return Outcome::NotApplicable("a lobe too narrow for cubature");
    }
    let mut worst = Worst::default();
    let count = context.budget.samples as u64;
    for wo in viewers::<T>(context.budget.viewers) {
        let lost = (0..count).filter(|&i| case.draw(wo, STREAM, i).is_none()).count();
        let lost = lost as f64 / count as f64;
        let delta = lobes_of(case, wo).iter().fold(0.0, |sum, l| sum + l.probability);
        let partition = case.partition(wo, context.budget.pilot);
        let [whole, returned] = partition.integrate_all(1e-4, |w| {
            let (f, pdf) = case.bsdf.eval_pdf(wo, narrow::<T>(w));
            let pdf = pdf.to_f64();
            [pdf, if f == T::ZERO { 0.0 } else { pdf }]
        });
        let noise = 5.0 * (lost * (1.0 - lost) / count as f64).sqrt();
        let error = whole.error.max(returned.error);
        let short = (returned.value + delta + lost - 1.0).abs();
        let over = whole.value + delta - 1.0;
        let figure = if error <= 1e-3 { short.max(over) - noise - error } else { f64::INFINITY };
        worst.observe(figure.max(0.0), || {
            format!("{}: ∫pdf {} + delta {delta} + none {lost}", subject.at_view(wo), whole.value)
        });
    }
    worst.within(1e-3, "of 1")
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::broken::{Fault, verdict};

    #[test]
    fn a_sound_model_passes_and_wrong_densities_are_caught() {
        assert!(verdict(Fault::None, check).passed());
        assert!(!verdict(Fault::DoubledDensity, check).passed());
        assert!(!verdict(Fault::SwappedAngle, check).passed());
    }
}
