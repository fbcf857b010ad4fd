//! Disney's materials.

use super::super::element::Element;
use super::super::exporter::Exporter;
use super::super::textures::Meaning::{Number, Share};
use super::super::values::float;
use super::plugin;
use crate::material::{PrincipledTextures, PrincipledThinTextures};
use crate::texture::TextureId;

impl Exporter<'_> {
    pub(super) fn principled(&mut self, textures: &PrincipledTextures) -> Element {
        let PrincipledTextures {
            base_color,
            roughness,
            anisotropic,
            metallic,
            spec_trans,
            eta,
            spec_tint,
            sheen,
            sheen_tint,
            flatness,
            clearcoat,
            clearcoat_gloss,
            sampling_rates: [diffuse, specular, coat],
        } = *textures;
        let shares = [
            ("anisotropic", Some(anisotropic)),
            ("metallic", Some(metallic)),
            ("spec_trans", spec_trans),
            ("spec_tint", Some(spec_tint)),
            ("sheen", Some(sheen)),
            ("sheen_tint", Some(sheen_tint)),
            ("flatness", Some(flatness)),
            ("clearcoat", Some(clearcoat)),
            ("clearcoat_gloss", Some(clearcoat_gloss)),
        ];
        let rates = [
            ("diffuse_reflectance_sampling_rate", diffuse),
            ("main_specular_sampling_rate", specular),
            ("clearcoat_sampling_rate", coat),
        ];
        let material = self.lobes("principled", [base_color, roughness], shares);
        material.with(float("eta", eta.value())).with_all(sampling(rates))
    }

    pub(super) fn principled_thin(&mut self, textures: &PrincipledThinTextures) -> Element {
        let PrincipledThinTextures {
            base_color,
            roughness,
            anisotropic,
            spec_trans,
            eta,
            spec_tint,
            sheen,
            sheen_tint,
            flatness,
            diff_trans,
            sampling_rates: [specular, specular_through, diffuse, diffuse_through],
        } = *textures;
        let shares = [
            ("anisotropic", Some(anisotropic)),
            ("spec_trans", spec_trans),
            ("eta", Some(eta)),
            ("spec_tint", Some(spec_tint)),
            ("sheen", Some(sheen)),
            ("sheen_tint", Some(sheen_tint)),
            ("flatness", Some(flatness)),
            ("diff_trans", Some(diff_trans)),
        ];
        let rates = [
            ("specular_reflectance_sampling_rate", specular),
            ("specular_transmittance_sampling_rate", specular_through),
            ("diffuse_reflectance_sampling_rate", diffuse),
            ("diffuse_transmittance_sampling_rate", diffuse_through),
        ];
        let material = self.lobes("principledthin", [base_color, roughness], shares);
        material.with_all(sampling(rates))
    }

    /// Colour and roughness, and those of the other parameters that are not 0, their default.
    fn lobes<const N: usize>(
        &mut self,
        name: &'static str,
        [base_color, roughness]: [TextureId; 2],
        shares: [(&'static str, Option<TextureId>); N],
    ) -> Element {
        let mut material = plugin(name)
            .with(self.texture("base_color", base_color, Share))
            .with(self.texture("roughness", roughness, Number));
        for (name, id) in shares {
            if let Some(id) = id.filter(|&id| !self.scene.textures.is_black(id)) {
                material = material.with(self.texture(name, id, Number));
            }
        }
        material
    }
}

/// How often lobes are sampled, where it is not as often as the others.
fn sampling<const N: usize>(rates: [(&'static str, f32); N]) -> impl Iterator<Item = Element> {
    rates.into_iter().filter(|(_, rate)| *rate != 1.0).map(|(name, rate)| float(name, rate))
}
