//! What a group of emitters looks like from afar: where it is, where it shines, how much.

use etendue_math::Real;
use etendue_math::glam::Vec3;

use super::cone::Cone;

/// Bounds of the positions, directions and power of a set of emitters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cluster {
    /// Lower corner of the box around all positions.
    pub(super) low: Vec3,
    /// Upper corner.
    pub(super) high: Vec3,
    /// Contains the emitters' axes, with spread θo.
    pub(super) normals: Cone,
    /// cos θe: light leaves within θe of an axis.
    pub(super) cos_emission: f32,
    /// Whether light leaves along the opposite axis too.
    pub(super) faces: Faces,
    /// Emitted power, in any unit common to all clusters.
    pub(super) power: f32,
}

/// The sides of its axis on which an emitter shines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Faces {
    /// Around the axis.
    Front,
    /// Around the axis and its opposite.
    Both,
}

impl Cluster {
    /// The cluster that contains both.
    pub(super) fn union(&self, other: &Self) -> Self {
        let faces = if self.faces == Faces::Both || other.faces == Faces::Both {
            Faces::Both
        } else {
            Faces::Front
        };
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            normals: self.normals.union(&other.normals),
            cos_emission: self.cos_emission.min(other.cos_emission),
            faces,
            power: self.power + other.power,
        }
    }

    /// Centre of the box.
    pub(super) fn centre(&self) -> Vec3 {
        // Halved before the sum: corners near ±f32::MAX do not overflow.
        self.low * 0.5 + self.high * 0.5
    }

    /// Radius of the sphere around the box.
    pub(super) fn radius(&self) -> f32 {
        (self.high * 0.5 - self.low * 0.5).length()
    }

    /// Squared diagonal of the box.
    fn diagonal_squared(&self) -> f32 {
        (self.high - self.low).length_squared()
    }

    /// Cost of having this cluster as a child: the surface area orientation heuristic.
    ///
    /// ```text
    /// cost = Φ · M_Ω · |diagonal|²,   θw = min(θo + θe, π)
    /// M_Ω = 2π(1 − cos θo) + π/2 (2 θw sin θo − cos(θo − 2θw) − 2 θo sin θo + cos θo)
    /// ```
    ///
    /// # Source
    /// Conty Estevez, Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting",
    /// PACMCGIT 1(2), 2018, equation 1. Departure: they take the box's surface area, which is 0 for
    /// all lights in a row and so cannot tell where to cut.
    pub(super) fn cost(&self) -> f32 {
        let cos_o = self.normals.cos_spread;
        let (theta_o, theta_e) = (Real::acos(cos_o), Real::acos(self.cos_emission));
        let theta_w = (theta_o + theta_e).min(f32::PI);
        let sin_o = (1.0 - cos_o * cos_o).safe_sqrt();
        let solid_angle = 2.0 * f32::PI * (1.0 - cos_o)
            + 0.5
                * f32::PI
                * (2.0 * theta_w * sin_o
                    - Real::cos(theta_o - 2.0 * theta_w)
                    - 2.0 * theta_o * sin_o
                    + cos_o);
        self.power * solid_angle * self.diagonal_squared()
    }
}

#[cfg(test)]
impl Cluster {
    /// A cluster of one point that shines everywhere.
    pub(super) fn point(position: Vec3, power: f32) -> Self {
        Self {
            low: position,
            high: position,
            normals: Cone::everything(),
            cos_emission: 0.0,
            faces: Faces::Front,
            power,
        }
    }

    /// A small patch that shines to the hemisphere around `axis`.
    pub(super) fn patch(position: Vec3, half_size: f32, axis: Vec3, power: f32) -> Self {
        Self {
            low: position - Vec3::splat(half_size),
            high: position + Vec3::splat(half_size),
            normals: Cone { axis, cos_spread: 1.0 },
            cos_emission: 0.0,
            faces: Faces::Front,
            power,
        }
    }
}
