//! Points over two axes.

use etendue_math::Real;

use crate::axis::{Axis, AxisRange, Scale};
use crate::labels::Labels;
use crate::svg::{Anchor, COLOURS, PATTERNS, Svg};

/// A chart.
///
/// Colours and line patterns tell series apart, six by four of them; filled markers are on the front.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What is shown.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// What is measured.
    pub series: Vec<Series>,
    /// Lines to compare with.
    pub guides: Vec<Guide>,
}

/// Points of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Its name in the legend; nothing there for an empty one.
    pub name: String,
    /// Whether the points belong together.
    pub style: Style,
    /// The points, in the order in which a line connects them.
    pub points: Vec<Point>,
}

/// How the points of a series are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// A marker each.
    Markers,
    /// Markers along a line.
    Line,
    /// A line only.
    Curve,
}

/// A point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Point {
    /// x and y, in the units of the axes; a point whose coordinates are not finite is left out.
    pub at: [f64; 2],
    /// What stands beside it, if there is room; always its tooltip.
    pub label: String,
    /// Whether its marker is filled.
    pub filled: bool,
}

/// A line to compare with.
#[derive(Clone, Debug, PartialEq)]
pub enum Guide {
    /// `y ∝ x^exponent` through a point, on two logarithmic axes.
    Power {
        /// The slope on the page.
        exponent: f64,
        /// A point of it.
        through: [f64; 2],
        /// What it means.
        label: String,
    },
    /// A constant y.
    Level {
        /// The constant.
        y: f64,
        /// What it means.
        label: String,
    },
}

const SIZE: [f64; 2] = [640.0, 420.0];
const LEFT: f64 = 74.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 50.0;
const LEGEND_LINE: f64 = 16.0;
const LEGEND_COLUMNS: usize = 3;

impl Chart {
    /// The chart as an SVG file, which can stand in an HTML page as it is.
    pub fn svg(&self) -> String {
        let named = self.series.iter().filter(|s| !s.name.is_empty()).count();
        let legend =
            if named > 1 { named.div_ceil(LEGEND_COLUMNS) as f64 * LEGEND_LINE } else { 0.0 };
        let mut svg = Svg::new([SIZE[0], SIZE[1] + legend]);
        let plane = Plane::of(self);
        plane.frame(&mut svg, self);
        for guide in &self.guides {
            plane.guide(&mut svg, guide);
        }
        let [[x0, x1], [y0, y1]] = [plane.left_right, plane.bottom_top];
        let mut labels = Labels::new([x0, y1, x1, y0]);
        let shown = |s: &Series| -> Vec<Point> {
            s.points.iter().filter(|p| p.at.iter().all(|x| x.is_finite())).cloned().collect()
        };
        for series in &self.series {
            for point in shown(series) {
                labels.avoid(plane.at(point.at));
            }
        }
        for (i, series) in self.series.iter().enumerate() {
            let (points, class) = (shown(series), class(i));
            if series.style != Style::Markers {
                svg.polyline(&format!("curve {class}"), points.iter().map(|p| plane.at(p.at)));
            }
            if series.style == Style::Curve {
                continue;
            }
            for point in &points {
                let at = plane.at(point.at);
                let kind = if point.filled { "filled" } else { "hollow" };
                svg.marker(&format!("marker {kind} {class}"), at, &point.label);
                if !point.label.is_empty()
                    && let Some(place) = labels.place(at, &point.label)
                {
                    svg.text("small", place, Anchor::Start, &point.label);
                }
            }
        }
        if named > 1 {
            self.legend(&mut svg);
        }
        svg.finish(&self.title)
    }

    fn legend(&self, svg: &mut Svg) {
        let width = (SIZE[0] - LEFT - RIGHT) / LEGEND_COLUMNS as f64;
        let named = self.series.iter().enumerate().filter(|(_, s)| !s.name.is_empty());
        for (place, (i, series)) in named.enumerate() {
            let x = LEFT + width * (place % LEGEND_COLUMNS) as f64;
            let y = SIZE[1] + LEGEND_LINE * (place / LEGEND_COLUMNS) as f64;
            if series.style == Style::Markers {
                svg.marker(&format!("marker filled {}", class(i)), [x + 12.0, y - 4.0], "");
            } else {
                svg.line(&format!("curve {}", class(i)), [x, y - 4.0], [x + 24.0, y - 4.0]);
            }
            svg.text("small", [x + 30.0, y], Anchor::Start, &series.name);
        }
    }
}

/// Colour and pattern of a series.
fn class(series: usize) -> String {
    format!("c{} p{}", series % COLOURS, series / COLOURS % PATTERNS)
}

/// Both axes on the page.
struct Plane {
    x: AxisRange,
    y: AxisRange,
    left_right: [f64; 2],
    bottom_top: [f64; 2],
}

