//! Where a render begins, if not at nothing, and where it is kept.

use std::path::{Path, PathBuf};

use etendue_renderer::progressive::ProgressiveState;
use etendue_renderer::{Accumulation, ReuseState};
use etendue_scene::Scene;

use super::Arguments;
use super::settings::settings;
use super::task::{Method, Task};
use crate::checkpoint::{Header, Identity, Keeper, Part, Recipe, Shard, State, Stored};
use crate::failure::Failure;
use crate::output::Output;

/// A render that is stored: as a checkpoint, as a part of a picture, or as both.
#[derive(Debug)]
pub(super) struct Storage {
    pub(super) keeper: Option<Keeper>,
    pub(super) header: Header,
    /// What there is already.
    pub(super) state: State,
    /// Whether the part that was asked for is there.
    pub(super) is_there: bool,
}

/// What a stored render is, for messages.
#[derive(Clone, Copy)]
enum Kind {
    Checkpoint,
    Part,
}

impl Storage {
    /// Reads what there is of a render; `None` for one that is not stored.
    ///
    /// # Errors
    /// What there is belongs to another render, or is damaged.
    pub(super) fn open(
        arguments: &Arguments,
        recipe: &Recipe,
        scene: &Scene,
        files: &[PathBuf],
        task: &Task,
        output: &Output,
    ) -> Result<Option<Self>, Failure> {
        if arguments.checkpoint.is_none() && arguments.shard.is_none() {
            return Ok(None);
        }
        let header = Header {
            identity: Identity::new(settings(arguments, scene, task), files)?,
            recipe: recipe.clone(),
            scene: arguments.scene.scene.display().to_string(),
            shard: arguments.shard,
            samples_per_pixel: scene.sampling.samples_per_pixel,
            seconds: 0.0,
            configuration: String::new(),
            whole: false,
        };
        let new = Self {
            keeper: None,
            header,
            state: nothing(arguments.shard, scene, task)?,
            is_there: false,
        };
        if let Some(target) = &arguments.checkpoint {
            let (keeper, stored) = Keeper::open(target)?;
            let new = Self { keeper: Some(keeper), ..new };
            if let Some(stored) = stored {
                return new.continued(stored, &target.path, Kind::Checkpoint).map(Some);
            }
            return new.with_part(output).map(Some);
        }
        new.with_part(output).map(Some)
    }

    /// The same with what the part that is to be written holds already.
    fn with_part(self, output: &Output) -> Result<Self, Failure> {
        let path = output.path();
        if self.header.shard.is_none() || !path.exists() {
            return Ok(self);
        }
        let storage = self.continued(Part::open(path)?.read()?, path, Kind::Part)?;
        let is_there = matches!(&storage.state, State::Plain(found) if found.is_whole());
        Ok(Self { is_there, ..storage })
    }

    /// The same with the state of a stored render, if that is the same render.
    fn continued(self, stored: Stored, path: &Path, kind: Kind) -> Result<Self, Failure> {
        let refuse = |difference: &str| {
            let (what, help) = match kind {
                Kind::Checkpoint => (
                    "checkpoint",
                    "name another checkpoint, or remove this one and its .previous to begin anew",
                ),
                Kind::Part => ("part", "name another picture, or remove this one to begin anew"),
            };
            let path = path.display();
            Failure::usage(format!(
                "{path}: the {what} is not of this render: {difference}\n  help: {help}"
            ))
        };
        if let Some(difference) = stored.header.identity.difference(&self.header.identity) {
            return Err(refuse(&difference));
        }
        let named = |shard: Option<Shard>| {
            shard.map_or("without --shard".to_owned(), |shard| format!("with --shard {shard}"))
        };
        let [then, now] = [stored.header.shard, self.header.shard].map(named);
        if then != now {
            return Err(refuse(&format!("it was made {then}, now it is {now}")));
        }
        let state = match (stored.state, self.state) {
            (State::Plain(mut found), State::Plain(asked)) => {
                let [had, wanted] =
                    [stored.header.samples_per_pixel, self.header.samples_per_pixel];
                if self.header.shard.is_some() && had != wanted || found.crop() != asked.crop() {
                    return Err(refuse(&format!(
                        "it was made with --spp {had}, now it is {wanted}"
                    )));
                }
                if asked.samples().end < found.samples().end {
                    return Err(refuse(&format!(
                        "it was made with --spp {had}, now it is {wanted}, which is less"
                    )));
                }
                found.extend_to(asked.samples().end);
                State::Plain(found)
            }
            (State::Progressive(found), State::Progressive(asked))
                if found.crop() == asked.crop() =>
            {
                State::Progressive(found)
            }
            (State::Reuse(found), State::Reuse(asked)) if found.crop() == asked.crop() => {
                State::Reuse(found)
            }
            _ => return Err(refuse("it holds another kind of render")),
        };
        let header = Header { seconds: stored.header.seconds, ..self.header };
        Ok(Self { header, state, ..self })
    }
}

/// The state of a render of which nothing has been drawn.
fn nothing(shard: Option<Shard>, scene: &Scene, task: &Task) -> Result<State, Failure> {
    let samples_per_pixel = scene.sampling.samples_per_pixel;
    match task.method {
        Method::Plain => {
            let samples = shard.map_or(0..samples_per_pixel, |s| s.samples(samples_per_pixel));
            if let Some(shard) = shard.filter(|_| samples.is_empty()) {
                return Err(Failure::usage(format!(
                    "--shard {shard} has none of the {samples_per_pixel} samples per pixel; \
                     divide them into {samples_per_pixel} parts at most"
                )));
            }
            Ok(State::Plain(Accumulation::new(scene.film.crop, samples)))
        }
        Method::Progressive { .. } if shard.is_some() => Err(Failure::usage(
            "a scene that asks for the layers variance or samples is rendered in rounds, which cannot be divided; \
             leave them or --shard out",
        )),
        Method::Progressive { goal, .. } => {
            Ok(State::Progressive(ProgressiveState::new(scene.film.crop, goal.allocation)))
        }
        Method::Reuse => Ok(State::Reuse(ReuseState::new(scene.film.crop))),
    }
}
