//! The base: metal, and a rough diffuse reflector under a dielectric interface.

use etendue_math::{Real, Spectrum, Vec3};

use super::OpenPbrParameters;
use super::interface::{Interface, facets};
use super::metal::Metal;
use crate::microfacet::{CosineRow, Place};
use crate::{Bsdf, Eon, Microfacets, ParameterError, Reflectance, Roughness};

/// Metal and dielectric with common facets, and what lies below the dielectric.
///
/// ```text
/// specular  F(wo·h) D V,  F = (1 − m) specular_color F_dielectric + F_metal
/// diffuse   (1 − m) f_EON(base) p(o) p(i) / p_avg,  p = (1 − E) · what passes the layers above
/// ```
///
/// with m `base_metalness` and E the albedo of the dielectric's facets.
///
/// # Source
/// OpenPBR 1.1, "Base substrate", "Glossy-diffuse", "Roughening"; the reciprocal form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Base<C: Spectrum> {
    /// `None` for a mirror.
    facets: Option<Microfacets<C::Real>>,
    interface: Interface<C::Real>,
    /// `(1 − m) specular_color`; black where there is nothing to tint.
    tint: C,
    metal: Option<Metal<C>>,
    /// `1 − E`
    passed: CosineRow<C::Real>,
    diffuse: Option<Diffuse<C>>,
    /// Mean of `(1 − m) base`.
    diffuse_share: C::Real,
}

/// The diffuse reflector, by what is left of light on its way through everything above it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Diffuse<C: Spectrum> {
    eon: Eon<C>,
    /// p
    through: CosineRow<C::Real>,
    /// `(1 − m) / p_avg`
    scale: C::Real,
}

impl<C: Spectrum> Base<C> {
    /// `above` is what passes the layers above; with it the base's albedo at normal incidence and its mean roughness.
    pub(super) fn new(
        p: &OpenPbrParameters<C>,
        above: &CosineRow<C::Real>,
    ) -> Result<Self, ParameterError> {
        let (zero, one) = (<C::Real as Real>::ZERO, <C::Real as Real>::ONE);
        let roughness = roughened(p);
        let facets = facets(roughness, p.specular_roughness_anisotropy)?;
        let is_mirror = facets.is_none();
        let interface = interface(p);
        let passed = interface.passed(roughness, is_mirror);
        let color = p.base_color.scale(p.base_weight);
        let dielectric = one - p.base_metalness;
        let metal_weight = p.base_metalness * p.specular_weight.min(one);
        let through = passed.times(above);
        let is_diffuse = dielectric > zero && !color.is_black();
        let diffuse = if is_diffuse {
            let roughness = Roughness::new(p.base_diffuse_roughness)?;
            let eon = Eon::new(Reflectance::new(color)?, roughness);
            // Not 0: along the normal something passes every interface.
            Some(Diffuse { eon, through, scale: dielectric / through.average() })
        } else {
            None
        };
        let tint = if interface.is_matched() { zero } else { dielectric };
        Ok(Self {
            facets,
            interface,
            tint: p.specular_color.scale(tint),
            metal: Metal::new(metal_weight, [color, p.specular_color], roughness, is_mirror)?,
            passed,
            diffuse,
            diffuse_share: dielectric * color.mean(),
        })
    }

    /// Facets; `None` for a mirror.
    #[inline]
    pub(super) fn facets(&self) -> Option<&Microfacets<C::Real>> {
        self.facets.as_ref()
    }

    /// Something is reflected by the facets or the mirror.
    #[inline]
    pub(super) fn is_specular(&self) -> bool {
        self.metal.is_some() || !self.tint.is_black()
    }

    /// Something is reflected diffusely below them.
    #[inline]
    pub(super) fn is_diffuse(&self) -> bool {
        self.diffuse.is_some()
    }

    /// F, at `cos = wo·h`.
    #[inline]
    pub(super) fn reflectance(&self, cos: C::Real) -> C {
        let metal = self.metal.as_ref().map_or(C::black(), |metal| metal.reflectance(cos));
        metal + self.tint.scale(self.interface.reflectance(cos))
    }

    /// What metal reflects more than once, without the layers above.
    #[inline]
    pub(super) fn multiple(&self, cos_o: C::Real, cos_i: C::Real) -> C {
        self.metal.as_ref().map_or(C::black(), |metal| metal.multiple(cos_o, cos_i))
    }

    /// The diffuse lobe with what all layers leave of it, but for absorption.
    #[inline]
    pub(super) fn diffuse(
        &self,
        [wo, wi]: [Vec3<C::Real>; 2],
        [place_o, place_i]: [Place<C::Real>; 2],
    ) -> C {
        self.diffuse.as_ref().map_or(C::black(), |d| {
            let passed = d.through.at(place_o) * (d.through.at(place_i) * d.scale);
            d.eon.eval(wo, wi).scale(passed)
        })
    }

    /// About how much facets and cosine lobes reflect of light at an angle that the layers above let through.
    #[inline]
    pub(super) fn albedos(&self, cos_o: C::Real, place: Place<C::Real>) -> [C::Real; 2] {
        let passed = self.passed.at(place);
        let zero = [C::Real::ZERO; 2];
        let [single, multiple] = self.metal.as_ref().map_or(zero, |metal| metal.albedos(cos_o));
        [
            single + self.tint.mean() * (C::Real::ONE - passed),
            multiple + self.diffuse_share * passed,
        ]
    }

    /// Albedo at normal incidence, of each colour, without the layers above.
    pub(super) fn normal_albedo(&self, p: &OpenPbrParameters<C>) -> C {
        let color = p.base_color.scale(p.base_weight);
        let passed = self.passed.0[CosineRow::<C::Real>::NODES - 1];
        let metal = color.scale(p.base_metalness * p.specular_weight.min(C::Real::ONE));
        let gloss = self.tint.scale(C::Real::ONE - passed);
        metal + gloss + color.scale((C::Real::ONE - p.base_metalness) * passed)
    }

    /// r_b of the [darkening](super::coat::darkening): how diffusely the base reflects.
    pub(super) fn mean_roughness(&self, p: &OpenPbrParameters<C>) -> C::Real {
        let (one, r) = (C::Real::ONE, p.specular_roughness);
        let gloss = one + (r - one) * self.interface.normal_reflectance();
        gloss + (r - gloss) * p.base_metalness
    }
}

/// `specular_roughness`, and where there is a coat what its facets make of it.
///
/// ```text
/// r' = lerp(r, min(1, r⁴ + 2 r_coat⁴)^¼, coat_weight)
/// ```
fn roughened<C: Spectrum>(p: &OpenPbrParameters<C>) -> C::Real {
    let (r, coat) = (p.specular_roughness, p.coat_roughness);
    let under = (r.powi(4) + C::Real::TWO * coat.powi(4)).min(C::Real::ONE).sqrt().sqrt();
    r + (under - r) * p.coat_weight
}

/// The dielectric's interface with what is above it.
///
/// ```text
/// η = lerp(n_s, max(n_s/n_coat, n_coat/n_s), coat_weight),  reflectance scaled by specular_weight
/// ```
fn interface<C: Spectrum>(p: &OpenPbrParameters<C>) -> Interface<C::Real> {
    let (ior, coat) = (p.specular_ior, p.coat_ior);
    let bare = ior - C::Real::ONE;
    let coated = (ior - coat).abs() / ior.min(coat);
    Interface::of_excess(bare + (coated - bare) * p.coat_weight).weighted(p.specular_weight)
}
