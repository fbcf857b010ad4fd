//! Directional albedos known from the literature, gains included.

use super::Context;
use super::energy::radiance;
use crate::generators::from_angles;
use crate::measure::{Outcome, Worst};
use crate::scalar::Scalar;
use crate::subject::Subject;

/// Asserts that documented albedos are reproduced, those above 1 as much as those below: a model
/// that gains energy by its own definition must not have the gain clamped away.
///
/// Tolerance: 6e-4, half a unit of the third printed digit plus 1e-4 of cubature.
pub(super) fn check<T: Scalar>(subject: &Subject<T>, context: &Context) -> Outcome {
    if subject.case.published.is_empty() {
        return Outcome::NotApplicable("no published figures");
    }
    let mut worst = Worst::default();
    for &(theta, want) in subject.case.published {
        let wo = from_angles::<T>(etendue_math::Real::cos(theta), 0.3);
        let got = radiance(subject.case, wo, context).value;
        worst.observe((got - want).abs(), || {
            format!("{}: {got}, published {want}", subject.at_view(wo))
        });
    }
    worst.within(6e-4, "of 1")
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
