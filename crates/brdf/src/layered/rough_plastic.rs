//! Rough plastic: a diffuse base under a rough dielectric interface.

use etendue_math::{Real, Spectrum, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use super::internal_scattering::{specular_probability, specular_share};
use crate::bsdf::{above, both_above};
use crate::direction::{half_vector, reflect_about};
use crate::fresnel::dielectric;
use crate::mixture::mixture_sample;
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::rough::rough_conductor::reflection_pdf;
use crate::{
    Bsdf, BsdfReal, BsdfVec, InternalScattering, Lobes, Reflectance, Sample, TransmittanceTable,
};

/// Rough plastic: microfacet reflection at the interface, diffuse scattering below it.
///
/// ```text
/// f = ks D(h) F(wo·h) V(wo, wi) + kd' T(θo) T(θi) / (π η²)
/// kd' = kd / (1 − F_in)  or  kd / (1 − kd F_in)
/// ```
///
/// with T and F_in from a [`TransmittanceTable`].
///
/// * Laws: reciprocal; conserves energy but for the table's interpolation (the interface loses
///   what would scatter more than once between its facets).
/// * Sampling: `u_lobe` chooses visible normals with probability
///   `(1 − T) s / ((1 − T) s + T (1 − s))`, `s = mean(ks) / (mean(ks) + mean(kd))`, else
///   cosine-weighted; the density is that of the mixture. `None` from below.
/// * The smooth limit is [`Plastic`](crate::Plastic), which [`AnyPlastic`](crate::AnyPlastic) chooses.
///
/// # Precision
/// A few ulp of the formula with the table's T.
///
/// # Source
/// Mitsuba's roughplastic (W. Jakob).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughPlastic<'a, C: Spectrum> {
    table: &'a TransmittanceTable<C::Real>,
    diffuse: C,
    /// `kd' / (π η²)`
    base: C,
    specular: C,
    share: C::Real,
}

impl<'a, C: Spectrum> RoughPlastic<'a, C> {
    /// A base of albedo `diffuse` under the tabulated interface.
    #[inline]
    pub fn new(
        table: &'a TransmittanceTable<C::Real>,
        diffuse: Reflectance<C>,
        scattering: InternalScattering,
    ) -> Self {
        let diffuse = diffuse.value();
        let factor = C::Real::FRAC_1_PI / (table.eta() * table.eta());
        let base = scattering.base(diffuse, table.internal_reflectance()).scale(factor);
        let specular = C::white();
        Self { table, diffuse, base, specular, share: specular_share(specular, diffuse) }
    }

    /// The same with its interface reflection scaled by `ks`, a factor without physical meaning.
    #[inline]
    pub fn with_specular_reflectance(self, ks: Reflectance<C>) -> Self {
        let specular = ks.value();
        Self { specular, share: specular_share(specular, self.diffuse), ..self }
    }

    #[inline(always)]
    fn facet_probability(&self, transmittance: C::Real) -> C::Real {
        specular_probability(C::Real::ONE - transmittance, transmittance, self.share)
    }
}

impl<C: Spectrum> Bsdf for RoughPlastic<'_, C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::CONTINUOUS
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        let nothing = (C::black(), C::Real::ZERO);
        if !both_above(wo, wi) {
            return nothing;
        }
        let Some((h, cos)) = half_vector(wo, wi) else { return nothing };
        let facets = self.table.facets();
        let d = facets.ndf(h);
        let f = dielectric(cos, self.table.eta());
        let lobe = (f * d * facets.visibility(wo, wi)).min(C::Real::MAX);
        let t = self.table.transmittance(wo.z());
        let p = self.facet_probability(t);
        let value =
            self.specular.scale(lobe) + self.base.scale(t * self.table.transmittance(wi.z()));
        let pdf = p * reflection_pdf(facets, wo, d)
            + (C::Real::ONE - p) * cosine_hemisphere::pdf::<C::Real>(wi);
        (value, pdf)
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
        let p = self.facet_probability(self.table.transmittance(wo.z()));
        let wi = if u_lobe < p {
            reflect_about(wo, self.table.facets().sample_visible_normal(wo, u)?)
        } else {
            cosine_hemisphere::from_square(u)
        };
        mixture_sample(self, wo, wi)
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "rough-plastic",
    type_name: "RoughPlastic",
    parameters: &[
        parameter::ETA,
        parameter::DISTRIBUTION,
        parameter::ALPHA,
        parameter::MASKING,
        parameter::REFLECTANCE,
        parameter::KS,
        parameter::SCATTERING,
        parameter::INTERNAL,
    ],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes::CONTINUOUS,
    albedo: Albedo::Quadrature,
    density: "mixture of visible normals and cosine",
    source: "Mitsuba, roughplastic",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use crate::quadrature::directional_albedo;
    use crate::{Alpha, Distribution, InternalReflectance, Ior, Masking};
    use etendue_math::glam::DVec3;

    fn table() -> TransmittanceTable<f64> {
        TransmittanceTable::new(
            Ior::new(1.5).unwrap(),
            Distribution::Ggx,
            Alpha::new(0.3).unwrap(),
            Masking::Separable,
            InternalReflectance::Exact,
        )
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        let table = table();
        let model = RoughPlastic::new(
            &table,
            Reflectance::new(0.7).unwrap(),
            InternalScattering::NonLinear,
        );
        laws::reciprocal(&model, 1e-12);
        laws::sampling_matches_density(&model, 1e-10);
        laws::density_integrates_to_at_most_one(&model);
        laws::total(&model);
    }

    #[test]
    fn a_white_base_gains_no_energy_and_loses_little() {
        let table = table();
        let model =
            RoughPlastic::new(&table, Reflectance::<f64>::white(), InternalScattering::Linear);
        for z in [1.0, 0.6, 0.2_f64] {
            let albedo =
                directional_albedo::<_, 64>(&model, DVec3::new((1.0 - z * z).sqrt(), 0.0, z));
            // The interface alone drops some 12 % on the way in and as much on the way out.
            assert!(albedo < 1.0 && albedo > 0.6, "{z} {albedo}");
        }
    }
}
