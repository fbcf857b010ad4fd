//! Delta lobes: directions, probabilities and energy.

use etendue_brdf::registry::Energy;
use etendue_brdf::{Density, Sample};
use etendue_math::{Vec3, Vector3};

use super::Context;
use crate::generators::unit_pair;
use crate::measure::{Outcome, Worst};
use crate::scalar::Scalar;
use crate::subject::{Case, Subject};

/// One direction of a delta lobe, as samples report it.
pub(super) struct DeltaLobe<T: Scalar> {
    pub(super) wi: Vec3<T>,
    pub(super) weight: T,
    pub(super) probability: f64,
    pub(super) eta: T,
}

impl<T: Scalar> DeltaLobe<T> {
    /// The sample came from this lobe. Two lobes may share a direction (a mask over glass, seen
    /// along the normal), but then differ in probability or index.
    pub(super) fn drew(&self, sample: &Sample<T>) -> bool {
        self.wi == sample.wi
            && self.eta == sample.eta
            && matches!(sample.density, Density::Delta(p) if p.to_f64() == self.probability)
    }
}

/// First steps over `u_lobe`; what lies between two steps that differ is bisected.
const STEPS: u32 = 32;

/// The delta lobes, each once: the unit interval of `u_lobe` is cut wherever the drawn lobe
/// changes, down to neighbouring numbers, so that no lobe between two others is too small to be met.
pub(super) fn lobes_of<T: Scalar>(case: &Case<T>, wo: Vec3<T>) -> Vec<DeltaLobe<T>> {
    let mut found = Vec::new();
    if case.bsdf.lobes().delta {
        let mut before = (T::ZERO, draw(case, wo, T::ZERO, &mut found));
        for i in 1..=STEPS {
            let u = T::lit(f64::from(i) / f64::from(STEPS)).min(T::ONE_MINUS_EPSILON);
            let here = (u, draw(case, wo, u, &mut found));
            bisect(case, wo, [before, here], &mut found);
            before = here;
        }
    }
    found
}

/// Index of the lobe drawn, which is added if it is new; `None` if it is no delta lobe.
fn draw<T: Scalar>(
    case: &Case<T>,
    wo: Vec3<T>,
    u_lobe: T,
    found: &mut Vec<DeltaLobe<T>>,
) -> Option<usize> {
    let sample = case.bsdf.sample(wo, u_lobe, [T::lit(0.375), T::lit(0.625)])?;
    let Density::Delta(probability) = sample.density else { return None };
    let known = found.iter().position(|l| l.drew(&sample));
    Some(known.unwrap_or_else(|| {
        found.push(DeltaLobe {
            wi: sample.wi,
            weight: sample.weight,
            probability: probability.to_f64(),
            eta: sample.eta,
        });
        found.len() - 1
    }))
}

/// Looks for further lobes between two values of `u_lobe` that draw different ones.
fn bisect<T: Scalar>(
    case: &Case<T>,
    wo: Vec3<T>,
    [low, high]: [(T, Option<usize>); 2],
    found: &mut Vec<DeltaLobe<T>>,
) {
    let middle = T::HALF * (low.0 + high.0);
    if low.1 == high.1 || middle <= low.0 || middle >= high.0 {
        return;
    }
    let middle = (middle, draw(case, wo, middle, found));
    bisect(case, wo, [low, middle], found);
    bisect(case, wo, [middle, high], found);
}

