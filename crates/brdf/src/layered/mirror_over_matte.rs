//! What the models made of a mirror and a matte term share: their parts, evaluation and sampling.

use etendue_math::{Real, Spectrum, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use crate::bsdf::{above, both_above};
use crate::direction::reflect;
use crate::{Bsdf, BsdfReal, BsdfVec, Density, Lobes, Sample};

/// A model made of a mirror and a matte term, both functions of cosines alone.
///
/// ```text
/// f = m(θo) δ(wi − mirror(wo)) + matte(θo, θi)
/// ```
///
/// `sample` chooses the matte term with probability `a / (m + a)` of the means over the channels, a its
/// albedo, and draws from it by the cosine: `pdf = matte_probability · cos θi / π`.
///
/// All cosines are of directions above the surface.
pub trait MirrorOverMatte: Bsdf {
    /// Reflectance m of the mirror, in `[0, 1]`.
    fn mirror(&self, cos_o: BsdfReal<Self>) -> Self::Color;

    /// The matte term, in sr⁻¹.
    fn matte(&self, cos_o: BsdfReal<Self>, cos_i: BsdfReal<Self>) -> Self::Color;

    /// Its albedo `a = ∫ matte(θo, θi) cos θi dωi`.
    fn matte_albedo(&self, cos_o: BsdfReal<Self>) -> Self::Color;

    /// The probability with which `sample` chooses the matte term; 0 where both parts are black.
    #[inline]
    fn matte_probability(&self, cos_o: BsdfReal<Self>) -> BsdfReal<Self> {
        let (mirror, matte) = (self.mirror(cos_o).mean(), self.matte_albedo(cos_o).mean());
        let sum = mirror + matte;
        if sum > BsdfReal::<Self>::ZERO { matte / sum } else { BsdfReal::<Self>::ZERO }
    }
}

/// The lobes of every such model.
pub(super) const LOBES: Lobes = Lobes { continuous: true, delta: true, transmission: false };

/// `Bsdf::eval_pdf`.
#[inline(always)]
pub(super) fn eval_pdf<M: MirrorOverMatte>(
    model: &M,
    wo: BsdfVec<M>,
    wi: BsdfVec<M>,
) -> (M::Color, BsdfReal<M>) {
    if !both_above(wo, wi) {
        return (M::Color::black(), BsdfReal::<M>::ZERO);
    }
    let density = cosine_hemisphere::pdf::<BsdfReal<M>>(wi);
    (model.matte(wo.z(), wi.z()), model.matte_probability(wo.z()) * density)
}

/// `Bsdf::sample`.
#[inline(always)]
pub(super) fn sample<M: MirrorOverMatte>(
    model: &M,
    wo: BsdfVec<M>,
    u_lobe: BsdfReal<M>,
    u: [BsdfReal<M>; 2],
) -> Option<Sample<M::Color>> {
    if !above(wo) {
        return None;
    }
    let one = BsdfReal::<M>::ONE;
    let probability = model.matte_probability(wo.z());
    let mirror = one - probability;
    let (wi, weight, density) = if u_lobe < mirror {
        (reflect(wo), model.mirror(wo.z()).scale(one / mirror), Density::Delta(mirror))
    } else {
        let wi = cosine_hemisphere::from_square(u);
        let f = model.matte(wo.z(), wi.z());
        let pdf = probability * cosine_hemisphere::pdf::<BsdfReal<M>>(wi);
        if !(pdf > BsdfReal::<M>::ZERO) {
            return None; // a matte term of next to nothing
        }
        // The cosine has been cancelled.
        (wi, f.scale(BsdfReal::<M>::PI / probability), Density::Continuous(pdf))
    };
    // Black also where the probability is 0: then the matte term is.
    let valid = above(wi) && weight.is_finite() && !weight.is_black();
    valid.then_some(Sample { wi, weight, density, eta: one })
}

/// `Bsdf::albedo`.
#[inline(always)]
pub(super) fn albedo<M: MirrorOverMatte>(model: &M, wo: BsdfVec<M>) -> M::Color {
    if above(wo) { model.mirror(wo.z()) + model.matte_albedo(wo.z()) } else { M::Color::black() }
}
