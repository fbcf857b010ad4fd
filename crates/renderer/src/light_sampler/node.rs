//! One node of the light tree, and its importance to a receiver.

use etendue_math::Real;
use etendue_math::glam::Vec3;

use super::cluster::{Cluster, Faces};
use super::receiver::{Receiver, Sides};

/// A cluster, with what its importance needs computed beforehand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    centre: Vec3,
    radius: f32,
    axis: Vec3,
    power: f32,
    /// Half angle θo of the cone of normals.
    normals: Angle,
    /// cos θe, beyond which nothing is emitted.
    cos_emission: f32,
    link: u32,
}

/// What hangs below a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Link {
    /// A pair of nodes, by index.
    Pair(u32),
    /// An emitter, by index.
    Emitter(u32),
}

const EMITTER: u32 = 1 << 31;
const BOTH_FACES: u32 = 1 << 30;
const INDEX: u32 = BOTH_FACES - 1;

impl Node {
    /// How many emitters a tree can hold.
    pub(super) const MAX_EMITTERS: usize = INDEX as usize;

    /// The node of a cluster whose power is a share of the total, in (0, 1].
    pub(super) fn new(cluster: &Cluster, link: Link) -> Self {
        let kind = match link {
            Link::Pair(index) => index,
            Link::Emitter(index) => index | EMITTER,
        };
        let faces = if cluster.faces == Faces::Both { BOTH_FACES } else { 0 };
        Self {
            centre: cluster.centre(),
            radius: cluster.radius(),
            axis: cluster.normals.axis,
            power: cluster.power,
            normals: Angle::from_cos(cluster.normals.cos_spread),
            cos_emission: cluster.cos_emission,
            link: kind | faces,
        }
    }

    /// What hangs below.
    #[inline(always)]
    pub(super) fn link(&self) -> Link {
        let index = self.link & INDEX;
        if self.link & EMITTER == 0 { Link::Pair(index) } else { Link::Emitter(index) }
    }

    /// An estimate of the irradiance the cluster's light makes at the receiver, unoccluded; 0 only
    /// where it makes none.
    ///
    /// ```text
    /// I = Φ cos θ' cos θi' / max(d², r²)
    /// θ'  = max(0, θw − θo − θb) ≤ θe,   θi' = max(0, θi − θb)
    /// ```
    ///
    /// θw between axis and receiver, θi between receiver's normal and cluster, θb the half angle
    /// under which the sphere around the cluster (radius r) is seen.
    ///
    /// # Source
    /// Conty Estevez, Kulla 2018, equation 3; Pharr, Jakob, Humphreys, "Physically Based
    /// Rendering", 4th edition, section 12.6.3. Departures: the distance is limited by r² (there:
    /// by r, which depends on the unit of length), and a receiver that only reflects sees
    /// nothing behind it.
    #[inline(always)]
    pub(super) fn importance(&self, receiver: &Receiver) -> f32 {
        let to_cluster = self.centre - receiver.position;
        self.importance_along(
            to_cluster.length_squared(),
            to_cluster.dot(self.axis),
            to_cluster.dot(receiver.normal),
            receiver.sides,
        )
    }

    /// Whether any of the light can arrive: `false` only where the importance is 0, at the cost of two products.
    #[inline(always)]
    pub(super) fn may_reach(&self, receiver: &Receiver) -> bool {
        // A thousandth of the size covers rounding.
        let reach = self.radius * 1.001;
        let to_cluster = self.centre - receiver.position;
        let behind = receiver.sides == Sides::Front && to_cluster.dot(receiver.normal) < -reach;
        // A flat emitter shines to the front of its plane.
        let is_flat =
            self.normals.cos == 1.0 && self.cos_emission >= 0.0 && self.link & BOTH_FACES == 0;
        let averted = is_flat && to_cluster.dot(self.axis) > reach;
        !(behind || averted)
    }

