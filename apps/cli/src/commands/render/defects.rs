//! Samples that are no light, and light that is cut: how much there is of them, and where it comes from.

use core::fmt;

use etendue_math::mix_u64;
use etendue_renderer::{BadSamples, Renderer, SampleAddress, Statistics};
use etendue_scene::{Origins, Scene};
use serde_json::{Value, json};

use super::replay::{Told, material, settings};
use crate::output::Metadata;

/// What is wrong with the samples of a render.
#[derive(Debug)]
pub(super) struct Defects<'a> {
    pub(super) non_finite: Defect<'a>,
    pub(super) negative: Defect<'a>,
    /// Where paths end that have the largest number of edges, by what they carry.
    pub(super) cut: Shares,
}

/// Samples that have one defect.
#[derive(Debug)]
pub(super) struct Defect<'a> {
    pub(super) samples: &'a BadSamples,
    /// In reading order, all of few or some of many, with the material or light that each one comes from, if that is known.
    some: Vec<(SampleAddress, Option<String>)>,
}

/// Shares of one where things come from, the largest first.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Shares(Vec<(String, f64)>);

/// Samples that are computed again to see where paths are cut.
const LOOKED_AT: u64 = 512;

/// The share of the camera's throughput that may be cut without a word on where.
const LITTLE: f64 = 1e-3;

impl<'a> Defects<'a> {
    /// Computes samples again, one by one, of which only the outcome is known.
    ///
    /// * `shared`: the paths of the render have shared what they found; those of samples by themselves are others.
    pub(super) fn of(
        statistics: &'a Statistics,
        scene: &Scene,
        origins: &Origins,
        shared: bool,
    ) -> Self {
        let much_is_cut = statistics.rays.cut_share(statistics.samples) > LITTLE;
        let bad = statistics.non_finite.count() + statistics.negative.count();
        let needed = much_is_cut || bad > 0;
        let renderer = needed.then(|| Renderer::new(scene, settings(scene)).ok()).flatten();
        let told = |address: &SampleAddress| {
            let renderer = renderer.as_ref().filter(|_| !shared)?;
            let replay = renderer.replay([address.column, address.row], address.sample);
            Some(Told { scene, origins, replay })
        };
        let defect = |samples: &'a BadSamples, step: &dyn Fn(&Told<'_>) -> Option<usize>| {
            let source = |address: &SampleAddress| {
                told(address).and_then(|told| Some(told.source(step(&told)?)))
            };
            let some = samples.some().into_iter().map(|address| (address, source(&address)));
            Defect { samples, some: some.collect() }
        };
        let cut = renderer.as_ref().filter(|_| much_is_cut).map(|renderer| {
            let found = addresses(scene).filter_map(|(pixel, sample)| {
                let cut = renderer.cut(pixel, sample)?;
                let surface = cut.surface.map(|point| point.shape.0);
                Some((material(scene, origins, surface?), cut.throughput))
            });
            Shares::new(found)
        });
        Self {
            non_finite: defect(&statistics.non_finite, &|told| told.replay.first_not_finite()),
            negative: defect(&statistics.negative, &|told| told.replay.first_negative()),
            cut: cut.unwrap_or_default(),
        }
    }
}

/// Pixels and samples of a picture that are spread evenly by chance, always the same.
fn addresses(scene: &Scene) -> impl Iterator<Item = ([u32; 2], u64)> {
    let (crop, samples) = (scene.film.crop, scene.sampling.samples_per_pixel);
    (0..LOOKED_AT).map(move |i| {
        let number = |which: u64, below: u32| mix_u64(i, which) % u64::from(below.max(1));
        let place = |axis: usize| crop.offset[axis] + number(axis as u64, crop.size[axis]) as u32;
        ([0, 1].map(place), number(2, samples))
    })
}

impl Defect<'_> {
    /// The first that are known, and where each comes from.
    pub(super) fn named(&self) -> &[(SampleAddress, Option<String>)] {
        &self.some[..self.some.len().min(Metadata::NAMED)]
    }

    /// Where all of them come from; where there are too many, by those that are known.
    pub(super) fn shares(&self) -> Shares {
        let known = self.some.iter().filter_map(|(_, source)| source.clone());
        Shares::new(known.map(|source| (source, 1.0)))
    }

    /// The warning, a line each: what they are, the first of them, and what they come from.
    pub(super) fn warn(&self, what: &str, seed: u64) {
        let count = self.samples.count();
        if count == 0 {
            return;
        }
        let (pixels, known) = (self.samples.pixels().count(), self.some.len());
        eprintln!("etendue: warning: {count} samples of {pixels} pixels {what}; with seed {seed}:");
        for (SampleAddress { column, row, sample }, source) in self.named() {
            let from = source.as_ref().map_or(String::new(), |source| format!(", from {source}"));
            eprintln!("etendue:   column {column}, row {row}, sample {sample}{from}");
        }
        let shares = self.shares();
        if known > Metadata::NAMED && !shares.is_empty() {
            let all = if known as u64 == count { "all of them" } else { "those looked at" };
            eprintln!("etendue:   and more; of {all} {shares}");
        }
        eprintln!(
            "etendue: the same command with --replay COLUMN,ROW,SAMPLE instead of -o shows the path of one"
        );
    }

    pub(super) fn json(&self) -> Value {
        let named = self.named().iter().map(|(address, source)| {
            json!({
                "column": address.column,
                "row": address.row,
                "sample": address.sample,
                "from": source,
            })
        });
        named.collect()
    }
}

impl Shares {
    fn new(found: impl Iterator<Item = (String, f64)>) -> Self {
        let mut weights = std::collections::BTreeMap::<String, f64>::new();
        for (source, weight) in found {
            *weights.entry(source).or_default() += weight;
        }
        let all: f64 = weights.values().sum();
        let mut shares: Vec<_> =
            weights.into_iter().map(|(source, weight)| (source, weight / all)).collect();
        shares.sort_by(|(_, a), (_, b)| b.total_cmp(a));
        Self(shares)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn json(&self) -> Value {
        let share = |(from, share): &(String, f64)| json!({ "from": from, "share": share });
        self.0.iter().map(share).collect()
    }
}

/// Sources that are named in a line.
const MOST_NAMED: usize = 3;

impl fmt::Display for Shares {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, (source, share)) in self.0.iter().take(MOST_NAMED).enumerate() {
            let comma = if i > 0 { ", " } else { "" };
            write!(f, "{comma}{:.0} % from {source}", 100.0 * share)?;
        }
        match self.0.len().checked_sub(MOST_NAMED) {
            None | Some(0) => Ok(()),
            Some(more) => write!(f, ", and from {more} others"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_add_up_to_one_and_the_largest_comes_first() {
        let found = [("b", 1.0), ("a", 1.0), ("c", 4.0), ("b", 2.0), ("d", 0.0)];
        let shares = Shares::new(found.into_iter().map(|(name, x)| (name.to_owned(), x)));
        let expected = [("c", 0.5), ("b", 0.375), ("a", 0.125), ("d", 0.0)];
        assert_eq!(shares.0, expected.map(|(name, share)| (name.to_owned(), share)));
        assert_eq!(shares.to_string(), "50 % from c, 38 % from b, 12 % from a, and from 1 others");
        assert!(Shares::new(core::iter::empty()).is_empty());
    }
}
