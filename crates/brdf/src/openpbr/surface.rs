//! The surface as a whole.

use etendue_math::{Real, Spectrum, Vec3, Vector3};
use etendue_sampling::warp::{cosine_hemisphere, uniform_hemisphere};

use super::base::Base;
use super::coat::{Coat, darkening};
use super::fuzz::Fuzz;
use super::parameters::OpenPbrParameters;
use crate::bsdf::{above, both_above};
use crate::direction::{half_vector, reflect, reflect_about};
use crate::microfacet::{CosineRow, Place};
use crate::mixture::limited_mixture_sample;
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::rough::rough_conductor::reflection_pdf;
use crate::{Bsdf, BsdfReal, BsdfVec, Density, Lobes, Microfacets, ParameterError, Sample};

/// OpenPBR 1.1's base, specular, coat and fuzz: fuzz over a coat over metal and glossy matter.
///
/// ```text
/// f = f_fuzz + t_fuzz (f_coat + t_coat a Δ (f_specular + f_metal,ms)) + a Δ f_diffuse
/// t(o, i) = min(t(o), t(i)),  t(μ) = 1 − weight E(μ) of fuzz, of coat
/// f_diffuse = (1 − m) f_EON p(o) p(i) / p_avg,  p = t_fuzz t_coat (1 − E_specular)
/// ```
///
/// with E the albedos of the lobes, tabulated ([`FuzzTable`](crate::FuzzTable),
/// [`DielectricTable`](crate::microfacet::DielectricTable)); a(o, i) the coat's absorption and Δ its darkening; m
/// `base_metalness`. Facets are GGX's, α the square of a roughness; metals reflect by
/// [`F82Tint`](crate::fresnel::F82Tint), with `specular_color` its tint, and more than once after Kulla and Conty.
///
/// Two ways of layering, both reciprocal: the diffuse base takes what all specular lobes leave in a coupled product, with
/// which a white base returns all of it; what is not diffuse is weighted by the smaller transmittance, which never gains.
///
/// Parameters: [`OpenPbrParameters`].
///
/// * Laws: reciprocal. White parameters and α ≥ 0.1 in a white furnace: a glossy base reflects 1 within 0.1 % (0.8 % with
///   `base_diffuse_roughness` 1, never above 1.001), at least 0.997 under a coat and 0.995 under fuzz. Metal reflects 1
///   within 0.1 %, at least 0.982 under a coat and 0.89 under fuzz: see "Known limitations". Of narrower facets the error of the
///   [`DielectricTable`](crate::microfacet::DielectricTable) at grazing angles comes on top.
/// * Limits: a roughness of 0 (α below 1e-8) is a mirror, a delta lobe chosen at construction, for coat and base
///   each. Without metal, specular, coat and fuzz the model is [`Eon`](crate::Eon).
/// * Sampling: `u_lobe` chooses fuzz (uniform), coat and base facets (visible normals) or a cosine by about what each
///   reflects at θo; the density is that of the mixture. `None` from below and where a facet reflects below.
///
/// # Departures
/// OpenPBR describes layers and leaves lobes to the implementation. From the reductions it suggests, and from
/// MaterialX's, this one differs as follows.
/// * Layers are weighted reciprocally, as above; the suggested albedo scaling by θo alone is not.
/// * The fuzz is the microfacet sheen of Estevez and Kulla with Smith's masking; Zeltner's fitted volume is not
///   reciprocal. A `fuzz_roughness` below 0.1 counts as 0.1.
/// * The K of the darkening of a smooth base is that of normal incidence.
/// * `specular_ior` and `coat_ior` are at least 1. Where the coat is denser than the base the inverse ratio counts, so that
///   nothing is totally reflected between them, as in MaterialX. Δ and the coat's absorption do not know the base's lobes apart.
/// * `specular_weight` is at most 1e4, and the index it makes too.
///
/// # Known limitations
/// * Transmission, subsurface scattering, thin films, emission, opacity, thin walls, and coat normals of their own
///   are not here: `transmission_weight`, `subsurface_weight`, `thin_film_weight` and `emission_luminance` count as 0.
/// * Anisotropic facets are compensated as isotropic ones of the same mean square width: white metal then reflects
///   up to 1.073 (roughness 1, anisotropy 0.9, at cos θ = 0.4 along the first tangent), and a glossy base 0.96 at
///   cos θ = 0.05 (roughness 0.6, anisotropy 0.7).
/// * What the facets of dielectrics reflect more than once counts as transmitted.
/// * What coat and fuzz send back down to metal is not followed: of white metal 2 % are lost under a coat and 11 %
///   under fuzz.
///
/// # Precision
/// A few ulp of each lobe times the condition of the problem, with the tables' values.
///
/// # Source
/// Z. Andersson et al., OpenPBR Surface 1.1, Academy Software Foundation 2024.
///
/// # Examples
/// ```
/// use etendue_brdf::{Bsdf, OpenPbr, OpenPbrParameters};
/// use etendue_math::{Rgb, glam::Vec3};
/// let car_paint = OpenPbr::new(OpenPbrParameters {
///     base_color: Rgb::new(0.5_f32, 0.02, 0.02),
///     base_metalness: 0.5,
///     coat_weight: 1.0,
///     coat_roughness: 0.1,
///     ..Default::default()
/// })?;
/// let (f, pdf) = car_paint.eval_pdf(Vec3::Z, Vec3::new(0.6, 0.0, 0.8));
/// assert!(f.r > f.g && pdf > 0.0);
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenPbr<C: Spectrum> {
    fuzz: Option<Fuzz<C>>,
    coat: Option<Coat<C>>,
    base: Base<C>,
    /// Δ
    darkening: C,
    /// About what coat absorption and darkening leave of the base.
    dimming: C::Real,
}

