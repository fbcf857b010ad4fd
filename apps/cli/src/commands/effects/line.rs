//! What is said of one effect.

use etendue_scene::effect::{Element, Presence};
use etendue_scene::{Effect, LoadedScene};
use serde_json::{Value, json};

/// An effect in a scene.
pub(super) struct Line<'a> {
    pub(super) effect: Effect,
    /// Why the scene calls for it, where it does.
    pub(super) reason: Option<&'a str>,
    /// Whether what is left of the scene calls for it.
    pub(super) simulated: bool,
}

impl Line<'_> {
    pub(super) fn print(&self) {
        let name = self.effect.name();
        match self.reason {
            None => println!("{name:22} absent"),
            Some(reason) if self.simulated => {
                println!("{name:22} present: {reason}");
                println!("{:22} costs {}", "", self.effect.cost());
            }
            Some(reason) => println!("{name:22} left out, called for by {reason}"),
        }
    }

    pub(super) fn json(&self) -> Value {
        json!({
            "effect": self.effect.name(),
            "present": self.reason.is_some(),
            "simulated": self.simulated,
            "reason": self.reason,
            "costs": self.effect.cost(),
        })
    }
}

/// The first element that calls for an effect, and how many do.
pub(super) fn reason(presence: &Presence, loaded: &LoadedScene) -> String {
    let element = match (loaded.origins.of(presence.because), presence.because) {
        (Some(origin), _) => origin.to_string(),
        (None, Element::Material(_)) => "a material that the file does not describe".to_owned(),
        (None, Element::Texture(_)) => "an image that a mesh file names".to_owned(),
        (None, Element::Light(_)) => "the light around what has none".to_owned(),
        (None, Element::Medium(_)) => "a medium that the file does not describe".to_owned(),
        (None, Element::Instances) => "instances".to_owned(),
        (None, Element::Moving(_)) => "a shape that moves".to_owned(),
        (None, Element::Camera) => "the camera".to_owned(),
        (None, Element::Paths) => "paths as they are without an integrator".to_owned(),
    };
    match presence.count {
        1 => element,
        count => format!("{element} and {} more", count - 1),
    }
}
