//! A segment of a B-spline, and parts of it.

use alloc::vec::Vec;

use etendue_math::glam::{DVec3, Vec3};
use etendue_math::{Real, Vector3};

use super::points::CurvePoint;
use crate::geometry::root::bracketed;
use crate::geometry::{Aabb, Ray};

/// A cubic segment of a curve and of its radius, with a parameter from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spline {
    /// Coefficients of the powers of the parameter.
    center: [DVec3; 4],
    radius: [f64; 4],
    /// Where it ends, computed as the next segment computes where it starts.
    end: Center,
}

/// The centre of a circle across a curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Center {
    pub(super) position: DVec3,
    /// The derivative of the position.
    pub(super) tangent: DVec3,
    pub(super) radius: f64,
}

/// A part of a segment that is nearly straight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Part {
    pub(super) segment: u32,
    /// Its parameters, multiples of a power of 1/2.
    pub(super) from: f32,
    pub(super) to: f32,
    /// Its ends, rounded.
    chord: [Vec3; 2],
    /// No point of its surface is farther from the chord.
    reach: f32,
}

/// A ray on its way past a part.
pub(super) struct Passage {
    /// The place on the ray next to the middle of the part, and its parameter: parameters count from there, so that
    /// distance costs no digits.
    place: DVec3,
    nearest: f64,
    direction: DVec3,
    /// Where the ray is within a sphere about the part, from its origin on.
    span: [f64; 2],
}

impl Part {
    /// The way of a ray past the part; `None` where it does not come near enough.
    pub(super) fn passage(&self, ray: &Ray) -> Option<Passage> {
        let ([start, end], reach) = (self.chord.map(Vec3::as_dvec3), f64::from(self.reach));
        let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        let (square, center) = (direction.dot(direction), (start + end) * 0.5);
        let nearest = (center - origin).dot(direction) / square;
        let place = origin + direction * nearest;
        let across = direction.cross(end - start);
        let gap = across.dot(center - place);
        if gap * gap > reach * reach * across.dot(across) {
            return None;
        }
        let beside = place - center;
        let radius = 0.5 * Vector3::length(end - start) + reach;
        let left = radius * radius - beside.dot(beside);
        if left.is_nan() || left < 0.0 {
            return None;
        }
        let half = Real::sqrt(left / square);
        let span = [(-half).max(-nearest), half];
        let is_met = span[0] < half && span[0] + nearest < f64::from(ray.t_max);
        is_met.then_some(Passage { place, nearest, direction, span })
    }
}

/// Parts are halved this many times at most: 64 of a segment that turns back on itself.
const MOST_HALVINGS: u32 = 6;
/// Cosine between chord and control polygon down to which a part is nearly straight: 16°.
const STRAIGHT: f64 = 0.96;
/// How far the radius of a nearly straight part leaves its own chord, relative to the largest.
const EVEN: f64 = 0.05;
/// A part longer than this many radii is halved up to [`FOR_BOXES`] times, since boxes of oblique parts are mostly empty.
const SLENDER: f64 = 16.0;
const FOR_BOXES: u32 = 2;

/// A part as a cubic Bézier curve: its control points and radii.
struct Bezier([(DVec3, f64); 4]);

/// The distance from the axis of the point at a parameter of a ray, and where on the axis.
#[derive(Clone, Copy)]
struct Depth {
    u: f64,
    /// Squared distance less squared radius, and its derivative along the ray.
    value: f64,
    slope: f64,
}

impl Spline {
    /// The uniform B-spline of four control points.
    pub(super) fn of(points: [&CurvePoint; 4]) -> Self {
        let [(p, r), (q, s), (v, t), (w, x)] = points.map(CurvePoint::exact);
        let end = Center {
            position: (q + v * 4.0 + w) / 6.0,
            tangent: (w - q) * 0.5,
            radius: (s + t * 4.0 + x) / 6.0,
        };
        Self {
            center: [
                (p + q * 4.0 + v) / 6.0,
                (v - p) * 0.5,
                (p - q * 2.0 + v) * 0.5,
                ((w - p) + (q - v) * 3.0) / 6.0,
            ],
            radius: [
                (r + s * 4.0 + t) / 6.0,
                (t - r) * 0.5,
                (r - s * 2.0 + t) * 0.5,
                ((x - r) + (s - t) * 3.0) / 6.0,
            ],
            end,
        }
    }

    pub(super) fn at(&self, u: f64) -> Center {
        if u == 1.0 {
            return self.end;
        }
        let [c0, c1, c2, c3] = self.center;
        let [r0, r1, r2, r3] = self.radius;
        Center {
            position: ((c3 * u + c2) * u + c1) * u + c0,
            tangent: (c3 * (3.0 * u) + c2 * 2.0) * u + c1,
            radius: ((r3 * u + r2) * u + r1) * u + r0,
        }
    }

