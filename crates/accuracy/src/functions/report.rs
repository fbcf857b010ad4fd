//! What was measured of a family, as a part of a report.

use etendue_report::significant;
use etendue_report::{
    Axis, Cell, Chart, Guide, Point, Section, Series, Style, Table, pareto_front,
};

use super::family::{ErrorKind, Family};
use super::measure::{Measured, MeasuredVariant};

/// What a reader of the tables needs to know.
pub fn introduction() -> Vec<String> {
    [
        "Every table compares ways of computing one quantity. Errors are taken against the reference named above the table, \
         at all points of the domain named there; they are the same in every run. The variant marked as exact is the one \
         whose error the audit bounds, and whose time is 1.",
        "Times are medians over rounds in which all variants of a family take turns, the idle loop taken off, with the \
         quartiles beside them; the ratio is the median of the ratios in each round. Instructions are counted by valgrind \
         where it is installed, and do not depend on what else the machine does. A variant is on a front where no other one \
         is at least as good in both error and cost and better in one: filled markers.",
        "What differs less than the times do from run to run can change places on the front of times. Energy is the \
         largest difference of an energy from that of the reference: of a directional albedo for scattering functions, of a \
         mean over the hemisphere for reflectances.",
    ]
    .map(str::to_owned)
    .to_vec()
}

/// Table, charts and prose of a family.
pub fn section(family: &Family, measured: &Measured) -> Section {
    let setup = &family.setup;
    let kind = setup.judged_by;
    let time = |v: &MeasuredVariant| v.timing.ratio;
    let count = |v: &MeasuredVariant| v.instructions.unwrap_or(f64::NAN);
    let fronts = [front(measured, kind, time), front(measured, kind, count)];
    let mut charts = vec![chart(family, measured, Cost::Time, &fronts[0], time)];
    if measured.variants.iter().any(|v| v.instructions.is_some()) {
        charts.push(chart(family, measured, Cost::Instructions, &fronts[1], count));
    }
    let mut prose = vec![
        format!("Quantity: {}.", setup.quantity),
        format!("Domain: {}; {} points.", setup.ground.words(), setup.ground.len()),
        format!("Reference: {}.{}", setup.reference, uncertainty(measured, kind)),
    ];
    prose.extend(setup.prose.iter().map(|&text| text.to_owned()));
    Section {
        name: family.name.to_owned(),
        heading: family.title.to_owned(),
        prose,
        table: table(family, measured, &fronts),
        charts,
        advice: vec![on_the_front(measured, &fronts[0]), setup.advice.to_owned()],
    }
}

fn uncertainty(measured: &Measured, kind: ErrorKind) -> String {
    let Some(own) = &measured.reference.uncertainty else { return String::new() };
    let share = match kind {
        ErrorKind::RmsAbsolute => "absolute",
        ErrorKind::RmsRelative => "relative",
    };
    let [rms, energy] = [own.rms, own.energy].map(|x| significant(x, 2));
    format!(" Its own error, by {}: {rms} RMS {share}, {energy} at most in energies.", own.method)
}

/// Which variants are on the front of error and a cost.
fn front(
    measured: &Measured,
    kind: ErrorKind,
    cost: impl Fn(&MeasuredVariant) -> f64,
) -> Vec<bool> {
    let point = |v: &MeasuredVariant| [cost(v), v.errors.judged(kind)];
    pareto_front(&measured.variants.iter().map(point).collect::<Vec<_>>())
}

/// The variants on the front, from the cheapest.
fn on_the_front(measured: &Measured, front: &[bool]) -> String {
    let mut on: Vec<&MeasuredVariant> =
        measured.variants.iter().zip(front).filter(|(_, on)| **on).map(|(v, _)| v).collect();
    on.sort_by(|a, b| a.timing.ratio.total_cmp(&b.timing.ratio));
    let names: Vec<String> = on.iter().map(|v| label(v)).collect();
    format!("On the front of error and time, from the cheapest: {}.", names.join("; "))
}