    /// The same from the squared distance of the cluster and its projections on its own axis and on
    /// the receiver's normal.
    ///
    /// Out of line; numbers instead of the receiver, which a reference would keep in memory on every
    /// path.
    #[inline(never)]
    fn importance_along(
        &self,
        distance_squared: f32,
        along_axis: f32,
        along_normal: f32,
        sides: Sides,
    ) -> f32 {
        // Cosines of clamped differences; a thousandth covers the rounding of all that follows.
        const GRAZING: f32 = 1e-3;
        let radius_squared = self.radius * self.radius;
        if distance_squared <= radius_squared || distance_squared < f32::MIN_POSITIVE {
            return self.power / radius_squared.max(NEAREST);
        }
        let per_distance = 1.0 / distance_squared.sqrt();
        let bound = Angle::from_sin(self.radius * per_distance);

        let cos_w = -along_axis * per_distance;
        let cos_w = if self.link & BOTH_FACES == 0 { cos_w } else { cos_w.abs() };
        let emission = Angle::from_cos(cos_w).minus(self.normals).minus(bound);
        if emission.cos < self.cos_emission - GRAZING {
            return 0.0;
        }
        let cos_i = along_normal * per_distance;
        let cos_i = match sides {
            Sides::Front => cos_i,
            Sides::Both => cos_i.abs(),
            Sides::Around => 1.0,
        };
        let incident = Angle::from_cos(cos_i).minus(bound);
        if incident.cos < -GRAZING {
            return 0.0;
        }
        self.power
            * emission.cos.max(GRAZING)
            * incident.cos.max(GRAZING)
            * (per_distance * per_distance)
    }
}

/// The smallest squared radius that counts: keeps importances finite.
const NEAREST: f32 = 1e-30;

/// An angle in [0, π] by its sine and cosine.
#[derive(Clone, Copy, Debug)]
struct Angle {
    cos: f32,
    sin: f32,
}

impl Angle {
    #[inline(always)]
    fn from_cos(cos: f32) -> Self {
        Self { cos, sin: (1.0 - cos * cos).safe_sqrt() }
    }

    /// The acute angle of a sine.
    #[inline(always)]
    fn from_sin(sin: f32) -> Self {
        Self { cos: (1.0 - sin * sin).safe_sqrt(), sin }
    }

    /// max(0, self − other).
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        if self.cos >= other.cos {
            return Self { cos: 1.0, sin: 0.0 };
        }
        Self {
            cos: self.cos * other.cos + self.sin * other.sin,
            sin: self.sin * other.cos - self.cos * other.sin,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn receiver(position: Vec3, normal: Vec3, sides: Sides) -> Receiver {
        Receiver { position, normal, sides }
    }

    #[test]
    fn a_point_light_is_worth_cosine_over_squared_distance() {
        let node = Node::new(&Cluster::point(Vec3::new(0.0, 0.0, 2.0), 0.5), Link::Emitter(0));
        let n = Vec3::new(0.6, 0.0, 0.8);
        let importance = node.importance(&receiver(Vec3::ZERO, n, Sides::Front));
        // A few roundings.
        assert!((importance - 0.5 * 0.8 / 4.0).abs() < 1e-6);
    }

    #[test]
    fn light_behind_an_opaque_receiver_or_behind_the_emitter_is_worth_nothing() {
        let patch = Cluster::patch(Vec3::new(0.0, 0.0, 5.0), 0.1, -Vec3::Z, 1.0);
        let node = Node::new(&patch, Link::Emitter(0));
        let at = |z: f32, normal, sides| {
            node.importance(&receiver(Vec3::new(0.0, 0.0, z), normal, sides))
        };
        assert!(at(0.0, Vec3::Z, Sides::Front) > 0.0);
        assert_eq!(at(0.0, -Vec3::Z, Sides::Front), 0.0);
        assert!(at(0.0, -Vec3::Z, Sides::Both) > 0.0);
        assert_eq!(at(10.0, -Vec3::Z, Sides::Front), 0.0);
    }

    #[test]
    fn importance_is_finite_on_top_of_a_light() {
        let node = Node::new(&Cluster::point(Vec3::ONE, 1.0), Link::Emitter(0));
        let importance = node.importance(&receiver(Vec3::ONE, Vec3::Z, Sides::Front));
        assert!(importance.is_finite() && importance > 0.0);
    }
}
