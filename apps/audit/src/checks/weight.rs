//! Weights of samples.

use etendue_brdf::Density;
use etendue_math::Vector3;

use super::Context;
use crate::generators::unit_pair;
use crate::measure::{Outcome, Worst};
use crate::scalar::Scalar;
use crate::subject::{Subject, conditioned_ulp};

/// Asserts that a sample is worth what its definition says.
///
/// ```text
/// weight = f(wo, wi) |cos θi| / pdf(wo, wi)
/// ```
///
/// Tolerance: 64 ulp on the scale of [`conditioned_ulp`] for the quotient as a function of `wi`,
/// since samplers know the half vector exactly and `eval` recovers it from the rounded direction.
/// Points where `f` or `pdf` is not a normal number are left to the check `hostile`.
pub(super) fn check<T: Scalar>(subject: &Subject<T>, context: &Context) -> Outcome {
    const STREAM: u64 = 51;
    if !subject.case.bsdf.lobes().continuous {
        return Outcome::NotApplicable("no continuous part");
    }
    let bsdf = &subject.case.bsdf;
    let quotient = |wo, wi: etendue_math::Vec3<T>| {
        let (f, pdf) = bsdf.eval_pdf(wo, wi);
        if f >= T::MIN_POSITIVE && pdf >= T::MIN_POSITIVE {
            f * wi.z().abs() / pdf
        } else {
            T::ZERO
        }
    };
    let mut worst = Worst::default();
    for i in 0..context.budget.draws as u64 {
        let wo = unit_pair::<T>(52, i)[0];
        let Some(sample) = subject.case.draw(wo, STREAM, i) else { continue };
        let want = quotient(wo, sample.wi);
        if want == T::ZERO || matches!(sample.density, Density::Delta(_)) {
            continue;
        }
        let scale = conditioned_ulp(sample.wi, T::EPSILON, |wi| quotient(wo, wi));
        let error = (sample.weight - want).to_f64().abs();
        worst.observe(error / scale, || subject.at(wo, sample.wi));
    }
    worst.within_if_any(64.0, "ulp")
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::broken::{Fault, verdict};

    #[test]
    fn a_sound_model_passes_and_wrong_weights_are_caught() {
        assert!(verdict(Fault::None, check).passed());
        assert!(!verdict(Fault::MissingCosine, check).passed());
        assert!(!verdict(Fault::DoubledDensity, check).passed());
        assert!(!verdict(Fault::WrongConstant, check).passed());
    }
}
