//! Error against time, as tables and charts.

use etendue_report::{Axis, Cell, Chart, Guide, Point, Report, Section, Series, Style, Table};

use super::{Estimate, Kind, Outcome, Reach, Settings, Variant};

/// The relMSE that times are given for.
pub const ERRORS: [f64; 3] = [0.1, 0.01, 0.001];

/// A report of an experiment; `facts` come first.
pub fn report(outcome: &Outcome, settings: &Settings, facts: Vec<(String, String)>) -> Report {
    Report {
        title: "Error against time".to_owned(),
        facts: facts.into_iter().chain(own_facts(outcome, settings)).collect(),
        introduction: vec![introduction(outcome)],
        sections: vec![times(outcome), bias(outcome), levels(outcome)],
    }
}

fn own_facts(outcome: &Outcome, settings: &Settings) -> Vec<(String, String)> {
    let fact = |name: &str, value: String| (name.to_owned(), value);
    let [width, height] = outcome.size;
    let reference = match outcome.reference_error {
        None => "given".to_owned(),
        Some(error) => {
            format!("two of {} samples per pixel, relMSE {error:.1e}", settings.reference_samples)
        }
    };
    let threads = match settings.threads {
        0 => "all".to_owned(),
        n => n.to_string(),
    };
    vec![
        fact("size", format!("{width}×{height}")),
        fact("seed", settings.seed.to_string()),
        fact("pairs of pictures", settings.pairs.to_string()),
        fact("reference", reference),
        fact("threads", threads),
    ]
}

fn introduction(outcome: &Outcome) -> String {
    let (compared, reference) = if outcome.reference_error.is_some() {
        (
            "What leaves something out is compared with pictures of the first variant with the same seeds instead. ",
            "The reference is rendered as the first variant is, twice: its own noise is in no figure, and what that variant \
             leaves out itself is not seen.",
        )
    } else {
        ("", "The reference was given: its noise counts as bias of every variant.")
    };
    format!(
        "relMSE, `mean((x − r)² / (r² + 0.01))`, is the sum of noise, which time pays back, and of squared bias, which it \
         does not. Pictures come in pairs with independent seeds: half the squared difference of the two is noise, the product \
         of their differences from the reference is bias. {compared}A bias counts where it is more than four standard errors; it is then \
         the floor of a variant. {reference} Seconds are the median over the pictures, preparations apart."
    )
}

/// When each variant reaches given errors.
fn times(outcome: &Outcome) -> Section {
    let mut table = Table::new([
        ("variant", "variant".to_owned()),
        ("seconds_1e-1", format!("seconds to {}", ERRORS[0])),
        ("how_1e-1", "how".to_owned()),
        ("seconds_1e-2", format!("seconds to {}", ERRORS[1])),
        ("how_1e-2", "how".to_owned()),
        ("seconds_1e-3", format!("seconds to {}", ERRORS[2])),
        ("how_1e-3", "how".to_owned()),
    ]);
    for (variant, estimate) in &outcome.estimates {
        let mut cells = vec![Cell::text(&variant.name)];
        for error in ERRORS {
            let (seconds, how) = match estimate.time_to(error) {
                Reach::Interpolated(t) => (Cell::number(t), ""),
                Reach::AtMost(t) => (Cell::number(t), "at most"),
                Reach::Extrapolated(t) => (Cell::number(t), "extrapolated"),
                Reach::Never => (Cell::Missing, "never"),
            };
            cells.extend([seconds, Cell::text(how)]);
        }
        table.push(cells);
    }
    Section {
        name: "times".to_owned(),
        heading: "Time to a given relMSE".to_owned(),
        prose: vec![
            "Interpolated between levels over logarithmic axes; extrapolated with noise that falls as 1/time beyond the last \
             level; at most the time of the first level where that is good enough; never where the bias is larger."
                .to_owned(),
        ],
        table,
        charts: vec![
            chart(outcome, "Ways to find light", |variant| variant.kind == Kind::Strategy),
            chart(outcome, "What is left out", |variant| {
                variant.kind == Kind::Approximation || Some(variant) == first(outcome)
            }),
        ],
        advice: Vec::new(),
    }
}

fn first(outcome: &Outcome) -> Option<&Variant> {
    outcome.estimates.first().map(|(variant, _)| variant)
}

