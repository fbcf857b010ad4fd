//! What the samplers came to, as tables and charts.

use etendue_report::{Axis, Cell, Chart, Guide, Point, Report, Section, Series, Style, Table};

use super::contest::{Contest, EXACT};
use super::{LIGHT_DEGREES, Lighting, Measurement, PointSet, Settings, VIEW_AZIMUTH, VIEW_COSINES};

/// A report of a measurement; `facts` come first.
pub fn report(
    measurement: &Measurement,
    settings: &Settings,
    facts: Vec<(String, String)>,
) -> Report {
    let lightings = (0..Lighting::ALL.len()).map(|lighting| section(measurement, lighting));
    Report {
        title: "Sampling of reflection models".to_owned(),
        facts: facts.into_iter().chain(own_facts(measurement, settings)).collect(),
        introduction: introduction(settings),
        sections: core::iter::once(digest(measurement)).chain(lightings).collect(),
    }
}

fn own_facts(measurement: &Measurement, settings: &Settings) -> Vec<(String, String)> {
    let [independent, sobol] = measurement.point_nanoseconds;
    let fact = |name: &str, value: String| (name.to_owned(), value);
    vec![
        fact("seed", settings.seed.to_string()),
        fact("points of a replication (N)", settings.points.to_string()),
        fact("replications", settings.replications.to_string()),
        fact("time of a point", format!("{independent:.1} ns independent, {sobol:.1} ns Sobol'")),
    ]
}

fn introduction(settings: &Settings) -> Vec<String> {
    let cosines = VIEW_COSINES.map(|c| c.to_string()).join(", ");
    let n = settings.points;
    vec![
        format!(
            "The noise of `f L |cos θi| / pdf` for one direction drawn per sample, computed in `f32`, seen at the cosines \
             {cosines} (azimuth {VIEW_AZIMUTH}°) with the parameters of the specimens. Variance is relative: the sum \
             over the directions of view of the variance, divided by that of the squared mean. For independent points it \
             is that of one sample; for Sobol' points it is N times the variance of the mean of N = {n} points over their \
             scrambles, so that the two are equal where structure is worth nothing. ± is the standard error of a variance, \
             in per cent of it: where it is large, tails are long and the variance is rather larger than what was seen."
        ),
        "Time is that of drawing and weighing a direction, the point given; the time of the point is added for the \
         efficiency 1/(variance · time), which is relative to the best of its model (●) under the same light. A model's \
         own sampler knows its weight in closed form, others evaluate the model and divide by their density. Only the \
         continuous part of a model counts: what its own sampler draws from a delta lobe is worth 0. Facet normals are \
         tried on models that reflect from facets and do not transmit. *exact*: no noise but rounding; the others of \
         its model are then compared among themselves."
            .to_owned(),
    ]
}

fn prose(lighting: Lighting) -> String {
    match lighting {
        Lighting::Furnace => {
            "Light of radiance 1 from everywhere: what is missing is the shape of the model."
                .to_owned()
        }
        Lighting::MirrorLight => format!(
            "A light whose radiance falls to 1/e at {LIGHT_DEGREES}° from the mirror direction of the view: the lobe is found \
             by whoever follows it."
        ),
        Lighting::SideLight => "The same light, 45° above the surface and at a right angle to the plane of view and normal: what every way \
             of sampling a model finds by chance only, and light sampling is for.".to_owned(),
    }
}

/// What each model's own sampler is worth.
fn digest(measurement: &Measurement) -> Section {
    let mut table = Table::new([
        ("model", "model"),
        ("furnace", "furnace"),
        ("furnace_best", "best"),
        ("mirror_light", "light in mirror direction"),
        ("mirror_light_best", "best"),
        ("side_light", "light aside"),
        ("side_light_best", "best"),
    ]);
    let lightings: Vec<Vec<Contest<'_>>> =
        (0..Lighting::ALL.len()).map(|lighting| Contest::all(measurement, lighting)).collect();
    for model in 0..lightings[0].len() {
        let mut cells = Vec::new();
        for contest in lightings.iter().map(|contests| contests[model]) {
            let own = &contest.outcomes[0];
            if cells.is_empty() {
                cells.push(Cell::text(own.model));
            }
            let best: Vec<&str> = contest
                .outcomes
                .iter()
                .filter(|outcome| contest.is_best(outcome))
                .map(|outcome| outcome.strategy)
                .collect();
            cells.push(share(contest.best_share(own)));
            cells.push(Cell::text(best.join(" = ")));
        }
        table.push(cells);
    }
    Section {
        name: "own".to_owned(),
        heading: "What the models' own samplers are worth".to_owned(),
        prose: vec![
            "Efficiency of the model's own sampler as a share of that of the best, either with the better kind of points."
                .to_owned(),
        ],
        table,
        ..Section::default()
    }
}

