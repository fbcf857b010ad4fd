//! Disney's principled material, as Mitsuba defines it.

use etendue_math::{Real, Spectrum, Vec3, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use super::clearcoat::Clearcoat;
use super::diffuse::Diffuse;
use super::facets::facets;
use super::fresnel::BlendedFresnel;
use super::sheen::Sheen;
use crate::bsdf::above;
use crate::direction::{half_vector, reflect_about};
use crate::fresnel::{RelativeIndex, refract_at};
use crate::mixture::limited_mixture_sample;
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::rough::rough_conductor::reflection_pdf;
use crate::rough::rough_dielectric::refraction_lobe;
use crate::{
    Bsdf, BsdfReal, BsdfVec, Lobes, Microfacets, ParameterError, PrincipledParameters, Sample,
};

/// Disney's principled BSDF in Mitsuba 3's definition: metal, glass and matter with sheen and clear coat.
///
/// ```text
/// with m metallic, s spec_trans, h the half vector, D and V = G1 G1 / (4 cos cos) of GGX facets
/// from above:  f = F D V                                   F blended of glass, tinted glass and metal
///                + clearcoat/4 · Fc Dc Gc                  GTR1 facets
///                + (1 − m)(1 − s) base f_diffuse           retro-reflection, flatness
///                + (1 − m) sheen colour (1 − wi·h)⁵
/// from below:  f = (1 − m) s F_dielectric D V
/// across:      f = (1 − m) s √base · (rough refraction)    of RoughDielectric
/// ```
///
/// Parameters: [`PrincipledParameters`].
///
/// * Laws: reflection is reciprocal, refraction up to η². Not energy-conserving: the lobes are added,
///   not layered. The directional albedo of a white material reaches 1.19 with roughness 0.5 and everything
///   else at its default, 1.72 at η 1.5 and 1.90 at η 4 (roughness 1, full sheen and clear coat, at
///   grazing incidence), and 2.86 for η → 0, where interface and coat alone reflect everything; tints of
///   saturated colours may go beyond.
/// * Sampling: from above diffuse, clear coat and main specular lobe with probabilities in the ratio
///   `(1 − m)(1 − s) r_d : clearcoat/4 r_c : r_s`, `r` the sampling rates; the specular lobe then
///   transmits with probability `(1 − m) s (1 − F)` of the drawn facet. From below the latter two
///   only. The density is that of the mixture; sheen has no sampler of its own. A lobe with rate 0
///   is never drawn and so missing from what samples add up to. `None` where the direction ends on the
///   wrong side.
///
/// # Departures
/// Values and densities agree with Mitsuba 3.9.1 to `f32` rounding, except:
/// * Half vectors, GTR1 and the refraction's Jacobian are in forms that do not cancel: Mitsuba's
///   clear coat at full gloss and its transmission for η near 1 are some 1e-3 off in `f32`.
/// * From below a material without transmission has density 0 as it has value 0; Mitsuba's `pdf` is
///   positive there, though its `sample` returns nothing.
/// * At η = 1 Mitsuba 3.9.1 transmits along half vectors of length 0 and its density is NaN; here it is 1.001
///   where there is transmission, the value that Mitsuba's `traverse` puts there.
///
/// # Precision
/// A few ulp of each lobe times the condition of the problem.
///
/// # Source
/// B. Burley, "Physically Based Shading at Disney", SIGGRAPH 2012, and "Extending the Disney BRDF to a BSDF
/// with Integrated Subsurface Scattering", SIGGRAPH 2015, course notes; Mitsuba 3, principled.
///
/// # Examples
/// ```
/// use etendue_brdf::{Bsdf, Principled, PrincipledParameters};
/// use etendue_math::{Rgb, glam::Vec3};
/// let paint = Principled::new(PrincipledParameters {
///     base_color: Rgb::new(0.7_f32, 0.1, 0.1),
///     roughness: 0.3,
///     clearcoat: 1.0,
///     clearcoat_gloss: 0.9,
///     ..Default::default()
/// })?;
/// let (f, pdf) = paint.eval_pdf(Vec3::Z, Vec3::new(0.6, 0.0, 0.8));
/// assert!(f.r > f.g && pdf > 0.0);
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Principled<C: Spectrum> {
    from_above: RelativeIndex<C::Real>,
    from_below: RelativeIndex<C::Real>,
    facets: Microfacets<C::Real>,
    fresnel: BlendedFresnel<C>,
    clearcoat: Clearcoat<C::Real>,
    diffuse: Diffuse<C>,
    sheen: Sheen<C>,
    /// `(1 − m) s`
    transmission: C::Real,
    /// `(1 − m) s √base`
    transmission_color: C,
    choice: Choice<C::Real>,
}

/// Probabilities of the lobes from above, with sum 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Choice<T> {
    diffuse: T,
    clearcoat: T,
    specular: T,
}