fn bias(outcome: &Outcome) -> Section {
    let mut table = Table::new([
        ("variant", "variant"),
        ("squared_bias", "squared bias"),
        ("standard_error", "± standard error"),
        ("biased", "biased"),
        ("floor", "floor of relMSE"),
    ]);
    for (variant, estimate) in &outcome.estimates {
        let [bias, error] = estimate.bias;
        let floor = estimate.floor();
        table.push([
            Cell::text(&variant.name),
            Cell::Number { value: bias, digits: 2 },
            Cell::Number { value: error, digits: 2 },
            Cell::Flag(floor > 0.0),
            if floor > 0.0 { Cell::number(floor) } else { Cell::Missing },
        ]);
    }
    Section {
        name: "bias".to_owned(),
        heading: "What time does not pay back".to_owned(),
        prose: vec![
            "Squared bias of all levels together; an estimate, which is negative by chance where there is none.".to_owned(),
        ],
        table,
        ..Section::default()
    }
}

fn levels(outcome: &Outcome) -> Section {
    let mut table = Table::new([
        ("variant", "variant"),
        ("samples_per_pixel", "samples per pixel"),
        ("seconds", "seconds"),
        ("relative_mse", "relMSE"),
        ("noise", "noise"),
        ("squared_bias", "squared bias"),
        ("bias_standard_error", "±"),
        ("flip", "ꟻLIP"),
    ]);
    for (variant, estimate) in &outcome.estimates {
        let floor = estimate.floor();
        for level in &estimate.levels {
            table.push([
                Cell::text(&variant.name),
                count(level.samples_per_pixel),
                Cell::number(level.seconds),
                Cell::number(level.noise + floor),
                Cell::number(level.noise),
                Cell::Number { value: level.bias[0], digits: 2 },
                Cell::Number { value: level.bias[1], digits: 2 },
                Cell::number(level.flip),
            ]);
        }
    }
    Section {
        name: "levels".to_owned(),
        heading: "Every level".to_owned(),
        prose: vec!["relMSE is noise and the floor of the variant; squared bias is that of the level alone. ꟻLIP is the mean of HDR-ꟻLIP \
             over the pixels, against the mean of the references: from 0, no difference seen, to 1."
                .to_owned()],
        table,
        charts: vec![flip_chart(outcome)],
        ..Section::default()
    }
}

/// A number of which all digits count.
fn count(n: u32) -> Cell {
    Cell::Number { value: n.into(), digits: n.max(1).ilog10() as usize + 1 }
}

/// relMSE against seconds of the variants that are wanted, with their floors and what 1/time means.
fn chart(outcome: &Outcome, title: &str, wanted: impl Fn(&Variant) -> bool) -> Chart {
    let chosen: Vec<&(Variant, Estimate)> =
        outcome.estimates.iter().filter(|(variant, _)| wanted(variant)).collect();
    let series = chosen.iter().map(|(variant, estimate)| line(variant, estimate.errors()));
    let floors = chosen.iter().filter(|(_, estimate)| estimate.floor() > 0.0);
    let mut guides: Vec<Guide> = floors
        .map(|(variant, estimate)| Guide::Level {
            y: estimate.floor(),
            label: variant.name.clone(),
        })
        .collect();
    // Through the first point of the first variant.
    let start = chosen.first().and_then(|(_, estimate)| estimate.errors().first().copied());
    guides.extend(start.map(|through| Guide::Power {
        exponent: -1.0,
        through,
        label: "1/time".to_owned(),
    }));
    Chart {
        title: title.to_owned(),
        x: Axis::log("seconds"),
        y: Axis::log("relMSE"),
        series: series.collect(),
        guides,
    }
}

/// FLIP against seconds of ways to find light.
fn flip_chart(outcome: &Outcome) -> Chart {
    let chosen = outcome.estimates.iter().filter(|(variant, _)| variant.kind == Kind::Strategy);
    let series = chosen.map(|(variant, estimate)| {
        line(variant, estimate.levels.iter().map(|level| [level.seconds, level.flip]).collect())
    });
    Chart {
        title: "Ways to find light: ꟻLIP".to_owned(),
        x: Axis::log("seconds"),
        y: Axis::log("mean HDR-ꟻLIP"),
        series: series.collect(),
        guides: Vec::new(),
    }
}

fn line(variant: &Variant, points: Vec<[f64; 2]>) -> Series {
    let points = points.into_iter().map(|at| Point { at, ..Point::default() });
    Series { name: variant.name.clone(), style: Style::Line, points: points.collect() }
}
