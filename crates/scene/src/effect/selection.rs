//! Leaving effects out of a scene.

use alloc::collections::BTreeSet;

use etendue_math::Spectrum;

use super::Effect;
use super::causes::{of_extinction, of_light, of_lobes, of_surface, of_texture};
use crate::material::{Material, MaterialId};
use crate::medium::{MediumId, Phase};
use crate::texture::{TextureId, Textures};
use crate::{Color, Scene};

impl Scene {
    /// The same scene with these effects left out; those that it does not call for make no difference.
    ///
    /// What is left is a scene that does not call for them, so that nothing of them is left in time either:
    ///
    /// * light: lights are not there, shapes that emit are dark, paths end at the second edge without indirect light;
    /// * reflection and transmission: the lobe is black, and a surface that has no other one is black altogether;
    /// * glass has the index of the yellow line of helium for every wavelength, and paths carry RGB;
    /// * bodies that overlap are each there, in what is around all of them;
    /// * facets lose what they scatter more than once;
    /// * principled materials are diffuse; surfaces with opacity masks are whole, those that let light pass are black;
    ///   of two that are blended the heavier one is there; normals are those of the shape;
    /// * textures: their mean is everywhere, or 1 times the scale of a mesh attribute;
    /// * media are not there, take as much of every colour, scatter evenly;
    /// * instances are not there, everything is in focus and stands where it is when the shutter opens, emitters are seen, normals need not agree.
    ///
    /// Lights are numbered anew.
    pub fn without(mut self, effects: &BTreeSet<Effect>) -> Self {
        let out = |effect: Effect| effects.contains(&effect);
        if out(Effect::IndirectLight) {
            self.path.max_depth = Some(self.path.max_depth.map_or(2, |depth| depth.min(2)));
        }
        self.path.spectral &= !out(Effect::SpectralColours);
        self.path.hide_emitters &= !out(Effect::HiddenEmitters);
        self.path.strict_normals &= !out(Effect::StrictNormals);
        self.retain_lights(|light| !out(of_light(light)));
        self.textures.average(|texture| of_texture(texture).is_some_and(out));
        if out(Effect::TextureFiltering) {
            self.textures.lose_filters();
        }
        let black = self.textures.constant(Color::black());
        let textures = &self.textures;
        self.materials
            .change(|material, earlier| changed(material, earlier, textures, &out, black));
        self.leave_out_of_media(&out);
        if out(Effect::Instancing) && self.geometry.instance_count() > 0 {
            self.geometry = self.geometry.without_instances();
        }
        if out(Effect::DepthOfField) {
            self.camera = self.camera.without_lens();
        }
        if out(Effect::MotionBlur) {
            self.camera = self.camera.without_motion();
            if self.geometry.moving_count() > 0 {
                self.geometry = self.geometry.without_motion();
            }
        }
        self
    }

    fn leave_out_of_media(&mut self, out: &impl Fn(Effect) -> bool) {
        let there =
            |id: &MediumId| self.media.get(*id).is_some_and(|medium| !out(of_extinction(medium)));
        for boundary in self.surfaces.iter_mut().filter_map(|surface| surface.boundary.as_mut()) {
            boundary.interior = boundary.interior.filter(there);
            boundary.exterior = boundary.exterior.filter(there);
        }
        self.media.around_camera = self.media.around_camera.filter(there);
        for medium in &mut self.media.list {
            if out(Effect::ColouredExtinction) {
                medium.lose_colour();
            }
            if out(Effect::AnisotropicScattering) {
                medium.phase = Phase::Isotropic;
            }
        }
    }
}

/// What is left of a material, if that is something else.
fn changed(
    material: &Material,
    earlier: &[Material],
    textures: &Textures,
    out: &impl Fn(Effect) -> bool,
    black: TextureId,
) -> Option<Material> {
    let absorber = Material::Diffuse { reflectance: black };
    let part = |MaterialId(id)| earlier[id as usize].clone();
    if of_surface(material).is_some_and(out) {
        return Some(match *material {
            Material::Compensated { nested, .. }
            | Material::Mask { nested, .. }
            | Material::NormalMap { nested, .. }
            | Material::BumpMap { nested, .. } => part(nested),
            Material::Blend { weight, parts } => {
                part(parts[usize::from(textures.mean(weight).luminance() > 0.5)])
            }
            Material::Principled(ref textures) => {
                Material::Diffuse { reflectance: textures.base_color }
            }
            Material::PrincipledThin(ref textures) => {
                Material::Diffuse { reflectance: textures.base_color }
            }
            _ => absorber,
        });
    }
    let mut changed = material.clone();
    let mut is_simpler = false;
    if let Material::Dielectric { dispersion, nesting, .. } = &mut changed {
        is_simpler |= out(Effect::Dispersion) && dispersion.take().is_some();
        is_simpler |= out(Effect::NestedDielectrics) && nesting.take().is_some();
    }
    let (mut lobes, mut left_out) = (0, 0);
    for (effect, factor) in of_lobes(&mut changed) {
        lobes += 1;
        if out(effect) {
            *factor = black;
            left_out += 1;
        }
    }
    let has_base = matches!(
        material,
        Material::DiffuseTransmitter { .. }
            | Material::Coated { .. }
            | Material::Phong { .. }
            | Material::Plastic { .. }
            | Material::Principled(_)
            | Material::PrincipledThin(_)
    );
    match left_out {
        0 => is_simpler.then_some(changed),
        n if n == lobes && !has_base => Some(absorber),
        _ => Some(changed),
    }
}
