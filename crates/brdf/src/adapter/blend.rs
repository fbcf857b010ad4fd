//! Two models on one surface.

use etendue_math::{Real, Spectrum, Vector3};
use etendue_sampling::mis;

use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Density, Lobes, Opacity, Sample};

/// A mixture of two models.
///
/// ```text
/// f = (1 − w) f_first + w f_second
/// ```
///
/// * Laws: those that both models keep; albedo `(1 − w) R_first + w R_second` where both are known.
/// * Sampling: the second model with probability w, the first otherwise, with `u_lobe` stretched for its own use.
///   A direction of a continuous part has the density and the weight of the mixture; one of a delta lobe is that
///   lobe's alone. With w = 0 and w = 1 the other model is absent, its lobes included.
///
/// # Source
/// Mitsuba, blendbsdf; the weight by the balance heuristic of E. Veach, L. Guibas 1995.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blend<A: Bsdf, B> {
    first: A,
    second: B,
    weight: BsdfReal<A>,
}

/// The model a direction was drawn from, or the other.
enum Part {
    First,
    Second,
}

impl<A: Bsdf, B: Bsdf<Color = A::Color>> Blend<A, B> {
    /// `first` and `second` in shares `1 − weight` and `weight`.
    #[inline]
    pub fn new(first: A, second: B, weight: Opacity<BsdfReal<A>>) -> Self {
        Self { first, second, weight: weight.value() }
    }

    /// A sample of one part made one of the mixture.
    #[inline(always)]
    fn mixed(
        &self,
        part: &Part,
        sample: Sample<A::Color>,
        wo: BsdfVec<A>,
    ) -> Option<Sample<A::Color>> {
        let (w, one) = (self.weight, BsdfReal::<A>::ONE);
        let (share, other_share) = match part {
            Part::First => (one - w, w),
            Part::Second => (w, one - w),
        };
        let own = match sample.density {
            Density::Delta(p) => {
                let p = p * share;
                let valid = p > BsdfReal::<A>::ZERO;
                return valid.then_some(Sample { density: Density::Delta(p), ..sample });
            }
            Density::Continuous(pdf) => pdf * share,
        };
        if !(other_share > BsdfReal::<A>::ZERO) {
            return Some(sample);
        }
        let (f, pdf) = match part {
            Part::First => self.second.eval_pdf(wo, sample.wi),
            Part::Second => self.first.eval_pdf(wo, sample.wi),
        };
        let other = pdf * other_share;
        let density = (own + other).min(BsdfReal::<A>::MAX);
        if !(density > BsdfReal::<A>::ZERO) {
            return None;
        }
        // (own weight + other f cos) / density, the first term with its factors cancelled.
        let rest = f.scale(other_share * (sample.wi.z().abs() / density));
        let weight = sample.weight.scale(mis::balance(own, other)) + rest;
        let weight = weight.map(|x| x.min(BsdfReal::<A>::MAX));
        Some(Sample { weight, density: Density::Continuous(density), ..sample })
    }
}

impl<A: Bsdf, B: Bsdf<Color = A::Color>> Bsdf for Blend<A, B> {
    type Color = A::Color;

