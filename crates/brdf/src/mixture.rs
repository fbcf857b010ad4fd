//! Sampling shared by the reflection models that are mixtures of lobes.

use etendue_math::{Real, Spectrum, Vector3};

use crate::{Bsdf, BsdfReal, BsdfVec, Density, Sample};

/// A direction drawn from one lobe of a mixture, worth `f cos / pdf` of the whole; `None` where that is
/// nothing.
#[inline(always)]
pub(crate) fn mixture_sample<B: Bsdf>(
    model: &B,
    wo: BsdfVec<B>,
    wi: BsdfVec<B>,
) -> Option<Sample<B::Color>> {
    let (f, pdf) = model.eval_pdf(wo, wi);
    if !(pdf > BsdfReal::<B>::ZERO) || f.is_black() {
        return None;
    }
    let weight = f.scale(wi.z() / pdf);
    // A density so small that nothing is ever drawn with it.
    if !weight.is_finite() {
        return None;
    }
    Some(Sample { wi, weight, density: Density::Continuous(pdf), eta: BsdfReal::<B>::ONE })
}

/// The same for models whose value may be enormous where the density is tiny, and on either side of the surface: the
/// weight is limited to the largest finite number. `eta` is that of the medium of `wi`.
#[inline]
pub(crate) fn limited_mixture_sample<B: Bsdf>(
    model: &B,
    wo: BsdfVec<B>,
    wi: BsdfVec<B>,
    eta: BsdfReal<B>,
) -> Option<Sample<B::Color>> {
    let (f, pdf) = model.eval_pdf(wo, wi);
    if !(pdf > BsdfReal::<B>::ZERO) || f.is_black() {
        return None;
    }
    let weight = f.map(|c| (c / pdf * wi.z().abs()).min(BsdfReal::<B>::MAX));
    Some(Sample { wi, weight, density: Density::Continuous(pdf), eta })
}
