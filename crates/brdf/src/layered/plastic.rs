//! Smooth plastic: a diffuse base under a dielectric interface.

use etendue_math::{Real, Spectrum, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use super::internal_scattering::{specular_probability, specular_share};
use crate::bsdf::{above, both_above};
use crate::direction::reflect;
use crate::fresnel::{
    dielectric, dielectric_average, dielectric_average_fit, dielectric_transmittance,
};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{
    Bsdf, BsdfReal, BsdfVec, Density, InternalReflectance, InternalScattering, Ior, Lobes,
    Reflectance, Sample,
};

/// A smooth dielectric interface with its hemispherical averages: computed once per material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlasticInterface<T> {
    eta: T,
    inverse_eta_squared: T,
    internal: T,
    /// `(1 − F_avg(η)) / η²`: share of diffuse light from below that leaves.
    escape: T,
}

impl<T: Real> PlasticInterface<T> {
    /// The interface to a base with relative index `eta`.
    pub fn new(eta: Ior<T>, internal: InternalReflectance) -> Self {
        let eta = eta.value();
        let inverse = T::ONE / eta;
        let inverse_eta_squared = inverse * inverse;
        Self {
            eta,
            inverse_eta_squared,
            // Below 1, which the fit exceeds and rounding reaches at extreme indices.
            internal: match internal {
                InternalReflectance::Exact => dielectric_average(inverse),
                InternalReflectance::Mitsuba => dielectric_average_fit(inverse),
            }
            .clamp_to(T::ZERO, T::ONE_MINUS_EPSILON),
            escape: (T::ONE - dielectric_average(eta)) * inverse_eta_squared,
        }
    }

    /// Relative index of the base.
    #[inline]
    pub fn eta(&self) -> T {
        self.eta
    }
}

/// Smooth plastic: mirror reflection at the interface, diffuse scattering below it with all internal
/// reflections summed.
///
/// ```text
/// f = kd' (1 − F(θo)) (1 − F(θi)) / (π η²)  +  ks F(θo) δ(wi − mirror(wo))
/// kd' = kd / (1 − F_in)  or  kd / (1 − kd F_in),  F_in = average of F from below
/// ```
///
/// * Laws: reciprocal; conserves energy: with the exact F_in and linear scattering the albedo is
///   `ks F + kd (1 − F)`.
/// * Sampling: `u_lobe` chooses the mirror with probability `F s / (F s + (1 − F)(1 − s))`,
///   `s = mean(ks) / (mean(ks) + mean(kd))`, else cosine-weighted; `None` from below.
///
/// # Precision
/// A few ulp times the condition of the problem; `1 − F` does not cancel near grazing.
///
/// # Source
/// Mitsuba's plastic (W. Jakob), after the diffuse substrate of L. Wolff, JOSA A 11(11), 1994.
///
/// # Examples
/// ```
/// use etendue_brdf::*;
/// use etendue_math::glam::DVec3;
/// let interface = PlasticInterface::new(Ior::new(1.5)?, InternalReflectance::Exact);
/// let red = Plastic::new(interface, Reflectance::new(0.5_f64)?, InternalScattering::Linear);
/// assert!((red.albedo(DVec3::Z).unwrap() - (0.04 + 0.5 * 0.96)).abs() < 1e-8);
/// # Ok::<(), ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plastic<C: Spectrum> {
    interface: PlasticInterface<C::Real>,
    diffuse: C,
    /// kd' of the formula
    base: C,
    specular: C,
    share: C::Real,
}

impl<C: Spectrum> Plastic<C> {
    /// A base of albedo `diffuse` under the interface.
    #[inline]
    pub fn new(
        interface: PlasticInterface<C::Real>,
        diffuse: Reflectance<C>,
        scattering: InternalScattering,
    ) -> Self {
        let diffuse = diffuse.value();
        let base = scattering.base(diffuse, interface.internal);
        let specular = C::white();
        Self { interface, diffuse, base, specular, share: specular_share(specular, diffuse) }
    }

    /// The same with its mirror reflection scaled by `ks`, a factor without physical meaning.
    #[inline]
    pub fn with_specular_reflectance(self, ks: Reflectance<C>) -> Self {
        let specular = ks.value();
        Self { specular, share: specular_share(specular, self.diffuse), ..self }
    }

    /// Probability of choosing the mirror, given `1 − F(θo)`.
    #[inline(always)]
    fn mirror_probability(&self, cos_o: C::Real, transmittance: C::Real) -> C::Real {
        specular_probability(dielectric(cos_o, self.interface.eta), transmittance, self.share)
    }

