//! Helmholtz reciprocity.

use etendue_brdf::registry::Reciprocity;
use etendue_math::Vector3;

use super::Context;
use crate::generators::{from_angles, unit_pair};
use crate::measure::{Outcome, Worst};
use crate::scalar::Scalar;
use crate::subject::{Subject, conditioned_ulp};

/// Asserts that light may be reversed, as the model promises it.
///
/// ```text
/// f(wo, wi) = f(wi, wo)          on one side
/// f(wo, wi) η² = f(wi, wo)       across, for a model that promises no more;
///                                η the index of the medium of wi relative to that of wo
/// ```
///
/// Tolerance: 64 ulp on the scale of [`conditioned_ulp`], since the two evaluations round
/// differently wherever the model treats its directions in turn.
pub(super) fn check<T: Scalar>(subject: &Subject<T>, context: &Context) -> Outcome {
    let (bsdf, lobes) = (&subject.case.bsdf, subject.case.bsdf.lobes());
    if !lobes.continuous {
        return Outcome::NotApplicable("no continuous part");
    }
    if subject.laws.reciprocity == Reciprocity::Broken {
        return Outcome::NotApplicable("documented as not reciprocal");
    }
    let index = [1.0, -1.0].map(|z| subject.case.relative_index(from_angles::<T>(z, 0.0)));
    let mut worst = Worst::default();
    for i in 0..context.budget.pairs as u64 {
        let [wo, wi] = unit_pair::<T>(21, i);
        let eta = match subject.laws.reciprocity {
            Reciprocity::UpToSquaredIndex if wo.z() * wi.z() < T::ZERO => {
                index[usize::from(wo.z() < T::ZERO)]
            }
            _ => 1.0,
        };
        let there = bsdf.eval(wo, wi).to_f64() * eta * eta;
        let back = bsdf.eval(wi, wo).to_f64();
        let scale = conditioned_ulp(wo, T::EPSILON, |wo| bsdf.eval(wo, wi)) * eta * eta
            + conditioned_ulp(wi, T::EPSILON, |wi| bsdf.eval(wo, wi)) * eta * eta
            + T::MIN_POSITIVE.to_f64();
        worst.observe((there - back).abs() / scale, || subject.at(wo, wi));
    }
    worst.within(64.0, "ulp")
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::broken::{Fault, verdict};

    #[test]
    fn a_sound_model_passes_and_a_one_way_factor_is_caught() {
        assert!(verdict(Fault::None, check).passed());
        assert!(!verdict(Fault::OneWayFactor, check).passed());
    }
}
