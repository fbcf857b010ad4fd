//! Rough glass: microfacet reflection and refraction.

use etendue_math::{Real, Spectrum, Vec3, Vector3};

use super::rough_conductor::reflection_pdf;
use crate::bsdf::above;
use crate::direction::{half_vector, reflect_about};
use crate::fresnel::{RelativeIndex, refract_at};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{
    Bsdf, BsdfReal, BsdfVec, Density, Ior, Lobes, Microfacets, ParameterError, Reflectance, Sample,
};

/// Rough interface between two dielectrics.
///
/// With η the index of the medium of `wi` relative to that of `wo` across the surface:
///
/// ```text
/// reflection   h = normalize(wo + wi)
///              f = ks F(wo·h) D(h) V,        pdf = F D(h) / (4 σ(wo))
/// refraction   l = wo + η wi,  h = ∓ l/|l| on the upper side
///              f = kt 4 |wo·h| |wi·h| (1 − F) D(h) V / |l|²
///              pdf = (1 − F) D(h) |wo·h| / σ(wo) · η² |wi·h| / |l|²
/// weight       ks G2/G1(wo),  kt G2/G1(wo) / η²
/// ```
///
/// `|l|² = (wo·h + η wi·h)²` is Walter's denominator without its cancellation, and
/// `V = G2 / (4 |cos θo cos θi|)`.
///
/// * Laws: reflection is reciprocal, refraction up to η² (radiance transport); loses what would
///   scatter more than once. Two-sided.
/// * Sampling: visible normals, then reflection with probability F of the drawn facet; three
///   uniforms. `None` where the direction ends on the wrong side.
///
/// # Precision
/// A few ulp times the condition of the problem, of which η → 1 is a part.
///
/// # Source
/// B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, eqs. 16 to
/// 21 and 41; visible normals after E. Heitz and E. d'Eon, EGSR 2014.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughDielectric<C: Spectrum> {
    from_above: RelativeIndex<C::Real>,
    from_below: RelativeIndex<C::Real>,
    facets: Microfacets<C::Real>,
    specular_reflectance: C,
    specular_transmittance: C,
}

impl<C: Spectrum> RoughDielectric<C> {
    /// The interface to a medium below with relative index `eta`.
    ///
    /// # Errors
    /// [`ParameterError`] for η = 1: every pair of opposite directions would have a half vector of
    /// length 0. The model there is [`Null`](crate::Null), which [`Dielectric`](crate::Dielectric) chooses.
    pub fn new(eta: Ior<C::Real>, facets: Microfacets<C::Real>) -> Result<Self, ParameterError> {
        if eta.is_matched() {
            let domain = "different from 1 (use the pass-through model)";
            return Err(ParameterError::number("eta", eta.value(), domain));
        }
        Ok(Self {
            from_above: RelativeIndex::from_above(eta.value()),
            from_below: RelativeIndex::from_below(eta.value()),
            facets,
            specular_reflectance: C::white(),
            specular_transmittance: C::white(),
        })
    }

    /// The same with reflection scaled by `ks` and transmission by `kt`, factors without physical meaning.
    #[inline]
    pub fn with_factors(self, ks: Reflectance<C>, kt: Reflectance<C>) -> Self {
        Self { specular_reflectance: ks.value(), specular_transmittance: kt.value(), ..self }
    }

    /// `wo` and `wi` mirrored so that `wo` is above, and the index as the side of `wo` sees it.
    #[inline(always)]
    fn upright(
        &self,
        wo: BsdfVec<Self>,
        wi: BsdfVec<Self>,
    ) -> (BsdfVec<Self>, BsdfVec<Self>, RelativeIndex<C::Real>) {
        if wo.z() < C::Real::ZERO {
            (wo.flip_z(), wi.flip_z(), self.from_below)
        } else {
            (wo, wi, self.from_above)
        }
    }