    #[inline]
    fn lobes(&self) -> Lobes {
        let (first, second) = (self.first.lobes(), self.second.lobes());
        if self.weight <= BsdfReal::<A>::ZERO {
            first
        } else if self.weight >= BsdfReal::<A>::ONE {
            second
        } else {
            Lobes {
                continuous: first.continuous || second.continuous,
                delta: first.delta || second.delta,
                transmission: first.transmission || second.transmission,
            }
        }
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (A::Color, BsdfReal<Self>) {
        let (f, pdf) = self.first.eval_pdf(wo, wi);
        let (g, other) = self.second.eval_pdf(wo, wi);
        let (w, rest) = (self.weight, BsdfReal::<A>::ONE - self.weight);
        let max = BsdfReal::<A>::MAX;
        let value = f.scale(rest) + g.scale(w);
        (value.map(|x| x.min(max)), (pdf * rest + other * w).min(max))
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<A::Color>> {
        let (w, one) = (self.weight, BsdfReal::<A>::ONE);
        let limit = BsdfReal::<A>::ONE_MINUS_EPSILON;
        if u_lobe < w {
            let sample = self.second.sample(wo, (u_lobe / w).min(limit), u)?;
            self.mixed(&Part::Second, sample, wo)
        } else {
            let sample = self.first.sample(wo, ((u_lobe - w) / (one - w)).min(limit), u)?;
            self.mixed(&Part::First, sample, wo)
        }
    }

    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<A::Color> {
        let (w, rest) = (self.weight, BsdfReal::<A>::ONE - self.weight);
        Some(self.first.albedo(wo)?.scale(rest) + self.second.albedo(wo)?.scale(w))
    }

    #[inline]
    fn pass_through(&self, wo: BsdfVec<Self>) -> A::Color {
        let (w, rest) = (self.weight, BsdfReal::<A>::ONE - self.weight);
        self.first.pass_through(wo).scale(rest) + self.second.pass_through(wo).scale(w)
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "blend",
    type_name: "Blend",
    parameters: &[
        parameter::named("first", "any model"),
        parameter::named("second", "any model of the same colour"),
        parameter::named("weight", "in [0, 1]"),
    ],
    reciprocity: Reciprocity::UpToSquaredIndex,
    energy: Energy::Conserves,
    lobes: Lobes { continuous: true, delta: true, transmission: true },
    albedo: Albedo::Inner,
    density: "mixture of the two",
    source: "Mitsuba, blendbsdf",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Alpha, ComplexIor, Lambert, Microfacets, Reflectance, RoughConductor, SmoothConductor, laws,
    };
    use etendue_math::glam::DVec3;

    type Metal = RoughConductor<f64>;

    fn paint(weight: f64, alpha: f64) -> Blend<Lambert<f64>, Metal> {
        let facets = Microfacets::ggx(Alpha::new(alpha).unwrap());
        let metal = RoughConductor::new(ComplexIor::new(1.4, 1.6).unwrap(), facets);
        let diffuse = Lambert::new(Reflectance::new(0.5).unwrap());
        Blend::new(diffuse, metal, Opacity::new(weight).unwrap())
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        for weight in [0.0, 0.3, 1.0] {
            let model = paint(weight, 0.3);
            laws::reciprocal(&model, 1e-12);
            laws::sampling_matches_density(&model, 1e-9);
            laws::density_integrates_to_at_most_one(&model);
            laws::total(&model);
        }
        laws::total(&paint(0.5, 1e-8));
    }

    #[test]
    fn delta_lobes_keep_their_weight_and_share_their_probability() {
        let mirror = SmoothConductor::new(ComplexIor::<f64>::perfect());
        let diffuse = Lambert::new(Reflectance::<f64>::white());
        let model = Blend::new(diffuse, mirror, Opacity::new(0.25).unwrap());
        let wo = DVec3::new(0.6, 0.0, 0.8);
        let s = model.sample(wo, 0.2, [0.5; 2]).unwrap();
        assert_eq!(s.density, Density::Delta(0.25));
        assert!((s.weight - 1.0).abs() < 1e-15);
        let s = model.sample(wo, 0.25, [0.5; 2]).unwrap();
        // The mirror has no continuous part: weight f cos / (¾ cos/π) / ¾ of it.
        assert!((s.weight - 1.0).abs() < 1e-15);
        assert!((model.albedo(wo).unwrap() - 1.0).abs() < 1e-15);
        laws::sampling_matches_density(&model, 1e-14);
        laws::total(&model);
    }

    #[test]
    fn at_its_ends_the_other_model_is_absent() {
        let mirror = SmoothConductor::new(ComplexIor::<f64>::perfect());
        let diffuse = Lambert::new(Reflectance::<f64>::white());
        let at = |w| Blend::new(diffuse, mirror, Opacity::new(w).unwrap()).lobes();
        assert_eq!((at(0.0), at(1.0)), (diffuse.lobes(), mirror.lobes()));
        assert!(at(0.5).continuous && at(0.5).delta);
    }
}
