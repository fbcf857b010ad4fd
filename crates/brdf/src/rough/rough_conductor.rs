//! Rough metal: microfacet reflection.

use core::marker::PhantomData;

use etendue_math::{Real, Spectrum, Vector3};

use crate::bsdf::{above, both_above};
use crate::direction::{half_vector, reflect_about};
use crate::microfacet::{NormalSampling, VisibleNormals};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::smooth::smooth_conductor::conductor_reflectance;
use crate::{
    Bsdf, BsdfReal, BsdfVec, ComplexIor, Density, Lobes, Microfacets, ParameterError, Reflectance,
    Sample,
};

/// Rough conductor: single scattering from microfacets with conductor Fresnel.
///
/// ```text
/// h = normalize(wo + wi)
/// f = ks D(h) F(wo·h) V(wo, wi),  V = G2 / (4 cos θo cos θi)
/// pdf = D(h) / (4 A),                      A = σ(wo) for visible normals
/// weight = ks F(wo·h) 4 cos θi A V           = ks F G2(wo, wi) / G1(wo) for visible normals
/// ```
///
/// * Laws: reciprocal; directional albedo ≤ 1, and below it by what would scatter more than once
///   (0.307 is left of 1 for GGX, α = 1, F = 1 at normal incidence);
///   [`KullaContyConductor`](crate::KullaContyConductor) returns that.
/// * Sampling: normals by the strategy `S`, visible ones unless [`sampled_by`](Self::sampled_by) another
///   (see [`NormalSampling`]), two uniforms; `None` from below and where the reflected direction falls
///   below, which is a loss of the model and why the density integrates to less than 1.
///
/// # Precision
/// A few ulp times the condition of the problem.
///
/// # Source
/// R. Cook and K. Torrance, ACM TOG 1(1), 1982; B. Walter et al., EGSR 2007, eq. 20; E. Heitz,
/// JCGT 3(2), 2014 and 7(4), 2018.
///
/// # Examples
/// ```
/// use etendue_brdf::{Alpha, Bsdf, ComplexIor, Microfacets, RoughConductor};
/// use etendue_math::{Rgb, glam::Vec3};
/// let gold = ComplexIor::new(Rgb::new(0.14_f32, 0.37, 1.44), Rgb::new(3.98, 2.39, 1.60))?;
/// let model = RoughConductor::new(gold, Microfacets::ggx(Alpha::new(0.2)?));
/// let wo = Vec3::new(0.6, 0.0, 0.8);
/// if let Some(sample) = model.sample(wo, 0.5, [0.25, 0.75]) {
///     let (f, pdf) = model.eval_pdf(wo, sample.wi);
///     assert!((f.r * sample.wi.z / pdf - sample.weight.r).abs() < 1e-5);
/// }
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughConductor<C: Spectrum, S = VisibleNormals> {
    ior: ComplexIor<C>,
    specular_reflectance: C,
    facets: Microfacets<C::Real>,
    sampling: PhantomData<S>,
}

impl<C: Spectrum> RoughConductor<C> {
    /// Metal with complex index `ior` and the surface `facets`, sampled by visible normals.
    #[inline]
    pub fn new(ior: ComplexIor<C>, facets: Microfacets<C::Real>) -> Self {
        Self { ior, specular_reflectance: C::white(), facets, sampling: PhantomData }
    }
}

impl<C: Spectrum, S: NormalSampling<C::Real>> RoughConductor<C, S> {
    /// The same surface with its normals drawn by another strategy.
    ///
    /// ```
    /// use etendue_brdf::microfacet::BoundedCaps;
    /// use etendue_brdf::{Alpha, ComplexIor, Microfacets, RoughConductor};
    /// let facets = Microfacets::ggx(Alpha::new(0.5_f64)?);
    /// let model = RoughConductor::<f64>::new(ComplexIor::perfect(), facets);
    /// let bounded = model.sampled_by::<BoundedCaps>()?;
    /// # Ok::<(), etendue_brdf::ParameterError>(())
    /// ```
    ///
    /// # Errors
    /// [`ParameterError`] where the strategy does not exist for the distribution of the facets.
    pub fn sampled_by<R: NormalSampling<C::Real>>(
        self,
    ) -> Result<RoughConductor<C, R>, ParameterError> {
        if !R::supports(self.facets.distribution()) {
            let domain = "ggx for this way of drawing normals";
            return Err(ParameterError::choice("distribution", "beckmann", domain));
        }
        let Self { ior, specular_reflectance, facets, .. } = self;
        Ok(RoughConductor { ior, specular_reflectance, facets, sampling: PhantomData })
    }

    /// The same with its reflection scaled by `ks`, a factor without physical meaning.
    #[inline]
    pub fn with_specular_reflectance(self, ks: Reflectance<C>) -> Self {
        Self { specular_reflectance: ks.value(), ..self }
    }

    /// Complex index.
    #[inline(always)]
    pub fn ior(&self) -> ComplexIor<C> {
        self.ior
    }

    /// The surface.
    #[inline(always)]
    pub fn facets(&self) -> &Microfacets<C::Real> {
        &self.facets
    }

    #[inline(always)]
    fn reflectance(&self, cos: C::Real) -> C {
        conductor_reflectance(self.ior, cos) * self.specular_reflectance
    }
}

