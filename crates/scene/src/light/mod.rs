//! What light comes from.

mod area;
mod beam;
mod bounds;
mod environment;
mod point;
mod projector;
mod spot;

use etendue_brdf::Density;
use etendue_math::glam::Vec3;

pub use area::AreaLight;
pub use beam::BeamLight;
pub use bounds::{EmissionSides, LightBounds};
pub use environment::EnvironmentLight;
pub use point::{ConstantLight, DirectionalLight, PointLight};
pub use projector::ProjectorLight;
pub use spot::SpotLight;

use crate::Color;
use crate::texture::TextureId;

/// Names a light of a scene by its place in the scene's list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LightId(pub u32);

/// A source of light.
#[derive(Clone, Debug)]
pub enum Light {
    /// A shape that emits from its front side.
    Area(AreaLight),
    /// A flat shape that emits along its normal only.
    Beam(BeamLight),
    /// A point that emits evenly into all directions.
    Point(PointLight),
    /// A point that emits into a cone.
    Spot(SpotLight),
    /// A point that throws a picture.
    Projector(ProjectorLight),
    /// Parallel light from infinitely far away.
    Directional(DirectionalLight),
    /// The same light from all directions.
    Constant(ConstantLight),
    /// A picture of all directions.
    Environment(EnvironmentLight),
}

impl Light {
    /// Whether the light surrounds the scene instead of having a place in it.
    #[inline]
    pub fn is_infinite(&self) -> bool {
        matches!(self, Self::Directional(_) | Self::Constant(_) | Self::Environment(_))
    }

    /// Whether only light sampling finds it: no ray hits a point or a single direction.
    #[inline]
    pub fn is_delta(&self) -> bool {
        match self {
            Self::Beam(_)
            | Self::Point(_)
            | Self::Spot(_)
            | Self::Projector(_)
            | Self::Directional(_) => true,
            Self::Area(_) | Self::Constant(_) | Self::Environment(_) => false,
        }
    }

    /// How much of an infinite light needs light samples, in [0, 1]: the share that is brighter than its mean over all directions. What
    /// is even, scattered rays find as well. 1 for lights with a place, and for those that no scattered ray finds.
    pub fn excess(&self) -> f32 {
        match self {
            Self::Constant(_) => 0.0,
            Self::Environment(light) => light.excess(),
            _ => 1.0,
        }
    }

    /// Where it is, of a light that is a single point.
    pub fn position(&self) -> Option<Vec3> {
        match self {
            Self::Point(light) => Some(light.position),
            Self::Spot(light) => Some(light.position()),
            Self::Projector(light) => Some(light.position()),
            Self::Area(_)
            | Self::Beam(_)
            | Self::Directional(_)
            | Self::Constant(_)
            | Self::Environment(_) => None,
        }
    }

    /// A stretch of a ray, from one distance to another, beyond which light of a single point lights none of it; `None` where
    /// it lights nothing of it. Of other lights the whole ray.
    ///
    /// * `along`: a unit vector.
    /// * `length`: may be infinite.
    ///
    /// Both ends are rounded.
    pub fn lit_stretch(&self, origin: Vec3, along: Vec3, length: f32) -> Option<[f32; 2]> {
        let [start, end] = match self {
            Self::Spot(light) => light.lit_line(origin, along)?,
            Self::Projector(light) => light.lit_line(origin, along),
            _ => [0.0, length],
        };
        let (start, end) = (start.max(0.0), end.min(length));
        (start < end).then_some([start, end])
    }

    /// The texture of its radiance, intensity or irradiance; the map of an environment belongs to the light itself.
    pub fn texture(&self) -> Option<TextureId> {
        match self {
            Self::Area(light) => Some(light.radiance),
            Self::Beam(light) => Some(light.exitance),
            Self::Spot(light) => light.texture(),
            Self::Projector(light) => Some(light.texture()),
            Self::Point(_) | Self::Directional(_) | Self::Constant(_) | Self::Environment(_) => {
                None
            }
        }
    }
}

/// Light that arrives at a point from a sampled direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample<S = Color> {
    /// Unit vector towards the light.
    pub direction: Vec3,
    /// The point on the light, moved off its surface already; `None` for a light infinitely far.
    pub target: Option<Vec3>,
    /// Radiance from there in W sr⁻¹ m⁻²; for a [`Density::Delta`] the irradiance in W m⁻² on a
    /// surface that faces it. What lies between is not considered.
    pub radiance: S,
    /// How likely the direction was, given the light and its primitive.
    pub density: Density<f32>,
}

/// Why a light is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LightError {
    /// Radiance, intensity or irradiance is NaN, infinite or negative.
    #[error("the emitted light is not finite and non-negative in every channel")]
    Emission,
    /// The position is NaN or infinite.
    #[error("the position is not finite")]
    Position,
    /// The direction is zero, NaN or infinite.
    #[error("the direction has no length")]
    Direction,
    /// The angles of a spot light are not `0 ≤ beam width ≤ cutoff ≤ 180` with a positive cutoff.
    #[error("the beam width must lie between 0 and the cutoff angle, and that at most at 180°")]
    Cone,
    /// The field of view of a projector is outside its domain, or its picture has no pixels.
    #[error("the field of view must lie between 0° and 180°")]
    FieldOfView,
    /// The transform of an environment map does more than rotate, mirror and scale evenly.
    #[error("the transform of an environment map may only rotate, mirror and scale evenly")]
    Transform,
}

/// Finite and not negative in every channel.
fn is_emission(color: Color) -> bool {
    color.to_array().iter().all(|c| c.is_finite() && *c >= 0.0)
}

#[cfg(test)]
mod tests;
