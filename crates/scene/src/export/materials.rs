//! Materials.

mod interfaces;
mod nearest;
mod principled;

use alloc::string::String;

use super::Loss;
use super::element::Element;
use super::exporter::Exporter;
use super::textures::Meaning::{Number, Share};
use super::values::{boolean, float};
use crate::material::{Material, MaterialId, Perturbation};
use crate::texture::TextureId;

/// A plugin, and what it is called.
type Described = (&'static str, Element);

impl Exporter<'_> {
    /// A reference to a material, described where that has not happened yet.
    pub(super) fn material(&mut self, id: MaterialId) -> Element {
        if let Some(known) = self.material_ids.get(&id) {
            return Element::reference(known);
        }
        let (name, element) = self.described(id);
        let name: String = self.name(name);
        self.materials.push(element.attribute("id", name.clone()));
        self.material_ids.insert(id, name.clone());
        Element::reference(&name)
    }

    /// The plugin that a material is.
    fn described(&mut self, id: MaterialId) -> Described {
        // What there is none of is not noticed.
        let Some(material) = self.scene.materials.get(id) else { return null() };
        match *material {
            Material::Diffuse { reflectance } => self.diffuse(reflectance),
            Material::RoughDiffuse { reflectance, .. } => {
                self.losses.insert(Loss::RoughDiffuse);
                self.diffuse(reflectance)
            }
            Material::DiffuseTransmitter { reflectance, transmittance } => {
                self.transmitter(reflectance, transmittance)
            }
            Material::Phong { diffuse_reflectance, specular_reflectance, exponent } => {
                self.phong(diffuse_reflectance, specular_reflectance, exponent)
            }
            Material::Dielectric {
                eta,
                // Left out before.
                dispersion: _,
                nesting: _,
                ref roughness,
                specular_reflectance,
                specular_transmittance,
            } => {
                let factors = [specular_reflectance, specular_transmittance];
                self.dielectric(eta, roughness.as_ref(), factors)
            }
            Material::ThinDielectric { eta, specular_reflectance, specular_transmittance } => {
                self.pane(eta, [specular_reflectance, specular_transmittance])
            }
            Material::Conductor { index, ref roughness, specular_reflectance } => {
                self.conductor(index, roughness.as_ref(), specular_reflectance)
            }
            Material::Plastic {
                ref surface,
                diffuse_reflectance,
                specular_reflectance,
                scattering,
            } => self.plastic(surface, diffuse_reflectance, scattering, specular_reflectance),
            Material::Principled(ref textures) => ("principled", self.principled(textures)),
            Material::PrincipledThin(ref textures) => {
                ("principledthin", self.principled_thin(textures))
            }
            // Left out before.
            Material::Compensated { nested, .. } => self.described(nested),
            Material::Coated { eta, nested, .. } => self.coated(eta, nested),
            Material::Mask { opacity, nested } => {
                let opacity = self.texture("opacity", opacity, Number);
                ("mask", plugin("mask").with(opacity).with(self.material(nested)))
            }
            Material::Blend { weight, parts } => {
                let weight = self.texture("weight", weight, Number);
                let parts = parts.map(|part| self.material(part));
                ("blend", plugin("blendbsdf").with(weight).with_all(parts))
            }
            Material::NormalMap { normal, options, nested } => {
                let normal = self.texture("normalmap", normal, Number);
                let map = plugin("normalmap").with(normal).with_all(perturbation(options));
                ("normalmap", map.with(self.material(nested)))
            }
            Material::BumpMap { height, scale, options, nested } => {
                let map = plugin("bumpmap")
                    .with(self.height(height))
                    .with_all((scale != 1.0).then(|| float("scale", scale)))
                    .with_all(perturbation(options));
                ("bumpmap", map.with(self.material(nested)))
            }
            Material::TwoSided { front, back } => {
                let front_side = self.material(front);
                let back_side = (front != back).then(|| self.material(back));
                ("twosided", plugin("twosided").with(front_side).with_all(back_side))
            }
            Material::Null => null(),
        }
    }

    fn diffuse(&mut self, reflectance: TextureId) -> Described {
        ("diffuse", plugin("diffuse").with(self.texture("reflectance", reflectance, Share)))
    }

    /// The height of bumps, which Mitsuba wants to be a texture of any name.
    fn height(&mut self, id: TextureId) -> Element {
        if self.scene.textures.is_constant(id) {
            let value = self.texture("value", id, Number);
            return Element::plugin("texture", "uniform").with(value).named("height");
        }
        self.texture("height", id, Number)
    }
}

fn plugin(name: &str) -> Element {
    Element::plugin("bsdf", name)
}

fn null() -> Described {
    ("null", plugin("null"))
}

/// What is done where normals disagree, where it is not the default.
fn perturbation(options: Perturbation) -> impl Iterator<Item = Element> {
    let options = [
        ("flip_invalid_normals", options.flip_invalid_normals),
        ("use_shadowing_function", options.use_shadowing_function),
    ];
    options.into_iter().filter(|(_, is_on)| !is_on).map(|(name, _)| boolean(name, false))
}
