//! Error against time of ways to render one scene.
//!
//! Every [`Variant`] renders pairs of pictures with independent seeds, with a growing number of samples. A pair tells noise,
//! which goes away with time, from bias, which does not ([`PairErrors`]); all pairs together say how sure that is
//! ([`Estimate`]). Pairs are rendered in an order in which all variants take turns, so that whatever slows the machine
//! slows all alike. A [`Checkpoint`] keeps every finished pair.

mod checkpoint;
mod errors;
mod estimate;
mod forms;
mod job;
mod report;
mod variant;

use core::sync::atomic::AtomicBool;
use std::time::Instant;

use etendue_math::mix_u64;
use etendue_renderer::image_metrics::SizeMismatch;
use etendue_renderer::{Image, Progress, Renderer, RendererError};
use etendue_scene::Scene;
use serde_json::{Map, Value, json};

use variant::Picture;

pub use checkpoint::{Checkpoint, CheckpointError};
pub use errors::{GROUPS, PairErrors, Reference};
pub use estimate::{Estimate, Level, Reach};
pub use forms::Form;
pub use job::Record;
pub use report::{ERRORS, report};
pub use variant::{Kind, Variant};

/// How much is rendered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Chooses all random numbers.
    pub seed: u64,
    /// Numbers of samples per pixel, growing.
    pub samples: Vec<u32>,
    /// Pairs of pictures for each of them, at least 2.
    pub pairs: u32,
    /// Samples per pixel of either of the two references, where none is given.
    pub reference_samples: u32,
    /// Threads; 0 for one per logical processor.
    pub threads: usize,
}

/// A scene, and the same with models in other forms.
pub struct Subject {
    variants: Vec<Variant>,
    base: Scene,
    forms: Vec<(Form, Scene)>,
}

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// relMSE of the rendered reference, which has been taken off; `None` for a given one.
    pub reference_error: Option<f64>,
    /// Width and height of the pictures.
    pub size: [u32; 2],
    /// Every variant.
    pub estimates: Vec<(Variant, Estimate)>,
}

/// Why an experiment ended early.
#[derive(Debug, thiserror::Error)]
pub enum ExperimentError {
    /// Threads.
    #[error(transparent)]
    Threads(#[from] RendererError),
    /// Sizes.
    #[error("the reference: {0}")]
    Size(#[from] SizeMismatch),
    /// The checkpoint.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
}

/// How an experiment is watched.
pub struct Watch<'a> {
    /// Hears of every tile; the unit is a sample per pixel.
    pub progress: &'a (dyn Fn(Progress) + Sync),
    /// Ends it early.
    pub cancel: &'a AtomicBool,
}

impl Subject {
    /// A scene that `load` gives, as often as it is asked.
    ///
    /// # Errors
    /// Those of `load`.
    pub fn new<E>(mut load: impl FnMut() -> Result<Scene, E>) -> Result<Self, E> {
        let base = load()?;
        let variants = Variant::of(&base);
        let mut forms = Vec::new();
        for form in variants.iter().filter_map(|variant| variant.form) {
            let mut scene = load()?;
            scene.materials = form.apply(&scene.materials);
            forms.push((form, scene));
        }
        Ok(Self { variants, base, forms })
    }

    /// Every variant.
    pub fn variants(&self) -> &[Variant] {
        &self.variants
    }

    fn scene(&self, variant: &Variant) -> &Scene {
        let other = self.forms.iter().find(|(form, _)| Some(*form) == variant.form);
        other.map_or(&self.base, |(_, scene)| scene)
    }
}

impl Settings {
    /// What the records of an experiment depend on, for its checkpoint. `scene` stands for the content of all files and
    /// the size of the film, `reference` for a reference that was given.
    pub fn circumstances(
        &self,
        subject: &Subject,
        scene: u64,
        reference: Option<u64>,
    ) -> Map<String, Value> {
        let variants: Vec<&str> = subject.variants.iter().map(|v| v.name.as_str()).collect();
        let reference = match reference {
            Some(hash) => json!(format!("given, {hash:016x}")),
            None => json!(format!("{} samples", self.reference_samples)),
        };
        let entry = |name: &str, value: Value| (name.to_owned(), value);
        Map::from_iter([
            entry("version", json!(env!("CARGO_PKG_VERSION"))),
            entry("scene", json!(format!("{scene:016x}"))),
            entry("size", json!(subject.base.film.crop.size)),
            entry("seed", json!(self.seed)),
            entry("samples", json!(self.samples)),
            entry("pairs", json!(self.pairs)),
            entry("threads", json!(self.threads)),
            entry("reference", reference),
            entry("variants", json!(variants)),
        ])
    }
}

/// Renders what is not in the checkpoint yet; `None` where it was cancelled.
///
/// # Errors
/// A given reference of another size, threads that cannot be started, a checkpoint that cannot be written.
pub fn run(
    subject: &Subject,
    settings: &Settings,
    given: Option<Image>,
    mut checkpoint: Option<Checkpoint>,
    watch: &Watch<'_>,
) -> Result<Option<Outcome>, ExperimentError> {
    let mut records = checkpoint.as_ref().map_or(Vec::new(), |c| c.records().to_vec());
    let is_given = given.is_some();
    let rounds = rounds(subject, settings, &records, is_given);
    let reference_cost = if is_given { 0 } else { 2 * settings.reference_samples as usize };
    let total = reference_cost + rounds.iter().map(Round::cost).sum::<usize>();
    let mut meter = Meter { finished: 0, total, threads: settings.threads, watch };

    let reference = match given {
        Some(image) => Reference::given(image),
        None => match rendered_reference(subject, settings, checkpoint.as_ref(), &mut meter)? {
            Some(halves) => Reference::halves(halves)?,
            None => return Ok(None),
        },
    };
    for Round { pair, samples, variants } in rounds {
        // Of the first variant, from which the reference is drawn: what the others leave out of it.
        let mut full: Option<[Image; 2]> = None;
        for (variant, is_done) in variants {
            let mut render = |side: u32| {
                let seed = seed(settings.seed, samples, 2 * pair + side);
                meter.render(subject.scene(variant), variant, samples, seed)
            };
            let (Some((a, seconds_a)), Some((b, seconds_b))) = (render(0)?, render(1)?) else {
                return Ok(None);
            };
            if !is_done {
                let errors = match &full {
                    Some(full) if variant.kind == Kind::Approximation => {
                        reference.compare_with([&a, &b], full)?
                    }
                    _ => reference.compare(&a, &b)?,
                };
                let record = Record {
                    variant: variant.name.clone(),
                    samples_per_pixel: samples,
                    pair,
                    seconds: [seconds_a, seconds_b],
                    errors,
                };
                records.push(record.clone());
                if let Some(checkpoint) = &mut checkpoint {
                    checkpoint.push(record)?;
                }
            }
            if !is_given && *variant == subject.variants[0] {
                full = Some([a, b]);
            }
        }
    }
    let estimates = subject.variants.iter().filter_map(|variant| {
        let own = records.iter().filter(|record| record.variant == variant.name);
        Some((variant.clone(), Estimate::of(own)?))
    });
    Ok(Some(Outcome {
        reference_error: (!is_given).then(|| reference.own_error()),
        size: reference.size(),
        estimates: estimates.collect(),
    }))
}

/// Pictures with the same seeds: variants take turns, the first one first.
struct Round<'a> {
    pair: u32,
    samples: u32,
    /// What is to be rendered, and whether its record is there already.
    variants: Vec<(&'a Variant, bool)>,
}

impl Round<'_> {
    /// Samples per pixel in all.
    fn cost(&self) -> usize {
        2 * self.samples as usize * self.variants.len()
    }
}

