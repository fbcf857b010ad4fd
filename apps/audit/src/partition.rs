//! Cells of the sphere adapted to a sampler.

use etendue_math::Real;

use crate::cubature::{Cell, Cubature, Integral};

/// A point in the coordinates of a [`Cell`]: cosine and azimuth.
pub type Point = [f64; 2];

/// Coordinates of a direction. Near the poles z comes from x and y, whose relative precision is
/// kept where that of `1 − z` is lost.
pub fn coordinates([x, y, z]: [f64; 3]) -> Point {
    let r2 = x * x + y * y;
    let z = if r2 < 0.01 { (1.0 - r2).sqrt().copysign(z) } else { z };
    let phi = Real::atan2(y, x);
    [z, if phi < 0.0 { phi + 2.0 * f64::PI } else { phi }]
}

#[derive(Clone, Copy, Debug)]
enum Node {
    Split { axis: usize, at: f64, below: usize, above: usize },
    Leaf(usize),
}

/// The sphere cut into cells: small where pilot samples are dense, with empty margins cut off, so
/// that neither a count nor an integral misses a narrow lobe.
#[derive(Clone, Debug)]
pub struct Partition {
    nodes: Vec<Node>,
    roots: [usize; 2],
    cells: Vec<Cell>,
}

impl Partition {
    /// Cells that hold at most `per_cell` pilot points each.
    pub fn new(pilot: Vec<Point>, per_cell: usize) -> Self {
        let mut partition = Self { nodes: Vec::new(), roots: [0; 2], cells: Vec::new() };
        let (mut lower, mut upper): (Vec<_>, Vec<_>) = pilot.into_iter().partition(|p| p[0] < 0.0);
        partition.roots = [
            partition.grow(Cell::HEMISPHERES[0], &mut upper, per_cell.max(1), 0),
            partition.grow(Cell::HEMISPHERES[1], &mut lower, per_cell.max(1), 0),
        ];
        partition
    }

    fn grow(&mut self, cell: Cell, points: &mut [Point], per_cell: usize, depth: u32) -> usize {
        // Every second level halves the points: 60 levels are beyond any number of them.
        let split = if depth < 60 { choose_split(cell, points, per_cell, depth) } else { None };
        let Some((axis, at)) = split else {
            self.cells.push(cell);
            self.nodes.push(Node::Leaf(self.cells.len() - 1));
            return self.nodes.len() - 1;
        };
        points.sort_unstable_by(|a, b| a[axis].total_cmp(&b[axis]));
        let count = points.partition_point(|p| p[axis] < at);
        let (low, high) = points.split_at_mut(count);
        let (mut first, mut second) = (cell, cell);
        let (a, b) = if axis == 0 {
            (&mut first.z, &mut second.z)
        } else {
            (&mut first.phi, &mut second.phi)
        };
        (a[1], b[0]) = (at, at);
        let below = self.grow(first, low, per_cell, depth + 1);
        let above = self.grow(second, high, per_cell, depth + 1);
        self.nodes.push(Node::Split { axis, at, below, above });
        self.nodes.len() - 1
    }

    /// The cells, disjoint and covering the sphere.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// Index of the cell that holds a point.
    pub fn find(&self, point: Point) -> usize {
        let mut node = self.roots[usize::from(point[0] < 0.0)];
        loop {
            match self.nodes[node] {
                Node::Leaf(cell) => return cell,
                Node::Split { axis, at, below, above } => {
                    node = if point[axis] < at { below } else { above };
                }
            }
        }
    }

    /// `∫ f dω` over every cell, `tolerance` for all of them together.
    pub fn integrate_each(&self, tolerance: f64, f: impl Fn([f64; 3]) -> f64) -> Vec<Integral> {
        self.each(tolerance, |w| [f(w)]).map(|[integral]| integral).collect()
    }

    /// `∫ f dω` over the sphere.
    pub fn integrate(&self, tolerance: f64, f: impl Fn([f64; 3]) -> f64) -> Integral {
        let [integral] = self.integrate_all(tolerance, |w| [f(w)]);
        integral
    }

    /// `∫ f dω` over the sphere of several quantities, which share the points where they are evaluated.
    pub fn integrate_all<const N: usize>(
        &self,
        tolerance: f64,
        f: impl Fn([f64; 3]) -> [f64; N],
    ) -> [Integral; N] {
        self.each(tolerance, f).fold([Integral::default(); N], |mut sum, cell| {
            sum.iter_mut().zip(cell).for_each(|(sum, part)| *sum += part);
            sum
        })
    }

