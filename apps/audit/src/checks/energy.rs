//! Conservation of energy.

use etendue_brdf::registry::Energy;
use etendue_math::{Vec3, Vector3};

use super::Context;
use crate::cubature::Integral;
use crate::generators::viewers;
use crate::measure::{Outcome, Worst};
use crate::scalar::{Scalar, narrow};
use crate::subject::{Case, Subject, Width};

/// Absolute error asked of the integrals.
pub(super) const TOLERANCE: f64 = 1e-4;

/// Asserts that no more light leaves than arrives, or for a model that is documented to gain
/// energy, no more than documented (that it does gain it is for `published-albedo`).
///
/// ```text
/// R(wo) = ∫ f(wo, wi) |cos θi| (η² if across) dωi + Σ delta weights · probabilities (η² likewise) ≤ limit
/// ```
///
/// Transmitted radiance carries 1/η²; energy does not, hence the factor. The integral is adaptive
/// product Gauss–Legendre cubature on cells shaped by the sampler.
///
/// Tolerance: 1e-4 plus the error the cubature states for itself, which may not exceed 1e-3.
pub(super) fn check<T: Scalar>(subject: &Subject<T>, context: &Context) -> Outcome {
    if subject.case.width != Width::Wide {
        return Outcome::NotApplicable("a lobe too narrow for cubature");
    }
    let limit = match subject.laws.energy {
        Energy::Conserves => 1.0,
        Energy::Gains { maximum, .. } => maximum,
    };
    let mut worst = Worst::default();
    for wo in viewers::<T>(context.budget.viewers) {
        let [reflected, transmitted] = sides(subject.case, wo, context);
        let eta = subject.case.relative_index(wo);
        let value = reflected.value + transmitted.value * eta * eta;
        let error = reflected.error + transmitted.error * eta * eta;
        let excess = if error <= 1e-3 { value - limit - error } else { f64::INFINITY };
        worst.observe(excess.max(0.0), || format!("{}: R = {value}", subject.at_view(wo)));
    }
    worst.within(TOLERANCE, "of 1")
}

/// Directional albedo on the side of `wo` and on the other, as radiance, delta lobes included.
pub(super) fn sides<T: Scalar>(case: &Case<T>, wo: Vec3<T>, context: &Context) -> [Integral; 2] {
    let partition = case.partition(wo, context.budget.pilot);
    let side = |sign: f64| {
        partition.integrate(TOLERANCE, |w| {
            if w[2] * sign * wo.z().to_f64() > 0.0 {
                case.bsdf.eval(wo, narrow::<T>(w)).to_f64() * w[2].abs()
            } else {
                0.0
            }
        })
    };
    let mut sides = if case.bsdf.lobes().continuous {
        [side(1.0), side(-1.0)]
    } else {
        [Integral::default(); 2]
    };
    for lobe in super::delta::lobes_of(case, wo) {
        let across = usize::from(lobe.wi.z() * wo.z() < T::ZERO);
        sides[across].value += lobe.weight.to_f64() * lobe.probability;
    }
    sides
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::broken::{Fault, verdict};

    #[test]
    fn a_sound_model_passes_and_a_gain_of_five_percent_is_caught() {
        assert!(verdict(Fault::None, check).passed());
        assert!(!verdict(Fault::EnergyGain, check).passed());
    }
}
