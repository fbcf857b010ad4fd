//! Disney's principled material for sheets without thickness, as Mitsuba defines it.

use etendue_math::{Real, Spectrum, Vec3, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use super::diffuse::Diffuse;
use super::facets::facets;
use super::fresnel::BlendedFresnel;
use super::sheen::Sheen;
use crate::bsdf::above;
use crate::direction::{half_vector, reflect_about};
use crate::fresnel::RelativeIndex;
use crate::mixture::limited_mixture_sample;
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::rough::rough_conductor::reflection_pdf;
use crate::{
    Bsdf, BsdfReal, BsdfVec, Lobes, Microfacets, ParameterError, PrincipledThinParameters, Sample,
};

/// Mitsuba 3's `principledthin`: leaves, paper, panes of frosted glass.
///
/// ```text
/// with s spec_trans, d diff_trans/2, wi' = wi mirrored to the side of wo, h the half vector of wo and wi'
/// one side:  f = s F D V + (1 − s)(1 − d)(base f_diffuse + sheen)      F blended of glass and tinted glass
/// across:    f = s base (1 − F_dielectric) D' V' + (1 − s) d base / π   only facets with wi·h < 0
/// D', V': roughness scaled by 0.65 η − 0.35
/// ```
///
/// Parameters: [`PrincipledThinParameters`]. Both sides are alike.
///
/// * Laws: reflection is reciprocal. Specular transmission is not: the light's mirrored direction makes
///   the highlight but its own must see the facet from behind, which exchanging the directions
///   does not preserve. Not energy-conserving: the directional albedo of a white material reaches 1.65
///   (rough, full sheen, at grazing incidence).
/// * Sampling: the four lobes with probabilities in the ratio `s/2 r : s/2 r : (1 − s)(1 − d) r : (1 − s) d r`
///   of specular reflection and transmission, diffuse reflection and transmission, `r` the sampling
///   rates; visible normals and cosine. The density is that of the mixture. `None` where a
///   specular direction falls on the wrong side of surface or facet.
///
/// # Departures
/// Values and densities agree with Mitsuba 3.9.1 to `f32` rounding.
///
/// # Precision
/// A few ulp of each lobe times the condition of the problem.
///
/// # Source
/// B. Burley, "Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering", SIGGRAPH 2015
/// course notes, section 5.3; Mitsuba 3, principledthin.
///
/// # Examples
/// ```
/// use etendue_brdf::{Bsdf, PrincipledThin, PrincipledThinParameters};
/// use etendue_math::glam::Vec3;
/// let leaf = PrincipledThin::new(PrincipledThinParameters {
///     base_color: 0.6_f32,
///     diff_trans: 1.0,
///     ..Default::default()
/// })?;
/// assert!(leaf.eval(Vec3::Z, -Vec3::Z) > 0.0);
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipledThin<C: Spectrum> {
    index: RelativeIndex<C::Real>,
    reflecting: Microfacets<C::Real>,
    transmitting: Microfacets<C::Real>,
    fresnel: BlendedFresnel<C>,
    specular: C::Real,
    diffuse: Diffuse<C>,
    sheen: Sheen<C>,
    /// `s base`
    specular_transmittance: C,
    /// `(1 − s) d base / π`
    diffuse_transmittance: C,
    choice: Choice<C::Real>,
}

/// Probabilities of the lobes, with sum 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Choice<T> {
    specular_reflection: T,
    specular_transmission: T,
    diffuse_reflection: T,
    diffuse_transmission: T,
}

impl<C: Spectrum> PrincipledThin<C> {
    /// Checks the parameters and prepares the lobes.
    ///
    /// # Errors
    /// [`ParameterError`] where a parameter lies outside its domain.
    pub fn new(parameters: PrincipledThinParameters<C>) -> Result<Self, ParameterError> {
        parameters.check()?;
        Ok(Self::of_checked(parameters))
    }

    /// The same with every parameter moved into its domain, NaN to its lower end: for values read from textures.
    #[inline]
    pub fn clamped(parameters: PrincipledThinParameters<C>) -> Self {
        Self::of_checked(parameters.clamped())
    }