impl<C: Spectrum, S: NormalSampling<C::Real>> Bsdf for RoughConductor<C, S> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::CONTINUOUS
    }

    #[inline(always)]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        let nothing = (C::black(), C::Real::ZERO);
        if !both_above(wo, wi) {
            return nothing;
        }
        let Some((h, cos)) = half_vector(wo, wi) else { return nothing };
        let d = self.facets.ndf(h);
        let lobe = (d * self.facets.visibility(wo, wi)).min(C::Real::MAX);
        (self.reflectance(cos).scale(lobe), density(d, S::area(&self.facets, wo, h, cos)))
    }

    /// Without what the value alone needs: of the provided one the optimiser does not remove it.
    #[inline]
    fn pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> BsdfReal<Self> {
        if !both_above(wo, wi) {
            return C::Real::ZERO;
        }
        half_vector(wo, wi).map_or(C::Real::ZERO, |(h, cos)| {
            density(self.facets.ndf(h), S::area(&self.facets, wo, h, cos))
        })
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        _u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        if !above(wo) {
            return None;
        }
        let h = S::sample(&self.facets, wo, u)?;
        let wi = reflect_about(wo, h);
        if !above(wi) {
            return None;
        }
        let cos = wo.dot(h);
        let area = S::area(&self.facets, wo, h, cos);
        let weight = self.reflectance(cos).scale(self.facets.weight_of_area(wo, wi, area));
        let pdf = density(self.facets.ndf(h), area);
        if weight.is_black() || !(pdf > C::Real::ZERO) {
            return None;
        }
        Some(Sample { wi, weight, density: Density::Continuous(pdf), eta: C::Real::ONE })
    }
}

/// Density of the direction reflected at a visible normal with density `d = D(h)`: `D / (4 σ(wo))`.
#[inline(always)]
pub(crate) fn reflection_pdf<T: Real>(
    facets: &Microfacets<T>,
    wo: etendue_math::Vec3<T>,
    d: T,
) -> T {
    density(d, facets.projected_area(wo))
}

/// Density of the direction reflected at a normal with density `D (wo·h) / A`: `D / (4 A)`.
#[inline(always)]
fn density<T: Real>(d: T, area: T) -> T {
    let area = T::lit(4.0) * area;
    if area > T::ZERO { (d / area).min(T::MAX) } else { T::ZERO }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "rough-conductor",
    type_name: "RoughConductor",
    parameters: &[
        parameter::COMPLEX_ETA,
        parameter::K,
        parameter::DISTRIBUTION,
        parameter::ALPHA_X,
        parameter::ALPHA_Y,
        parameter::MASKING,
        parameter::KS,
    ],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes::CONTINUOUS,
    albedo: Albedo::Quadrature,
    density: "visible normals; bounded ones or all by choice",
    source: "Walter et al. 2007; Heitz 2014, 2018; Dupuy and Benyoub 2023; Eto and Tokuyoshi 2023",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use crate::quadrature::directional_albedo;
    use crate::{Alpha, BeckmannLambda, Distribution, Masking};
    use etendue_math::glam::DVec3;

    fn mirror(distribution: Distribution, masking: Masking, x: f64, y: f64) -> RoughConductor<f64> {
        let facets =
            Microfacets::new(distribution, Alpha::new(x).unwrap(), Alpha::new(y).unwrap(), masking);
        RoughConductor::new(ComplexIor::perfect(), facets)
    }

    const EXACT: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Exact };
    const WALTER: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Walter };

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        for distribution in [Distribution::Ggx, EXACT, WALTER] {
            for masking in [Masking::HeightCorrelated, Masking::Separable] {
                let model = mirror(distribution, masking, 0.3, 0.7);
                laws::reciprocal(&model, 1e-11);
                laws::sampling_matches_density(&model, 1e-9);
                laws::density_integrates_to_at_most_one(&model);
                laws::total(&model);
                laws::total(&mirror(distribution, masking, 1e-8, 1.0));
            }
        }
        let facets = Microfacets::ggx(Alpha::new(1e-3_f32).unwrap());
        laws::total(&RoughConductor::new(ComplexIor::<f32>::perfect(), facets));
    }

    #[test]
    fn the_albedo_at_normal_incidence_has_its_closed_form() {
        let model = mirror(Distribution::Ggx, Masking::HeightCorrelated, 1.0, 1.0);
        let got = directional_albedo::<_, 64>(&model, DVec3::Z);
        // 1 − ln 2; the integrand is smooth but for √ at the horizon.
        assert!((got - (1.0 - Real::ln(2.0))).abs() < 1e-6, "{got}");
    }

    #[test]
    fn tabulated_albedos_are_reproduced() {
        for (distribution, masking, want) in [
            (Distribution::Ggx, Masking::HeightCorrelated, [0.68295, 0.74527, 0.86011]),
            (Distribution::Ggx, Masking::Separable, [0.67845, 0.71415, 0.77228]),
            (EXACT, Masking::HeightCorrelated, [0.87382, 0.89595, 0.95503]),
            (EXACT, Masking::Separable, [0.87381, 0.89231, 0.93609]),
        ] {
            let model = mirror(distribution, masking, 0.5, 0.5);
            for (cos, want) in [0.7, 0.3, 0.1_f64].into_iter().zip(want) {
                let wo = DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
                let got = directional_albedo::<_, 96>(&model, wo);
                // Five digits are known.
                assert!((got - want).abs() < 1e-4, "{distribution:?} {masking:?} {cos} {got}");
            }
        }
    }
}
