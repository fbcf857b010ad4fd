//! Conservation of energy.

use etendue_brdf::registry::Energy;
use etendue_math::{Vec3, Vector3};

use super::Context;
use super::delta::lobes_of;
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
        Energy::OfData => return Outcome::NotApplicable("energy is that of the data"),
    };
    let mut worst = Worst::default();
    for wo in viewers::<T>(context.budget.viewers) {
        let Integral { value, error } = flux(subject.case, wo, context);
        let excess = if error <= 1e-3 { value - limit - error } else { f64::INFINITY };
        worst.observe(excess.max(0.0), || format!("{}: R = {value}", subject.at_view(wo)));
    }
    worst.within(TOLERANCE, "of 1")
}

/// Directional albedo as radiance, on both sides, delta lobes included.
pub(super) fn radiance<T: Scalar>(case: &Case<T>, wo: Vec3<T>, context: &Context) -> Integral {
    let [mut reflected, transmitted] = sides(case, wo, context);
    reflected += transmitted;
    for lobe in lobes_of(case, wo) {
        reflected.value += lobe.weight.to_f64() * lobe.probability;
    }
    reflected
}

/// The same as flux: what crosses the surface times the squared index of the far side.
pub(super) fn flux<T: Scalar>(case: &Case<T>, wo: Vec3<T>, context: &Context) -> Integral {
    let [mut sum, transmitted] = sides(case, wo, context);
    let eta = case.relative_index(wo);
    sum.value += transmitted.value * eta * eta;
    sum.error += transmitted.error * eta * eta;
    for lobe in lobes_of(case, wo) {
        let eta = lobe.eta.to_f64();
        sum.value += lobe.weight.to_f64() * lobe.probability * eta * eta;
    }
    sum
}

/// Integrals of the continuous part on the side of `wo` and on the other.
fn sides<T: Scalar>(case: &Case<T>, wo: Vec3<T>, context: &Context) -> [Integral; 2] {
    if !case.bsdf.lobes().continuous {
        return [Integral::default(); 2];
    }
    let partition = case.partition(wo, context.budget.pilot);
    let up = wo.z().to_f64().is_sign_positive();
    partition.integrate_all(TOLERANCE, |w| {
        let flux = case.bsdf.eval(wo, narrow::<T>(w)).to_f64() * w[2].abs();
        if w[2].is_sign_positive() == up { [flux, 0.0] } else { [0.0, flux] }
    })
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