/// Probabilities of the lobes, with sum 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Choice<T> {
    fuzz: T,
    coat: T,
    specular: T,
    cosine: T,
}

impl<C: Spectrum> OpenPbr<C> {
    /// Checks the parameters and prepares the layers that are there.
    ///
    /// # Errors
    /// [`ParameterError`] where a parameter lies outside its domain.
    pub fn new(parameters: OpenPbrParameters<C>) -> Result<Self, ParameterError> {
        parameters.check()?;
        let p = &parameters;
        let fuzz = Fuzz::new(p.fuzz_weight, p.fuzz_color, p.fuzz_roughness);
        let coat = Coat::new(p)?;
        let clear = CosineRow::of(|_| C::Real::ONE);
        let under_fuzz = fuzz.as_ref().map_or(clear, |fuzz| *fuzz.through());
        let under_coat = coat.as_ref().map_or(under_fuzz, |coat| coat.through().times(&under_fuzz));
        let base = Base::new(p, &under_coat)?;
        let darkening = darkening(p, base.normal_albedo(p), base.mean_roughness(p));
        let color = (C::Real::ONE - p.coat_weight) + p.coat_weight * p.coat_color.mean();
        Ok(Self { fuzz, coat, base, darkening, dimming: color * darkening.mean() })
    }

    #[inline]
    fn choice(&self, cos_o: C::Real, place: Place<C::Real>) -> Choice<C::Real> {
        let (zero, one) = (<C::Real as Real>::ZERO, <C::Real as Real>::ONE);
        let (mut fuzz, mut coat, mut rest) = (zero, zero, one);
        if let Some(layer) = &self.fuzz {
            (fuzz, rest) = (layer.albedo(place), layer.through().at(place));
        }
        if let Some(layer) = &self.coat {
            coat = rest * layer.albedo(place);
            rest *= layer.through().at(place);
        }
        let base = self.base.albedos(cos_o, place);
        let [specular, cosine] = base.map(|albedo| rest * self.dimming * albedo);
        let sum = fuzz + coat + specular + cosine;
        let share = |x: C::Real| if sum > zero { x / sum } else { zero };
        Choice {
            fuzz: share(fuzz),
            coat: share(coat),
            specular: share(specular),
            cosine: share(cosine),
        }
    }

    /// What passes fuzz and coat both ways.
    #[inline]
    fn through(&self, places: [Place<C::Real>; 2]) -> [C::Real; 2] {
        let smaller = |row: &CosineRow<C::Real>| row.at(places[0]).min(row.at(places[1]));
        [
            self.fuzz.as_ref().map_or(C::Real::ONE, |fuzz| smaller(fuzz.through())),
            self.coat.as_ref().map_or(C::Real::ONE, |coat| smaller(coat.through())),
        ]
    }

    /// `a Δ`
    #[inline]
    fn dimming(&self, wo: Vec3<C::Real>, wi: Vec3<C::Real>) -> C {
        self.coat.as_ref().map_or(C::white(), |coat| coat.absorption(wo, wi) * self.darkening)
    }

    /// The coat's facets and the base's, as far as they are not mirrors.
    #[inline]
    fn facets(&self) -> [Option<&Microfacets<C::Real>>; 2] {
        [self.coat.as_ref().and_then(Coat::facets), self.base.facets()]
    }

    /// The mirror direction with all that is reflected into it.
    #[inline]
    fn mirror(
        &self,
        wo: Vec3<C::Real>,
        place: Place<C::Real>,
        choice: &Choice<C::Real>,
    ) -> Option<Sample<C>> {
        let (mut value, mut probability) = (C::black(), C::Real::ZERO);
        let cos = wo.z().min(C::Real::ONE);
        let wi = reflect(wo);
        let [through_fuzz, through_coat] = self.through([place; 2]);
        if let Some(coat) = self.coat.as_ref().filter(|coat| coat.facets().is_none()) {
            value += C::splat(coat.reflectance(cos));
            probability += choice.coat;
        }
        if self.base.facets().is_none() {
            value += (self.base.reflectance(cos) * self.dimming(wo, wi)).scale(through_coat);
            probability += choice.specular;
        }
        if !(probability > C::Real::ZERO) || value.is_black() {
            return None;
        }
        let weight = value.scale(through_fuzz).map(|c| (c / probability).min(C::Real::MAX));
        let density = Density::Delta(probability.min(C::Real::ONE));
        Some(Sample { wi, weight, density, eta: C::Real::ONE })
    }
}

