//! Metal: facets by their colours, with what they reflect more than once.

use etendue_math::{Real, Spectrum};

use crate::fresnel::F82Tint;
use crate::microfacet::FacetLoss;
use crate::rough::kulla_conty::Multiple;
use crate::{Alpha, Microfacets, ParameterError, Reflectance};

/// The reflectance of metal and its second, diffuse lobe after Kulla and Conty.
///
/// ```text
/// F(c) = w F82(c),   f_ms = w F_ms l(θo) l(θi) / (π l_avg)
/// ```
///
/// with w = `base_metalness` · min(1, `specular_weight`), [`F82Tint`] of the colours, and l, F_ms of
/// [`KullaContyConductor`](crate::KullaContyConductor) for facets of the mean width `α = r²`.
///
/// # Source
/// OpenPBR 1.1, "Metal".
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Metal<C: Spectrum> {
    weight: C::Real,
    fresnel: F82Tint<C>,
    /// l, and `w F_ms / (π l_avg)`; `None` for a mirror.
    multiple: Option<(FacetLoss<C::Real>, C)>,
    /// Channel means of `w F_avg` and `w F_ms`.
    shares: [C::Real; 2],
}

impl<C: Spectrum> Metal<C> {
    /// Metal of these colours at normal incidence and towards the edge; `None` where `weight` is 0.
    pub(super) fn new(
        weight: C::Real,
        [base, edge]: [C; 2],
        roughness: C::Real,
        is_mirror: bool,
    ) -> Result<Option<Self>, ParameterError> {
        if !(weight > C::Real::ZERO) {
            return Ok(None);
        }
        let fresnel = F82Tint::new(Reflectance::new(base)?, Reflectance::new(edge)?);
        let average = fresnel.average();
        let (mut multiple, mut shares) = (None, [weight * average.mean(), C::Real::ZERO]);
        if !is_mirror {
            let loss = FacetLoss::new(&Microfacets::ggx(Alpha::clamped(roughness * roughness)))?;
            let Multiple { reflectance, scale } = Multiple::new(average, &loss);
            multiple = Some((loss, reflectance.scale(weight * scale)));
            shares[1] = weight * reflectance.mean();
        }
        Ok(Some(Self { weight, fresnel, multiple, shares }))
    }

    /// `F(c)`
    #[inline]
    pub(super) fn reflectance(&self, cos: C::Real) -> C {
        self.fresnel.reflectance(cos).scale(self.weight)
    }

    /// `f_ms`
    #[inline]
    pub(super) fn multiple(&self, cos_o: C::Real, cos_i: C::Real) -> C {
        self.multiple
            .as_ref()
            .map_or(C::black(), |(loss, color)| color.scale(loss.at(cos_o) * loss.at(cos_i)))
    }

    /// About how much the two lobes reflect of light at an angle: what they are chosen by.
    #[inline]
    pub(super) fn albedos(&self, cos_o: C::Real) -> [C::Real; 2] {
        let lost = self.multiple.as_ref().map_or(C::Real::ZERO, |(loss, _)| loss.at(cos_o));
        [(C::Real::ONE - lost) * self.shares[0], lost * self.shares[1]]
    }
}
