//! Curves with thickness: hair, grass, wires.

mod cone;
mod frame;
mod points;
mod spline;
#[cfg(test)]
mod tests;

use alloc::vec::Vec;

use etendue_math::glam::{DVec3, Vec3};
use etendue_math::{Real, Vector3};

use super::sphere::{round_point, uniform_scale};
use super::surface::LocalSurface;
use super::{Aabb, Ray, ShapeError, Transform};
use cone::RoundCone;
use frame::Around;
pub use points::{CurveBasis, CurveError, CurvePoint};
use spline::{Center, Part, Spline};

/// Curves of one kind with a radius at each control point.
///
/// [Linear](CurveBasis::Linear) curves are what a sphere sweeps that goes from point to point: cones with round joints
/// and ends. [B-splines](CurveBasis::BSpline) are what a circle across the curve sweeps; their ends are open where the
/// radius is not 0. Both are met from outside only: a ray that starts inside passes through the wall. The front is
/// outside. No points are drawn on curves.
///
/// `u` is the angle around the curve over 2π (`Around`), `v` the number of the segment and the way in it over the
/// number of all segments.
///
/// # Numerics
/// Each segment of a linear curve is an object of the hierarchy, and so is each nearly straight part of a B-spline. Hits
/// are found in `f64` (`RoundCone::entry`, `Spline::entry`) from a place next to the object, and moved to its
/// surface at the distance of the radius from the curve. So a hit has the bound of rounding to `f32`, whatever the
/// distance and the angle from which it is seen, and the noise of `f64` in coordinates of the curve.
///
/// # Source
/// Definitions as in Mitsuba 3, `src/shapes/linearcurve.cpp` and `bsplinecurve.cpp`, which leaves what is hit to Embree.
#[derive(Clone, Debug, PartialEq)]
pub struct Curves {
    basis: CurveBasis,
    /// In world space.
    points: Vec<CurvePoint>,
    /// The first control point of each segment; not empty.
    segments: Vec<u32>,
    /// Of B-splines.
    parts: Vec<Part>,
    /// +1 where the front is outside, −1 where it is inside.
    side: f64,
}

/// The objects of all shapes are numbered with 30 bits; no curves alone have more than a quarter of these.
const MOST_OBJECTS: usize = 1 << 28;

/// A hit before it is rounded: the ray's parameter, the segment, and the way in it.
struct Entry {
    t: f64,
    segment: u32,
    v: f64,
}

impl Curves {
    /// Curves that follow one another in `points`, `lengths` points each; the transform moves the points and leaves the
    /// radii, as in Mitsuba.
    ///
    /// # Errors
    /// No curve, curves of fewer than 2 (B-splines: 4) points, lengths that do not add up to the number of points,
    /// coordinates and radii that are not finite, radii below 0, more objects than can be numbered.
    pub fn new(
        basis: CurveBasis,
        mut points: Vec<CurvePoint>,
        lengths: &[u32],
        transform: &Transform,
    ) -> Result<Self, ShapeError> {
        let segments = points::segments(basis, &points, lengths)?;
        for point in &mut points {
            point.position = transform.point(point.position);
        }
        Self::of_segments(basis, points, segments)
    }

    fn of_segments(
        basis: CurveBasis,
        points: Vec<CurvePoint>,
        segments: Vec<u32>,
    ) -> Result<Self, ShapeError> {
        if !points.iter().all(|point| point.position.is_finite() && point.radius.is_finite()) {
            return Err(ShapeError::OutOfRange);
        }
        let mut curves = Self { basis, points, segments, parts: Vec::new(), side: 1.0 };
        if basis == CurveBasis::BSpline {
            let mut parts = Vec::new();
            for segment in 0..curves.segment_count() {
                curves.spline(segment).split(segment, &mut parts);
                if parts.len() > MOST_OBJECTS {
                    return Err(CurveError::TooMany.into());
                }
            }
            curves.parts = parts;
        } else if curves.segments.len() > MOST_OBJECTS {
            return Err(CurveError::TooMany.into());
        }
        Ok(curves)
    }

