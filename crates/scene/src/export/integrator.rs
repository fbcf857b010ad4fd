//! The integrator.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::element::Element;
use super::exporter::Exporter;
use super::values::{boolean, integer, string};
use crate::light::Light;
use crate::medium::Medium;
use crate::scene::{Layer, PathSettings, Shows};

/// The integrator of a scene: of those that see media the one without heavy tails where colours of light are taken away
/// differently, of the others the one that sees beams where there are some.
pub(super) fn element(exporter: &mut Exporter<'_>) -> Element {
    let scene = exporter.scene;
    let PathSettings {
        max_depth,
        roulette_depth,
        hide_emitters,
        // Left out before.
        strict_normals: _,
        volumes,
        spectral: _,
        shows,
    } = scene.path;
    if shows == Shows::Distance {
        return Element::plugin("integrator", "depth");
    }
    let in_use = scene.media_in_use();
    let mut media = in_use.iter().filter_map(|&id| scene.media.get(id));
    let has_beams = scene.lights.iter().any(|light| matches!(light, Light::Beam(_)));
    let (kind, roulette) = match volumes {
        false if has_beams => ("ptracer", roulette_depth),
        false => ("path", roulette_depth),
        // Theirs is the last number of edges at which no path is ended by chance.
        true if media.any(Medium::is_coloured) => ("volpathmis", roulette_depth.saturating_sub(1)),
        true => ("volpath", roulette_depth.saturating_sub(1)),
    };
    let depth = max_depth.map_or(-1, i64::from);
    Element::plugin("integrator", kind)
        .with(integer("max_depth", depth))
        .with_all((roulette != 5).then(|| integer("rr_depth", roulette.max(1))))
        .with_all(hide_emitters.then(|| boolean("hide_emitters", true)))
}

/// An integrator with layers beside its picture, each called after what it is.
pub(super) fn with_layers(integrator: Element, layers: &[Layer]) -> Element {
    let names: Vec<String> = layers.iter().map(|&layer| pair(layer)).collect();
    if names.is_empty() {
        return integrator;
    }
    Element::plugin("integrator", "aov").with(string("aovs", &names.join(","))).with(integrator)
}

fn pair(layer: Layer) -> String {
    let kind = match layer {
        Layer::Albedo => "albedo",
        Layer::Normal => "sh_normal",
        Layer::Depth => "depth",
        Layer::Position => "position",
        Layer::Uv => "uv",
        Layer::Shape => "shape_index",
    };
    format!("{kind}:{kind}")
}