    #[inline]
    fn of_checked(p: PrincipledThinParameters<C>) -> Self {
        let (zero, one, half) = (<C::Real as Real>::ZERO, <C::Real as Real>::ONE, C::Real::HALF);
        let through = p.diff_trans * half;
        let reflected = (one - p.spec_trans) * (one - through);
        let transmitted = (one - p.spec_trans) * through;
        // Burley's fit of how much two refractions blur (2015, figure 15).
        let scaled = (C::Real::lit(0.65) * p.eta - C::Real::lit(0.35)) * p.roughness;
        Self {
            index: RelativeIndex::from_above(p.eta),
            reflecting: facets(p.roughness, p.anisotropic),
            transmitting: facets(scaled, p.anisotropic),
            fresnel: BlendedFresnel::new(p.base_color, zero, p.spec_tint, p.eta),
            specular: p.spec_trans,
            diffuse: Diffuse::new(p.base_color, reflected, p.roughness, p.flatness),
            sheen: Sheen::new(p.base_color, p.sheen * reflected, p.sheen_tint),
            specular_transmittance: p.base_color.scale(p.spec_trans),
            diffuse_transmittance: p.base_color.scale(transmitted * C::Real::FRAC_1_PI),
            choice: Choice {
                specular_reflection: half * p.spec_trans * p.specular_reflectance_sampling_rate,
                specular_transmission: half * p.spec_trans * p.specular_transmittance_sampling_rate,
                diffuse_reflection: reflected * p.diffuse_reflectance_sampling_rate,
                diffuse_transmission: transmitted * p.diffuse_transmittance_sampling_rate,
            }
            .normalized(),
        }
    }

    #[inline]
    fn reflection(&self, wo: Vec3<C::Real>, wi: Vec3<C::Real>) -> (C, C::Real) {
        let largest = C::Real::MAX;
        let Some((h, cos)) = half_vector(wo, wi) else { return (C::black(), C::Real::ZERO) };
        let d = self.reflecting.ndf(h);
        let lobe = (self.specular * d * self.reflecting.visibility(wo, wi)).min(largest);
        let f = self.fresnel.reflectance(self.index, cos, self.index.reflectance(cos));
        let value = f.scale(lobe) + self.diffuse.eval(wo.z(), wi.z(), cos) + self.sheen.eval(cos);
        let pdf = self.choice.specular_reflection * reflection_pdf(&self.reflecting, wo, d)
            + self.choice.diffuse_reflection * cosine_hemisphere::pdf::<C::Real>(wi);
        (value.map(|c| c.min(largest)), pdf.min(largest))
    }

    /// `wi` below; `mirrored` above.
    #[inline]
    fn transmission(&self, wo: Vec3<C::Real>, wi: Vec3<C::Real>) -> (C, C::Real) {
        let mirrored = wi.flip_z();
        let diffuse_pdf =
            self.choice.diffuse_transmission * cosine_hemisphere::pdf::<C::Real>(mirrored);
        let diffuse = (self.diffuse_transmittance, diffuse_pdf);
        let Some((h, cos)) = half_vector(wo, mirrored) else { return diffuse };
        if !(wi.dot(h) < C::Real::ZERO) {
            return diffuse; // the facet is seen from the wrong side
        }
        let d = self.transmitting.ndf(h);
        let lobe = (d * self.transmitting.visibility(wo, mirrored)).min(C::Real::MAX);
        let color = self.specular_transmittance.scale(self.index.transmittance(cos));
        let pdf = self.choice.specular_transmission * reflection_pdf(&self.transmitting, wo, d);
        let value = (color.scale(lobe) + diffuse.0).map(|c| c.min(C::Real::MAX));
        (value, (pdf + diffuse.1).min(C::Real::MAX))
    }
}

impl<T: Real> Choice<T> {
    fn normalized(self) -> Self {
        let sum = self.specular_reflection
            + self.specular_transmission
            + self.diffuse_reflection
            + self.diffuse_transmission;
        let share = |x: T| if sum > T::ZERO { x / sum } else { T::ZERO };
        Self {
            specular_reflection: share(self.specular_reflection),
            specular_transmission: share(self.specular_transmission),
            diffuse_reflection: share(self.diffuse_reflection),
            diffuse_transmission: share(self.diffuse_transmission),
        }
    }
}

