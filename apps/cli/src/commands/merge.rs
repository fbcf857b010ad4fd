//! `etendue merge`: from the parts of a render to its picture.

use core::ops::Range;
use std::path::PathBuf;

use etendue_renderer::Accumulation;

use super::encoding_arguments::EncodingArguments;
use crate::checkpoint::{Header, Part, Shard, State};
use crate::failure::{Exit, Failure};
use crate::output::{Metadata, Output, of_bad_samples};
use crate::progress::{ProgressDisplay, Quiet, Standing};

/// Joins the parts that `etendue render --shard` drew, in any order, to the picture of a render in one go, bit by bit.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The parts: all of one render, each once.
    #[arg(required = true, value_name = "PART")]
    parts: Vec<PathBuf>,
    /// The picture to write; its extension chooses the format: exr, hdr, pfm (linear), png (sRGB).
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    encoding: EncodingArguments,
    #[command(flatten)]
    quiet: Quiet,
}

impl Part {
    fn refuse(&self, message: &str) -> Failure {
        Failure::usage(format!("{}: {message}", self.path().display()))
    }

    /// The samples that it is to hold.
    fn samples(&self) -> Range<u32> {
        let all = self.header.samples_per_pixel;
        self.header.shard.map_or(0..all, |shard| shard.samples(all))
    }

    /// That it is whole, and of the same render as another.
    fn check(&self, first: &Self) -> Result<(), Failure> {
        if self.samples().is_empty() {
            return Err(self.refuse("the part has no samples"));
        }
        if !self.header.whole {
            return Err(self.refuse("the part is not whole; the command that drew it finishes it"));
        }
        let [then, now] = [self, first].map(|part| part.header.samples_per_pixel);
        let difference = match self.header.identity.difference(&first.header.identity) {
            None if then != now => Some(format!("it was made with --spp {then}, now it is {now}")),
            difference => difference,
        };
        difference.map_or(Ok(()), |difference| {
            let first = first.path().display();
            Err(self
                .refuse(&format!("the part is not of the same render as {first}: {difference}")))
        })
    }

    /// Adds its sums to those of all parts before it.
    fn join(&self, before: Option<Accumulation>) -> Result<Accumulation, Failure> {
        let sums = match self.read()?.state {
            State::Plain(sums) if sums.is_whole() && sums.samples() == self.samples() => sums,
            _ => return Err(self.refuse("the part is not what it says of itself")),
        };
        match before {
            Some(before) => {
                before.joined(sums).ok_or_else(|| self.refuse("the part is of another crop"))
            }
            None => Ok(sums),
        }
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let output = Output::check(&arguments.output)?;
    // Everything that can be known from their headers is tested before any of them is read.
    let mut parts =
        arguments.parts.iter().map(|path| Part::open(path)).collect::<Result<Vec<_>, _>>()?;
    if let [first, ..] = &parts[..] {
        parts.iter().try_for_each(|part| part.check(first))?;
    }
    parts.sort_by_key(|part| part.samples().start);
    check_ranges(&parts)?;
    let header = parts[0].header.clone();
    let seconds = parts.iter().map(|part| part.header.seconds).sum();
    let display = ProgressDisplay::new("merging", arguments.quiet);
    let mut sums = None;
    for (index, part) in parts.iter().enumerate() {
        sums = Some(part.join(sums)?);
        display.update(Standing::parts(index + 1, parts.len()));
    }
    display.finish();
    let Some(sums) = sums else { return Err(Failure::usage("there are no parts")) };
    let metadata = Metadata {
        scene: header.scene.clone(),
        samples_per_pixel: f64::from(header.samples_per_pixel),
        seed: header.identity.setting("--seed").and_then(|seed| seed.parse().ok()).unwrap_or(0),
        seconds,
        statistics: sums.statistics(),
        sources: Vec::new(),
        configuration: header.configuration.clone(),
        error: None,
        part: None,
    };
    let encoding = arguments.encoding.encoding();
    let layers = of_bad_samples(&metadata.statistics, &sums.crop());
    output.write_or_rescue(&sums.image(), &layers, encoding, &metadata, None)?;
    if !arguments.quiet.quiet {
        eprintln!(
            "etendue: {} of {} parts, {} samples, {} rays",
            output.path().display(),
            arguments.parts.len(),
            metadata.statistics.samples,
            metadata.statistics.rays.total()
        );
    }
    Ok(Exit::Done)
}

/// That the ranges of parts in order cover all samples once.
fn check_ranges(parts: &[Part]) -> Result<(), Failure> {
    for pair in parts.windows(2) {
        let [a, b] = [&pair[0], &pair[1]].map(Part::samples);
        if b.start < a.end {
            let both = named(&(b.start..a.end.min(b.end)));
            return Err(pair[1].refuse(&format!(
                "the part overlaps with {}: both hold the samples {both}",
                pair[0].path().display()
            )));
        }
    }
    let Some(Header { samples_per_pixel, shard, .. }) = parts.first().map(|part| &part.header)
    else {
        return Ok(());
    };
    let mut missing = Vec::new();
    let mut end = 0;
    let ranges = parts.iter().map(Part::samples);
    let behind_all = core::iter::once(*samples_per_pixel..*samples_per_pixel);
    for range in ranges.chain(behind_all) {
        if end < range.start {
            missing.push(missing_parts(&(end..range.start), *samples_per_pixel, *shard));
        }
        end = range.end;
    }
    if missing.is_empty() {
        return Ok(());
    }
    Err(Failure::usage(format!("parts of the render are missing: {}", missing.join(", "))))
}

/// Most parts of a division that are looked for by name.
const MOST_PARTS: u32 = 1 << 16;

/// Most parts that are named.
const MOST_NAMED: usize = 16;

/// What a range of samples is called: by the parts that make it up where the division is known, by its numbers otherwise.
fn missing_parts(range: &Range<u32>, samples_per_pixel: u32, shard: Option<Shard>) -> String {
    let count = shard.map_or(1, |shard| shard.count.min(MOST_PARTS));
    let shards: Vec<Shard> = (1..=count)
        .map(|index| Shard { index, count })
        .filter(|shard| {
            let part = shard.samples(samples_per_pixel);
            !part.is_empty() && range.start <= part.start && part.end <= range.end
        })
        .collect();
    let covered = shards.first().map(|s| s.samples(samples_per_pixel).start) == Some(range.start)
        && shards.last().map(|s| s.samples(samples_per_pixel).end) == Some(range.end);
    if !covered || shard.is_some_and(|shard| shard.count > count) {
        return format!("the samples {}", named(range));
    }
    let names: Vec<String> =
        shards.iter().take(MOST_NAMED).map(|shard| format!("--shard {shard}")).collect();
    let more = match shards.len().checked_sub(MOST_NAMED) {
        None | Some(0) => String::new(),
        Some(more) => format!(" and {more} more"),
    };
    names.join(", ") + &more
}

fn named(range: &Range<u32>) -> String {
    format!("{} to {}", range.start, range.end - 1)
}