    #[inline(always)]
    fn transmittance(&self, cos: C::Real) -> C::Real {
        dielectric_transmittance(cos, self.interface.eta)
    }
}

impl<C: Spectrum> Bsdf for Plastic<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes { continuous: true, delta: true, transmission: false }
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        if !both_above(wo, wi) {
            return (C::black(), C::Real::ZERO);
        }
        let t = self.transmittance(wo.z());
        let mirror = self.mirror_probability(wo.z(), t);
        let t = t * self.transmittance(wi.z());
        (
            self.base.scale(t * self.interface.inverse_eta_squared * C::Real::FRAC_1_PI),
            (C::Real::ONE - mirror) * cosine_hemisphere::pdf::<C::Real>(wi),
        )
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
        let one = <C::Real as Real>::ONE;
        let t = self.transmittance(wo.z());
        let mirror = self.mirror_probability(wo.z(), t);
        let (wi, weight, density) = if u_lobe < mirror {
            let f = dielectric(wo.z(), self.interface.eta);
            (reflect(wo), self.specular.scale(f / mirror), Density::Delta(mirror))
        } else {
            let wi = cosine_hemisphere::from_square(u);
            let probability = one - mirror;
            let t = t * self.transmittance(wi.z()) * self.interface.inverse_eta_squared;
            let pdf = probability * cosine_hemisphere::pdf::<C::Real>(wi);
            if !(pdf > C::Real::ZERO) {
                return None; // the mirror takes all, or nearly, and the product underflows
            }
            (wi, self.base.scale(t / probability), Density::Continuous(pdf))
        };
        // Not finite for a uniform below 0 where the mirror has no probability.
        let valid = above(wi) && weight.is_finite() && !weight.is_black();
        valid.then_some(Sample { wi, weight, density, eta: one })
    }

    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        if !above(wo) {
            return Some(C::black());
        }
        let mirror = self.specular.scale(dielectric(wo.z(), self.interface.eta));
        Some(mirror + self.base.scale(self.transmittance(wo.z()) * self.interface.escape))
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "plastic",
    type_name: "Plastic",
    parameters: &[
        parameter::ETA,
        parameter::REFLECTANCE,
        parameter::KS,
        parameter::SCATTERING,
        parameter::INTERNAL,
    ],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes { continuous: true, delta: true, transmission: false },
    albedo: Albedo::ClosedForm,
    density: "mirror or cosine, by Fresnel and mean colours",
    source: "Mitsuba, plastic; Wolff 1994",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use etendue_math::glam::DVec3;

    fn model(rho: f64, scattering: InternalScattering) -> Plastic<f64> {
        let interface = PlasticInterface::new(Ior::new(1.5).unwrap(), InternalReflectance::Exact);
        Plastic::new(interface, Reflectance::new(rho).unwrap(), scattering)
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        for scattering in [InternalScattering::Linear, InternalScattering::NonLinear] {
            let model = model(0.8, scattering);
            laws::reciprocal(&model, 1e-14);
            laws::sampling_matches_density(&model, 1e-13);
            laws::total(&model);
        }
        let interface =
            PlasticInterface::new(Ior::new(1.5_f32).unwrap(), InternalReflectance::Mitsuba);
        laws::total(&Plastic::new(
            interface,
            Reflectance::<f32>::white(),
            InternalScattering::NonLinear,
        ));
    }

    #[test]
    fn a_mirror_without_probability_is_not_sampled() {
        // No uniform is below 0, but what a caller passes may be.
        let black = Reflectance::new(0.0).unwrap();
        let model = model(0.8, InternalScattering::Linear).with_specular_reflectance(black);
        assert!(model.sample(DVec3::Z, -1.0, [0.5, 0.5]).is_none());
        assert!(model.sample(DVec3::Z, 0.0, [0.5, 0.5]).is_some());
    }

    #[test]
    fn a_white_base_reflects_everything() {
        for scattering in [InternalScattering::Linear, InternalScattering::NonLinear] {
            for z in [1.0, 0.5, 0.01_f64] {
                let wo = DVec3::new((1.0 - z * z).sqrt(), 0.0, z);
                // Two averages by quadrature, good to 1e-9.
                assert!((model(1.0, scattering).albedo(wo).unwrap() - 1.0).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn the_diffuse_part_integrates_to_its_closed_form() {
        let model = model(0.7, InternalScattering::NonLinear)
            .with_specular_reflectance(Reflectance::clamped(0.0));
        laws::albedo_is_closed_form(&model, 1e-6);
    }
}