/// The surface as one of its sides sees it, that side up.
struct Side<T> {
    index: RelativeIndex<T>,
    choice: Choice<T>,
    /// Share of the specular lobe that is a dielectric interface: what is not reflected there goes through.
    dielectric: T,
    is_front: bool,
}

impl<C: Spectrum> Principled<C> {
    /// Checks the parameters and prepares the lobes.
    ///
    /// With transmission an index of exactly 1 counts as 1.001: the refraction of a matched interface is a
    /// delta lobe, which this model does not have.
    ///
    /// # Errors
    /// [`ParameterError`] where a parameter lies outside its domain.
    pub fn new(parameters: PrincipledParameters<C>) -> Result<Self, ParameterError> {
        parameters.check()?;
        Ok(Self::of_checked(parameters))
    }

    /// The same with every parameter moved into its domain, NaN to its lower end: for values read from textures.
    #[inline]
    pub fn clamped(parameters: PrincipledParameters<C>) -> Self {
        Self::of_checked(parameters.clamped())
    }

    #[inline]
    fn of_checked(p: PrincipledParameters<C>) -> Self {
        let one = <C::Real as Real>::ONE;
        let transmission = (one - p.metallic) * p.spec_trans;
        let matched = p.eta == one && transmission > C::Real::ZERO;
        let eta = if matched { C::Real::lit(1.001) } else { p.eta };
        let matter = (one - p.metallic) * (one - p.spec_trans);
        let clearcoat = Clearcoat::new(p.clearcoat, p.clearcoat_gloss);
        Self {
            from_above: RelativeIndex::from_above(eta),
            from_below: RelativeIndex::from_below(eta),
            facets: facets(p.roughness, p.anisotropic),
            fresnel: BlendedFresnel::new(p.base_color, p.metallic, p.spec_tint, eta),
            clearcoat,
            diffuse: Diffuse::new(p.base_color, matter, p.roughness, p.flatness),
            sheen: Sheen::new(p.base_color, p.sheen * (one - p.metallic), p.sheen_tint),
            transmission,
            transmission_color: p.base_color.map(Real::sqrt).scale(transmission),
            choice: Choice {
                diffuse: matter * p.diffuse_reflectance_sampling_rate,
                clearcoat: clearcoat.share() * p.clearcoat_sampling_rate,
                specular: p.main_specular_sampling_rate,
            }
            .normalized(),
        }
    }

    /// `None` from below where nothing is transmitted.
    #[inline]
    fn side(&self, wo: BsdfVec<Self>) -> Option<Side<C::Real>> {
        let (zero, one) = (<C::Real as Real>::ZERO, <C::Real as Real>::ONE);
        if wo.z() > zero {
            let (index, choice) = (self.from_above, self.choice);
            return Some(Side { index, choice, dielectric: self.transmission, is_front: true });
        }
        let choice = Choice { diffuse: zero, clearcoat: zero, specular: one };
        (self.transmission > zero).then_some(Side {
            index: self.from_below,
            choice,
            dielectric: one,
            is_front: false,
        })
    }

    #[inline]
    fn reflection(
        &self,
        side: &Side<C::Real>,
        wo: Vec3<C::Real>,
        wi: Vec3<C::Real>,
    ) -> (C, C::Real) {
        let (one, largest) = (<C::Real as Real>::ONE, C::Real::MAX);
        let Some((h, cos)) = half_vector(wo, wi) else { return (C::black(), C::Real::ZERO) };
        let f = side.index.reflectance(cos);
        let d = self.facets.ndf(h);
        let lobe = (d * self.facets.visibility(wo, wi)).min(largest);
        let kept = (one - side.dielectric) + side.dielectric * f;
        let pdf = side.choice.specular * kept * reflection_pdf(&self.facets, wo, d);
        if !side.is_front {
            return (C::splat((self.transmission * f * lobe).min(largest)), pdf);
        }
        let (coat, coat_pdf) = self.clearcoat.eval_pdf(side.index, [wo, wi, h], cos);
        let value = self.fresnel.reflectance(side.index, cos, f).scale(lobe)
            + C::splat(coat)
            + self.diffuse.eval(wo.z(), wi.z(), cos)
            + self.sheen.eval(cos);
        let cosine = cosine_hemisphere::pdf::<C::Real>(wi);
        let pdf = pdf + side.choice.clearcoat * coat_pdf + side.choice.diffuse * cosine;
        (value.map(|c| c.min(largest)), pdf.min(largest))
    }

