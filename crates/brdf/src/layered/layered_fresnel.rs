//! A mirror by Schlick's Fresnel term, and a Lambertian term by what the mirror leaves.

use etendue_math::{Real, Spectrum};

use super::mirror_over_matte::{self, MirrorOverMatte};
use crate::fresnel::{schlick, schlick_transmittance};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Lobes, Reflectance, Sample};

/// A mirror weighted by the Fresnel term, over a Lambertian term weighted by its complement: the common
/// blend of renderers, offered for comparison with [`Coupled`](crate::Coupled).
///
/// ```text
/// f = Rf(θo) δ(wi − mirror(wo)) + (1 − Rf(θi)) rd / π
/// Rf(θ) = R0 + (1 − R0)(1 − cos θ)⁵
/// ```
///
/// with θi the angle of the light.
///
/// * Parameters: `r0` and `rd` per channel in `[0, 1]`.
/// * Laws: **not reciprocal**: the matte term knows the light's angle and not the viewer's, and exchanging the
///   normal and a direction at cos θ = 0.1 changes it by 59 % (`0.9⁵`, whatever the parameters). A beam of light loses nothing,
///   `Rf + (1 − Rf) rd ≤ 1`; but the albedo for a viewer, `Rf(θo) + rd (1 − R0) 20/21`, reaches 1.95
///   at grazing angles for R0 = 0, so that a path traced from the camera gains energy.
/// * Sampling: mirror or cosine, see [`MirrorOverMatte`]; `None` from below.
///
/// # Precision
/// A few ulp; `1 − Rf` does not cancel near grazing.
///
/// # Source
/// P. Shirley, B. Smits, H. Hu, E. Lafortune, "A Practitioners' Assessment of Light Reflection Models",
/// Pacific Graphics 1997, which shows what is wrong with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayeredFresnel<C> {
    r0: C,
    matte: C,
}

impl<C: Spectrum> LayeredFresnel<C> {
    /// The mirror's reflectance at normal incidence and the reflectance of the base.
    #[inline]
    pub fn new(r0: Reflectance<C>, rd: Reflectance<C>) -> Self {
        Self { r0: r0.value(), matte: rd.value() }
    }
}

impl<C: Spectrum> MirrorOverMatte for LayeredFresnel<C> {
    #[inline(always)]
    fn mirror(&self, cos_o: C::Real) -> C {
        schlick(self.r0, cos_o)
    }
    #[inline(always)]
    fn matte(&self, _cos_o: C::Real, cos_i: C::Real) -> C {
        (self.matte * schlick_transmittance(self.r0, cos_i)).scale(C::Real::FRAC_1_PI)
    }
    #[inline(always)]
    fn matte_albedo(&self, _cos_o: C::Real) -> C {
        let share = C::Real::lit(20.0 / 21.0);
        self.matte.zip(self.r0, |rd, r0| rd * (C::Real::ONE - r0) * share)
    }
}

impl<C: Spectrum> Bsdf for LayeredFresnel<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        mirror_over_matte::LOBES
    }
    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        mirror_over_matte::eval_pdf(self, wo, wi)
    }
    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        mirror_over_matte::sample(self, wo, u_lobe, u)
    }
    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        Some(mirror_over_matte::albedo(self, wo))
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "layered-fresnel",
    type_name: "LayeredFresnel",
    parameters: &[
        parameter::named("r0", "each channel in [0, 1]"),
        parameter::named("rd", "each channel in [0, 1]"),
    ],
    // 1 − q(0.1)/q(1), q = 1 − (1 − cos θ)⁵.
    reciprocity: Reciprocity::NonReciprocal { residual: Some(0.590_49) },
    energy: Energy::Gains {
        maximum: 1.952_381,
        at: "r0 0, rd 1, grazing viewer: 1 + 20/21; a beam of light conserves",
    },
    lobes: mirror_over_matte::LOBES,
    albedo: Albedo::ClosedForm,
    density: "mirror or cosine, by mean albedos",
    source: "Shirley et al. 1997, section 2",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use etendue_math::glam::DVec3;

    fn model(r0: f64, rd: f64) -> LayeredFresnel<f64> {
        LayeredFresnel::new(Reflectance::new(r0).unwrap(), Reflectance::new(rd).unwrap())
    }

    #[test]
    fn it_obeys_the_laws_it_promises() {
        laws::sampling_matches_density(&model(0.04, 0.7), 1e-13);
        for (r0, rd) in [(0.04, 0.7), (0.0, 1.0), (1.0, 1.0), (0.5, 0.0)] {
            laws::total(&model(r0, rd));
        }
    }

    #[test]
    fn exchanging_light_and_viewer_changes_it_as_stated() {
        let (normal, low) = (DVec3::Z, DVec3::new(0.99_f64.sqrt(), 0.0, 0.1));
        let model = model(0.3, 0.5);
        let ratio = model.eval(normal, low) / model.eval(low, normal);
        // 0.9⁵ by a few products.
        assert!((1.0 - ratio - 0.590_49).abs() < 1e-14, "{ratio}");
    }

    #[test]
    fn a_beam_of_light_loses_nothing() {
        for z in [1.0, 0.5, 0.01] {
            let beam = schlick(0.2, z) + schlick_transmittance(0.2, z);
            assert!((beam - 1.0).abs() < 1e-15, "{z} {beam}");
        }
    }
}
