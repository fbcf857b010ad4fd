//! Ashikhmin and Shirley's model, both parts.

use etendue_math::{Real, Spectrum, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use super::{AshikhminShirleyDiffuse, AshikhminShirleySpecular};
use crate::bsdf::above;
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Density, Exponent, Lobes, Reflectance, Sample};

/// How [`AshikhminShirley`] is sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AshikhminShirleySampling {
    /// The specular lobe, or the cosine for the diffuse part, by their albedos; both densities count.
    #[default]
    Mixture,
    /// The specular lobe alone, with the published density `p(h)/(4 h·wo)`: right in the mean also for the diffuse part,
    /// but noisy where that counts. For comparison, or in a renderer that samples the diffuse part itself.
    Specular,
}

/// Anisotropic Phong reflection above a diffuse base: [`AshikhminShirleySpecular`] + [`AshikhminShirleyDiffuse`].
///
/// ```text
/// f = √((nu + 1)(nv + 1))/(8π) (n·h)^e F(h·wo) / ((h·wo) max(n·wo, n·wi))
///   + 28 rd/(23π) (1 − rs) (1 − (1 − μo/2)⁵) (1 − (1 − μi/2)⁵)
/// ```
///
/// * Laws: reciprocal; conserves energy for all rs, rd in `[0, 1]`.
/// * Sampling: see [`AshikhminShirleySampling`]; the mixture chooses the specular lobe by the ratio of Schlick's
///   reflectance at `cos θo` to the diffuse albedo, means over the channels. `None` from below, and where the direction
///   falls below.
///
/// # Precision
/// That of the two parts.
///
/// # Source
/// M. Ashikhmin and P. Shirley, "An Anisotropic Phong BRDF Model", J. Graphics Tools 5(2), 2000.
///
/// # Examples
/// ```
/// use etendue_brdf::{AshikhminShirley, Bsdf, Exponent, Reflectance};
/// use etendue_math::{Rgb, glam::Vec3};
/// let copper = Reflectance::new(Rgb::new(0.9_f32, 0.5, 0.4))?;
/// let brushed = AshikhminShirley::new(Exponent::new(10.0)?, Exponent::new(1000.0)?, copper, copper);
/// let wo = Vec3::new(0.6, 0.0, 0.8);
/// let (f, pdf) = brushed.eval_pdf(wo, Vec3::new(-0.6, 0.0, 0.8));
/// assert!(f.r > f.g && pdf > 0.0);
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AshikhminShirley<C: Spectrum> {
    specular: AshikhminShirleySpecular<C>,
    diffuse: AshikhminShirleyDiffuse<C>,
    sampling: AshikhminShirleySampling,
}

impl<C: Spectrum> AshikhminShirley<C> {
    /// The model with exponents nu along x and nv along y, specular reflectance rs at normal incidence and diffuse
    /// reflectance rd, sampled as a mixture.
    #[inline]
    pub fn new(
        nu: Exponent<C::Real>,
        nv: Exponent<C::Real>,
        rs: Reflectance<C>,
        rd: Reflectance<C>,
    ) -> Self {
        Self {
            specular: AshikhminShirleySpecular::new(nu, nv, rs),
            diffuse: AshikhminShirleyDiffuse::new(rs, rd),
            sampling: AshikhminShirleySampling::Mixture,
        }
    }

    /// The same, sampled in this way.
    #[inline]
    pub fn with_sampling(self, sampling: AshikhminShirleySampling) -> Self {
        Self { sampling, ..self }
    }

    /// The specular part alone.
    #[inline]
    pub fn specular(&self) -> AshikhminShirleySpecular<C> {
        self.specular
    }

    /// The diffuse part alone.
    #[inline]
    pub fn diffuse(&self) -> AshikhminShirleyDiffuse<C> {
        self.diffuse
    }

    /// Probabilities of choosing the specular lobe and the cosine for a viewer above the surface.
    #[inline(always)]
    fn probabilities(&self, wo: BsdfVec<Self>) -> [C::Real; 2] {
        let (zero, one) = (C::Real::ZERO, <C::Real as Real>::ONE);
        let diffuse = self.diffuse.albedo(wo).map_or(zero, Spectrum::mean);
        if self.sampling == AshikhminShirleySampling::Specular || !(diffuse > zero) {
            return [one, zero];
        }
        let specular = self.specular.fresnel(one - wo.z().min(one)).mean();
        [specular / (specular + diffuse), diffuse / (specular + diffuse)]
    }
}

