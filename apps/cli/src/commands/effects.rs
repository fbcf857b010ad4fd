//! `etendue effects`: what a scene calls for.

mod line;
mod measure;

use std::collections::BTreeSet;
use std::path::PathBuf;

use etendue_scene::{Effect, LoadOptions};
use serde_json::Value;

use super::scene_arguments::{SceneArguments, load};
use super::selection::SelectionArguments;
use super::values::size;
use crate::failure::{Exit, Failure};
use crate::progress::Quiet;
use line::Line;

/// Prints which effects a scene calls for, because of what, and what each costs.
///
/// An effect that a scene does not call for is not simulated: it draws no random numbers and takes no time.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    selection: SelectionArguments,
    /// Render the scene with and without each effect that is simulated, and print what it costs in time and what leaving
    /// it out does to the picture.
    #[arg(long)]
    measure: bool,
    /// Samples per pixel of the measured pictures; those of the scene if not given.
    #[arg(long, value_name = "N", requires = "measure", value_parser = clap::value_parser!(u32).range(1..))]
    spp: Option<u32>,
    /// Size of the measured pictures in pixels.
    #[arg(long, value_name = "WIDTHxHEIGHT", requires = "measure", value_parser = size)]
    size: Option<[u32; 2]>,
    /// How often each pair of pictures is rendered; times are compared within pairs, and the median counts.
    #[arg(long, value_name = "N", requires = "measure", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=1000))]
    rounds: u32,
    /// Write a difference picture for each effect into this folder: red where the picture without it is brighter,
    /// blue where it is darker.
    #[arg(long, value_name = "FOLDER", requires = "measure")]
    pictures: Option<PathBuf>,
    #[command(flatten)]
    quiet: Quiet,
    /// Print one line of JSON.
    #[arg(long)]
    json: bool,
}

impl Arguments {
    fn load_options(&self) -> LoadOptions {
        LoadOptions {
            film_size: self.size,
            samples_per_pixel: self.spp,
            ..self.scene.load_options()
        }
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let mut loaded = load(&arguments.scene.scene, &arguments.load_options())?;
    let present = loaded.scene.effects();
    let reasons: Vec<_> =
        present.iter().map(|presence| (presence.effect, line::reason(presence, &loaded))).collect();
    loaded.scene = arguments.selection.select(loaded.scene);
    let simulated: BTreeSet<Effect> = loaded.scene.effects().iter().map(|p| p.effect).collect();
    if arguments.measure {
        return measure::run(arguments, &loaded.scene, &simulated);
    }
    let lines = Effect::ALL.map(|effect| {
        let reason = reasons.iter().find(|(present, _)| *present == effect);
        Line {
            effect,
            reason: reason.map(|(_, reason)| reason.as_str()),
            simulated: simulated.contains(&effect),
        }
    });
    if arguments.json {
        println!("{}", lines.iter().map(Line::json).collect::<Value>());
    } else {
        lines.iter().for_each(Line::print);
    }
    Ok(Exit::Done)
}