fn label(variant: &MeasuredVariant) -> String {
    format!("{}, {}", variant.name, variant.precision.name())
}

fn table(family: &Family, measured: &Measured, fronts: &[Vec<bool>; 2]) -> Table {
    let setup = &family.setup;
    let mut table = Table::new([
        ("variant", "variant"),
        ("precision", ""),
        ("exact", "exact"),
        ("rms_relative", "RMS relative error"),
        ("max_relative", "max relative"),
        ("rms_absolute", "RMS absolute"),
        ("max_absolute", "max absolute"),
        ("worst", "worst at"),
        ("energy", "energy"),
        ("energy_worst", "at"),
        ("time", "time, ratio"),
        ("front_time", "front"),
        ("nanoseconds", "ns"),
        ("nanoseconds_low", "quartiles"),
        ("nanoseconds_high", ""),
        ("instructions", "instructions"),
        ("front_instructions", "front"),
    ]);
    for (i, v) in measured.variants.iter().enumerate() {
        let e = &v.errors;
        let number = |value: f64| Cell::Number { value, digits: 2 };
        let [energy, energy_worst] = match e.energy {
            Some((at, size)) => [number(size), Cell::text(setup.ground.energy_place(at))],
            None => [Cell::Missing, Cell::Missing],
        };
        let worst = if e.max_absolute == 0.0 {
            Cell::Missing
        } else {
            Cell::text(setup.ground.place(e.worst))
        };
        let [low, high] = v.timing.quartiles;
        table.push([
            Cell::text(v.name),
            Cell::text(v.precision.name()),
            Cell::Flag(i == 0),
            number(e.rms_relative),
            number(e.max_relative),
            number(e.rms_absolute),
            number(e.max_absolute),
            worst,
            energy,
            energy_worst,
            Cell::number(v.timing.ratio),
            Cell::Flag(fronts[0][i]),
            Cell::number(v.timing.nanoseconds),
            Cell::number(low),
            Cell::number(high),
            v.instructions.map_or(Cell::Missing, Cell::number),
            Cell::Flag(fronts[1][i]),
        ]);
    }
    table
}

/// What error is drawn against.
#[derive(Clone, Copy)]
enum Cost {
    Time,
    Instructions,
}

/// Costs that differ by less than this are spread evenly over the axis.
const LINEAR_SPAN: f64 = 12.0;

fn chart(
    family: &Family,
    measured: &Measured,
    what: Cost,
    front: &[bool],
    cost: impl Fn(&MeasuredVariant) -> f64,
) -> Chart {
    let kind = family.setup.judged_by;
    let series = [super::Precision::Double, super::Precision::Single].map(|precision| {
        let of = measured.variants.iter().zip(front).filter(|(v, _)| v.precision == precision);
        let point = |(v, on): (&MeasuredVariant, &bool)| Point {
            at: [cost(v), v.errors.judged(kind)],
            label: v.name.to_owned(),
            filled: *on,
        };
        let name = precision.name().to_owned();
        Series { name, style: Style::Markers, points: of.map(point).collect() }
    });
    let costs = measured.variants.iter().map(&cost).filter(|c| *c > 0.0);
    let (low, high) =
        costs.fold((f64::INFINITY, 0.0), |(l, h): (f64, f64), c| (l.min(c), h.max(c)));
    let axis = if high < LINEAR_SPAN * low { Axis::linear } else { Axis::log };
    let (x, by) = match what {
        Cost::Time => ("time, ratio to the exact variant", "time"),
        Cost::Instructions => ("instructions per evaluation", "instructions"),
    };
    let own = measured.reference.uncertainty.iter();
    let guide = |y: f64| Guide::Level { y, label: "error of the reference".to_owned() };
    Chart {
        title: format!("{}: error against {by}", family.title),
        x: axis(x.to_owned()),
        y: Axis::log(kind.label()),
        series: series.into_iter().filter(|s| !s.points.is_empty()).collect(),
        guides: own.map(|own| guide(own.rms)).collect(),
    }
}
