//! A segment of a linear curve.

use etendue_math::Real;
use etendue_math::glam::DVec3;

use super::points::CurvePoint;
use crate::geometry::{Aabb, Ray};

/// The convex hull of two spheres: what a sphere sweeps whose centre goes straight from one to the other while its radius
/// changes linearly.
#[derive(Clone, Copy, Debug)]
pub(super) struct RoundCone {
    pub(super) start: DVec3,
    pub(super) axis: DVec3,
    pub(super) radii: [f64; 2],
}

impl RoundCone {
    #[inline]
    pub(super) fn between(a: &CurvePoint, b: &CurvePoint) -> Self {
        let ((start, r), (end, s)) = (a.exact(), b.exact());
        Self { start, axis: end - start, radii: [r, s] }
    }

    pub(super) fn bounds(&self) -> Aabb {
        let [r, s] = self.radii;
        if r == 0.0 && s == 0.0 {
            return Aabb::EMPTY;
        }
        let end = self.start + self.axis;
        super::outwards((self.start - r).min(end - s), (self.start + r).max(end + s))
    }

    /// The centre and the radius of the sphere at a share of the way.
    pub(super) fn sphere(&self, v: f64) -> (DVec3, f64) {
        let [r, s] = self.radii;
        (self.start + self.axis * v, r + (s - r) * v)
    }

    /// Where a line enters the hull, at which parameter and on which of the swept spheres; `None` for one that passes it.
    ///
    /// The hull is the union of the spheres at its ends and of the cone between the circles in which it touches them:
    /// it is entered where the first of them is. A point of the cone lies on the sphere at
    ///
    /// ```text
    /// v = y/k,  y = m·a + r Δr,  k = a² − Δr²,  m = p − start            in [0, 1]
    /// k (m² − r²) − y² = 0
    /// ```
    ///
    /// a quadratic in the ray's parameter, of which the root at which it falls is computed without cancellation, from
    /// the place on the ray that is next to the middle of the axis. Where one sphere holds the other, k ≤ 0, there is no
    /// cone.
    ///
    /// # Source
    /// What a round linear curve is: Embree 4, `kernels/geometry/roundline_intersector.h`; the derivation is ours.
    pub(super) fn entry(&self, ray: &Ray) -> Option<(f64, f64)> {
        let (o, d) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        let (a, [r, s]) = (self.axis, self.radii);
        let dd = d.dot(d);
        let middle = (self.start + a * 0.5 - o).dot(d) / dd;
        let m = o + d * middle - self.start;
        let mut first: Option<(f64, f64)> = None;
        let mut meet = |t: Option<f64>, v: f64| {
            if let Some(t) = t
                && first.is_none_or(|(before, _)| t < before)
            {
                first = Some((t, v));
            }
        };
        meet(enter_sphere(m, d, r), 0.0);
        meet(enter_sphere(m - a, d, s), 1.0);
        let grows = s - r;
        let k = a.dot(a) - grows * grows;
        if k > 0.0 {
            let (y, along) = (m.dot(a) + r * grows, d.dot(a));
            let quadratic =
                [k * (m.dot(m) - r * r) - y * y, k * m.dot(d) - y * along, k * dd - along * along];
            let t = falling_root(quadratic);
            let v = t.map_or(f64::NAN, |t| (y + t * along) / k);
            meet(t.filter(|_| (0.0..=1.0).contains(&v)), v);
        }
        first.map(|(t, v)| (middle + t, v))
    }
}

/// Where a line enters a sphere about the origin.
fn enter_sphere(m: DVec3, d: DVec3, radius: f64) -> Option<f64> {
    let dd = d.dot(d);
    let nearest = -m.dot(d) / dd;
    let across = m + d * nearest;
    let square = radius * radius - across.dot(across);
    // Not a sphere without extent.
    (radius > 0.0 && square >= 0.0).then(|| nearest - Real::sqrt(square / dd))
}

/// The root of `c₀ + 2 c₁ t + c₂ t²` at which it goes from positive to negative, whatever the sign of c₂.
fn falling_root([c0, c1, c2]: [f64; 3]) -> Option<f64> {
    let discriminant = c1 * c1 - c0 * c2;
    if discriminant.is_nan() || discriminant < 0.0 {
        return None;
    }
    let root = Real::sqrt(discriminant);
    let t = if c1 >= 0.0 { -(c1 + root) / c2 } else { c0 / (root - c1) };
    t.is_finite().then_some(t)
}
