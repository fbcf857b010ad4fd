//! Lights that are no shape.

use alloc::vec::Vec;

use super::element::Element;
use super::exporter::Exporter;
use super::textures::Meaning;
use super::values::{float, rgb, to_world, vector};
use super::{Loss, camera};
use crate::light::{EnvironmentLight, Light, ProjectorLight, SpotLight};
use crate::texture::Texture;

/// The emitters of a scene but those inside shapes.
pub(super) fn elements(exporter: &mut Exporter<'_>) -> Vec<Element> {
    let mut elements = Vec::new();
    let mut has_background = false;
    for light in &exporter.scene.lights {
        // Mitsuba has room for one light around the scene, but for any number of directions.
        let is_background = light.is_infinite() && !light.is_delta();
        if is_background && has_background {
            exporter.losses.insert(Loss::SecondBackground);
            continue;
        }
        has_background |= is_background;
        elements.extend(element(exporter, light));
    }
    elements
}

/// The emitter that a light is; nothing for a shape that emits.
fn element(exporter: &mut Exporter<'_>, light: &Light) -> Option<Element> {
    Some(match light {
        Light::Area(_) | Light::Beam(_) => return None,
        Light::Point(light) => plugin("point")
            .with(rgb("intensity", light.intensity))
            .with(vector("point", "position", light.position)),
        Light::Spot(light) => spot(exporter, light),
        Light::Projector(light) => projector(exporter, light),
        Light::Directional(light) => plugin("directional")
            .with(rgb("irradiance", light.irradiance))
            .with(vector("vector", "direction", light.direction)),
        Light::Constant(light) => plugin("constant").with(rgb("radiance", light.radiance)),
        Light::Environment(light) => envmap(exporter, light),
    })
}

fn plugin(kind: &str) -> Element {
    Element::plugin("emitter", kind)
}

fn spot(exporter: &mut Exporter<'_>, light: &SpotLight) -> Element {
    let [cutoff, beam_width] = light.degrees();
    let mut intensity = light.axial_intensity();
    let mut picture = None;
    if let Some(id) = light.texture() {
        match exporter.scene.textures.get(id) {
            // Mitsuba wants one that varies.
            Some(Texture::Constant(color)) => intensity = intensity * *color,
            _ => picture = Some(exporter.texture("texture", id, Meaning::Light)),
        }
    }
    plugin("spot")
        .with(rgb("intensity", intensity))
        .with_all(picture)
        .with(float("cutoff_angle", cutoff))
        .with(float("beam_width", beam_width))
        .with_all(to_world(light.to_world().affine()))
}

fn projector(exporter: &mut Exporter<'_>, light: &ProjectorLight) -> Element {
    plugin("projector")
        .with(exporter.texture("irradiance", light.texture(), Meaning::Light))
        .with_all((light.scale() != 1.0).then(|| float("scale", light.scale())))
        .with_all(camera::field_of_view(light.field_of_view()).into_iter().flatten())
        .with_all(to_world(light.to_world().affine()))
}

fn envmap(exporter: &mut Exporter<'_>, light: &EnvironmentLight) -> Element {
    let name = exporter.name("envmap");
    plugin("envmap")
        .with(exporter.image(&name, light.image()))
        .with_all((light.scale() != 1.0).then(|| float("scale", light.scale())))
        .with_all(to_world(light.to_world().affine()))
}
