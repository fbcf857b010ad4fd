//! The figure of `etendue brdf plot`: polar panels above two charts.

use etendue_math::Real;

use super::lobe::Lobe;
use etendue_report::AxisRange;
use etendue_report::svg::{Anchor, Extent, Svg};

/// What is drawn of one model.
#[derive(Debug)]
pub(super) struct Curves {
    pub(super) name: String,
    pub(super) parameters: String,
    pub(super) transmits: bool,
    /// One per viewer.
    pub(super) lobes: Vec<Lobe>,
    pub(super) albedo: Vec<[f64; 2]>,
    pub(super) retro_reflection: Vec<[f64; 2]>,
}

const PANEL: f64 = 330.0;
const RADIUS: f64 = 118.0;
const PER_ROW: usize = 3;
const CHART_HEIGHT: f64 = 300.0;

/// The SVG file.
pub(super) fn figure(models: &[Curves], angles: &[f64]) -> String {
    let columns = models.len().clamp(2, PER_ROW);
    let rows = models.len().div_ceil(PER_ROW);
    let extent = if models.iter().any(|m| m.transmits) { Extent::Whole } else { Extent::UpperHalf };
    let panel_height = 96.0 + if extent == Extent::Whole { 2.0 * RADIUS } else { RADIUS };
    let charts = rows as f64 * panel_height + 30.0;
    let size = [columns as f64 * PANEL, charts + CHART_HEIGHT + 10.0];
    let mut svg = Svg::new(size);
    for (i, model) in models.iter().enumerate() {
        let corner = [(i % PER_ROW) as f64 * PANEL, (i / PER_ROW) as f64 * panel_height];
        polar(&mut svg, corner, i, model, angles, extent);
    }
    pattern_legend(&mut svg, charts - 12.0, size[0], angles);
    let width = size[0] / 2.0;
    let albedos = Chart {
        title: "Directional albedo",
        vertical: "reflected and transmitted share",
        curves: models.iter().map(|m| m.albedo.as_slice()).collect(),
    };
    albedos.draw(&mut svg, [0.0, charts], width);
    let retro = Chart {
        title: "Retro-reflection",
        vertical: "f(ω, ω) cos θ  (sr⁻¹)",
        curves: models.iter().map(|m| m.retro_reflection.as_slice()).collect(),
    };
    retro.draw(&mut svg, [width, charts], width);
    let names: Vec<_> = models.iter().map(|m| m.name.as_str()).collect();
    svg.finish(&format!("Reflection models: {}", names.join(", ")))
}

/// A polar panel: `f cos θi` of one model over the plane of incidence.
fn polar(
    svg: &mut Svg,
    [left, top]: [f64; 2],
    colour: usize,
    model: &Curves,
    angles: &[f64],
    extent: Extent,
) {
    let centre = [left + PANEL / 2.0, top + 70.0 + RADIUS];
    svg.text("title", [centre[0], top + 20.0], Anchor::Middle, &model.name);
    svg.text("small", [centre[0], top + 35.0], Anchor::Middle, &model.parameters);
    let key = [centre[0] - 20.0, top + 44.0];
    svg.line(&format!("curve c{colour}"), key, [key[0] + 40.0, key[1]]);
    let at = |degrees: f64, radius: f64| {
        let (sin, cos) = Real::sin_cos(degrees.to_radians());
        [centre[0] + radius * sin, centre[1] - radius * cos]
    };
    let peak = model.lobes.iter().flat_map(|l| &l.points).fold(0.0, |m: f64, p| m.max(p[1]));
    let scale = AxisRange::linear(peak);
    for tick in scale.ticks().into_iter().skip(1) {
        let radius = RADIUS * scale.place(tick);
        svg.arc("grid", centre, radius, extent);
        if peak > 0.0 {
            let label = scale.label(tick);
            svg.text("small", [centre[0] + radius, centre[1] + 12.0], Anchor::Middle, &label);
        }
    }
    let spokes = if extent == Extent::Whole { 12 } else { 7 };
    for i in 0..spokes {
        let degrees = -90.0 + 30.0 * f64::from(i);
        svg.line("grid", centre, at(degrees, RADIUS));
        if degrees.abs() < 90.0 {
            let [x, y] = at(degrees, RADIUS + 10.0);
            svg.text("small", [x, y + 3.0], Anchor::Middle, &format!("{degrees}°"));
        }
    }
    svg.line("axis", at(-90.0, RADIUS), at(90.0, RADIUS));
    for (pattern, (lobe, &degrees)) in model.lobes.iter().zip(angles).enumerate() {
        svg.line(&format!("viewer p{pattern}"), at(-degrees, RADIUS), at(-degrees, RADIUS - 14.0));
        if peak > 0.0 {
            let points = lobe.points.iter().map(|&[angle, f]| at(angle, RADIUS * scale.place(f)));
            svg.polyline(&format!("curve c{colour} p{pattern}"), points);
        }
        for delta in &lobe.deltas {
            let end = at(delta.angle, RADIUS * delta.share);
            svg.line(&format!("delta c{colour} p{pattern}"), centre, end);
        }
    }
    let below = if extent == Extent::Whole { RADIUS } else { 12.0 };
    let unit = match (peak > 0.0, model.lobes.iter().any(|l| !l.deltas.is_empty())) {
        (true, false) => "radius: f cos θi  (sr⁻¹)",
        (true, true) => "radius: f cos θi  (sr⁻¹); straight: delta lobes, rim = all light",
        (false, _) => "straight: delta lobes, rim = all light",
    };
    svg.text("small", [centre[0], centre[1] + below + 14.0], Anchor::Middle, unit);
}