impl<C: Spectrum> Bsdf for PrincipledThin<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        let transmission =
            !self.specular_transmittance.is_black() || !self.diffuse_transmittance.is_black();
        Lobes { continuous: true, delta: false, transmission }
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        let is_front = wo.z() > C::Real::ZERO;
        let (wo, wi) = if is_front { (wo, wi) } else { (wo.flip_z(), wi.flip_z()) };
        if above(wo) && above(wi) {
            self.reflection(wo, wi)
        } else if above(wo) && above(-wi) {
            self.transmission(wo, wi)
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
        let is_front = wo.z() > C::Real::ZERO;
        let w = if is_front { wo } else { wo.flip_z() };
        if !above(w) {
            return None;
        }
        let choice = &self.choice;
        let specular = choice.specular_reflection + choice.specular_transmission;
        let wi = if u_lobe < choice.specular_reflection {
            reflect_about(w, self.reflecting.sample_visible_normal(w, u)?)
        } else if u_lobe < specular {
            let h = self.transmitting.sample_visible_normal(w, u)?;
            let wi = reflect_about(w, h);
            if !(wi.flip_z().dot(h) < C::Real::ZERO) {
                return None; // the facet is seen from the wrong side
            }
            wi
        } else {
            cosine_hemisphere::from_square(u)
        };
        if !above(wi) {
            return None;
        }
        let reflected = u_lobe < choice.specular_reflection
            || (u_lobe >= specular && u_lobe - specular < choice.diffuse_reflection);
        let wi = if reflected == is_front { wi } else { wi.flip_z() };
        limited_mixture_sample(self, wo, wi, C::Real::ONE)
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "principled-thin",
    type_name: "PrincipledThin",
    parameters: &[
        parameter::BASE_COLOR,
        parameter::ROUGHNESS,
        parameter::ANISOTROPIC,
        parameter::SPEC_TRANS,
        parameter::ETA,
        parameter::SPEC_TINT,
        parameter::SHEEN,
        parameter::SHEEN_TINT,
        parameter::FLATNESS,
        parameter::named("diff_trans", "in [0, 2]"),
        parameter::sampling_rate("specular_reflectance_sampling_rate"),
        parameter::sampling_rate("specular_transmittance_sampling_rate"),
        parameter::sampling_rate("diffuse_reflectance_sampling_rate"),
        parameter::sampling_rate("diffuse_transmittance_sampling_rate"),
    ],
    reciprocity: Reciprocity::ReflectionOnly,
    energy: Energy::Gains { maximum: 1.65, at: "roughness 1, sheen 1, at grazing incidence" },
    lobes: Lobes { continuous: true, delta: false, transmission: true },
    albedo: Albedo::Quadrature,
    density: "mixture of visible normals and cosine on either side",
    source: "Burley 2015; Mitsuba 3, principledthin",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use etendue_math::glam::DVec3;

    fn everything() -> PrincipledThinParameters<f64> {
        PrincipledThinParameters {
            base_color: 0.8,
            roughness: 0.6,
            anisotropic: 0.4,
            spec_trans: 0.4,
            spec_tint: 0.5,
            sheen: 0.6,
            flatness: 0.5,
            diff_trans: 0.7,
            ..Default::default()
        }
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        let model = PrincipledThin::new(everything()).unwrap();
        laws::sampling_matches_density(&model, 1e-10);
        laws::density_integrates_to_at_most_one(&model);
        laws::total(&model);
        let extreme = PrincipledThinParameters::<f32> {
            roughness: 0.0,
            spec_trans: 1.0,
            eta: 1.0,
            ..Default::default()
        };
        laws::total(&PrincipledThin::new(extreme).unwrap());
    }

    #[test]
    fn without_specular_transmission_it_is_reciprocal() {
        let parameters = PrincipledThinParameters { spec_trans: 0.0, ..everything() };
        laws::reciprocal(&PrincipledThin::new(parameters).unwrap(), 1e-12);
    }

    #[test]
    fn the_sides_are_alike() {
        let model = PrincipledThin::new(everything()).unwrap();
        let (wo, wi) = (DVec3::new(0.6, 0.0, 0.8), DVec3::new(-0.36, -0.48, 0.8));
        for wi in [wi, wi.flip_z()] {
            assert_eq!(model.eval_pdf(wo, wi), model.eval_pdf(wo.flip_z(), wi.flip_z()));
        }
    }

    #[test]
    fn every_parameter_is_checked() {
        for parameters in [
            PrincipledThinParameters { diff_trans: 2.1, ..everything() },
            PrincipledThinParameters { eta: 0.0, ..everything() },
            PrincipledThinParameters { sheen_tint: f64::NAN, ..everything() },
            PrincipledThinParameters { diffuse_reflectance_sampling_rate: -1.0, ..everything() },
        ] {
            assert!(PrincipledThin::new(parameters).is_err(), "{parameters:?}");
        }
    }

    #[test]
    fn what_a_texture_says_is_moved_into_its_domain() {
        let beyond = PrincipledThinParameters { diff_trans: 9.0, sheen: f64::NAN, ..everything() };
        let ends = PrincipledThinParameters { diff_trans: 2.0, sheen: 0.0, ..everything() };
        assert_eq!(PrincipledThin::clamped(beyond), PrincipledThin::new(ends).unwrap());
        assert_eq!(
            PrincipledThin::clamped(everything()),
            PrincipledThin::new(everything()).unwrap()
        );
    }
}
