//! Delta lobes in both precisions.

use etendue_brdf::{Density, Sample};
use etendue_math::{Real, Vec3, Vector3};

use super::scale::error_beyond;
use super::tally::Tally;
use super::{exactly, show};
use crate::scalar::Scalar;
use crate::subject::Case;

/// Energy and direction of the delta lobe at one end of `u_lobe`, each end in turn.
///
/// Where the precisions draw different lobes, or only one of them draws any, the ends of `u_lobe` lie
/// within rounding of a probability: then there is nothing to compare. That a lobe is lost
/// altogether is for the checks `delta` and `normalisation` to see.
pub(super) fn compare(
    tally: &mut Tally,
    single: &Case<f32>,
    double: &Case<f64>,
    wo: Vec3<f32>,
    index: u64,
) {
    let end = if index.is_multiple_of(2) { 0.0 } else { f32::ONE_MINUS_EPSILON };
    let Some(got) = lobe(single, wo, end) else { return };
    let wide = exactly(wo);
    let Some(want) = lobe(double, wide, f64::from(end)) else { return };
    if got.across != want.across {
        return;
    }
    tally.inputs += 1;
    let place = |value: f32| {
        format!("{}, delta lobe at u {end:?}, wo {}: {value}", single.parameters, show(wo))
    };
    tally.inspect(f64::from(got.values[0]), || place(got.values[0]));
    tally.inspect(want.values[0], || place(got.values[0]));
    for k in 0..4 {
        let value = |w| {
            lobe(double, w, f64::from(end))
                .filter(|lobe| lobe.across == want.across)
                .map_or(0.0, |lobe| lobe.values[k])
        };
        let worst = tally.worst();
        let error = error_beyond(worst, got.values[k], want.values[k], [wide], |[w]| value(w));
        tally.observe(error, || place(got.values[k]));
    }
}

struct Lobe<T> {
    /// Energy, then the direction.
    values: [T; 4],
    across: bool,
}

fn lobe<T: Scalar>(case: &Case<T>, wo: Vec3<T>, u_lobe: T) -> Option<Lobe<T>> {
    let Sample { wi, weight, density, .. } = case.bsdf.sample(wo, u_lobe, [T::HALF; 2])?;
    let Density::Delta(probability) = density else { return None };
    let values = [weight * probability, wi.x(), wi.y(), wi.z()];
    Some(Lobe { values, across: wi.z() * wo.z() < T::ZERO })
}
