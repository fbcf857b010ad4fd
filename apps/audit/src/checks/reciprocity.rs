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
/// Of a model that promises it of reflection only, pairs across are left out. One that promises no symmetry
/// is held to the asymmetry it states instead: the residual
///
/// ```text
/// |f(a, b) − f(b, a)| / max(f(a, b), f(b, a)),  a the normal, cos θ of b = 0.1
/// ```
///
/// must be the stated one within 1e-5, half a unit of its last digit and the rounding of `f32` at cos θ = 0.1.
///
/// Tolerance of the symmetric: 64 ulp on the scale of [`conditioned_ulp`], since the two evaluations round
/// differently wherever the model treats its directions in turn.
pub(super) fn check<T: Scalar>(subject: &Subject<T>, context: &Context) -> Outcome {
    let (bsdf, lobes) = (&subject.case.bsdf, subject.case.bsdf.lobes());
    if !lobes.continuous {
        return Outcome::NotApplicable("no continuous part");
    }
    if let Reciprocity::NonReciprocal { residual } = subject.laws.reciprocity {
        return residual.map_or(
            Outcome::NotApplicable("not reciprocal, by what the parameters make of it"),
            |residual| asymmetry(subject, residual),
        );
    }
    let index = [1.0, -1.0].map(|z| subject.case.relative_index(from_angles::<T>(z, 0.0)));
    let mut worst = Worst::default();
    for i in 0..context.budget.pairs as u64 {
        let [wo, wi] = unit_pair::<T>(21, i);
        let across = wo.z() * wi.z() < T::ZERO;
        let eta = match subject.laws.reciprocity {
            Reciprocity::ReflectionOnly if across => continue,
            Reciprocity::UpToSquaredIndex if across => index[usize::from(wo.z() < T::ZERO)],
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

/// The measured residual against the stated one.
fn asymmetry<T: Scalar>(subject: &Subject<T>, stated: f64) -> Outcome {
    let [a, b] = [from_angles::<T>(1.0, 0.0), from_angles::<T>(0.1, 0.3)];
    let bsdf = &subject.case.bsdf;
    let [there, back] = [bsdf.eval(a, b), bsdf.eval(b, a)].map(etendue_math::Real::to_f64);
    let larger = there.max(back);
    if larger == 0.0 {
        return Outcome::NotApplicable("black");
    }
    let residual = (there - back).abs() / larger;
    let mut worst = Worst::default();
    worst.observe((residual - stated).abs(), || {
        format!("{}: residual {residual}, stated {stated}", subject.at(a, b))
    });
    worst.within(1e-5, "of 1")
}

#[cfg(test)]
mod tests {
    use etendue_brdf::registry::Reciprocity;

    use super::check;
    use crate::broken::{Fault, case, context, laws, verdict};
    use crate::subject::{Laws, Subject};

    #[test]
    fn a_sound_model_passes_and_a_one_way_factor_is_caught() {
        assert!(verdict(Fault::None, check).passed());
        assert!(!verdict(Fault::OneWayFactor, check).passed());
    }

    #[test]
    fn a_stated_asymmetry_must_be_there_and_be_that_large() {
        let holds = |fault, residual| {
            let laws = Laws {
                reciprocity: Reciprocity::NonReciprocal { residual: Some(residual) },
                ..laws()
            };
            check(&Subject { laws: &laws, case: &case::<f64>(fault) }, &context()).passed()
        };
        // f ∝ cos θo: 1 − 0.1/1.
        assert!(holds(Fault::OneWayFactor, 0.9));
        assert!(!holds(Fault::OneWayFactor, 0.8) && !holds(Fault::None, 0.9));
    }
}
