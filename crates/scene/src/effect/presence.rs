//! Which effects a scene calls for.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;

use super::Effect;
use super::causes::{of_light, of_lobes, of_medium, of_surface, of_texture};
use crate::Scene;
use crate::light::{Light, LightId};
use crate::material::{Material, MaterialId};
use crate::medium::MediumId;
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
    /// A participating medium.
    Medium(MediumId),
    /// The instances of groups of shapes.
    Instances,
    /// A shape or an instance that moves, in the order in which they were added.
    Moving(u32),
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
    /// A material counts if a shape is made of it, a texture if such a material or a light uses it, a
    /// medium if paths know media and a shape bounds it or the camera stands in it.
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
            (Effect::SpectralColours, path.spectral),
            (Effect::StrictNormals, path.strict_normals),
        ];
        causes.extend(
            demands.into_iter().filter(|d| d.1).map(|(effect, _)| (effect, Element::Paths)),
        );
        let lights = (0..).map(LightId).zip(&self.lights);
        causes.extend(lights.map(|(id, light)| (of_light(light), Element::Light(id))));
        let materials = self.materials.with_parts(self.surfaces.iter().map(|s| s.material));
        for &id in &materials {
            let Some(mut material) = self.materials.get(id).cloned() else { continue };
            let element = Element::Material(id);
            causes.extend(of_surface(&material).map(|effect| (effect, element)));
            if material.nesting().is_some() {
                causes.push((Effect::NestedDielectrics, element));
            }
            if material.disperses() {
                causes.push((Effect::Dispersion, element));
            }
            let lobes = of_lobes(&mut material);
            let lobes = lobes.filter(|(_, factor)| !self.textures.is_black(**factor));
            causes.extend(lobes.map(|(effect, _)| (effect, element)));
        }
        let of_materials = materials.iter().filter_map(|&id| self.materials.get(id));
        let textures = of_materials.flat_map(Material::textures);
        let textures = textures.chain(self.lights.iter().filter_map(Light::texture));
        for id in self.textures.with_parts(textures) {
            let Some(texture) = self.textures.get(id) else { continue };
            causes.extend(of_texture(texture).map(|effect| (effect, Element::Texture(id))));
            if matches!(texture, Texture::Bitmap(bitmap) if bitmap.is_filtered()) {
                causes.push((Effect::TextureFiltering, Element::Texture(id)));
            }
        }
        for id in self.media_in_use() {
            let Some(medium) = self.media.get(id).filter(|_| path.volumes) else { continue };
            causes.extend(of_medium(medium).map(|effect| (effect, Element::Medium(id))));
        }
        let instances = self.geometry.instance_count();
        causes.extend((0..instances).map(|_| (Effect::Instancing, Element::Instances)));
        if self.camera.has_lens() {
            causes.push((Effect::DepthOfField, Element::Camera));
        }
        let moving = (0..self.geometry.moving_count()).map(|i| Element::Moving(i as u32));
        let moving = moving.chain(self.camera.is_moving().then_some(Element::Camera));
        causes.extend(moving.map(|element| (Effect::MotionBlur, element)));
        causes
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