    /// The curves moved by a transform, which scales their radii as well.
    pub(super) fn transformed(self, transform: &Transform) -> Result<Self, ShapeError> {
        let scale = uniform_scale(transform).ok_or(ShapeError::NonUniformScale)?;
        let Self { basis, mut points, segments, side, .. } = self;
        for point in &mut points {
            point.position = transform.point(point.position);
            point.radius = (f64::from(point.radius) * scale) as f32;
        }
        Ok(Self { side, ..Self::of_segments(basis, points, segments)? })
    }

    /// How points make a curve.
    pub fn basis(&self) -> CurveBasis {
        self.basis
    }

    /// The control points, in world space.
    pub fn points(&self) -> &[CurvePoint] {
        &self.points
    }

    /// The first control point of each segment, in order.
    pub fn segments(&self) -> &[u32] {
        &self.segments
    }

    /// Whether front and back are exchanged.
    pub fn is_flipped(&self) -> bool {
        self.side < 0.0
    }

    /// The same curves with front and back exchanged. They are met from outside as before.
    #[must_use]
    pub fn flipped(self) -> Self {
        Self { side: -self.side, ..self }
    }

    /// Segments of all curves.
    pub fn segment_count(&self) -> u32 {
        self.segments.len() as u32
    }

    /// Segments of linear curves, parts of B-splines.
    pub(crate) fn object_count(&self) -> u32 {
        match self.basis {
            CurveBasis::Linear => self.segment_count(),
            CurveBasis::BSpline => self.parts.len() as u32,
        }
    }

    pub(crate) fn bounds(&self) -> Aabb {
        (0..self.object_count()).fold(Aabb::EMPTY, |all, i| all.union(self.object_bounds(i)))
    }

    pub(crate) fn object_bounds(&self, object: u32) -> Aabb {
        match self.basis {
            CurveBasis::Linear => self.cone(object).bounds(),
            CurveBasis::BSpline => {
                let part = &self.parts[object as usize];
                self.spline(part.segment).bounds(part)
            }
        }
    }

    fn cone(&self, segment: u32) -> RoundCone {
        let first = self.segments[segment as usize] as usize;
        RoundCone::between(&self.points[first], &self.points[first + 1])
    }

    fn spline(&self, segment: u32) -> Spline {
        let first = self.segments[segment as usize] as usize;
        Spline::of(core::array::from_fn(|i| &self.points[first + i]))
    }

    fn entry(&self, object: u32, ray: &Ray) -> Option<Entry> {
        match self.basis {
            CurveBasis::Linear => {
                let (t, v) = self.cone(object).entry(ray)?;
                Some(Entry { t, segment: object, v })
            }
            CurveBasis::BSpline => {
                let part = self.parts.get(object as usize)?;
                let passage = part.passage(ray)?;
                let (t, v) = self.spline(part.segment).entry(part, &passage)?;
                Some(Entry { t, segment: part.segment, v })
            }
        }
    }

    pub(crate) fn intersect(&self, object: u32, ray: &Ray) -> Option<f32> {
        let t = self.entry(object, ray)?.t as f32;
        (t > 0.0 && t < ray.t_max).then_some(t)
    }

    pub(crate) fn surface(&self, object: u32, ray: &Ray, t: f32) -> LocalSurface {
        // The same as has been hit: only a caller that mixes up hits and rays finds none.
        let endless = Ray { t_max: f32::INFINITY, ..*ray };
        let entry = self.entry(object, &endless);
        let Entry { t, segment, v } =
            entry.unwrap_or(Entry { t: f64::from(t), segment: 0, v: 0.0 });
        let p = ray.origin.as_dvec3() + ray.direction.as_dvec3() * t;
        match self.basis {
            CurveBasis::Linear => self.on_cone(segment, v, p),
            CurveBasis::BSpline => self.on_spline(segment, v, p),
        }
    }

    /// Without a tangent along `u`, as in Mitsuba 3.9.
    fn on_cone(&self, segment: u32, v: f64, p: DVec3) -> LocalSurface {
        let cone = self.cone(segment);
        let (center, radius) = cone.sphere(v);
        let axis = Vector3::try_normalize(cone.axis).unwrap_or(DVec3::Z);
        let outward = Vector3::try_normalize(p - center).unwrap_or(DVec3::Z);
        let u = Around::of(axis).turn(outward);
        self.local(&Placed { center, radius, outward, normal: outward, uv: [u, v], segment }, None)
    }

