//! Where to cut a range of items.

use super::LANES;
use super::binary::Item;
use crate::geometry::Aabb;

/// How ranges are cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    /// At the least expected cost of traversal.
    SurfaceArea,
    /// Into two halves of equally many items.
    Halves,
}

const BINS: usize = 32;

#[derive(Clone, Copy)]
struct Bin {
    bounds: Aabb,
    count: usize,
}

/// A plane between two bins.
struct Plane {
    axis: usize,
    /// Bins below it.
    bin: usize,
    cost: f32,
}

/// Reorders a range of two or more items and returns where to cut it, strictly inside.
///
/// A short range in which triangles and objects are mixed is cut between the two kinds, whatever
/// their places, since a leaf holds one kind only. `triangles` is the number of the first object.
pub(super) fn cut(items: &mut [Item], cut: Cut, triangles: u32) -> usize {
    if items.len() <= LANES {
        let middle = partition(items, |item| item.number < triangles);
        if middle > 0 && middle < items.len() {
            return middle;
        }
    }
    let centers = items.iter().fold(Aabb::EMPTY, |b, item| b.grow(item.bounds.center()));
    if cut == Cut::SurfaceArea
        && let Some(plane) = best_plane(items, &centers)
    {
        let middle = partition(items, |item| bin_of(item, &centers, plane.axis) < plane.bin);
        if middle > 0 && middle < items.len() {
            return middle;
        }
    }
    halve(items, &centers)
}

/// The bin of an item's centre along an axis.
#[inline]
fn bin_of(item: &Item, centers: &Aabb, axis: usize) -> usize {
    let extent = centers.max[axis] - centers.min[axis];
    let place = (item.bounds.center()[axis] - centers.min[axis]) / extent;
    // The cast takes NaN and negative numbers to 0.
    ((place * BINS as f32) as usize).min(BINS - 1)
}

/// The plane with the least `area × items` on both sides; `None` if all centres coincide.
///
/// # Source
/// Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007.
fn best_plane(items: &[Item], centers: &Aabb) -> Option<Plane> {
    let extent = centers.extent();
    let mut best: Option<Plane> = None;
    for axis in (0..3).filter(|&axis| extent[axis] > 0.0 && extent[axis].is_finite()) {
        let mut bins = [Bin { bounds: Aabb::EMPTY, count: 0 }; BINS];
        for item in items {
            let bin = &mut bins[bin_of(item, centers, axis)];
            bin.bounds = bin.bounds.union(item.bounds);
            bin.count += 1;
        }
        // Costs of what is above each plane, then one sweep from below.
        let mut above = [0.0; BINS];
        let mut side = Bin { bounds: Aabb::EMPTY, count: 0 };
        for i in (1..BINS).rev() {
            side = side.add(&bins[i]);
            above[i] = side.cost();
        }
        let mut side = Bin { bounds: Aabb::EMPTY, count: 0 };
        for i in 1..BINS {
            side = side.add(&bins[i - 1]);
            let cost = side.cost() + above[i];
            if side.count > 0
                && side.count < items.len()
                && best.as_ref().is_none_or(|b| cost < b.cost)
            {
                best = Some(Plane { axis, bin: i, cost });
            }
        }
    }
    best
}

impl Bin {
    fn add(&self, other: &Self) -> Self {
        Self { bounds: self.bounds.union(other.bounds), count: self.count + other.count }
    }

    /// In units of one item in a box of half area 1. Counting blocks instead would be true to the
    /// traversal, yet makes trees with fuller blocks and larger boxes that are a fifth slower.
    fn cost(&self) -> f32 {
        self.bounds.half_area() * self.count as f32
    }
}

/// Cuts in the middle of the order along the axis in which the centres spread most.
fn halve(items: &mut [Item], centers: &Aabb) -> usize {
    let extent = centers.extent();
    let axis = extent.max_position();
    let middle = items.len() / 2;
    // The number makes the order total, and with it the result unique.
    items.select_nth_unstable_by(middle, |a, b| {
        let key = |item: &Item| item.bounds.center()[axis];
        key(a).total_cmp(&key(b)).then(a.number.cmp(&b.number))
    });
    middle
}

/// Brings the items that satisfy a condition to the front; returns how many there are.
fn partition(items: &mut [Item], mut front: impl FnMut(&Item) -> bool) -> usize {
    let mut middle = 0;
    for i in 0..items.len() {
        if front(&items[i]) {
            items.swap(i, middle);
            middle += 1;
        }
    }
    middle
}