/// Asserts for delta lobes that
///
/// ```text
/// reflection      wi = (−x, −y, z)
/// refraction      η wi.xy = −wo.xy (Snell's law), |wi| = 1; η = 1 passes straight through
/// index           seen from the other side it is 1/η
/// probabilities   Σ p ≤ 1, and Σ p = 1 where there is nothing but delta lobes and all are drawn
/// energy          Σ weight · p (η² if across) ≤ 1 where promised
/// ```
///
/// Tolerance: 16 ulp of 1, a handful of products of numbers up to 1 and the rounding of `wo`
/// itself, whose length is 1 within 2 ulp.
pub(super) fn check<T: Scalar>(subject: &Subject<T>, context: &Context) -> Outcome {
    let (case, kinds) = (subject.case, subject.case.bsdf.lobes());
    if !kinds.delta {
        return Outcome::NotApplicable("no delta lobe");
    }
    let mut worst = Worst::default();
    let ulp = T::EPSILON.to_f64();
    // Every direction costs a sweep: a tenth of the pairs of other checks is as much work.
    for i in 0..(context.budget.pairs / 10) as u64 {
        let wo = unit_pair::<T>(71, i)[0];
        let lobes = lobes_of(case, wo);
        if lobes.is_empty() {
            continue;
        }
        for lobe in &lobes {
            let error = misdirection(wo, lobe).to_f64();
            worst.observe(error / ulp, || subject.at(wo, lobe.wi));
            if let Some(error) = index_error(case, wo, lobe) {
                worst.observe(error / ulp, || format!("{}: index", subject.at(wo, lobe.wi)));
            }
        }
        let total: f64 = lobes.iter().map(|l| l.probability).sum();
        let unaccounted = if !kinds.continuous && complete(case, wo) {
            (total - 1.0).abs()
        } else {
            (total - 1.0).max(0.0)
        };
        worst.observe(unaccounted / ulp, || format!("{}: Σp = {total}", subject.at_view(wo)));
        let energy: f64 = lobes.iter().map(energy_of::<T>).sum();
        if subject.laws.energy == Energy::Conserves {
            worst.observe((energy - 1.0).max(0.0) / ulp, || {
                format!("{}: energy {energy}", subject.at_view(wo))
            });
        }
    }
    worst.within_if_any(16.0, "ulp of 1")
}

/// How far η of a refracted direction and of the way back are from being inverse; `None` where there is no way
/// across or back.
fn index_error<T: Scalar>(case: &Case<T>, wo: Vec3<T>, lobe: &DeltaLobe<T>) -> Option<f64> {
    let across = |w: Vec3<T>, wi: Vec3<T>| (w.z() < T::ZERO) != (wi.z() < T::ZERO);
    if !across(wo, lobe.wi) {
        return None;
    }
    let back = lobes_of(case, lobe.wi).into_iter().filter(|b| across(lobe.wi, b.wi));
    back.map(|b| (b.eta.to_f64() * lobe.eta.to_f64() - 1.0).abs()).reduce(f64::min)
}

/// No draw over the range of `u_lobe`, its ends included, is without a sample.
fn complete<T: Scalar>(case: &Case<T>, wo: Vec3<T>) -> bool {
    let u = [T::lit(0.375), T::lit(0.625)];
    (0..=STEPS).all(|i| {
        let u_lobe = T::lit(f64::from(i) / f64::from(STEPS)).min(T::ONE_MINUS_EPSILON);
        case.bsdf.sample(wo, u_lobe, u).is_some()
    })
}

fn energy_of<T: Scalar>(lobe: &DeltaLobe<T>) -> f64 {
    let eta = lobe.eta.to_f64();
    lobe.weight.to_f64() * lobe.probability * eta * eta
}

/// Largest deviation from mirror reflection or Snell's law.
fn misdirection<T: Scalar>(wo: Vec3<T>, lobe: &DeltaLobe<T>) -> T {
    let wi = lobe.wi;
    let side = if wi.z() * wo.z() > T::ZERO {
        (wi.z() - wo.z()).abs().max((lobe.eta - T::ONE).abs())
    } else {
        (wi.length() - T::ONE).abs()
    };
    let tangential = (wi.x() * lobe.eta + wo.x()).abs().max((wi.y() * lobe.eta + wo.y()).abs());
    side.max(tangential)
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::broken::{MirrorFault, mirror_verdict};

    #[test]
    fn a_sound_mirror_passes_and_broken_ones_are_caught() {
        assert!(mirror_verdict(MirrorFault::None, check).passed());
        assert!(!mirror_verdict(MirrorFault::Gain, check).passed());
        assert!(!mirror_verdict(MirrorFault::HalfProbability, check).passed());
        assert!(!mirror_verdict(MirrorFault::BentRay, check).passed());
    }
}