    /// The second and third derivative of the position.
    pub(super) fn curvature(&self, u: f64) -> [DVec3; 2] {
        let [_, _, c2, c3] = self.center;
        [c2 * 2.0 + c3 * (6.0 * u), c3 * 6.0]
    }

    /// The derivative of the radius.
    pub(super) fn growth(&self, u: f64) -> f64 {
        let [_, r1, r2, r3] = self.radius;
        (3.0 * r3 * u + 2.0 * r2) * u + r1
    }

    fn bezier(&self, from: f64, to: f64) -> Bezier {
        let (start, end, third) = (self.at(from), self.at(to), (to - from) / 3.0);
        Bezier([
            (start.position, start.radius),
            (start.position + start.tangent * third, start.radius + self.growth(from) * third),
            (end.position - end.tangent * third, end.radius - self.growth(to) * third),
            (end.position, end.radius),
        ])
    }

    /// Adds the parts of the segment, of which `segment` is the number.
    pub(super) fn split(&self, segment: u32, parts: &mut Vec<Part>) {
        self.halve(segment, [0.0, 1.0], 0, parts);
    }

    fn halve(&self, segment: u32, [from, to]: [f64; 2], depth: u32, parts: &mut Vec<Part>) {
        let bezier = self.bezier(from, to);
        let is_whole = depth >= MOST_HALVINGS
            || (bezier.is_straight() && (depth >= FOR_BOXES || !bezier.is_slender()));
        if is_whole {
            let chord = bezier.ends().map(DVec3::as_vec3);
            let size = chord[0].abs().max(chord[1].abs()).max_element();
            // Rounded up, and what the ends are rounded by.
            let reach = (bezier.reach() * (1.0 + f64::from(f32::EPSILON))) as f32;
            let reach = reach + size * f32::EPSILON;
            parts.push(Part { segment, from: from as f32, to: to as f32, chord, reach });
        } else {
            let middle = 0.5 * (from + to);
            self.halve(segment, [from, middle], depth + 1, parts);
            self.halve(segment, [middle, to], depth + 1, parts);
        }
    }

    /// A box that holds a part: a point of it is a mean, with the weights of Bernstein, of points of spheres about the
    /// control points.
    pub(super) fn bounds(&self, part: &Part) -> Aabb {
        let Bezier(points) = self.bezier(f64::from(part.from), f64::from(part.to));
        if points.iter().all(|&(position, _)| position == points[0].0) {
            // A point has no direction, and so no circle across it.
            return Aabb::EMPTY;
        }
        if points.iter().all(|&(_, radius)| radius == 0.0) {
            return Aabb::EMPTY;
        }
        let low = points.iter().fold(DVec3::INFINITY, |low, &(p, r)| low.min(p - r.abs()));
        let high = points.iter().fold(DVec3::NEG_INFINITY, |high, &(p, r)| high.max(p + r.abs()));
        super::outwards(low, high)
    }

    /// Where a ray enters a part from outside, from its origin on: its parameter and that of the curve.
    ///
    /// The surface is what circles across the curve sweep: `p` with
    ///
    /// ```text
    /// (p − c(u))·c′(u) = 0,   f(p) = (p − c(u))² − r(u)² = 0
    /// ```
    ///
    /// The first equation has a root between the planes across the ends of the part, found in `f64` by Newton's method
    /// in an interval. So `f` is a function of the ray's parameter between these planes and within a sphere about the
    /// part. It is the quadratic of a cone where the curve is straight, and nearly so in a part, which is straight up to
    /// 16°: it falls through 0 between its ends, or on the way to its only minimum, or after its only maximum. Parts that
    /// touch have their plane in common, so that a ray that enters at it enters one of them.
    ///
    /// # Source
    /// What a round curve is: Embree 4, `kernels/geometry/curve_intersector_sweep.h`; the way to the root is ours.
    pub(super) fn entry(&self, part: &Part, passage: &Passage) -> Option<(f64, f64)> {
        let Passage { place, nearest, direction, span: [mut near, mut far] } = *passage;
        let span = [f64::from(part.from), f64::from(part.to)];
        let [start, end] = span.map(|u| self.at(u));
        let chord = end.position - start.position;
        // Behind the first plane and before the second one.
        for (plane, side) in [(&start, 1.0), (&end, -1.0)] {
            let normal = if plane.tangent == DVec3::ZERO { chord } else { plane.tangent };
            let slope = normal.dot(direction) * side;
            let height = normal.dot(plane.position - place) * side;
            if slope > 0.0 {
                near = near.max(height / slope);
            } else if slope < 0.0 {
                far = far.min(height / slope);
            } else if height > 0.0 {
                return None;
            }
        }
        let share = chord / chord.dot(chord);
        let depth = |t: f64| {
            let p = place + direction * t;
            // As if the part was straight.
            let guess = span[0] + (span[1] - span[0]) * (p - start.position).dot(share);
            self.depth(p, direction, span, guess)
        };
        // Written so that NaN is no way.
        let ends = (near < far).then(|| entry_bracket(&depth, near, far)).flatten()?;
        let function = |t: f64| {
            let Depth { value, slope, .. } = depth(t);
            [value, slope]
        };
        let t = bracketed(function, ends, f64::NAN, false);
        Some((nearest + t, depth(t).u))
    }