    #[inline]
    fn refraction(
        &self,
        side: &Side<C::Real>,
        wo: Vec3<C::Real>,
        wi: Vec3<C::Real>,
    ) -> (C, C::Real) {
        if !(self.transmission > C::Real::ZERO) {
            return (C::black(), C::Real::ZERO);
        }
        let (lobe, pdf) = refraction_lobe(&self.facets, side.index, wo, wi);
        (self.transmission_color.scale(lobe), side.choice.specular * side.dielectric * pdf)
    }

    /// A direction for `w` above, and the index of the medium it lies in.
    #[inline]
    fn draw(
        &self,
        side: &Side<C::Real>,
        w: Vec3<C::Real>,
        u_lobe: C::Real,
        u: [C::Real; 2],
    ) -> Option<(Vec3<C::Real>, C::Real)> {
        let one = <C::Real as Real>::ONE;
        let (diffuse, coat) = (side.choice.diffuse, side.choice.clearcoat);
        let wi = if u_lobe < diffuse {
            cosine_hemisphere::from_square(u)
        } else if u_lobe - diffuse < coat {
            reflect_about(w, self.clearcoat.sample(u))
        } else {
            let h = self.facets.sample_visible_normal(w, u)?;
            let cos = w.dot(h).min(one);
            let rest = u_lobe - diffuse - coat;
            let through = side.dielectric * side.index.transmittance(cos);
            if rest < side.choice.specular * through {
                let g = side.index.scaled_cos_t(cos)?;
                let wi = refract_at(w, h, side.index, cos, g)?;
                return above(-wi).then_some((wi, side.index.eta()));
            }
            reflect_about(w, h)
        };
        above(wi).then_some((wi, one))
    }
}

impl<T: Real> Choice<T> {
    fn normalized(self) -> Self {
        let sum = self.diffuse + self.clearcoat + self.specular;
        let share = |x: T| if sum > T::ZERO { x / sum } else { T::ZERO };
        Self {
            diffuse: share(self.diffuse),
            clearcoat: share(self.clearcoat),
            specular: share(self.specular),
        }
    }
}

