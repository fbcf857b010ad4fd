//! What a hierarchy of lights knows about the lights in a box.

use etendue_math::Real;
use etendue_math::glam::Vec3;

use super::{AreaLight, BeamLight, PointLight, ProjectorLight, SpotLight};
use crate::geometry::{Aabb, Shape};
use crate::texture::Textures;

/// From which side of its surface a light emits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EmissionSides {
    /// The side of the normal.
    One,
    /// Both.
    Both,
}

/// Where a light is, how strong it is, and where it can send light.
///
/// Normals lie within θo of the axis and light within θe of a normal.
///
/// # Source
/// Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting",
/// HPG 2018; in the form of pbrt-v4's `LightBounds`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightBounds {
    /// A box around the light.
    pub bounds: Aabb,
    /// Power in W. Of a spot light or a projector: what it would emit if it were as strong everywhere as along its
    /// axis, because the angles account for the cone.
    pub power: f32,
    /// Middle of the cone of normals, a unit vector.
    pub axis: Vec3,
    /// Cosine of θo; −1 for normals into all directions.
    pub cos_theta_o: f32,
    /// Cosine of θe; 0 for a surface.
    pub cos_theta_e: f32,
    /// Whether the back emits too.
    pub sides: EmissionSides,
}

impl LightBounds {
    /// Of one primitive of an area light: a triangle, or a whole shape of another kind. `None`
    /// where it has no area.
    pub(crate) fn of_primitive(
        light: AreaLight,
        shape: &Shape,
        textures: &Textures,
        primitive: u32,
    ) -> Option<Self> {
        let flat = !matches!(shape, Shape::Sphere(_) | Shape::Cylinder(_));
        let normal = shape.sample_area(primitive, [0.5; 2])?.normal;
        Some(Self {
            bounds: match shape {
                Shape::Mesh(mesh) => Aabb::from_points(mesh.corners(primitive)),
                shape => shape.bounds(),
            },
            power: light.power(textures, shape.primitive_area(primitive)),
            axis: if flat { normal } else { Vec3::Z },
            cos_theta_o: if flat { 1.0 } else { -1.0 },
            cos_theta_e: 0.0,
            sides: EmissionSides::One,
        })
    }

    /// Of a flat shape that emits along its normal only.
    pub(crate) fn of_beam(light: BeamLight, shape: &Shape, textures: &Textures) -> Self {
        Self {
            bounds: shape.bounds(),
            power: light.power(textures, shape.area_total()),
            axis: shape.sample_area(0, [0.5; 2]).map_or(Vec3::Z, |point| point.normal),
            cos_theta_o: 1.0,
            cos_theta_e: 1.0,
            sides: EmissionSides::One,
        }
    }

    /// Of a point light.
    pub(crate) fn of_point(light: &PointLight) -> Self {
        Self {
            bounds: Aabb::from_points([light.position]),
            power: light.power(),
            axis: Vec3::Z,
            cos_theta_o: -1.0,
            cos_theta_e: 0.0,
            sides: EmissionSides::One,
        }
    }

    /// Of a spot light: θo is the beam width and θe the transition, so that their sum is the cutoff.
    pub(crate) fn of_spot(light: &SpotLight, textures: &Textures) -> Self {
        let [cutoff, beam_width] = light.angles();
        Self {
            bounds: Aabb::from_points([light.position()]),
            power: 4.0 * f32::PI * light.peak(textures),
            axis: light.axis(),
            cos_theta_o: Real::cos(beam_width),
            cos_theta_e: Real::cos(cutoff - beam_width),
            sides: EmissionSides::One,
        }
    }

    /// Of a projector: θo is the angle of its picture's corners, for within the picture it does not grow weaker towards
    /// them.
    pub(crate) fn of_projector(light: &ProjectorLight, textures: &Textures) -> Self {
        Self {
            bounds: Aabb::from_points([light.position()]),
            power: 4.0 * f32::PI * light.peak(textures),
            axis: light.axis(),
            cos_theta_o: light.cos_corner(),
            cos_theta_e: 1.0,
            sides: EmissionSides::One,
        }
    }
}
