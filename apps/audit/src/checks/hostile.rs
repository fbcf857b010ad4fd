//! Inputs that break reflection code.

use etendue_brdf::{Density, Sample};
use etendue_math::{Real, Spectrum, Vec3, Vector3};

use super::Context;
use crate::generators::{HOSTILE_UNIFORMS, poisoned, unit_grid, unnormalised};
use crate::measure::{Measurement, Outcome};
use crate::scalar::Scalar;
use crate::subject::Subject;

/// Asserts over a grid of hostile directions and uniforms that
///
/// - `eval`, `pdf`, `eval_pdf` and `albedo` are finite and not negative, and `eval_pdf` has the
///   bits of `eval` and `pdf`;
/// - where there is no direction (zero, NaN or infinite components) values are 0, samples `None`;
/// - every sample has a unit direction, a finite weight that is not negative, a density above 0
///   and a positive η.
///
/// Unnormalised directions may give any finite value that is not negative. Tolerance: none, but 8
/// ulp for the length of a sampled direction: `2 (w·h) h − w` multiplies the 1½ ulp of a normalised
/// `h` by up to four and adds its own two.
pub(super) fn check<T: Scalar>(subject: &Subject<T>, _: &Context) -> Outcome {
    let mut tally = Tally { subject, violations: 0, first: String::new(), evaluations: 0 };
    let (units, strange, void) = (unit_grid::<T>(), unnormalised::<T>(), poisoned::<T>());
    for &wo in units.iter().chain(&strange) {
        for &wi in units.iter().chain(&strange) {
            tally.values(wo, wi);
        }
        for &wi in &void {
            tally.nothing(wo, wi);
            tally.nothing(wi, wo);
        }
    }
    for (directions, kind) in
        [(&units, Kind::Unit), (&strange, Kind::Unnormalised), (&void, Kind::Void)]
    {
        for &wo in directions {
            tally.albedo(wo);
            tally.samples(wo, kind);
        }
    }
    Outcome::Measured(Measurement {
        worst: tally.violations as f64,
        bound: 0.0,
        unit: "violations",
        at: tally.first,
        evaluations: tally.evaluations,
    })
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Unit,
    Unnormalised,
    Void,
}

struct Tally<'a, T: Scalar> {
    subject: &'a Subject<'a, T>,
    violations: u64,
    first: String,
    evaluations: u64,
}

impl<T: Scalar> Tally<'_, T> {
    fn expect(&mut self, held: bool, what: impl FnOnce() -> String) {
        self.evaluations += 1;
        if !held {
            if self.violations == 0 {
                self.first = what();
            }
            self.violations += 1;
        }
    }

    fn values(&mut self, wo: Vec3<T>, wi: Vec3<T>) {
        let (subject, bsdf) = (self.subject, &self.subject.case.bsdf);
        let (f, pdf) = (bsdf.eval(wo, wi), bsdf.pdf(wo, wi));
        self.expect(sane(f) && sane(pdf), || format!("{}: f {f}, pdf {pdf}", subject.at(wo, wi)));
        self.expect(bsdf.eval_pdf(wo, wi) == (f, pdf), || {
            format!("{}: eval_pdf differs from eval and pdf", subject.at(wo, wi))
        });
    }

    fn nothing(&mut self, wo: Vec3<T>, wi: Vec3<T>) {
        let (subject, bsdf) = (self.subject, &self.subject.case.bsdf);
        let both = [bsdf.eval(wo, wi), bsdf.pdf(wo, wi)];
        self.expect(both == [T::ZERO; 2], || {
            format!("{}: {both:?} without a direction", subject.at(wo, wi))
        });
    }

    fn albedo(&mut self, wo: Vec3<T>) {
        if let Some(albedo) = self.subject.case.bsdf.albedo(wo) {
            let subject = self.subject;
            self.expect(sane(albedo), || format!("{}: albedo {albedo}", subject.at_view(wo)));
        }
    }

    fn samples(&mut self, wo: Vec3<T>, kind: Kind) {
        let uniforms = HOSTILE_UNIFORMS.map(|u| T::lit(u).min(T::ONE_MINUS_EPSILON));
        for lobe in uniforms {
            for u in uniforms.iter().flat_map(|&a| uniforms.map(|b| [a, b])) {
                let subject = self.subject;
                let sample = subject.case.bsdf.sample(wo, lobe, u);
                let held = match (&sample, kind) {
                    (None, _) => true,
                    (Some(_), Kind::Void) => false,
                    (Some(s), Kind::Unnormalised) => sane(s.weight),
                    (Some(s), Kind::Unit) => well_formed(s),
                };
                self.expect(held, || {
                    format!("{}, u {lobe:?} {u:?}: {sample:?}", subject.at_view(wo))
                });
            }
        }
    }
}

fn sane<T: Scalar>(x: T) -> bool {
    x >= T::ZERO && Real::is_finite(x)
}

fn well_formed<C: Spectrum<Real = T>, T: Scalar>(sample: &Sample<C>) -> bool {
    let (Density::Continuous(density) | Density::Delta(density)) = sample.density;
    (sample.wi.length() - T::ONE).abs() <= T::lit(8.0) * T::EPSILON
        && sane(sample.weight.channel(0))
        && sane(density)
        && density > T::ZERO
        && sane(sample.eta)
        && sample.eta > T::ZERO
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::broken::{Fault, verdict};

    #[test]
    fn a_sound_model_passes_and_nan_negatives_and_answers_to_nothing_are_caught() {
        assert!(verdict(Fault::None, check).passed());
        assert!(!verdict(Fault::NanAtGrazing, check).passed());
        assert!(!verdict(Fault::NegativeBehind, check).passed());
        assert!(!verdict(Fault::AcceptsNan, check).passed());
        assert!(!verdict(Fault::LongSamples, check).passed());
    }
}
