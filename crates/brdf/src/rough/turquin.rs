//! Rough metal with what single scattering loses, after Turquin.

use etendue_math::{Real, Spectrum, Vector3};

use crate::microfacet::FacetLoss;
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::smooth::smooth_conductor::conductor_reflectance;
use crate::{
    Bsdf, BsdfReal, BsdfVec, ComplexIor, Lobes, Microfacets, ParameterError, Reflectance,
    RoughConductor, Sample,
};

/// Rough conductor scaled up, for each view direction, by what it loses.
///
/// ```text
/// f = f₁ (1 + F0 l(θo) / (1 − l(θo))),  l = 1 − E,  F0 = F(1)
/// ```
///
/// with f₁ of [`RoughConductor`] and l from [`FacetLoss`]: the cheap variant of
/// [`KullaContyConductor`](crate::KullaContyConductor). No second lobe, one look-up, and the sampler of
/// visible normals with its weights scaled.
///
/// * Laws: *not* reciprocal: the factor depends on `wo` alone. White furnace: with F = 1 the directional
///   albedo is 1 within the table's error divided by E: 3e-3 for GGX, 5e-3 for Beckmann.
/// * Domain: isotropic α in `[1e-8, 1]`, facets that [`FacetLoss`] has a table for.
/// * Sampling: that of [`RoughConductor`].
///
/// # Precision
/// A few ulp of the formula with the table's l.
///
/// # Source
/// E. Turquin, "Practical Multiple Scattering Compensation for Microfacet Models", Industrial Light & Magic
/// 2019, eq. 16.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurquinConductor<C: Spectrum> {
    single: RoughConductor<C>,
    loss: FacetLoss<C::Real>,
    /// F at normal incidence.
    f0: C,
}

impl<C: Spectrum> TurquinConductor<C> {
    /// Metal with complex index `ior` and the surface `facets`.
    ///
    /// # Errors
    /// [`ParameterError`] where [`FacetLoss`] has no table.
    pub fn new(ior: ComplexIor<C>, facets: Microfacets<C::Real>) -> Result<Self, ParameterError> {
        Ok(Self {
            single: RoughConductor::new(ior, facets),
            loss: FacetLoss::new(&facets)?,
            f0: conductor_reflectance(ior, C::Real::ONE),
        })
    }

    /// The same with its reflection scaled by `ks`, a factor without physical meaning.
    #[inline]
    pub fn with_specular_reflectance(self, ks: Reflectance<C>) -> Self {
        Self { single: self.single.with_specular_reflectance(ks), ..self }
    }

    /// `1 + F0 l / (1 − l)`; l is below 0.72 for every table.
    #[inline(always)]
    fn factor(&self, cos: C::Real) -> C {
        let lost = self.loss.at(cos);
        let ratio = lost / (C::Real::ONE - lost);
        self.f0.map(|f| C::Real::ONE + f * ratio)
    }
}

impl<C: Spectrum> Bsdf for TurquinConductor<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::CONTINUOUS
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        let (f, pdf) = self.single.eval_pdf(wo, wi);
        ((f * self.factor(wo.z())).map(|x| x.min(C::Real::MAX)), pdf)
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        let sample = self.single.sample(wo, u_lobe, u)?;
        Some(Sample { weight: sample.weight * self.factor(wo.z()), ..sample })
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "turquin-conductor",
    type_name: "TurquinConductor",
    parameters: &[
        parameter::COMPLEX_ETA,
        parameter::K,
        parameter::DISTRIBUTION,
        parameter::TABULATED_ALPHA,
        parameter::MASKING,
        parameter::KS,
    ],
    reciprocity: Reciprocity::NonReciprocal { residual: None },
    energy: Energy::Gains {
        maximum: 1.005,
        at: "F = 1, Beckmann α 0.46, cos 0.9: the error of the table; 1.003 for GGX",
    },
    lobes: Lobes::CONTINUOUS,
    albedo: Albedo::Quadrature,
    density: "visible normals",
    source: "Turquin 2019",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use crate::microfacet::facet_loss;
    use crate::{Alpha, BeckmannLambda, Distribution, Masking};
    use etendue_math::glam::DVec3;

    const BECKMANN: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Exact };

    fn mirror(distribution: Distribution, alpha: f64) -> TurquinConductor<f64> {
        let alpha = Alpha::new(alpha).unwrap();
        let facets = Microfacets::new(distribution, alpha, alpha, Masking::HeightCorrelated);
        TurquinConductor::new(ComplexIor::perfect(), facets).unwrap()
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf_but_for_reciprocity() {
        let model = mirror(Distribution::Ggx, 0.6);
        laws::sampling_matches_density(&model, 1e-9);
        laws::density_integrates_to_at_most_one(&model);
        laws::total(&model);
        let (a, b) = (DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.0, 0.96, 0.28));
        assert!((model.eval(a, b) / model.eval(b, a) - 1.0).abs() > 0.1);
    }

    #[test]
    fn a_white_furnace_stays_white() {
        for (distribution, bound) in [(Distribution::Ggx, 3e-3), (BECKMANN, 5e-3)] {
            for alpha in [1e-3, 0.03, 0.1, 0.25, 0.47, 0.8, 1.0] {
                let model = mirror(distribution, alpha);
                for cos in [1.0, 0.9, 0.6, 0.3, 0.1, 0.03] {
                    let albedo = (1.0 - facet_loss(model.single.facets(), cos)) * model.factor(cos);
                    assert!(
                        (albedo - 1.0).abs() < bound,
                        "{distribution:?} {alpha} {cos} {albedo}"
                    );
                }
            }
        }
    }
}