    #[inline]
    fn reflection(
        &self,
        wo: Vec3<C::Real>,
        wi: Vec3<C::Real>,
        index: RelativeIndex<C::Real>,
    ) -> (C, C::Real) {
        let Some((h, cos)) = half_vector(wo, wi) else { return (C::black(), C::Real::ZERO) };
        let f = index.reflectance(cos);
        let d = self.facets.ndf(h);
        let lobe = (f * d * self.facets.visibility(wo, wi)).min(C::Real::MAX);
        (self.specular_reflectance.scale(lobe), f * reflection_pdf(&self.facets, wo, d))
    }
}

/// Refraction through facets: `T 4 |wo·h| |wi·h| D V / |l|²` and `T D |wo·h| / σ(wo) · η² |wi·h| / |l|²`,
/// the value and the density it has where the facet refracts with its probability T.
///
/// `wo` above, `wi` below the surface; `index` as the side of `wo` sees it.
#[inline]
pub(crate) fn refraction_lobe<T: Real>(
    facets: &Microfacets<T>,
    index: RelativeIndex<T>,
    wo: Vec3<T>,
    wi: Vec3<T>,
) -> (T, T) {
    let nothing = (T::ZERO, T::ZERO);
    let (l, eta) = (index.half_sum(wo, wi), index.eta());
    let squared = l.length_squared();
    let Some(h) = l.try_normalize() else { return nothing };
    let h = if h.z() < T::ZERO { -h } else { h };
    let (cos_o, cos_i) = (wo.dot(h), -wi.dot(h));
    if !(cos_o > T::ZERO && cos_i > T::ZERO) {
        return nothing; // a facet cannot be seen from behind
    }
    let t = index.transmittance_of_pair(cos_o, eta * cos_i);
    let d = t * facets.ndf(h) * (cos_i / squared) * cos_o;
    let lobe = T::lit(4.0) * d * facets.visibility(wo, wi);
    let pdf = d * eta * eta / facets.projected_area(wo);
    (lobe.min(T::MAX), pdf.min(T::MAX))
}

