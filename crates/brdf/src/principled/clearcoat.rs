//! The clear coat: a second, weak highlight.

use etendue_math::{Real, Vec3, Vector3};

use super::fresnel::schlick_weight;
use super::gtr1::Gtr1;
use crate::fresnel::RelativeIndex;
use crate::microfacet::ggx;

/// Clear coat with GTR1 facets.
///
/// ```text
/// f = clearcoat/4 · F(wo·h) D(h) G(wo) G(wi),   F = Schlick with F0 = 0.04
/// α = 0.1 + (0.001 − 0.1) gloss,   G of GGX with α = 0.25
/// pdf = D(h) h.z / (4 wo·h)
/// ```
///
/// There is no `1/(4 cos θo cos θi)`, as there is none in the published model's code.
///
/// # Source
/// B. Burley, SIGGRAPH 2012 course notes, section 5.6; Mitsuba 3, principledhelpers.h.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Clearcoat<T> {
    quarter: T,
    facets: Gtr1<T>,
}

/// Width of the facets that mask the coat.
const MASKING_ALPHA: f64 = 0.25;

impl<T: Real> Clearcoat<T> {
    /// Weight and gloss in `[0, 1]`.
    pub(super) fn new(weight: T, gloss: T) -> Self {
        let alpha = T::lit(0.1) + (T::lit(0.001) - T::lit(0.1)) * gloss;
        Self { quarter: weight * T::lit(0.25), facets: Gtr1::new(alpha) }
    }

    /// A quarter of the weight: the lobe's share in sampling.
    #[inline]
    pub(super) fn share(&self) -> T {
        self.quarter
    }

    /// Value and density for a pair above the surface with half vector `h`, `cos = wo·h`.
    #[inline]
    pub(super) fn eval_pdf(
        &self,
        index: RelativeIndex<T>,
        [wo, wi, h]: [Vec3<T>; 3],
        cos: T,
    ) -> (T, T) {
        if !(self.quarter > T::ZERO) {
            return (T::ZERO, T::ZERO);
        }
        let d = self.facets.ndf(h);
        let f0 = T::lit(0.04);
        let f = f0 + (T::ONE - f0) * schlick_weight(index, cos);
        let alpha = T::lit(MASKING_ALPHA);
        let g = |w: Vec3<T>| {
            let area = ggx::projected_area(w, alpha, alpha);
            if area > T::ZERO { w.z() / area } else { T::ZERO }
        };
        let pdf = if cos > T::ZERO { d * (h.z() / (T::lit(4.0) * cos)) } else { T::ZERO };
        (self.quarter * f * d * g(wo) * g(wi), pdf.min(T::MAX))
    }

    /// A facet normal with density `D(h) h.z`.
    #[inline]
    pub(super) fn sample(&self, u: [T; 2]) -> Vec3<T> {
        self.facets.sample(u)
    }
}
