//! What Mitsuba has no plugin for, as the nearest that it has.

use etendue_brdf::Ior;
use etendue_math::{Real, Spectrum};

use super::super::Loss;
use super::super::exporter::Exporter;
use super::super::textures::Meaning::Share;
use super::super::values::{float, string};
use super::interfaces::indices;
use super::{Described, plugin};
use crate::material::{Material, MaterialId};
use crate::texture::TextureId;

impl Exporter<'_> {
    /// A layer on a diffuse surface as plastic, on any other surface as nothing.
    pub(super) fn coated(&mut self, eta: Ior<f32>, nested: MaterialId) -> Described {
        self.losses.insert(Loss::Coating);
        match self.scene.materials.get(nested) {
            Some(Material::Diffuse { reflectance }) => {
                let base = self.texture("diffuse_reflectance", *reflectance, Share);
                ("plastic", plugin("plastic").with_all(indices(eta)).with(base))
            }
            _ => self.described(nested),
        }
    }

    /// A sheet that lets light through, as Disney's without its specular lobes.
    pub(super) fn transmitter(
        &mut self,
        reflectance: TextureId,
        transmittance: TextureId,
    ) -> Described {
        self.losses.insert(Loss::DiffuseTransmitter);
        let textures = &self.scene.textures;
        let (color, through) = if textures.is_black(reflectance) {
            (self.texture("base_color", transmittance, Share), 2.0)
        } else {
            let [r, t] = [textures.mean(reflectance), textures.mean(transmittance)];
            let both = r + t;
            let share = t.luminance() / both.luminance();
            (self.constant("base_color", both, None, Share), 2.0 * share.clamp(0.0, 1.0))
        };
        let sheet = plugin("principledthin")
            .with(color)
            .with(float("roughness", 0.0_f32))
            .with(float("diff_trans", through));
        ("principledthin", sheet)
    }

    /// Phong's lobe as that of a metal whose facets have normals as far apart: α² = 2 / (n + 2).
    ///
    /// # Source
    /// B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, section 5.2.
    pub(super) fn phong(
        &mut self,
        diffuse: TextureId,
        specular: TextureId,
        exponent: TextureId,
    ) -> Described {
        self.losses.insert(Loss::Phong);
        let textures = &self.scene.textures;
        let is_even = [diffuse, specular, exponent].iter().all(|&id| textures.is_constant(id));
        let [kd, ks] = [textures.mean(diffuse), textures.mean(specular)];
        let [d, s] = [kd, ks].map(Spectrum::max_channel);
        if !is_even || s == 0.0 {
            return self.diffuse(diffuse);
        }
        let alpha = Real::sqrt(2.0 / (textures.mean(exponent).luminance() + 2.0));
        let weight = s / (d + s);
        let metal = plugin("roughconductor")
            .with(string("material", "none"))
            .with(float("alpha", alpha))
            .with(self.constant("specular_reflectance", ks * weight.recip(), None, Share));
        let base = match 1.0 - weight {
            rest if rest > 0.0 => kd * rest.recip(),
            _ => kd,
        };
        let base = plugin("diffuse").with(self.constant("reflectance", base, None, Share));
        let parts = [base, metal];
        ("blend", plugin("blendbsdf").with(float("weight", weight)).with_all(parts))
    }
}
