//! Values against the published formula.

use etendue_math::Vector3;

use super::Context;
use crate::generators::unit_pair;
use crate::measure::{Outcome, Worst};
use crate::scalar::{Scalar, widen};
use crate::subject::Subject;

/// Cosines below which published forms begin to lose the digits they are compared in.
const OBLIQUE: f64 = 0.05;

/// Asserts that the value is that of the published formula, read literally, at directions that are
/// hard for neither.
///
/// ```text
/// |f − literal| ≤ 1e-7 literal,   |cos θ| ≥ 0.05
/// ```
///
/// This is what a constant that is wrong in value, density and albedo alike cannot pass. In `f64`
/// alone: the check `precision` ties `f32` to it. Tolerance: 1e-7, since literal forms cancel, and
/// averages in them are integrated by a plain midpoint rule.
pub(super) fn check<T: Scalar>(subject: &Subject<T>, context: &Context) -> Outcome {
    let Some(literal) = &subject.case.textbook else {
        return Outcome::NotApplicable("no literal form kept here");
    };
    if T::SIGNIFICAND_BITS < f64::MANTISSA_DIGITS {
        return Outcome::NotApplicable("compared in f64");
    }
    let mut worst = Worst::default();
    for i in 0..context.budget.pairs as u64 {
        let [wo, wi] = unit_pair::<T>(121, i);
        let [o, w] = [wo, wi].map(widen::<T>);
        if wo.z().to_f64().abs() < OBLIQUE || wi.z().to_f64().abs() < OBLIQUE {
            continue;
        }
        let (got, want) = (subject.case.bsdf.eval(wo, wi).to_f64(), literal(o, w));
        // Values that underflow towards 0 are for the check `precision`.
        let error = (got - want).abs() / (want.abs() + 1e-12);
        worst.observe(error, || format!("{}: {got}, literally {want}", subject.at(wo, wi)));
    }
    worst.within(1e-7, "relative")
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
