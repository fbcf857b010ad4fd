//! What the arguments ask for.

use std::time::Duration;

use etendue_renderer::RenderSettings;
use etendue_renderer::progressive::{Allocation, Goal};
use etendue_scene::Scene;

use super::Arguments;
use crate::failure::Failure;
use crate::output::Aov;
use crate::progress::Quiet;

/// Samples per pixel of the layers that show what is seen, at most.
const MOST_OF_FEATURES: u32 = 64;

/// The same where the samples of the picture are not limited.
const USUAL_OF_FEATURES: u32 = 16;

/// A render that is to be done.
#[derive(Clone, Debug)]
pub(super) struct Task {
    pub(super) threads: usize,
    pub(super) quiet: Quiet,
    pub(super) method: Method,
    /// The layers, each once.
    pub(super) layers: Vec<Aov>,
    /// Samples per pixel of the layers that show what is seen.
    pub(super) feature_samples: u32,
}

/// How samples are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Method {
    /// The scene's number of samples, pixel by pixel.
    Plain,
    /// The scene's number of samples in the mean, of paths that share what they find.
    Reuse,
    /// In rounds, with an estimate of the error.
    Progressive { goal: Goal, time: Option<Duration> },
}

impl Task {
    /// * `layers`: each once.
    ///
    /// # Errors
    /// An error is to be estimated from less than two samples, or where there is no estimate.
    pub(super) fn new(
        arguments: &Arguments,
        layers: Vec<Aov>,
        scene: &Scene,
    ) -> Result<Self, Failure> {
        let open_ended = arguments.error.is_some() || arguments.time.is_some();
        let halves = layers.iter().any(|aov| aov.is_of_samples());
        let of_scene = scene.sampling.samples_per_pixel;
        let limit = if open_ended { arguments.spp } else { Some(of_scene) };
        let method = if arguments.reuse {
            if halves {
                return Err(Failure::usage(
                    "--reuse leaves nothing for the layers variance and samples, which need an estimate of the error; \
                     leave it or them out",
                ));
            }
            if RenderSettings::of_scene(scene).reuses_paths(scene) {
                Method::Reuse
            } else {
                Method::Plain
            }
        } else if open_ended || halves || arguments.allocation.is_some() {
            if limit == Some(1) {
                return Err(Failure::usage(
                    "an error is estimated from two samples per pixel at least; ask for --spp 2 or more",
                ));
            }
            let usual = if open_ended { Allocation::Adaptive } else { Allocation::Uniform };
            let allocation = arguments.allocation.map_or(usual, Allocation::from);
            let goal = Goal { allocation, samples_per_pixel: limit, error: arguments.error };
            Method::Progressive { goal, time: arguments.time }
        } else {
            Method::Plain
        };
        Ok(Self {
            threads: arguments.threads.map_or(0, usize::from),
            quiet: arguments.quiet,
            method,
            layers,
            feature_samples: limit.unwrap_or(USUAL_OF_FEATURES).min(MOST_OF_FEATURES),
        })
    }
}