fn share(efficiency: Option<f64>) -> Cell {
    efficiency.map_or(Cell::text("exact"), Cell::number)
}

fn section(measurement: &Measurement, lighting: usize) -> Section {
    let name = Lighting::ALL[lighting];
    let mut table = Table::new([
        ("model", "model"),
        ("strategy", "strategy"),
        ("nanoseconds", "ns"),
        ("mean", "mean"),
        ("variance_independent", "variance, independent"),
        ("uncertainty_independent", "± %"),
        ("variance_sobol", "variance, Sobol'"),
        ("uncertainty_sobol", "± %"),
        ("efficiency_independent", "efficiency, independent"),
        ("efficiency_sobol", "efficiency, Sobol'"),
        ("best", "best"),
    ]);
    let contests = Contest::all(measurement, lighting);
    for contest in &contests {
        for outcome in contest.outcomes {
            let independent = contest.variance(outcome, PointSet::Independent);
            let mut cells = vec![
                Cell::text(outcome.model),
                Cell::text(outcome.strategy),
                Cell::number(outcome.timing.nanoseconds),
                Cell::number(mean(&independent.means)),
            ];
            for set in PointSet::ALL {
                let variance = contest.variance(outcome, set);
                let uncertainty = Cell::Number { value: 100.0 * variance.uncertainty, digits: 2 };
                let is_exact = variance.relative < EXACT;
                cells.push(Cell::number(variance.relative));
                cells.push(if is_exact { Cell::Missing } else { uncertainty });
            }
            cells.extend(PointSet::ALL.map(|set| share(contest.relative_efficiency(outcome, set))));
            cells.push(Cell::Flag(contest.is_best(outcome)));
            table.push(cells);
        }
    }
    Section {
        name: name.name().to_owned(),
        heading: name.heading().to_owned(),
        prose: vec![prose(name)],
        table,
        charts: vec![chart(&contests, name)],
        advice: Vec::new(),
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Variance against time with independent points, a series for each strategy.
fn chart(contests: &[Contest<'_>], lighting: Lighting) -> Chart {
    let mut series: Vec<Series> = Vec::new();
    for contest in contests {
        for outcome in contest.outcomes {
            let variance = contest.variance(outcome, PointSet::Independent).relative;
            if variance < EXACT {
                continue;
            }
            let point = Point {
                at: [contest.nanoseconds(outcome, PointSet::Independent), variance],
                label: outcome.model.to_owned(),
                filled: contest.is_best(outcome),
            };
            match series.iter_mut().find(|s| s.name == outcome.strategy) {
                Some(series) => series.points.push(point),
                None => series.push(Series {
                    name: outcome.strategy.to_owned(),
                    style: Style::Markers,
                    points: vec![point],
                }),
            }
        }
    }
    let points: Vec<_> = series.iter().flat_map(|s| s.points.iter().map(|p| p.at)).collect();
    Chart {
        title: format!("{}: variance against time, independent points", lighting.heading()),
        x: Axis::log("nanoseconds per sample, point included"),
        y: Axis::log("relative variance of a sample"),
        series,
        guides: guides(&points),
    }
}

/// Lines of equal efficiency a factor of 10 apart, one of them through the middle of the points.
fn guides(points: &[[f64; 2]]) -> Vec<Guide> {
    let median = |axis: usize| {
        let mut values: Vec<f64> = points.iter().map(|p| p[axis]).collect();
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied()
    };
    let (Some(time), Some(variance)) = (median(0), median(1)) else { return Vec::new() };
    let line = |factor: f64, label: &str| Guide::Power {
        exponent: -1.0,
        through: [time, variance * factor],
        label: label.to_owned(),
    };
    vec![line(10.0, "a tenth"), line(1.0, "equal efficiency"), line(0.1, "ten times")]
}
