//! What a ray finds on a surface.

use etendue_math::Frame;
use etendue_math::glam::Vec3;

use super::{Hit, Ray, ShapeId, ShapeSample, Transform, offset_point};

/// A point on a surface, with all that shading needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Where it is, in world space.
    pub position: Vec3,
    /// Absolute bound on the error of the position, per axis.
    pub error: Vec3,
    /// Unit geometric normal, on the front side of the shape.
    pub normal: Vec3,
    /// Shading frame: `n` is the interpolated normal, `s` lies along `∂p/∂u`.
    ///
    /// It belongs to the shape's front side whatever side the ray came from.
    pub shading: Frame<f32>,
    /// Texture coordinates.
    pub uv: [f32; 2],
    /// The shape.
    pub shape: ShapeId,
    /// The primitive within the shape, for [`Shape::pdf_from`](super::Shape::pdf_from).
    pub primitive: u32,
    /// Barycentric weights of the second and third corner of a triangle; 0 on shapes without triangles.
    pub barycentric: [f32; 2],
    /// The instance through which the shape is seen, or `u32::MAX` for none.
    pub instance: u32,
    /// When it is there, in shares of the exposure.
    pub time: f32,
}

/// What a shape knows of a point on it, in its own space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LocalSurface {
    pub(crate) position: Vec3,
    pub(crate) error: Vec3,
    pub(crate) normal: Vec3,
    pub(crate) shading_normal: Vec3,
    pub(crate) uv: [f32; 2],
    /// `∂p/∂u`, where the shape has texture coordinates.
    pub(crate) tangent: Option<Vec3>,
    pub(crate) primitive: u32,
}

impl LocalSurface {
    /// The same point placed by an instance's transform.
    pub(crate) fn transformed(self, t: &Transform) -> Self {
        let position = t.point(self.position);
        Self {
            position,
            error: t.round_trip_error(self.position, self.error, position),
            normal: t.normal(self.normal),
            shading_normal: t.normal(self.shading_normal),
            tangent: self.tangent.map(|tangent| t.vector(tangent)),
            ..self
        }
    }

    #[inline(always)]
    pub(crate) fn of(self, hit: &Hit) -> SurfacePoint {
        let shading = match self.tangent {
            Some(tangent) => Frame::from_normal_and_tangent(self.shading_normal, tangent),
            None => Frame::from_normal(self.shading_normal),
        };
        SurfacePoint {
            position: self.position,
            error: self.error,
            normal: self.normal,
            shading,
            uv: self.uv,
            shape: hit.shape,
            primitive: self.primitive,
            barycentric: hit.uv,
            instance: hit.instance,
            time: hit.time,
        }
    }
}

impl SurfacePoint {
    /// A ray without end that leaves the surface to the side of `direction`.
    #[inline(always)]
    pub fn spawn(&self, direction: Vec3) -> Ray {
        Ray::new(self.offset_towards(direction), direction)
    }

    /// The segment from here to a point that lies on no surface, or was moved off it already.
    #[inline(always)]
    pub fn spawn_to(&self, target: Vec3) -> Ray {
        Ray::between(self.offset_towards(target - self.position), target)
    }

    /// The segment from here to a sampled point of another surface, which it does not touch.
    #[inline(always)]
    pub fn spawn_to_sample(&self, sample: &ShapeSample) -> Ray {
        self.spawn_to(sample.seen_from(self.position))
    }

    #[inline(always)]
    fn offset_towards(&self, direction: Vec3) -> Vec3 {
        offset_point(self.position, self.error, self.normal, direction)
    }
}