impl Plane {
    fn of(chart: &Chart) -> Self {
        let points = || chart.series.iter().flat_map(|s| s.points.iter().map(|p| p.at));
        let levels = chart.guides.iter().filter_map(|guide| match guide {
            Guide::Level { y, .. } => Some(*y),
            Guide::Power { .. } => None,
        });
        Self {
            x: AxisRange::of(chart.x.scale, points().map(|p| p[0])),
            y: AxisRange::of(chart.y.scale, points().map(|p| p[1]).chain(levels)),
            left_right: [LEFT, SIZE[0] - RIGHT],
            bottom_top: [SIZE[1] - BOTTOM, TOP],
        }
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let between = |[a, b]: [f64; 2], t: f64| a + (b - a) * t;
        [between(self.left_right, self.x.place(x)), between(self.bottom_top, self.y.place(y))]
    }

    fn frame(&self, svg: &mut Svg, chart: &Chart) {
        let ([x0, x1], [y0, y1]) = (self.left_right, self.bottom_top);
        svg.text("title", [f64::midpoint(x0, x1), 20.0], Anchor::Middle, &chart.title);
        for tick in self.x.ticks() {
            let [x, _] = self.at([tick, 0.0]);
            svg.line("grid", [x, y0], [x, y1]);
            svg.text("small", [x, y0 + 15.0], Anchor::Middle, &self.x.label(tick));
        }
        for tick in self.y.ticks() {
            let [_, y] = self.at([self.x.ends()[0], tick]);
            svg.line("grid", [x0, y], [x1, y]);
            svg.text("small", [x0 - 6.0, y + 3.5], Anchor::End, &self.y.label(tick));
        }
        svg.polyline("axis", [[x0, y1], [x0, y0], [x1, y0]]);
        svg.text("", [f64::midpoint(x0, x1), y0 + 34.0], Anchor::Middle, &chart.x.label);
        svg.upward_text("", [18.0, f64::midpoint(y0, y1)], &chart.y.label);
    }

    /// Cuts the line at the frame and labels its right end.
    fn guide(&self, svg: &mut Svg, guide: &Guide) {
        let label = match guide {
            Guide::Power { label, .. } | Guide::Level { label, .. } => label,
        };
        let ends = match *guide {
            Guide::Level { y, .. } => Some(self.x.ends().map(|x| [x, y])),
            Guide::Power { exponent, through, .. } => self.power(exponent, through),
        };
        let Some([from, to]) = ends.map(|ends| ends.map(|end| self.at(end))) else { return };
        svg.line("guide", from, to);
        svg.text("small", [to[0] - 4.0, to[1] - 5.0], Anchor::End, label);
    }

    /// Where `y = y₀ (x/x₀)^e` enters and leaves the frame.
    fn power(&self, exponent: f64, [x0, y0]: [f64; 2]) -> Option<[[f64; 2]; 2]> {
        let log = [&self.x, &self.y].iter().all(|axis| axis.is(Scale::Log));
        if !(log && x0 > 0.0 && y0 > 0.0) {
            return None;
        }
        let y = |x: f64| y0 * Real::powf(x / x0, exponent);
        let x = |y: f64| x0 * Real::powf(y / y0, 1.0 / exponent);
        let [left, right] = self.x.ends();
        let [mut low, mut high] = self.y.ends().map(x);
        if low > high {
            (low, high) = (high, low);
        }
        let ends = [left.max(low), right.min(high)];
        (ends[0] < ends[1]).then(|| ends.map(|x| [x, y(x)]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(points: Vec<Point>, guides: Vec<Guide>) -> Chart {
        let series = vec![Series { name: "<s>".to_owned(), style: Style::Line, points }];
        let [x, y] = ["seconds", "error"].map(Axis::log);
        Chart { title: "t".to_owned(), x, y, series, guides }
    }

    fn point(x: f64, y: f64) -> Point {
        Point { at: [x, y], label: format!("{x} & {y}"), filled: true }
    }

    #[test]
    fn what_is_not_finite_is_left_out_and_nothing_in_the_file_is_not_a_number() {
        let points =
            vec![point(1.0, 0.5), point(f64::NAN, 1.0), point(10.0, 0.0), point(2.0, 0.05)];
        let level = Guide::Level { y: 1e-3, label: "floor".to_owned() };
        let file = chart(points, vec![level]).svg();
        assert_eq!(file.matches("<circle class=\"marker").count(), 3);
        assert!(!file.contains("NaN") && !file.contains("inf"), "{file}");
        assert!(file.contains("1 &amp; 0.5") && file.contains(">floor<"));
    }

    #[test]
    fn a_guide_of_slope_minus_one_is_cut_at_the_frame() {
        let guide = Guide::Power { exponent: -1.0, through: [1.0, 1.0], label: "1/t".to_owned() };
        let chart = chart(vec![point(1.0, 1.0), point(50.0, 0.03)], vec![guide]);
        let plane = Plane::of(&chart);
        let [from, to] = plane.power(-1.0, [1.0, 1.0]).expect("inside");
        // From the upper left corner region to where the lower end of y, 0.01, is reached at x = 100.
        assert!((from[0] * from[1] - 1.0).abs() < 1e-9 && (to[0] * to[1] - 1.0).abs() < 1e-9);
        assert!((to[0] - 100.0).abs() < 1e-6, "{to:?}");
        assert!(chart.svg().contains("class=\"guide\""));
    }

    #[test]
    fn a_chart_without_points_is_drawn() {
        assert!(chart(Vec::new(), Vec::new()).svg().ends_with("</svg>\n"));
    }
}
