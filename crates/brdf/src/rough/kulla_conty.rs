//! Rough metal with what single scattering loses, after Kulla and Conty.

use etendue_math::{Real, Spectrum, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use crate::bsdf::{above, both_above};
use crate::fresnel::conductor_average;
use crate::microfacet::FacetLoss;
use crate::mixture::mixture_sample;
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{
    Bsdf, BsdfReal, BsdfVec, ComplexIor, Lobes, Microfacets, ParameterError, Reflectance,
    RoughConductor, Sample,
};

/// Rough conductor with a second, diffuse lobe for light that leaves after several facets.
///
/// ```text
/// f = f₁ + F_ms l(θo) l(θi) / (π l_avg),  l = 1 − E
/// F_ms = F_avg² (1 − l_avg) / (1 − F_avg l_avg)
/// ```
///
/// with f₁ of [`RoughConductor`], l from [`FacetLoss`] and F_avg the mean over the hemisphere, per channel.
/// F_ms is the series `Σ F^(k+1) l^(k−1) (1 − l)` over k + 1 reflections: with every reflection the colour
/// saturates.
///
/// * Laws: reciprocal. White furnace: with F = 1 the directional albedo is 1 within the table's error, 1e-3
///   for GGX and 4e-3 for Beckmann, at all angles.
/// * Domain: isotropic α in `[1e-8, 1]`, facets that [`FacetLoss`] has a table for.
/// * Sampling: `u_lobe` chooses visible normals with probability
///   `(1 − l) F_avg / ((1 − l) F_avg + l F_ms)` at θo (channels averaged), else cosine-weighted; the density
///   is that of the mixture.
/// * Cost: two look-ups with a root each per evaluation; one material is 160 numbers.
///
/// # Precision
/// A few ulp of the formula with the table's l.
///
/// # Source
/// C. Kulla and A. Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 course. They
/// print F_ms with a single F_avg in the numerator; light in this lobe has met two facets at least, hence
/// the square. Against the random walk of [`microfacet::walk`](crate::microfacet::walk), grey GGX metals at
/// α = 0.9: too dark in albedo by 0.007 to 0.015 (F_avg 0.37) and 0.016 to 0.021 (F_avg 0.92). Unsquared it
/// would be too bright by 0.02 to 0.08 and by 0.001 to 0.025: the square errs on the side of losing.
///
/// # Examples
/// ```
/// use etendue_brdf::{Alpha, Bsdf, ComplexIor, KullaContyConductor, Microfacets};
/// use etendue_brdf::quadrature::directional_albedo;
/// use etendue_math::glam::DVec3;
/// let facets = Microfacets::ggx(Alpha::new(1.0_f64)?);
/// let model = KullaContyConductor::<f64>::new(ComplexIor::perfect(), facets)?;
/// // Single scattering would leave 1 − ln 2.
/// assert!((directional_albedo::<_, 64>(&model, DVec3::Z) - 1.0).abs() < 1e-3);
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KullaContyConductor<C: Spectrum> {
    single: RoughConductor<C>,
    loss: FacetLoss<C::Real>,
    /// `ks F_ms / (π l_avg)`
    multiple: C,
    /// Channel means of `F_avg` and `F_ms`, what the lobes are chosen by.
    shares: [C::Real; 2],
}

/// What facets reflect more than once: `F_ms`, and the factor `1/(π l_avg)` of `l(θo) l(θi)`.
pub(crate) struct Multiple<C: Spectrum> {
    pub(crate) reflectance: C,
    pub(crate) scale: C::Real,
}

impl<C: Spectrum> Multiple<C> {
    /// Of facets with the mean reflectance `average`.
    pub(crate) fn new(average: C, loss: &FacetLoss<C::Real>) -> Self {
        let (one, lost) = (C::Real::ONE, loss.average());
        let reflectance = average.map(|f| {
            let kept = one - f * lost;
            // l_avg is below 1 for every table, and so is the product.
            f * f * (one - lost) / kept
        });
        let scale = if lost > C::Real::ZERO { C::Real::FRAC_1_PI / lost } else { C::Real::ZERO };
        Self { reflectance, scale }
    }
}

impl<C: Spectrum> KullaContyConductor<C> {
    /// Metal with complex index `ior` and the surface `facets`.
    ///
    /// # Errors
    /// [`ParameterError`] where [`FacetLoss`] has no table.
    pub fn new(ior: ComplexIor<C>, facets: Microfacets<C::Real>) -> Result<Self, ParameterError> {
        Self::with_average(ior, facets, Self::average_reflectance(ior))
    }

    /// The hemispherical average of Fresnel's term, [`conductor_average`]: what [`new`](Self::new) spends most of its time on, and the
    /// same for all facets.
    pub fn average_reflectance(ior: ComplexIor<C>) -> C {
        ior.eta().zip(ior.k(), conductor_average)
    }

    /// The same model with [`average_reflectance`](Self::average_reflectance) known beforehand.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_average(
        ior: ComplexIor<C>,
        facets: Microfacets<C::Real>,
        average: C,
    ) -> Result<Self, ParameterError> {
        let loss = FacetLoss::new(&facets)?;
        let Multiple { reflectance, scale } = Multiple::new(average, &loss);
        Ok(Self {
            single: RoughConductor::new(ior, facets),
            loss,
            multiple: reflectance.scale(scale),
            shares: [average.mean(), reflectance.mean()],
        })
    }

    /// The same with its reflection scaled by `ks`, a factor without physical meaning.
    #[inline]
    pub fn with_specular_reflectance(self, ks: Reflectance<C>) -> Self {
        Self {
            single: self.single.with_specular_reflectance(ks),
            multiple: self.multiple * ks.value(),
            ..self
        }
    }

    /// Probabilities of the two lobes where `lost` is `l(θo)`; of a nearly smooth surface the second is
    /// tiny, and not 1 less the first.
    #[inline(always)]
    fn probabilities(&self, lost: C::Real) -> [C::Real; 2] {
        let shares = [(C::Real::ONE - lost) * self.shares[0], lost * self.shares[1]];
        let sum = shares[0] + shares[1];
        if sum > C::Real::ZERO { shares.map(|s| s / sum) } else { [C::Real::ONE, C::Real::ZERO] }
    }
}