    fn each<const N: usize>(
        &self,
        tolerance: f64,
        f: impl Fn([f64; 3]) -> [f64; N],
    ) -> impl Iterator<Item = [Integral; N]> {
        let rule = Cubature::default();
        let each = tolerance / self.cells.len() as f64;
        self.cells.iter().map(move |&c| rule.integrate(c, each, &f))
    }
}

/// Where to cut a cell: first towards the margin of its points where more than half of the cell is
/// empty, then at their median, alternating axes. `None` for a leaf.
fn choose_split(cell: Cell, points: &[Point], per_cell: usize, depth: u32) -> Option<(usize, f64)> {
    if points.len() < 2 {
        return None;
    }
    let ranges = [cell.z, cell.phi];
    // Gaps that are wide next to the points are cut in steps, and along the axis where they are
    // widest first: what is cut off is then about as large as it is far from the points along both
    // axes. A larger cell would hide the tail of the lobe from the nodes of a quadrature.
    let margins = [0, 1].map(|axis| margin(ranges[axis], points.iter().map(|p| p[axis])));
    let widest = usize::from(margins[1].gap > margins[0].gap);
    if margins[widest].gap > 1.0 {
        return Some((widest, margins[widest].at));
    }
    if points.len() <= per_cell {
        return None;
    }
    let axis = depth as usize % 2;
    let mut values: Vec<f64> = points.iter().map(|p| p[axis]).collect();
    values.sort_unstable_by(f64::total_cmp);
    let at = values[values.len() / 2];
    (at > ranges[axis][0] && at < ranges[axis][1]).then_some((axis, at))
}

/// The emptier end of a range of values inside a cell.
struct Margin {
    /// Its length in units of the spread of the values, 0 where these coincide.
    gap: f64,
    /// Where to cut it: at a quarter of its length, or where it is short, at its end.
    at: f64,
}

fn margin(range: [f64; 2], values: impl Iterator<Item = f64>) -> Margin {
    let (low, high) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
    let spread = high - low;
    // A quarter of the spread is left as margin, since the next points may fall outside.
    let inner = [low - 0.25 * spread, high + 0.25 * spread];
    let gaps = [inner[0] - range[0], range[1] - inner[1]];
    let gap = gaps[0].max(gaps[1]);
    let rest = if gap > 4.0 * spread { 0.25 * gap } else { 0.0 };
    let at = if gaps[0] > gaps[1] { inner[0] - rest } else { inner[1] + rest };
    Margin { gap: if spread > 0.0 { gap / spread } else { 0.0 }, at }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generators::uniforms;

    fn narrow_lobe() -> Vec<Point> {
        // A lobe of width 1e-3 around (0.3, 2).
        (0..2000)
            .map(|i| {
                let [_, u, v] = uniforms::<f64>(5, i);
                [0.3 + 1e-3 * (u - 0.5), 2.0 + 1e-3 * (v - 0.5)]
            })
            .collect()
    }

    #[test]
    fn cells_cover_the_sphere_and_find_returns_the_cell_around_the_point() {
        let partition = Partition::new(narrow_lobe(), 50);
        let area: f64 = partition.integrate(1e-9, |_| 1.0).value;
        // Dozens of cells, each area to rounding.
        assert!((area - 4.0 * f64::PI).abs() < 1e-12);
        for i in 0..500 {
            let [_, u, v] = uniforms::<f64>(6, i);
            let point = [2.0 * u - 1.0, 2.0 * f64::PI * v];
            let cell = partition.cells()[partition.find(point)];
            assert!(cell.z[0] <= point[0] && point[0] <= cell.z[1], "{point:?} {cell:?}");
            assert!(cell.phi[0] <= point[1] && point[1] <= cell.phi[1], "{point:?} {cell:?}");
        }
    }

    #[test]
    fn a_lobe_of_a_millionth_of_the_sphere_is_integrated() {
        let partition = Partition::new(narrow_lobe(), 50);
        let inside = |w: [f64; 3]| {
            let [z, phi] = coordinates(w);
            let (a, b) = ((z - 0.3) / 2e-4, (phi - 2.0) / 2e-4);
            Real::exp(-0.5 * (a * a + b * b)) / (2.0 * f64::PI * 4e-8)
        };
        // Cells are fine up to the margin, 3.75 σ, beyond which 1.8e-4 of the mass lies per axis.
        assert!((partition.integrate(1e-6, inside).value - 1.0).abs() < 4e-4);
    }
}
