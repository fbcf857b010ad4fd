//! `etendue effects`: what a scene calls for.

use etendue_scene::effect::{Element, Presence};
use etendue_scene::{Effect, LoadedScene};
use serde_json::{Value, json};

use super::scene_arguments::{SceneArguments, load};
use crate::failure::{Exit, Failure};

/// Prints which effects a scene calls for, because of what, and what each costs.
///
/// An effect that a scene does not call for is not simulated: it draws no random numbers and takes no time.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Print one line of JSON.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let loaded = load(&arguments.scene.scene, &arguments.scene.load_options())?;
    let present = loaded.scene.effects();
    let lines = Effect::ALL.map(|effect| {
        let presence = present.iter().find(|presence| presence.effect == effect);
        Line { effect, reason: presence.map(|presence| reason(presence, &loaded)) }
    });
    if arguments.json {
        println!("{}", lines.iter().map(Line::json).collect::<Value>());
    } else {
        lines.iter().for_each(Line::print);
    }
    Ok(Exit::Done)
}

/// What is said of one effect.
struct Line {
    effect: Effect,
    /// Why it is simulated, where it is.
    reason: Option<String>,
}

impl Line {
    fn print(&self) {
        match &self.reason {
            None => println!("{:22} absent", self.effect.name()),
            Some(reason) => {
                println!("{:22} present: {reason}", self.effect.name());
                println!("{:22} costs {}", "", self.effect.cost());
            }
        }
    }

    fn json(&self) -> Value {
        json!({
            "effect": self.effect.name(),
            "present": self.reason.is_some(),
            "reason": self.reason,
            "costs": self.effect.cost(),
        })
    }
}

/// The first element that calls for an effect, and how many do.
fn reason(presence: &Presence, loaded: &LoadedScene) -> String {
    let element = match (loaded.origins.of(presence.because), presence.because) {
        (Some(origin), _) => origin.to_string(),
        (None, Element::Material(_)) => "a material that the file does not describe".to_owned(),
        (None, Element::Texture(_)) => "an image that a mesh file names".to_owned(),
        (None, Element::Light(_)) => "the light around a bare mesh".to_owned(),
        (None, Element::Medium(_)) => "a medium that the file does not describe".to_owned(),
        (None, Element::Instances) => "instances".to_owned(),
        (None, Element::Camera) => "the camera".to_owned(),
        (None, Element::Paths) => "paths as they are without an integrator".to_owned(),
    };
    match presence.count {
        1 => element,
        count => format!("{element} and {} more", count - 1),
    }
}
