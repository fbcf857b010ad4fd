//! Which effects a scene calls for.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;

use super::Effect;
use crate::Scene;
use crate::light::{Light, LightId};
use crate::material::{Material, MaterialId, PlasticSurface};
use crate::texture::{Texture, TextureId};

/// A part of a scene that calls for an effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Element {
    /// What a surface is made of.
    Material(MaterialId),
    /// What varies over a surface or a light.
    Texture(TextureId),
    /// A light.
    Light(LightId),
    /// The instances of groups of shapes.
    Instances,
    /// The camera.
    Camera,
    /// What is computed along paths.
    Paths,
}

/// An effect that a scene calls for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Presence {
    /// The effect.
    pub effect: Effect,
    /// The first element that calls for it.
    pub because: Element,
    /// How many do.
    pub count: usize,
}

impl Scene {
    /// The effects that the scene calls for, in the order of the vocabulary.
    ///
    /// A material counts if a shape is made of it, a texture if such a material or a light uses it.
    pub fn effects(&self) -> Vec<Presence> {
        let mut found = BTreeMap::new();
        for (effect, because) in self.causes() {
            let presence = found.entry(effect).or_insert(Presence { effect, because, count: 0 });
            presence.count += 1;
        }
        found.into_values().collect()
    }

    /// Every effect with every element that calls for it.
    fn causes(&self) -> Vec<(Effect, Element)> {
        let mut causes = Vec::new();
        let path = &self.path;
        let demands = [
            // Two edges see light by way of one surface.
            (
                Effect::IndirectLight,
                path.max_depth.is_none_or(|d| d > 2) && !self.surfaces.is_empty(),
            ),
            (Effect::HiddenEmitters, path.hide_emitters),
            (Effect::StrictNormals, path.strict_normals),
        ];
        causes.extend(
            demands.into_iter().filter(|d| d.1).map(|(effect, _)| (effect, Element::Paths)),
        );
        let lights = (0..).map(LightId).zip(&self.lights);
        causes.extend(lights.map(|(id, light)| (effect_of_light(light), Element::Light(id))));
        let materials = self.materials.with_parts(self.surfaces.iter().map(|s| s.material));
        for &id in &materials {
            let Some(material) = self.materials.get(id) else { continue };
            causes
                .extend(effects_of_material(material).iter().map(|&e| (e, Element::Material(id))));
        }
        let of_materials = materials.iter().filter_map(|&id| self.materials.get(id));
        let textures = of_materials.flat_map(Material::textures);
        let textures = textures.chain(self.lights.iter().filter_map(Light::texture));
        for id in self.textures.with_parts(textures) {
            let effect = match self.textures.get(id) {
                Some(Texture::Bitmap(_)) => Effect::BitmapTexture,
                Some(Texture::Checkerboard(_)) => Effect::CheckerboardTexture,
                Some(Texture::Attribute(_)) => Effect::MeshAttribute,
                Some(Texture::Constant(_)) | None => continue,
            };
            causes.push((effect, Element::Texture(id)));
        }
        let instances = self.geometry.instance_count();
        causes.extend((0..instances).map(|_| (Effect::Instancing, Element::Instances)));
        if self.camera.has_lens() {
            causes.push((Effect::DepthOfField, Element::Camera));
        }
        causes
    }
}

fn effect_of_light(light: &Light) -> Effect {
    match light {
        Light::Area(_) => Effect::AreaLight,
        Light::Point(_) => Effect::PointLight,
        Light::Spot(_) => Effect::SpotLight,
        Light::Directional(_) => Effect::DirectionalLight,
        Light::Constant(_) => Effect::ConstantBackground,
        Light::Environment(_) => Effect::EnvironmentMap,
    }
}

/// A material of many lobes refracts only where it has a share of transmission.
fn principled(spec_trans: Option<TextureId>) -> &'static [Effect] {
    match spec_trans {
        None => &[Effect::RoughReflection, Effect::Principled],
        Some(_) => &[Effect::RoughReflection, Effect::RoughTransmission, Effect::Principled],
    }
}

fn effects_of_material(material: &Material) -> &'static [Effect] {
    const MIRROR: &[Effect] = &[Effect::DeltaReflection];
    const FACETS: &[Effect] = &[Effect::RoughReflection];
    match material {
        Material::Diffuse { .. } | Material::RoughDiffuse { .. } | Material::TwoSided { .. } => &[],
        Material::Dielectric { roughness: None, .. } | Material::ThinDielectric { .. } => {
            &[Effect::DeltaReflection, Effect::DeltaTransmission]
        }
        Material::Dielectric { roughness: Some(_), .. } => {
            &[Effect::RoughReflection, Effect::RoughTransmission]
        }
        Material::Conductor { roughness: None, .. }
        | Material::Plastic { surface: PlasticSurface::Smooth(_), .. } => MIRROR,
        Material::Conductor { roughness: Some(_), .. }
        | Material::Plastic { surface: PlasticSurface::Rough(_), .. } => FACETS,
        Material::Principled(textures) => principled(textures.spec_trans),
        Material::PrincipledThin(textures) => principled(textures.spec_trans),
        Material::Mask { .. } => &[Effect::OpacityMask],
        Material::Blend { .. } => &[Effect::Blend],
        Material::NormalMap { .. } => &[Effect::NormalMap],
        Material::BumpMap { .. } => &[Effect::BumpMap],
        Material::Null => &[Effect::PassThrough],
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn the_vocabulary_is_whole_in_order_and_without_doubles() {
        assert!(Effect::ALL.is_sorted());
        let names: HashSet<&str> = Effect::ALL.iter().map(|effect| effect.name()).collect();
        assert_eq!(names.len(), Effect::ALL.len());
        // The last of the enumeration: one that is missing in the list would be found here or be it.
        assert_eq!(Effect::StrictNormals as usize + 1, Effect::ALL.len());
    }
}