/// What is left to do. The first variant is rendered again where others are compared with it.
fn rounds<'a>(
    subject: &'a Subject,
    settings: &Settings,
    done: &[Record],
    reference_is_given: bool,
) -> Vec<Round<'a>> {
    let mut rounds = Vec::new();
    for pair in 0..settings.pairs {
        for &samples in &settings.samples {
            let is_done = |variant: &Variant| {
                done.iter().any(|record| {
                    (record.pair, record.samples_per_pixel) == (pair, samples)
                        && record.variant == variant.name
                })
            };
            let compared = |variant: &Variant| {
                !reference_is_given && variant.kind == Kind::Approximation && !is_done(variant)
            };
            let first_is_needed = subject.variants.iter().any(compared);
            let variants: Vec<(&Variant, bool)> = subject
                .variants
                .iter()
                .enumerate()
                .map(|(i, variant)| (i, variant, is_done(variant)))
                .filter(|(i, _, is_done)| !is_done || (*i == 0 && first_is_needed))
                .map(|(_, variant, is_done)| (variant, is_done))
                .collect();
            rounds.push(Round { pair, samples, variants });
        }
    }
    rounds
}

/// Different for every number of samples, so that levels are independent; 0 samples stand for the references.
fn seed(seed: u64, samples: u32, picture: u32) -> u64 {
    mix_u64(mix_u64(seed, u64::from(samples)), u64::from(picture))
}

/// The two references: kept ones, or new ones, which are kept. `None` where it was cancelled.
fn rendered_reference(
    subject: &Subject,
    settings: &Settings,
    checkpoint: Option<&Checkpoint>,
    meter: &mut Meter<'_>,
) -> Result<Option<[Image; 2]>, ExperimentError> {
    let variant = &subject.variants[0];
    let mut halves = Vec::new();
    for number in 0..2 {
        let kept = checkpoint.map(|c| c.reference(number)).transpose()?.flatten();
        let image = if let Some(image) = kept {
            meter.finished += settings.reference_samples as usize;
            image
        } else {
            let seed = seed(settings.seed, 0, number as u32);
            let scene = subject.scene(variant);
            let Some((image, _)) =
                meter.render(scene, variant, settings.reference_samples, seed)?
            else {
                return Ok(None);
            };
            if let Some(checkpoint) = checkpoint {
                checkpoint.keep_reference(number, &image)?;
            }
            image
        };
        halves.push(image);
    }
    Ok(<[Image; 2]>::try_from(halves).ok())
}

/// Renders and reports how far the whole is.
struct Meter<'a> {
    finished: usize,
    total: usize,
    threads: usize,
    watch: &'a Watch<'a>,
}

impl Meter<'_> {
    /// A picture and how many seconds it took, preparations apart; `None` where it was cancelled.
    fn render(
        &mut self,
        scene: &Scene,
        variant: &Variant,
        samples_per_pixel: u32,
        seed: u64,
    ) -> Result<Option<(Image, f64)>, RendererError> {
        let picture = Picture { samples_per_pixel, seed, threads: self.threads };
        let renderer = Renderer::new(scene, variant.settings(scene, picture))?;
        let (finished, total, cost) = (self.finished, self.total, samples_per_pixel as usize);
        let report = |part: Progress| {
            let finished = finished + cost * part.finished / part.total;
            (self.watch.progress)(Progress { finished, total });
        };
        let start = Instant::now();
        let rendering = renderer.render(&report, self.watch.cancel);
        let seconds = start.elapsed().as_secs_f64();
        self.finished += cost;
        let Progress { finished, total } = rendering.progress;
        Ok((finished == total).then_some((rendering.image, seconds)))
    }
}

#[cfg(test)]
mod tests;
