//! Sampling shared by the diffuse models whose density is the cosine.

use etendue_math::{Real, Spectrum};
use etendue_sampling::warp::cosine_hemisphere;

use crate::bsdf::above;
use crate::{Bsdf, BsdfReal, BsdfVec, Density, Sample};

/// A cosine-weighted sample of a diffuse model: weight `π f`.
#[inline]
pub(super) fn cosine_sample<B: Bsdf>(
    model: &B,
    wo: BsdfVec<B>,
    u: [BsdfReal<B>; 2],
) -> Option<Sample<B::Color>> {
    let wi = cosine_hemisphere::from_square(u);
    if !above(wo) || !above(wi) {
        return None;
    }
    let (f, pdf) = model.eval_pdf(wo, wi);
    let weight = f.scale(BsdfReal::<B>::PI);
    let density = Density::Continuous(pdf);
    (!weight.is_black()).then_some(Sample { wi, weight, density, eta: BsdfReal::<B>::ONE })
}

/// What values are limited to where they overflow: finite after a multiplication by π, too.
#[inline(always)]
pub(super) fn largest_value<T: Real>() -> T {
    T::MAX * T::lit(0.25)
}