impl<C: Spectrum> Bsdf for AshikhminShirley<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::CONTINUOUS
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        let (specular, half_vectors) = self.specular.eval_pdf(wo, wi);
        let (diffuse, cosine) = self.diffuse.eval_pdf(wo, wi);
        let value = (specular + diffuse).map(|f| f.min(C::Real::MAX));
        let [s, d] = self.probabilities(wo);
        (value, s * half_vectors + d * cosine)
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
        let [s, d] = self.probabilities(wo);
        let (wi, weight, pdf) = if d == C::Real::ZERO {
            // Nothing else could have drawn it: the lobe cancels out of its own part of the weight.
            let (wi, weight, pdf) = self.specular.reflect(wo, u)?;
            (wi, weight + self.diffuse.eval(wo, wi).scale(wi.z() / pdf), pdf)
        } else {
            let wi = if u_lobe < s {
                self.specular.reflect(wo, u)?.0
            } else {
                cosine_hemisphere::from_square(u)
            };
            let (f, pdf) = self.eval_pdf(wo, wi);
            if !(pdf > C::Real::ZERO) {
                return None;
            }
            (wi, f.scale(wi.z() / pdf), pdf)
        };
        let density = Density::Continuous(pdf);
        // Infinite where the density is so small that nothing is ever drawn with it.
        (!weight.is_black() && weight.is_finite()).then_some(Sample {
            wi,
            weight,
            density,
            eta: C::Real::ONE,
        })
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "ashikhmin-shirley",
    type_name: "AshikhminShirley",
    parameters: &[parameter::NU, parameter::NV, parameter::RS, parameter::RD, parameter::SAMPLING],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes::CONTINUOUS,
    albedo: Albedo::Quadrature,
    density: "half vectors, p(h)/(4 h·wo), and cosine by albedos; or half vectors alone",
    source: "Ashikhmin and Shirley 2000",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use etendue_math::glam::{DVec3, Vec3};

    fn model<T: Real + Spectrum<Real = T>>([nu, nv, rs, rd]: [f64; 4]) -> AshikhminShirley<T> {
        let [nu, nv] = [nu, nv].map(|n| Exponent::new(T::lit(n)).unwrap());
        let [rs, rd] = [rs, rd].map(|r| Reflectance::new(T::lit(r)).unwrap());
        AshikhminShirley::new(nu, nv, rs, rd)
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf_however_it_is_sampled() {
        for sampling in [AshikhminShirleySampling::Mixture, AshikhminShirleySampling::Specular] {
            for parameters in [[3.0, 20.0, 0.5, 0.5], [10.0, 10.0, 0.0, 1.0], [8.0, 1.0, 1.0, 1.0]]
            {
                let model = model::<f64>(parameters).with_sampling(sampling);
                laws::reciprocal(&model, 1e-13);
                laws::sampling_matches_density(&model, 1e-11);
                laws::total(&model);
            }
            laws::total(&model::<f32>([1e6, 10.0, 0.04, 0.5]).with_sampling(sampling));
            laws::total(&model::<f32>([1e12, 1e12, 0.0, 0.5]).with_sampling(sampling));
        }
    }

    #[test]
    fn a_density_too_small_for_a_finite_weight_draws_nothing() {
        // Found by fuzzing: the density is the smallest positive number.
        let wo = Vec3::new(4.517586e-39, 5.51014e-40, 7.34684e-40);
        for u_lobe in [0.0, 0.5, 0.999, 48.5] {
            let weight = model::<f32>([1e6, 1e6, 0.5, 0.5]).sample(wo, u_lobe, [2.5784852e-9; 2]);
            assert!(weight.is_none_or(|sample| sample.weight.is_finite()), "{weight:?}");
        }
    }

    #[test]
    fn it_is_the_sum_of_its_parts_and_the_mixture_lies_between_their_densities() {
        let model = model::<f64>([20.0, 5.0, 0.3, 0.6]);
        let (wo, wi) = (DVec3::new(0.6, 0.0, 0.8), DVec3::new(-0.48, 0.36, 0.8));
        let (s, half_vectors) = model.specular().eval_pdf(wo, wi);
        let (d, cosine) = model.diffuse().eval_pdf(wo, wi);
        let (f, pdf) = model.eval_pdf(wo, wi);
        assert_eq!(f, s + d);
        assert!((pdf - half_vectors) * (pdf - cosine) < 0.0);
        let published = model.with_sampling(AshikhminShirleySampling::Specular);
        assert_eq!(published.pdf(wo, wi), half_vectors);
    }

    #[test]
    fn a_coat_that_reflects_nothing_along_the_normal_still_has_samples() {
        let coated = model::<f64>([1e3, 1e3, 0.0, 1.0]);
        assert!(coated.sample(DVec3::Z, 0.0, [0.3, 0.3]).is_some());
        let bare = model::<f64>([1e3, 1e3, 0.0, 0.0]);
        assert!(bare.sample(DVec3::Z, 0.9, [0.3, 0.3]).is_some());
    }
}
