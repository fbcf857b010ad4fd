//! Shirley's coupled matte term under a rough specular share.

use etendue_math::{Real, Spectrum, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use super::coupled_interface::{self, CoupledInterface};
use crate::bsdf::{above, both_above};
use crate::direction::{half_vector, reflect_about};
use crate::mixture::mixture_sample;
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::rough::rough_conductor::reflection_pdf;
use crate::{Bsdf, BsdfReal, BsdfVec, Lobes, Microfacets, Reflectance, Sample};

/// [`Coupled`](crate::Coupled) with a microfacet lobe in the place of its mirror.
///
/// ```text
/// f = D(h) F(wo·h) V(wo, wi) + k Rm (1 − F(θo)) (1 − F(θi))
/// ```
///
/// with V the visibility `G2 / (4 cos θo cos θi)` of the [`Microfacets`] and the matte term of the smooth model.
///
/// * Parameters: as for [`Coupled`](crate::Coupled), and the facets.
/// * Laws: reciprocal; energy is conserved only as far as the rough share reflects what the smooth one would. The
///   facets lose what would scatter more than once, and at middle angles they gain a little, F being convex: the white
///   albedo reaches 1.0025 with isotropic GGX, 1.0053 with Beckmann, and 1.0163 with facets of α 1e-6 × 0.5
///   (all at R0 = 0; measured over a grid of α, angles and indices). With the exact F of an extreme index the gain
///   is larger where the flat surface is seen near its Brewster angle, and lets half of the light in, and the facets
///   are not: 1.0007 for η up to 3, 1.06 for η = 10, 1.42 for η = 100, and towards 1.5 beyond (rm = 1, GGX α 0.5,
///   cos θo ≈ 1/η).
/// * Sampling: `u_lobe` chooses visible normals with probability `F / (F + Rm (1 − F))` of the means at θo, else
///   cosine-weighted; the density is that of the mixture. `None` from below.
/// * The smooth limit is [`Coupled`](crate::Coupled), which [`AnyCoupled`](crate::AnyCoupled) chooses.
///
/// # Precision
/// A few ulp times the condition of the problem.
///
/// # Source
/// As [`Coupled`](crate::Coupled) and [`RoughConductor`](crate::RoughConductor).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughCoupled<C: Spectrum> {
    interface: CoupledInterface<C>,
    facets: Microfacets<C::Real>,
    matte: C,
}

impl<C: Spectrum> RoughCoupled<C> {
    /// A base of reflectance `rm` under the interface with the surface `facets`.
    #[inline]
    pub fn new(
        interface: CoupledInterface<C>,
        facets: Microfacets<C::Real>,
        rm: Reflectance<C>,
    ) -> Self {
        Self { interface, facets, matte: rm.value() }
    }

    /// Probability of the facets; 0 where both shares are black.
    #[inline(always)]
    fn facet_probability(&self, cos_o: C::Real) -> C::Real {
        let facets = self.interface.reflectance(cos_o).mean();
        let sum = facets + (self.interface.transmittance(cos_o) * self.matte).mean();
        if sum > C::Real::ZERO { facets / sum } else { C::Real::ZERO }
    }
}

impl<C: Spectrum> Bsdf for RoughCoupled<C> {
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
        let d = self.facets.ndf(h);
        let lobe = (d * self.facets.visibility(wo, wi)).min(C::Real::MAX);
        let matte = self.interface.matte(wo.z(), wi.z()) * self.matte;
        let versine = (wo - wi).length_squared() / (C::Real::lit(4.0) * (C::Real::ONE + cos));
        let f = self.interface.facet_reflectance(cos, versine).scale(lobe) + matte;
        let p = self.facet_probability(wo.z());
        let pdf = p * reflection_pdf(&self.facets, wo, d)
            + (C::Real::ONE - p) * cosine_hemisphere::pdf::<C::Real>(wi);
        (f.map(|x| x.min(C::Real::MAX)), pdf.min(C::Real::MAX))
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
        let wi = if u_lobe < self.facet_probability(wo.z()) {
            reflect_about(wo, self.facets.sample_visible_normal(wo, u)?)
        } else {
            cosine_hemisphere::from_square(u)
        };
        mixture_sample(self, wo, wi)
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "rough-coupled",
    type_name: "RoughCoupled",
    parameters: &[
        coupled_interface::PARAMETER,
        coupled_interface::MATTE,
        parameter::DISTRIBUTION,
        parameter::ALPHA_X,
        parameter::ALPHA_Y,
        parameter::MASKING,
    ],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Gains {
        maximum: 1.5,
        at: "exact F, eta 1e4, rm 1, cos 1e-4; 1.06 for eta 10, 1.001 for eta up to 3, 1.017 with Schlick's F",
    },
    lobes: Lobes::CONTINUOUS,
    albedo: Albedo::Quadrature,
    density: "mixture of visible normals and cosine",
    source: "Shirley et al. 1997, section 3; Walter et al. 2007",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::directional_albedo;
    use crate::{Alpha, Coupled, laws};
    use etendue_math::glam::DVec3;

    fn model(r0: f64, alpha: f64, rm: f64) -> RoughCoupled<f64> {
        let interface = CoupledInterface::schlick(Reflectance::new(r0).unwrap());
        let facets = Microfacets::ggx(Alpha::new(alpha).unwrap());
        RoughCoupled::new(interface, facets, Reflectance::new(rm).unwrap())
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        let plain = model(0.04, 0.3, 0.7);
        laws::reciprocal(&plain, 1e-12);
        laws::sampling_matches_density(&plain, 1e-10);
        laws::density_integrates_to_at_most_one(&plain);
        laws::total(&plain);
        laws::total(&model(1.0, 1e-8, 1.0));
        laws::total(&model(0.0, 1.0, 0.0));
    }

    #[test]
    fn a_narrow_lobe_reflects_what_the_mirror_does() {
        let (rough, r0) = (model(0.3, 0.02, 0.6), Reflectance::new(0.3).unwrap());
        let smooth = Coupled::new(CoupledInterface::schlick(r0), Reflectance::new(0.6).unwrap());
        for z in [1.0, 0.7, 0.4_f64] {
            let wo = DVec3::new((1.0 - z * z).sqrt(), 0.0, z);
            let albedo = directional_albedo::<_, 256>(&rough, wo);
            // The lobe spans α² of F's curvature; the rule resolves it to as much.
            assert!((albedo - smooth.albedo(wo).unwrap()).abs() < 3e-3, "{z} {albedo}");
        }
    }

    #[test]
    fn facets_that_lean_towards_the_viewer_gain_as_stated() {
        let wo = DVec3::new((1.0 - 0.65 * 0.65_f64).sqrt(), 0.0, 0.65);
        let albedo = directional_albedo::<_, 128>(&model(0.0, 0.15, 1.0), wo);
        // The largest for isotropic GGX; the rule is good to 1e-4 at this width.
        assert!((albedo - 1.0025).abs() < 3e-4, "{albedo}");
    }
}