/// Which line pattern belongs to which viewer.
fn pattern_legend(svg: &mut Svg, y: f64, width: f64, angles: &[f64]) {
    let step = 160.0;
    let start = (width - step * angles.len() as f64) / 2.0;
    for (pattern, degrees) in angles.iter().enumerate() {
        let x = start + step * pattern as f64;
        svg.line(&format!("axis p{pattern}"), [x, y], [x + 34.0, y]);
        svg.text("", [x + 40.0, y + 4.0], Anchor::Start, &format!("viewer at {degrees}°"));
    }
}

/// Curves over the viewer's angle.
struct Chart<'a> {
    title: &'static str,
    vertical: &'static str,
    /// One per model: degrees and value.
    curves: Vec<&'a [[f64; 2]]>,
}

impl Chart<'_> {
    fn draw(&self, svg: &mut Svg, [left, top]: [f64; 2], width: f64) {
        let [x0, x1] = [left + 62.0, left + width - 22.0];
        let [y0, y1] = [top + CHART_HEIGHT - 44.0, top + 30.0];
        let peak = self.curves.iter().copied().flatten().fold(0.0, |m: f64, p| m.max(p[1]));
        let scale = AxisRange::linear(peak);
        let at = |[degrees, value]: [f64; 2]| {
            [x0 + (x1 - x0) * degrees / 90.0, y0 + (y1 - y0) * scale.place(value)]
        };
        svg.text("title", [f64::midpoint(x0, x1), top + 16.0], Anchor::Middle, self.title);
        for tick in scale.ticks() {
            let [_, y] = at([0.0, tick]);
            svg.line("grid", [x0, y], [x1, y]);
            svg.text("small", [x0 - 6.0, y + 3.5], Anchor::End, &scale.label(tick));
        }
        for degrees in (0..=90).step_by(15) {
            let [x, _] = at([f64::from(degrees), 0.0]);
            svg.line("grid", [x, y0], [x, y1]);
            svg.text("small", [x, y0 + 15.0], Anchor::Middle, &format!("{degrees}°"));
        }
        svg.polyline("axis", [[x0, y1], [x0, y0], [x1, y0]]);
        let below = [f64::midpoint(x0, x1), y0 + 32.0];
        svg.text("", below, Anchor::Middle, "angle of the viewer to the normal θ");
        svg.upward_text("", [left + 16.0, f64::midpoint(y0, y1)], self.vertical);
        for (colour, curve) in self.curves.iter().enumerate() {
            svg.polyline(&format!("curve c{colour}"), curve.iter().map(|&point| at(point)));
        }
    }
}