impl<C: Spectrum> Bsdf for KullaContyConductor<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::CONTINUOUS
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        if !both_above(wo, wi) {
            return (C::black(), C::Real::ZERO);
        }
        let (f, pdf) = self.single.eval_pdf(wo, wi);
        let lost = self.loss.at(wo.z());
        let [single, multiple] = self.probabilities(lost);
        let diffuse = self.multiple.scale(lost * self.loss.at(wi.z()));
        let pdf = single * pdf + multiple * cosine_hemisphere::pdf::<C::Real>(wi);
        ((f + diffuse).map(|x| x.min(C::Real::MAX)), pdf.min(C::Real::MAX))
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        if !above(wo) {
            return None;
        }
        let [single, _] = self.probabilities(self.loss.at(wo.z()));
        let wi = if u_lobe < single {
            self.single.sample(wo, u_lobe, u)?.wi
        } else {
            cosine_hemisphere::from_square(u)
        };
        mixture_sample(self, wo, wi)
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "kulla-conty-conductor",
    type_name: "KullaContyConductor",
    parameters: &[
        parameter::COMPLEX_ETA,
        parameter::K,
        parameter::DISTRIBUTION,
        parameter::TABULATED_ALPHA,
        parameter::MASKING,
        parameter::KS,
    ],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Gains {
        maximum: 1.004,
        at: "F = 1, Beckmann α 0.46, cos 0.9: the error of the table; 1.001 for GGX",
    },
    lobes: Lobes::CONTINUOUS,
    albedo: Albedo::Quadrature,
    density: "mixture of visible normals and cosine",
    source: "Kulla and Conty 2017, with the square of F_avg",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use crate::microfacet::facet_loss;
    use crate::{Alpha, BeckmannLambda, Distribution, Masking};

    const BECKMANN: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Exact };

    fn facets(distribution: Distribution, alpha: f64, masking: Masking) -> Microfacets<f64> {
        let alpha = Alpha::new(alpha).unwrap();
        Microfacets::new(distribution, alpha, alpha, masking)
    }

    fn mirror(facets: Microfacets<f64>) -> KullaContyConductor<f64> {
        KullaContyConductor::new(ComplexIor::perfect(), facets).unwrap()
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        for (distribution, masking) in [
            (Distribution::Ggx, Masking::HeightCorrelated),
            (Distribution::Ggx, Masking::Separable),
            (BECKMANN, Masking::HeightCorrelated),
        ] {
            let model = mirror(facets(distribution, 0.6, masking));
            laws::reciprocal(&model, 1e-11);
            laws::sampling_matches_density(&model, 1e-9);
            laws::density_integrates_to_at_most_one(&model);
            laws::total(&model);
            laws::total(&mirror(facets(distribution, 1e-8, masking)));
        }
    }

    #[test]
    fn a_white_furnace_stays_white_at_every_width_and_angle() {
        for (distribution, masking, bound) in [
            (Distribution::Ggx, Masking::HeightCorrelated, 1e-3),
            (Distribution::Ggx, Masking::Separable, 1e-3),
            (BECKMANN, Masking::HeightCorrelated, 4e-3),
        ] {
            for alpha in [1e-3, 0.03, 0.1, 0.25, 0.47, 0.8, 1.0] {
                let facets = facets(distribution, alpha, masking);
                let model = mirror(facets);
                // 2 ∫ l(μ) μ dμ / l_avg by panels that shrink towards grazing, where l lives for small α.
                let mut share = 0.0;
                for k in 0..40 {
                    let (a, b) = (Real::powf(0.7, f64::from(k + 1)), Real::powf(0.7, f64::from(k)));
                    for (t, w) in etendue_math::quadrature::gauss_legendre::<f64, 16>() {
                        let mu = a + (b - a) * t;
                        share += w * (b - a) * 2.0 * mu * model.loss.at(mu);
                    }
                }
                share /= model.loss.average();
                // Linear interpolation of the average between its 64 widths.
                assert!((share - 1.0).abs() < 1e-2, "{distribution:?} {alpha} {share}");
                for cos in [1.0, 0.9, 0.6, 0.3, 0.1, 0.03] {
                    let albedo = 1.0 - facet_loss(&facets, cos) + model.loss.at(cos) * share;
                    assert!(
                        (albedo - 1.0).abs() < bound,
                        "{distribution:?} {alpha} {cos} {albedo}"
                    );
                }
            }
        }
    }

    #[test]
    fn surfaces_without_a_table_are_refused() {
        let [a, b] = [0.3, 0.4].map(|a| Alpha::new(a).unwrap());
        let anisotropic = Microfacets::new(Distribution::Ggx, a, b, Masking::Separable);
        for facets in [
            anisotropic,
            facets(Distribution::Ggx, 1.1, Masking::Separable),
            facets(BECKMANN, 0.3, Masking::Separable),
        ] {
            assert!(KullaContyConductor::<f64>::new(ComplexIor::perfect(), facets).is_err());
        }
    }
}
