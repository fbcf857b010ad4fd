//! The box of a part of a triangle.

use etendue_math::glam::{DVec3, Vec3};

use crate::geometry::Aabb;
use crate::geometry::triangle::Corners;

/// How much a box of a part is padded, relative to the largest side of the triangle's box.
///
/// The test of a triangle accepts rays that pass it by roundings relative to the distances of its corners, up to 6 · 2⁻²⁴
/// along each of two axes. The test of a box allows for that where a corner is on the box; in the middle of a triangle the
/// corners may be farther away by the size of the triangle.
const PAD: f64 = 16.0 * 0.5 * f32::EPSILON as f64;

/// A box around the part of a triangle with `low ≤ x ≤ high` along an axis, cut down to a box that holds all of the triangle
/// that matters. Empty where there is no such part.
pub(super) fn clipped(corners: &Corners, bounds: &Aabb, axis: usize, low: f32, high: f32) -> Aabb {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let (low, high) = (f64::from(low), f64::from(high));
    let (mut least, mut largest) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let mut grow = |p: DVec3| {
        least = least.min(p);
        largest = largest.max(p);
    };
    for (p, q) in [(a, b), (b, c), (c, a)] {
        let (x, y) = (p[axis], q[axis]);
        if low <= x && x <= high {
            grow(p);
        }
        for plane in [low, high] {
            if (x < plane) != (y < plane) && plane.is_finite() {
                grow(p + (q - p) * ((plane - x) / (y - x)));
            }
        }
    }
    let side = (a.max(b).max(c) - a.min(b).min(c)).max_element();
    let pad = PAD * side;
    let down = |x: f64| if f64::from(x as f32) > x { (x as f32).next_down() } else { x as f32 };
    let up = |x: f64| -down(-x);
    let outward = |at: usize| {
        let (mut from, mut to) = (least[at], largest[at]);
        if at == axis {
            (from, to) = (from.max(low), to.min(high));
        }
        let limits = (f64::from(bounds.min[at]) - pad, f64::from(bounds.max[at]) + pad);
        (down((from - pad).max(limits.0)), up((to + pad).min(limits.1)))
    };
    let [x, y, z] = [0, 1, 2].map(outward);
    Aabb { min: Vec3::new(x.0, y.0, z.0), max: Vec3::new(x.1, y.1, z.1) }
}
