//! Large triangles in several parts, before a tree is built.

use alloc::vec::Vec;

use etendue_math::Real;

use super::binary::Item;
use super::build::Triangles;
use super::clip::clipped;
use crate::geometry::Aabb;
use crate::geometry::triangle::Corners;
use crate::parallel;

/// Triangles are split where the boxes of all are, but for what their triangles cover, so many times the box of the scene:
/// where a ray meets so many empty boxes on its way.
const EMPTY: f32 = 16.0;
/// How many more items there may be, per item.
const MORE: f32 = 0.33;

/// A triangle that may be split.
struct Candidate {
    /// Its item.
    at: u32,
    priority: f32,
}

/// Replaces the items of triangles whose boxes are large and empty by those of their parts, where that pays; the first is in
/// the place of the triangle's, the others are appended.
///
/// Triangles are cut at the planes that halve the box of the scene again and again, so that parts of neighbours end at the
/// same places, into more parts the larger and emptier their boxes are.
///
/// # Source
/// Karras, Aila, "Fast Parallel Construction of High-Quality Bounding Volume Hierarchies", HPG 2013, section 4.
pub(super) fn presplit(items: &mut Vec<Item>, triangles: &impl Triangles) {
    let all = items.iter().fold(Aabb::EMPTY, |b, item| b.union(item.bounds));
    let grid = Grid { start: all.min.to_array(), extent: all.extent().max_element() };
    // Objects have no corners, and stay whole.
    let corners = |item: &Item| triangles.get(item.number).map(|triangle| triangle.corners);
    let empty = parallel::map(items, |item| {
        corners(item).map_or(0.0, |corners| (item.bounds.half_area() - covered(&corners)).max(0.0))
    });
    let sum: f32 = empty.iter().sum();
    if !(sum > EMPTY * all.half_area() && sum.is_finite()) {
        return;
    }
    let room = (MORE * items.len() as f32) as usize;
    let candidates = empty.iter().zip(0..).filter(|&(&empty, _)| empty > 0.0);
    let candidates: Vec<Candidate> = candidates
        .map(|(&empty, at)| {
            let plane = grid.plane(&items[at as usize].bounds);
            let size = plane.map_or(0.0, |plane| plane.size);
            Candidate { at, priority: Real::powf(size * empty, 1.0 / 3.0) }
        })
        .collect();
    let parts = |scale: f32, c: &Candidate| (scale * c.priority) as usize;
    // The largest scale with which the parts still fit, by halving.
    let total: f32 = candidates.iter().map(|c| c.priority).sum();
    let (mut low, mut high) = (0.0, 16.0 * room as f32 / total);
    for _ in 0..24 {
        let middle = 0.5 * (low + high);
        let more: usize = candidates.iter().map(|c| parts(middle, c)).sum();
        if more <= room { low = middle } else { high = middle }
    }
    for c in &candidates {
        let more = parts(low, c);
        let at = c.at as usize;
        if more > 0
            && let Some(corners) = corners(&items[at])
        {
            split(&grid, &corners, at, more, items);
        }
    }
}

/// Half the area that the box of a triangle comes to as it is cut into ever more parts.
fn covered([a, b, c]: &Corners) -> f32 {
    let cross = (*b - *a).cross(*c - *a).abs();
    0.5 * (cross.x + cross.y + cross.z)
}

/// Splits an item into up to `more` further ones.
fn split(grid: &Grid, corners: &Corners, at: usize, more: usize, items: &mut Vec<Item>) {
    let item = items[at];
    let Some(Plane { axis, position, .. }) = grid.plane(&item.bounds) else { return };
    let low = clipped(corners, &item.bounds, axis, f32::NEG_INFINITY, position);
    let high = clipped(corners, &item.bounds, axis, position, f32::INFINITY);
    if low.is_empty() || high.is_empty() {
        return;
    }
    items[at].bounds = low;
    let other = items.len();
    items.push(Item { bounds: high, ..item });
    let [a, b] = [low, high].map(|bounds| bounds.extent().max_element());
    let first = (((more - 1) as f32 * a / (a + b) + 0.5) as usize).min(more - 1);
    for (at, more) in [(at, first), (other, more - 1 - first)] {
        if more > 0 {
            split(grid, corners, at, more, items);
        }
    }
}

/// The planes that halve a cube around the scene, its halves, and so on.
struct Grid {
    start: [f32; 3],
    extent: f32,
}

/// One of these planes.
struct Plane {
    axis: usize,
    position: f32,
    /// The distance of planes of its level, relative to the cube.
    size: f32,
}

/// Levels of the grid.
const LEVELS: i32 = 20;

impl Grid {
    /// The plane of the coarsest level that goes through a box, and of those the one along its longest side.
    fn plane(&self, bounds: &Aabb) -> Option<Plane> {
        let mut best: Option<Plane> = None;
        let sides = bounds.extent();
        for axis in 0..3 {
            let cells = (1 << LEVELS) as f32;
            let cell = |x: f32| ((x - self.start[axis]) / self.extent * cells) as u32;
            let (from, to) = (cell(bounds.min[axis]), cell(bounds.max[axis]));
            if from == to {
                continue;
            }
            // The highest bit in which the two differ.
            let bit = 31 - (from ^ to).leading_zeros();
            let place = (to >> bit << bit) as f32 / cells;
            let position = self.start[axis] + place * self.extent;
            let size = (1_u32 << bit) as f32 / cells;
            let better = best
                .as_ref()
                .is_none_or(|b| size > b.size || size == b.size && sides[axis] > sides[b.axis]);
            if better && bounds.min[axis] < position && position < bounds.max[axis] {
                best = Some(Plane { axis, position, size });
            }
        }
        best
    }
}
