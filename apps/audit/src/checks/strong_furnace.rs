//! The strong white furnace test.

use etendue_math::Vector3;

use super::Context;
use super::energy::{TOLERANCE, flux};
use crate::cubature::Integral;
use crate::generators::viewers;
use crate::measure::{Outcome, Worst};
use crate::scalar::Scalar;
use crate::subject::{Loss, Subject, Width};

/// Asserts of cases that lose nothing by their definition that in a white furnace they cannot be
/// seen: all that arrives leaves.
///
/// ```text
/// ∫ f(wo, wi) |cos θi| (η² if across) dωi + Σ delta weights · probabilities (η² likewise) = 1
/// ```
///
/// Tolerance: 2e-4, twice what is asked of the cubature, plus the error it states for itself, which
/// may not exceed 1e-3, and the error of its tables that a case declares.
pub(super) fn check<T: Scalar>(subject: &Subject<T>, context: &Context) -> Outcome {
    let Loss::None { within } = subject.case.loss else {
        return Outcome::NotApplicable("absorbs");
    };
    if subject.case.width != Width::Wide {
        return Outcome::NotApplicable("a lobe too narrow for cubature");
    }
    let mut worst = Worst::default();
    for wo in viewers::<T>(context.budget.viewers) {
        let Integral { value, error } = flux(subject.case, wo, context);
        if value == 0.0 && wo.z() < T::ZERO && !subject.case.bsdf.lobes().transmission {
            continue; // a one-sided model seen from behind is not in the furnace
        }
        let difference = (value - 1.0).abs() - error;
        let figure = if error <= 1e-3 { difference.max(0.0) } else { f64::INFINITY };
        worst.observe(figure, || format!("{}: R = {value}", subject.at_view(wo)));
    }
    worst.within(2.0 * TOLERANCE + within, "of 1")
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::broken::{Fault, verdict};

    #[test]
    fn a_sound_model_passes_and_gains_and_losses_are_caught() {
        assert!(verdict(Fault::None, check).passed());
        assert!(!verdict(Fault::EnergyGain, check).passed());
        assert!(!verdict(Fault::OneWayFactor, check).passed());
    }
}
