//! Closed forms of the directional albedo.

use etendue_brdf::registry::Albedo;

use super::Context;
use super::energy::{TOLERANCE, radiance};
use crate::cubature::Integral;
use crate::generators::viewers;
use crate::measure::{Outcome, Worst};
use crate::scalar::Scalar;
use crate::subject::{Subject, Width};

/// Asserts that the closed-form albedo is the integral it stands for, and is there if promised.
///
/// ```text
/// albedo(wo) = ∫ f(wo, wi) |cos θi| dωi, delta lobes included
/// ```
///
/// Tolerance: 2e-4, twice what is asked of the cubature (see the check `energy`), plus the error
/// the cubature states for itself.
pub(super) fn check<T: Scalar>(subject: &Subject<T>, context: &Context) -> Outcome {
    if subject.case.width != Width::Wide {
        return Outcome::NotApplicable("a lobe too narrow for cubature");
    }
    let mut worst = Worst::default();
    // From either side of the surface even in the shortest run.
    for wo in viewers::<T>(context.budget.viewers.max(2)) {
        let Some(closed) = subject.case.bsdf.albedo(wo) else {
            if subject.laws.albedo == Albedo::ClosedForm {
                worst.observe(f64::INFINITY, || format!("{}: None", subject.at_view(wo)));
            }
            continue;
        };
        let Integral { value, error } = radiance(subject.case, wo, context);
        let difference = (closed.to_f64() - value).abs() - error;
        let figure = if error <= 1e-3 { difference.max(0.0) } else { f64::INFINITY };
        worst.observe(figure, || format!("{}: {closed}", subject.at_view(wo)));
    }
    if worst.evaluations() == 0 {
        return Outcome::NotApplicable("no closed form");
    }
    worst.within(2.0 * TOLERANCE, "of 1")
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::broken::{Fault, verdict};

    #[test]
    fn a_sound_model_passes_and_a_wrong_constant_is_caught() {
        assert!(verdict(Fault::None, check).passed());
        assert!(!verdict(Fault::WrongConstant, check).passed());
    }
}
