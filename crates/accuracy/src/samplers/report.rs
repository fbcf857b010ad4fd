//! What the samplers came to, as tables and charts.

use etendue_report::{Axis, Cell, Chart, Guide, Point, Report, Section, Series, Style, Table};

use super::{
    LIGHT_DEGREES, Lighting, Measurement, Outcome, PointSet, Settings, VIEW_AZIMUTH, VIEW_COSINES,
};

/// Relative variances below this are the rounding of `f32`: a few hundred ulp of standard deviation.
const EXACT: f64 = 1e-10;

/// A report of a measurement; `facts` come first.
pub fn report(
    measurement: &Measurement,
    settings: &Settings,
    facts: Vec<(String, String)>,
) -> Report {
    let sections = (0..Lighting::ALL.len()).map(|lighting| section(measurement, lighting));
    Report {
        title: "Sampling of reflection models".to_owned(),
        facts: facts.into_iter().chain(own_facts(measurement, settings)).collect(),
        introduction: introduction(settings),
        sections: sections.collect(),
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
    let mut charted = Vec::new();
    for outcomes in measurement.outcomes.chunk_by(|a, b| a.model == b.model) {
        let efficiency = |outcome: &Outcome, set: PointSet| {
            let [points, seconds] =
                [measurement.point_nanoseconds[set as usize], outcome.timing.nanoseconds];
            1.0 / (outcome.variances[set as usize][lighting].relative * (points + seconds))
        };
        let exact = |outcome: &Outcome, set: PointSet| {
            outcome.variances[set as usize][lighting].relative < EXACT
        };
        let contested = outcomes.iter().flat_map(|o| PointSet::ALL.map(|set| (o, set)));
        let best = contested
            .filter(|(o, set)| !exact(o, *set))
            .map(|(o, set)| efficiency(o, set))
            .filter(|e| e.is_finite())
            .fold(0.0, f64::max);
        let any_exact = outcomes.iter().any(|o| PointSet::ALL.iter().any(|set| exact(o, *set)));
        for outcome in outcomes {
            let is_best = PointSet::ALL.iter().any(|&set| {
                if any_exact { exact(outcome, set) } else { efficiency(outcome, set) == best }
            });
            let [independent, sobol] =
                PointSet::ALL.map(|set| &outcome.variances[set as usize][lighting]);
            let mut cells = vec![
                Cell::text(outcome.model),
                Cell::text(outcome.strategy),
                Cell::number(outcome.timing.nanoseconds),
                Cell::number(mean(&independent.means)),
            ];
            for (set, variance) in [(PointSet::Independent, independent), (PointSet::Sobol, sobol)]
            {
                let uncertainty = Cell::Number { value: 100.0 * variance.uncertainty, digits: 2 };
                cells.push(Cell::number(variance.relative));
                cells.push(if exact(outcome, set) { Cell::Missing } else { uncertainty });
            }
            for set in PointSet::ALL {
                cells.push(if exact(outcome, set) {
                    Cell::text("exact")
                } else {
                    Cell::number(efficiency(outcome, set) / best)
                });
            }
            cells.push(Cell::Flag(is_best));
            table.push(cells);
            charted.push((outcome, is_best));
        }
    }
    Section {
        name: name.name().to_owned(),
        heading: name.heading().to_owned(),
        prose: vec![prose(name)],
        table,
        charts: vec![chart(measurement, &charted, lighting)],
        advice: Vec::new(),
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Variance against time with independent points, a series for each strategy.
fn chart(measurement: &Measurement, outcomes: &[(&Outcome, bool)], lighting: usize) -> Chart {
    let at = |outcome: &Outcome| {
        let time = measurement.point_nanoseconds[0] + outcome.timing.nanoseconds;
        [time, outcome.variances[0][lighting].relative]
    };
    let noisy: Vec<_> =
        outcomes.iter().filter(|(outcome, _)| at(outcome)[1] >= EXACT).copied().collect();
    let mut strategies: Vec<&str> = Vec::new();
    for (outcome, _) in &noisy {
        if !strategies.contains(&outcome.strategy) {
            strategies.push(outcome.strategy);
        }
    }
    let series = strategies.iter().map(|&strategy| {
        let points = noisy.iter().filter(|(o, _)| o.strategy == strategy).map(|&(o, best)| Point {
            at: at(o),
            label: o.model.to_owned(),
            filled: best,
        });
        Series { name: strategy.to_owned(), style: Style::Markers, points: points.collect() }
    });
    Chart {
        title: format!(
            "{}: variance against time, independent points",
            Lighting::ALL[lighting].heading()
        ),
        x: Axis::log("nanoseconds per sample, point included"),
        y: Axis::log("relative variance of a sample"),
        series: series.collect(),
        guides: guides(&noisy.iter().map(|(outcome, _)| at(outcome)).collect::<Vec<_>>()),
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
