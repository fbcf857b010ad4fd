//! Where to cut a range of items.

use etendue_math::glam::Vec3A;

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

/// Bins along an axis, at most.
const BINS: usize = 32;

/// Boxes on one side of a cut, in vectors of four floats: most of the time of building is spent on their unions.
#[derive(Clone, Copy)]
struct Side {
    min: Vec3A,
    max: Vec3A,
    count: usize,
}

impl Side {
    const EMPTY: Self = Self { min: Vec3A::INFINITY, max: Vec3A::NEG_INFINITY, count: 0 };

    fn of(item: &Item) -> Self {
        let Aabb { min, max } = item.bounds;
        Self { min: min.into(), max: max.into(), count: 1 }
    }

    fn add(&self, other: &Self) -> Self {
        let (min, max) = (self.min.min(other.min), self.max.max(other.max));
        Self { min, max, count: self.count + other.count }
    }

    /// In units of one item in a box of half area 1. Counting blocks instead would be true to the
    /// traversal, yet makes trees with fuller blocks and larger boxes that are a fifth slower.
    fn cost(&self) -> f32 {
        let bounds = Aabb { min: self.min.into(), max: self.max.into() };
        bounds.half_area() * self.count as f32
    }
}

/// A plane between two bins of centres.
struct Plane {
    axis: usize,
    /// Bins below it.
    bin: usize,
    cost: f32,
}

/// Reorders a range of two or more items and returns where to cut it, strictly inside.
///
/// A short range in which triangles and objects are mixed is cut between the two kinds, whatever
/// their places, since a leaf holds one kind only.
pub(super) fn cut(items: &mut [Item], cut: Cut, first_object: u32) -> usize {
    if items.len() <= LANES {
        let middle = partition(items, |item| item.number < first_object);
        if middle > 0 && middle < items.len() {
            return middle;
        }
    }
    let centers = items.iter().fold(Aabb::EMPTY, |b, item| b.grow(item.bounds.center()));
    if cut == Cut::SurfaceArea
        && let Some(plane) = best_plane(items, &centers)
    {
        let bins = Bins::new(items.len(), &centers, plane.axis);
        let middle = partition(items, |item| bins.of(item) < plane.bin);
        if middle > 0 && middle < items.len() {
            return middle;
        }
    }
    halve(items, &centers)
}

/// Bins of centres along an axis.
struct Bins {
    axis: usize,
    start: f32,
    scale: f32,
    count: usize,
}

impl Bins {
    /// No more than items, since most ranges are short.
    fn new(items: usize, centers: &Aabb, axis: usize) -> Self {
        let count = items.clamp(LANES, BINS);
        let scale = count as f32 / (centers.max[axis] - centers.min[axis]);
        // An extent so small that its reciprocal overflows.
        let scale = if scale.is_finite() { scale } else { 0.0 };
        Self { axis, start: centers.min[axis], scale, count }
    }

    #[inline]
    fn of(&self, item: &Item) -> usize {
        let place = (item.bounds.center()[self.axis] - self.start) * self.scale;
        // The cast takes NaN and negative numbers to 0.
        (place as usize).min(self.count - 1)
    }
}

/// The plane with the least `area × items` on both sides; `None` if all centres coincide.
///
/// # Source
/// Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007.
fn best_plane(items: &[Item], centers: &Aabb) -> Option<Plane> {
    let extent = centers.extent();
    let axes = [0, 1, 2].map(|axis| Bins::new(items.len(), centers, axis));
    // All axes in one pass: what takes time is reading the items.
    let mut sides = [[Side::EMPTY; BINS]; 3];
    for item in items {
        let one = Side::of(item);
        for (bins, sides) in axes.iter().zip(&mut sides) {
            let side = &mut sides[bins.of(item)];
            *side = side.add(&one);
        }
    }
    let mut best: Option<Plane> = None;
    for axis in (0..3).filter(|&axis| extent[axis] > 0.0 && extent[axis].is_finite()) {
        let bins = &sides[axis][..axes[axis].count];
        // What is above each plane, then one sweep from below.
        let mut above = [Side::EMPTY; BINS];
        let mut side = Side::EMPTY;
        for i in (1..bins.len()).rev() {
            side = side.add(&bins[i]);
            above[i] = side;
        }
        let mut side = Side::EMPTY;
        for i in 1..bins.len() {
            side = side.add(&bins[i - 1]);
            let cost = side.cost() + above[i].cost();
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
