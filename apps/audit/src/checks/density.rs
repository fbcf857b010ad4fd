//! The density a sample reports.

use etendue_brdf::Density;

use super::Context;
use crate::generators::unit_pair;
use crate::measure::{Outcome, Worst};
use crate::scalar::Scalar;
use crate::subject::{Subject, Width, conditioned_ulp};

/// Asserts that the density reported with a sample is the density of its direction.
///
/// ```text
/// sample.density = pdf(wo, sample.wi)
/// ```
///
/// Tolerance: 64 ulp on the scale of [`conditioned_ulp`] for `pdf` as a function of `wi`, since the
/// sampler knows its half vector exactly and `pdf` recovers it from the rounded direction.
pub(super) fn check<T: Scalar>(subject: &Subject<T>, context: &Context) -> Outcome {
    const STREAM: u64 = 61;
    if !subject.case.bsdf.lobes().continuous {
        return Outcome::NotApplicable("no continuous part");
    }
    if subject.case.width == Width::Needle {
        return Outcome::NotApplicable("a lobe narrower than the rounding of its directions");
    }
    let mut worst = Worst::default();
    for i in 0..context.budget.draws as u64 {
        let wo = unit_pair::<T>(62, i)[0];
        let Some(sample) = subject.case.draw(wo, STREAM, i) else { continue };
        let Density::Continuous(density) = sample.density else { continue };
        let pdf = |wi| subject.case.bsdf.pdf(wo, wi);
        let scale = conditioned_ulp(sample.wi, T::EPSILON, pdf) + T::MIN_POSITIVE.to_f64();
        let error = (density.to_f64() - pdf(sample.wi).to_f64()).abs();
        worst.observe(error / scale, || subject.at(wo, sample.wi));
    }
    worst.within_if_any(64.0, "ulp")
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::broken::{Fault, verdict};

    #[test]
    fn a_sound_model_passes_and_a_doubled_density_is_caught() {
        assert!(verdict(Fault::None, check).passed());
        assert!(!verdict(Fault::DoubledDensity, check).passed());
        assert!(!verdict(Fault::SwappedAngle, check).passed());
    }
}