    /// * `d`: the ray's direction. * `span`: the parameters of the part. * `guess`: where on the curve to begin.
    fn depth(&self, p: DVec3, d: DVec3, span: [f64; 2], guess: f64) -> Depth {
        let along = |u: f64| {
            let Center { position, tangent, .. } = self.at(u);
            let w = p - position;
            [w.dot(tangent), w.dot(self.curvature(u)[0]) - tangent.dot(tangent)]
        };
        let u = bracketed(along, span, guess, false);
        let Center { position, tangent, radius } = self.at(u);
        let w = p - position;
        let advance = d.dot(tangent) / (tangent.dot(tangent) - w.dot(self.curvature(u)[0]));
        let slope = 2.0 * (w.dot(d) - radius * self.growth(u) * advance);
        Depth { u, value: w.dot(w) - radius * radius, slope }
    }
}

/// Two parameters between which a function that is nearly a quadratic falls from above 0 to 0 or below.
fn entry_bracket(depth: &impl Fn(f64) -> Depth, near: f64, far: f64) -> Option<[f64; 2]> {
    let (first, last) = (depth(near), depth(far));
    let is_outside = first.value > 0.0;
    if is_outside && last.value <= 0.0 {
        return Some([near, far]);
    }
    // From outside through a minimum below 0, or from inside over a maximum above it and back.
    let side = if is_outside { 1.0 } else { -1.0 };
    if !(first.slope * side < 0.0 && last.slope * side > 0.0) || (last.value > 0.0) != is_outside {
        return None;
    }
    // Regula falsi for the slope, which is nearly linear.
    let [mut low, mut high] = [(near, first.slope), (far, last.slope)];
    for _ in 0..32 {
        let share = -low.1 / (high.1 - low.1);
        // Off the ends, so that the interval shrinks in any case.
        let t = low.0 + (high.0 - low.0) * share.clamp_to(1e-3, 1.0 - 1e-3);
        let Depth { value, slope, .. } = depth(t);
        if is_outside && value <= 0.0 {
            return Some([near, t]);
        }
        if !is_outside && value > 0.0 {
            return Some([t, far]);
        }
        // The slope is the steepest from here to the extremum.
        if Real::abs(value) > Real::abs(slope) * (high.0 - low.0) {
            return None;
        }
        if slope * side < 0.0 {
            low = (t, slope);
        } else {
            high = (t, slope);
        }
    }
    None
}

impl Bezier {
    fn ends(&self) -> [DVec3; 2] {
        [self.0[0].0, self.0[3].0]
    }

    fn chord(&self) -> DVec3 {
        let [start, end] = self.ends();
        end - start
    }

    fn is_straight(&self) -> bool {
        let chord = self.chord();
        let length = Vector3::length(chord);
        let legs = self.0.windows(2).map(|pair| pair[1].0 - pair[0].0);
        let is_aligned = |leg: DVec3| leg.dot(chord) >= STRAIGHT * Vector3::length(leg) * length;
        let [_, bend] = self.bulge();
        legs.into_iter().all(is_aligned) && bend <= EVEN * self.largest_radius()
    }

    fn is_slender(&self) -> bool {
        Vector3::length(self.chord()) > SLENDER * self.largest_radius()
    }

    fn largest_radius(&self) -> f64 {
        self.0.iter().fold(0.0, |largest, &(_, radius)| radius.abs().max(largest))
    }

    /// How far the curve and its radius are at most from what is linear between their ends: less than their inner control
    /// points.
    fn bulge(&self) -> [f64; 2] {
        let [(p, r), (q, s), (v, t), (w, x)] = self.0;
        let lerp = |share: f64| (p + (w - p) * share, r + (x - r) * share);
        let ((a, b), (c, e)) = (lerp(1.0 / 3.0), lerp(2.0 / 3.0));
        let position = Vector3::length(q - a).max(Vector3::length(v - c));
        [position, Real::abs(s - b).max(Real::abs(t - e))]
    }

    fn reach(&self) -> f64 {
        self.bulge()[0] + self.largest_radius()
    }
}
