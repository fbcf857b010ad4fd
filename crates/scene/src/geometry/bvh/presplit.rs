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
    // Rounded down: what is left of the room goes to none, rather than to some of many that are alike, which was slower.
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
            let bit = (from ^ to).ilog2();
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

#[cfg(test)]
mod tests {
    use super::super::build::TriangleRef;
    use super::*;
    use etendue_math::glam::Vec3;

    struct List(Vec<Corners>);

    impl Triangles for List {
        fn count(&self) -> u32 {
            self.0.len() as u32
        }

        fn get(&self, number: u32) -> Option<TriangleRef> {
            let corners = *self.0.get(number as usize)?;
            Some(TriangleRef { corners, shape: 0, primitive: number })
        }
    }

    fn items(list: &List) -> Vec<Item> {
        let item = |(corners, number): (&Corners, u32)| Item {
            bounds: Aabb::from_points(*corners),
            number,
        };
        list.0.iter().zip(0..).map(item).collect()
    }

    /// Triangles from one corner of a cube to the opposite one, each a little beside the last and longer.
    fn diagonals() -> List {
        let triangle = |i: u16| {
            let place = f32::from(i) / 400.0;
            let shift = Vec3::new(1.0, -2.0, 1.3) * place;
            let long = 0.2 + 0.8 * place;
            [shift, shift + Vec3::ONE * long, shift + Vec3::new(1.0, 1.01, 1.0) * long]
        };
        List((0..400).map(triangle).collect())
    }

    #[test]
    fn parts_hold_all_of_their_triangles_in_smaller_boxes() {
        let list = diagonals();
        let whole = items(&list);
        let mut parts = whole.clone();
        presplit(&mut parts, &list);
        assert!(parts.len() > whole.len() && parts.len() <= whole.len() * 4 / 3, "{}", parts.len());
        let area = |items: &[Item]| items.iter().map(|item| item.bounds.half_area()).sum::<f32>();
        assert!(area(&parts) < 0.95 * area(&whole));
        for (number, [a, b, c]) in (0..).zip(&list.0) {
            for i in 0_u8..=40 {
                for j in 0..=(40 - i) {
                    let (s, t) = (f32::from(i) / 40.0, f32::from(j) / 40.0);
                    let p = *a + (*b - *a) * s + (*c - *a) * t;
                    let inside = |item: &&Item| {
                        // Coordinates up to 3, and so many roundings of the point.
                        let slack = Vec3::splat(4.0 * 3.0 * f32::EPSILON);
                        let (min, max) = (item.bounds.min - slack, item.bounds.max + slack);
                        item.number == number && min.cmple(p).all() && p.cmple(max).all()
                    };
                    assert!(parts.iter().any(|item| inside(&item)), "{p} of {number}");
                }
            }
        }
    }

    #[test]
    fn small_triangles_stay_whole() {
        let small = |[a, b, c]: &Corners| [*a, *a + (*b - *a) * 0.01, *a + (*c - *a) * 0.01];
        let list = List(diagonals().0.iter().map(small).collect());
        let mut parts = items(&list);
        presplit(&mut parts, &list);
        assert_eq!(parts.len(), list.0.len());
    }
}