impl<C: Spectrum> Bsdf for RoughDielectric<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes { continuous: true, delta: false, transmission: true }
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        let (wo, wi, index) = self.upright(wo, wi);
        if above(wo) && above(wi) {
            self.reflection(wo, wi, index)
        } else if above(wo) && above(-wi) {
            let (lobe, pdf) = refraction_lobe(&self.facets, index, wo, wi);
            (self.specular_transmittance.scale(lobe), pdf)
        } else {
            (C::black(), C::Real::ZERO)
        }
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        let one = <C::Real as Real>::ONE;
        let (w, _, index) = self.upright(wo, wo);
        if !above(w) {
            return None;
        }
        let h = self.facets.sample_visible_normal(w, u)?;
        let cos = w.dot(h).min(one);
        let f = index.reflectance(cos);
        let d = self.facets.ndf(h);
        let (wi, factor, pdf, eta_i) = if u_lobe < f {
            let wi = reflect_about(w, h);
            if !above(wi) {
                return None;
            }
            (wi, self.specular_reflectance, f * reflection_pdf(&self.facets, w, d), one)
        } else {
            let g = index.scaled_cos_t(cos)?;
            let wi = refract_at(w, h, index, cos, g)?;
            if !above(-wi) {
                return None;
            }
            // `l = (c − g) h` and `η cos θi = g`, known better here than from the rounded direction.
            let eta = index.eta();
            let length = index.cosine_difference(cos, g);
            let t = index.transmittance_of_pair(cos, g);
            let visible = d * cos / self.facets.projected_area(w);
            let pdf = (t * visible * (g / (length * length)) * eta).min(C::Real::MAX);
            (wi, self.specular_transmittance.scale(one / (eta * eta)), pdf, eta)
        };
        let weight = factor.scale(self.facets.weight(w, wi));
        if weight.is_black() || !(pdf > C::Real::ZERO) {
            return None;
        }
        let wi = if wo.z() < C::Real::ZERO { wi.flip_z() } else { wi };
        Some(Sample { wi, weight, density: Density::Continuous(pdf), eta: eta_i })
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "rough-dielectric",
    type_name: "RoughDielectric",
    parameters: &[
        parameter::ROUGH_ETA,
        parameter::DISTRIBUTION,
        parameter::ALPHA_X,
        parameter::ALPHA_Y,
        parameter::MASKING,
        parameter::KS,
        parameter::KT,
    ],
    reciprocity: Reciprocity::UpToSquaredIndex,
    energy: Energy::Conserves,
    lobes: Lobes { continuous: true, delta: false, transmission: true },
    albedo: Albedo::Quadrature,
    density: "visible normals, reflection with probability F",
    source: "Walter et al. 2007; Heitz and d'Eon 2014",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use crate::{Alpha, BeckmannLambda, Distribution, Masking};
    use etendue_math::glam::DVec3;

    const BECKMANN: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Exact };

    fn glass(distribution: Distribution, alpha: f64, eta: f64) -> RoughDielectric<f64> {
        let alpha = Alpha::new(alpha).unwrap();
        let facets = Microfacets::new(distribution, alpha, alpha, Masking::Separable);
        RoughDielectric::new(Ior::new(eta).unwrap(), facets).unwrap()
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        for distribution in [Distribution::Ggx, BECKMANN] {
            for eta in [1.5, 1.0 / 1.33] {
                let model = glass(distribution, 0.4, eta);
                laws::sampling_matches_density(&model, 1e-8);
                laws::density_integrates_to_at_most_one(&model);
                laws::total(&model);
            }
        }
        let facets = Microfacets::ggx(Alpha::new(1e-3_f32).unwrap());
        laws::total(&RoughDielectric::<f32>::new(Ior::new(1.000_000_1).unwrap(), facets).unwrap());
    }

    #[test]
    fn refraction_is_symmetric_up_to_the_squared_index() {
        let eta = 1.5;
        let model = glass(Distribution::Ggx, 0.5, eta);
        let (a, b) = (DVec3::new(0.36, 0.48, 0.8), DVec3::new(-0.28, -0.0, -0.96));
        // f(wo, wi) η_i² is symmetric: below is the denser medium.
        let (into, back) = (model.eval(a, b), model.eval(b, a));
        assert!(into > 0.0 && (into * eta * eta - back).abs() < 1e-13 * back, "{into} {back}");
    }

    #[test]
    fn sampled_weights_add_up_to_the_known_energy() {
        // Reflected and transmitted flux for GGX, α = 0.3, at cos = 1, 0.5, 0.1 from either side.
        let model = glass(Distribution::Ggx, 0.3, 1.5);
        for (side, want) in [(1.0, [0.9884, 0.9469, 0.8498]), (-1.0, [0.8995, 0.7802, 0.7398])] {
            for (cos, want) in [1.0, 0.5, 0.1_f64].into_iter().zip(want) {
                let wo = DVec3::new((1.0 - cos * cos).sqrt(), 0.0, side * cos);
                let mut sum = 0.0;
                for i in 0..32 * 32 * 32 {
                    let u = [i % 32, i / 32 % 32, i / 1024].map(|i| (f64::from(i) + 0.5) / 32.0);
                    let sample = model.sample(wo, u[0], [u[1], u[2]]);
                    // Flux: without the 1/η² of radiance.
                    sum += sample.map_or(0.0, |s| s.weight * s.eta * s.eta) / 32_768.0;
                }
                // Where one lobe is lost below the horizon, 32 strata place the edge to 1/32 of some 0.1.
                assert!((sum - want).abs() < 4e-3, "{side} {cos} {sum} {want}");
            }
        }
    }

    #[test]
    fn a_matched_index_is_refused() {
        let facets = Microfacets::ggx(Alpha::new(0.1_f64).unwrap());
        assert!(RoughDielectric::<f64>::new(Ior::new(1.0).unwrap(), facets).is_err());
    }
}