impl<C: Spectrum> Bsdf for OpenPbr<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        let [coat_facets, base_facets] = self.facets();
        let (is_coated, is_specular) = (self.coat.is_some(), self.base.is_specular());
        Lobes {
            continuous: self.fuzz.is_some()
                || self.base.is_diffuse()
                || coat_facets.is_some()
                || (is_specular && base_facets.is_some()),
            delta: (is_coated && coat_facets.is_none()) || (is_specular && base_facets.is_none()),
            transmission: false,
        }
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        let nothing = (C::black(), C::Real::ZERO);
        if !both_above(wo, wi) {
            return nothing;
        }
        let Some((h, cos)) = half_vector(wo, wi) else { return nothing };
        let places = [wo, wi].map(|w| Place::of(w.z()));
        let choice = self.choice(wo.z(), places[0]);
        let [through_fuzz, through_coat] = self.through(places);
        let lobe = |facets: &Microfacets<C::Real>| {
            let d = facets.ndf(h);
            let value = (d * facets.visibility(wo, wi)).min(C::Real::MAX);
            (value, reflection_pdf(facets, wo, d))
        };
        let (mut above, mut base, mut pdf) =
            (C::black(), self.base.multiple(wo.z(), wi.z()), C::Real::ZERO);
        let [coat_facets, base_facets] = self.facets();
        if let Some((coat, facets)) = self.coat.as_ref().zip(coat_facets) {
            let (value, density) = lobe(facets);
            above += C::splat(coat.reflectance(cos) * value);
            pdf += choice.coat * density;
        }
        if let Some(facets) = base_facets {
            let (value, density) = lobe(facets);
            base += self.base.reflectance(cos).scale(value);
            pdf += choice.specular * density;
        }
        let dimming = self.dimming(wo, wi);
        let mut value = (above + (base * dimming).scale(through_coat)).scale(through_fuzz)
            + self.base.diffuse([wo, wi], places) * dimming;
        pdf += choice.cosine * cosine_hemisphere::pdf::<C::Real>(wi);
        if let Some(fuzz) = &self.fuzz {
            value += fuzz.value(wo, wi, h);
            pdf += choice.fuzz * uniform_hemisphere::pdf::<C::Real>(wi);
        }
        (value.map(|c| c.min(C::Real::MAX)), pdf.min(C::Real::MAX))
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
        let place = Place::of(wo.z());
        let choice = self.choice(wo.z(), place);
        let [coat_facets, base_facets] = self.facets();
        let rest = u_lobe - choice.fuzz;
        let wi = if u_lobe < choice.fuzz {
            uniform_hemisphere::from_square(u)
        } else if rest < choice.coat + choice.specular {
            let facets = if rest < choice.coat { coat_facets } else { base_facets };
            let Some(facets) = facets else { return self.mirror(wo, place, &choice) };
            reflect_about(wo, facets.sample_visible_normal(wo, u)?)
        } else {
            cosine_hemisphere::from_square(u)
        };
        limited_mixture_sample(self, wo, wi, C::Real::ONE)
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "open-pbr",
    type_name: "OpenPbr",
    parameters: &[
        parameter::named("base_weight", "in [0, 1]"),
        parameter::BASE_COLOR,
        parameter::named("base_diffuse_roughness", "in [0, 1]"),
        parameter::named("base_metalness", "in [0, 1]"),
        parameter::named("specular_weight", "in [0, 1e4]"),
        parameter::named("specular_color", "each channel in [0, 1]"),
        parameter::named("specular_roughness", "in [0, 1]"),
        parameter::named("specular_roughness_anisotropy", "in [0, 1]"),
        parameter::named("specular_ior", "in [1, 1e4]"),
        parameter::named("coat_weight", "in [0, 1]"),
        parameter::named("coat_color", "each channel in [0, 1]"),
        parameter::named("coat_roughness", "in [0, 1]"),
        parameter::named("coat_roughness_anisotropy", "in [0, 1]"),
        parameter::named("coat_ior", "in [1, 1e4]"),
        parameter::named("coat_darkening", "in [0, 1]"),
        parameter::named("fuzz_weight", "in [0, 1]"),
        parameter::named("fuzz_color", "each channel in [0, 1]"),
        parameter::named("fuzz_roughness", "in [0, 1]"),
    ],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Gains {
        maximum: 1.08,
        at: "white metal, specular_roughness 1, anisotropy 0.9, cos 0.4 along x; 1.001 where isotropic",
    },
    lobes: Lobes { continuous: true, delta: true, transmission: false },
    albedo: Albedo::Quadrature,
    density: "mixture of uniform, visible normals of coat and base, and cosine; or mirrors",
    source: "OpenPBR 1.1",
};

#[cfg(test)]
mod tests;