impl<C: Spectrum> Bsdf for Principled<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        let transmission = self.transmission > C::Real::ZERO;
        Lobes { continuous: true, delta: false, transmission }
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        let nothing = (C::black(), C::Real::ZERO);
        let Some(side) = self.side(wo) else { return nothing };
        let (wo, wi) = if side.is_front { (wo, wi) } else { (wo.flip_z(), wi.flip_z()) };
        if above(wo) && above(wi) {
            self.reflection(&side, wo, wi)
        } else if above(wo) && above(-wi) {
            self.refraction(&side, wo, wi)
        } else {
            nothing
        }
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        let side = self.side(wo)?;
        let w = if side.is_front { wo } else { wo.flip_z() };
        if !above(w) {
            return None;
        }
        let (wi, eta) = self.draw(&side, w, u_lobe, u)?;
        let wi = if side.is_front { wi } else { wi.flip_z() };
        limited_mixture_sample(self, wo, wi, eta)
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "principled",
    type_name: "Principled",
    parameters: &[
        parameter::BASE_COLOR,
        parameter::ROUGHNESS,
        parameter::ANISOTROPIC,
        parameter::named("metallic", "in [0, 1]"),
        parameter::SPEC_TRANS,
        parameter::named("eta", "in [1e-4, 1e4], or specular in [0, 1]"),
        parameter::SPEC_TINT,
        parameter::SHEEN,
        parameter::SHEEN_TINT,
        parameter::FLATNESS,
        parameter::named("clearcoat", "in [0, 1]"),
        parameter::named("clearcoat_gloss", "in [0, 1]"),
        parameter::sampling_rate("diffuse_reflectance_sampling_rate"),
        parameter::sampling_rate("main_specular_sampling_rate"),
        parameter::sampling_rate("clearcoat_sampling_rate"),
    ],
    reciprocity: Reciprocity::UpToSquaredIndex,
    energy: Energy::Gains {
        maximum: 2.86,
        at: "eta 1e-4, roughness 0.1, clearcoat 1, clearcoat_gloss 1, normal incidence",
    },
    lobes: Lobes { continuous: true, delta: false, transmission: true },
    albedo: Albedo::Quadrature,
    density: "mixture of cosine, clear coat's facets and visible normals",
    source: "Burley 2012, 2015; Mitsuba 3, principled",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use etendue_math::glam::DVec3;

    fn everything() -> PrincipledParameters<f64> {
        PrincipledParameters {
            base_color: 0.8,
            roughness: 0.6,
            anisotropic: 0.4,
            metallic: 0.3,
            spec_trans: 0.4,
            spec_tint: 0.5,
            sheen: 0.6,
            sheen_tint: 0.5,
            flatness: 0.5,
            clearcoat: 0.9,
            clearcoat_gloss: 0.2,
            ..Default::default()
        }
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        let opaque = PrincipledParameters { spec_trans: 0.0, ..everything() };
        for parameters in [everything(), opaque] {
            let model = Principled::new(parameters).unwrap();
            laws::sampling_matches_density(&model, 1e-10);
            laws::total(&model);
        }
        let model = Principled::new(opaque).unwrap();
        laws::reciprocal(&model, 1e-12);
        laws::density_integrates_to_at_most_one(&model);
        let extreme = PrincipledParameters::<f32> {
            roughness: 0.0,
            anisotropic: 1.0,
            spec_trans: 1.0,
            eta: 1.0,
            clearcoat: 1.0,
            clearcoat_gloss: 1.0,
            ..Default::default()
        };
        laws::total(&Principled::new(extreme).unwrap());
    }

    #[test]
    fn refraction_is_symmetric_up_to_the_squared_index() {
        let parameters = PrincipledParameters { eta: 1.5, ..everything() };
        let model = Principled::new(parameters).unwrap();
        let (a, b) = (DVec3::new(0.36, 0.48, 0.8), DVec3::new(-0.28, 0.0, -0.96));
        let (into, back) = (model.eval(a, b), model.eval(b, a));
        // A dozen roundings.
        assert!(into > 0.0 && (into * 2.25 - back).abs() < 1e-13 * back, "{into} {back}");
    }

    #[test]
    fn from_below_there_is_nothing_without_transmission() {
        for (metallic, spec_trans) in [(1.0, 1.0), (0.0, 0.0)] {
            let parameters = PrincipledParameters { metallic, spec_trans, ..everything() };
            let model = Principled::new(parameters).unwrap();
            assert_eq!(model.eval_pdf(-DVec3::Z, DVec3::new(0.6, 0.0, -0.8)), (0.0, 0.0));
            assert!(model.sample(-DVec3::Z, 0.5, [0.5; 2]).is_none());
        }
    }

    #[test]
    fn every_parameter_is_checked() {
        let broken = |change: fn(&mut PrincipledParameters<f64>)| {
            let mut parameters = everything();
            change(&mut parameters);
            Principled::new(parameters).is_err()
        };
        assert!(broken(|p| p.base_color = 1.1));
        assert!(broken(|p| p.eta = 0.0));
        assert!(broken(|p| p.roughness = f64::NAN));
        assert!(broken(|p| p.clearcoat_gloss = -0.1));
        assert!(broken(|p| p.clearcoat_sampling_rate = f64::INFINITY));
    }

    #[test]
    fn what_a_texture_says_is_moved_into_its_domain() {
        let beyond = PrincipledParameters {
            base_color: 1.5,
            metallic: f64::NAN,
            clearcoat: 3.0,
            eta: 1e9,
            ..everything()
        };
        let ends = PrincipledParameters {
            base_color: 1.0,
            metallic: 0.0,
            clearcoat: 1.0,
            eta: 1e4,
            ..everything()
        };
        assert_eq!(Principled::clamped(beyond), Principled::new(ends).unwrap());
        assert_eq!(Principled::clamped(everything()), Principled::new(everything()).unwrap());
    }
}