    fn on_spline(&self, segment: u32, v: f64, p: DVec3) -> LocalSurface {
        let spline = self.spline(segment);
        let Center { position: center, tangent, radius } = spline.at(v);
        let w = p - center;
        let along = Vector3::try_normalize(tangent).unwrap_or(DVec3::Z);
        let outward = Vector3::try_normalize(w - along * w.dot(along)).unwrap_or(DVec3::Z);
        let stretch = tangent.dot(tangent) - radius * outward.dot(spline.curvature(v)[0]);
        let normal = outward * stretch - tangent * spline.growth(v);
        let normal = Vector3::try_normalize(normal).unwrap_or(outward);
        let u = Around::of(along).turn(outward);
        let around = along.cross(outward);
        self.local(
            &Placed { center, radius, outward, normal, uv: [u, v], segment },
            Some(around.as_vec3()),
        )
    }

    fn local(&self, placed: &Placed, tangent: Option<Vec3>) -> LocalSurface {
        let Placed { center, radius, outward, normal, uv: [u, v], segment } = *placed;
        let (position, error) = round_point(center + outward * radius, center, radius);
        let normal = (normal * self.side).as_vec3();
        let v = (v + f64::from(segment)) / f64::from(self.segment_count());
        LocalSurface {
            position,
            error,
            normal,
            shading_normal: normal,
            uv: [u as f32, v as f32],
            tangent,
            primitive: segment,
        }
    }

    /// `∂p/∂u` and `∂p/∂v` on a segment.
    ///
    /// Along B-splines with the twist of the curve itself, as in Mitsuba, where that of [`Around`] would be exact.
    pub(crate) fn partials(&self, segment: u32, [u, v]: [f32; 2]) -> [Vec3; 2] {
        if segment >= self.segment_count() {
            return [Vec3::ZERO; 2];
        }
        let count = f64::from(self.segment_count());
        let v = (f64::from(v) * count - f64::from(segment)).clamp_to(0.0, 1.0);
        let turn = 2.0 * <f64 as Real>::PI;
        let unit = |direction: DVec3| Vector3::try_normalize(direction).unwrap_or(DVec3::Z);
        let [around, along] = match self.basis {
            CurveBasis::Linear => {
                let cone = self.cone(segment);
                let (axis, [r, s]) = (unit(cone.axis), cone.radii);
                // How the normal leans on the cone.
                let sine = ((r - s) / Vector3::length(cone.axis)).clamp_to(-1.0, 1.0);
                let ring = Around::of(axis).at(f64::from(u)) * Real::sqrt(1.0 - sine * sine);
                let outward = ring + axis * sine;
                let (_, radius) = cone.sphere(v);
                [axis.cross(outward) * radius, cone.axis + outward * (s - r)]
            }
            CurveBasis::BSpline => {
                let spline = self.spline(segment);
                let Center { tangent, radius, .. } = spline.at(v);
                let [second, third] = spline.curvature(v);
                let along = unit(tangent);
                let outward = Around::of(along).at(f64::from(u));
                let around = along.cross(outward);
                let binormal = tangent.cross(second);
                let twist = third.dot(binormal) / binormal.dot(binormal);
                let speed = Vector3::length(tangent);
                let twist = if twist.is_finite() { twist * speed } else { 0.0 };
                let bend = second.dot(outward) / speed;
                let bend = if bend.is_finite() { bend } else { 0.0 };
                let change = around * twist - along * bend;
                [around * radius, tangent + outward * spline.growth(v) + change * radius]
            }
        };
        [(around * turn).as_vec3(), (along * count).as_vec3()]
    }
}

/// A point on a curve: `center + outward · radius`.
struct Placed {
    center: DVec3,
    radius: f64,
    outward: DVec3,
    normal: DVec3,
    /// The second one in the segment.
    uv: [f64; 2],
    segment: u32,
}

/// The box in `f32` around one in `f64`: a step outwards for the rounding, and the noise of `f64`.
fn outwards(low: DVec3, high: DVec3) -> Aabb {
    let noise = low.abs().max(high.abs()) * (16.0 * f64::EPSILON);
    let (low, high) = ((low - noise).as_vec3(), (high + noise).as_vec3());
    Aabb {
        min: Vec3::new(low.x.next_down(), low.y.next_down(), low.z.next_down()),
        max: Vec3::new(high.x.next_up(), high.y.next_up(), high.z.next_up()),
    }
}
