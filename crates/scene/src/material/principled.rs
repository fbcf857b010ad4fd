//! Textures of materials that artists put together from many lobes.

use alloc::vec::Vec;

use etendue_brdf::{Ior, PrincipledParameters, PrincipledThinParameters};

use super::prepare::At;
use crate::color::Channels;
use crate::texture::TextureId;

/// What the parameters of [`etendue_brdf::Principled`] are looked up in.
#[derive(Clone, Debug, PartialEq)]
pub struct PrincipledTextures {
    /// Colour of the diffuse lobe and of metal.
    pub base_color: TextureId,
    /// Root of the facets' width.
    pub roughness: TextureId,
    /// How much wider the facets are along ∂p/∂u.
    pub anisotropic: TextureId,
    /// 0: dielectric; 1: metal.
    pub metallic: TextureId,
    /// Share of specular transmission; `None` for a material that lets no light through anywhere.
    pub spec_trans: Option<TextureId>,
    /// Index of the medium behind the surface relative to the one in front.
    pub eta: Ior<f32>,
    /// Share of the dielectric reflection that has the base colour.
    pub spec_tint: TextureId,
    /// Weight of the sheen.
    pub sheen: TextureId,
    /// Share of the sheen that has the base colour.
    pub sheen_tint: TextureId,
    /// Share of flat subsurface scattering in the diffuse lobe.
    pub flatness: TextureId,
    /// Weight of the clear coat.
    pub clearcoat: TextureId,
    /// 0: satin; 1: gloss.
    pub clearcoat_gloss: TextureId,
    /// How often the diffuse lobe, the main specular one and the clear coat are sampled.
    pub sampling_rates: [f32; 3],
}

impl PrincipledTextures {
    pub(super) fn textures(&self) -> Vec<TextureId> {
        let always = [
            self.base_color,
            self.roughness,
            self.anisotropic,
            self.metallic,
            self.spec_tint,
            self.sheen,
            self.sheen_tint,
            self.flatness,
            self.clearcoat,
            self.clearcoat_gloss,
        ];
        always.into_iter().chain(self.spec_trans).collect()
    }

    pub(super) fn at<C: Channels>(&self, at: At<'_, C>) -> PrincipledParameters<C::Color> {
        let [diffuse, specular, clearcoat] = self.sampling_rates;
        PrincipledParameters {
            base_color: at.color(self.base_color),
            roughness: at.value(self.roughness),
            anisotropic: at.value(self.anisotropic),
            metallic: at.value(self.metallic),
            spec_trans: self.spec_trans.map_or(0.0, |id| at.value(id)),
            eta: self.eta.value(),
            spec_tint: at.value(self.spec_tint),
            sheen: at.value(self.sheen),
            sheen_tint: at.value(self.sheen_tint),
            flatness: at.value(self.flatness),
            clearcoat: at.value(self.clearcoat),
            clearcoat_gloss: at.value(self.clearcoat_gloss),
            diffuse_reflectance_sampling_rate: diffuse,
            main_specular_sampling_rate: specular,
            clearcoat_sampling_rate: clearcoat,
        }
    }
}

/// What the parameters of [`etendue_brdf::PrincipledThin`] are looked up in.
#[derive(Clone, Debug, PartialEq)]
pub struct PrincipledThinTextures {
    /// Colour of everything but untinted reflection.
    pub base_color: TextureId,
    /// Root of the facets' width.
    pub roughness: TextureId,
    /// How much wider the facets are along ∂p/∂u.
    pub anisotropic: TextureId,
    /// Share of the specular lobes; `None` for a sheet that has none anywhere.
    pub spec_trans: Option<TextureId>,
    /// Index of the sheet.
    pub eta: TextureId,
    /// Share of the specular reflection that has the base colour.
    pub spec_tint: TextureId,
    /// Weight of the sheen.
    pub sheen: TextureId,
    /// Share of the sheen that has the base colour.
    pub sheen_tint: TextureId,
    /// Share of flat subsurface scattering in the diffuse lobe.
    pub flatness: TextureId,
    /// Twice the share of diffuse light that goes through.
    pub diff_trans: TextureId,
    /// How often specular reflection and transmission, diffuse reflection and transmission are sampled.
    pub sampling_rates: [f32; 4],
}

impl PrincipledThinTextures {
    pub(super) fn textures(&self) -> Vec<TextureId> {
        let always = [
            self.base_color,
            self.roughness,
            self.anisotropic,
            self.eta,
            self.spec_tint,
            self.sheen,
            self.sheen_tint,
            self.flatness,
            self.diff_trans,
        ];
        always.into_iter().chain(self.spec_trans).collect()
    }

    pub(super) fn at<C: Channels>(&self, at: At<'_, C>) -> PrincipledThinParameters<C::Color> {
        let [specular, specular_through, diffuse, diffuse_through] = self.sampling_rates;
        PrincipledThinParameters {
            base_color: at.color(self.base_color),
            roughness: at.value(self.roughness),
            anisotropic: at.value(self.anisotropic),
            spec_trans: self.spec_trans.map_or(0.0, |id| at.value(id)),
            eta: at.value(self.eta),
            spec_tint: at.value(self.spec_tint),
            sheen: at.value(self.sheen),
            sheen_tint: at.value(self.sheen_tint),
            flatness: at.value(self.flatness),
            diff_trans: at.value(self.diff_trans),
            specular_reflectance_sampling_rate: specular,
            specular_transmittance_sampling_rate: specular_through,
            diffuse_reflectance_sampling_rate: diffuse,
            diffuse_transmittance_sampling_rate: diffuse_through,
        }
    }
}
