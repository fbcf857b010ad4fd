//! Two children of the light tree side by side, and how a choice between them falls.

use etendue_math::Real;
use etendue_math::glam::Vec3;

use super::cluster::{Cluster, Faces};
use super::node::Node;
use super::receiver::{Receiver, Sides};

/// From how many radii away two clusters that shine in one direction are told apart by power only:
/// their squared distances differ by less than a factor of 4 then.
const FAR: f32 = 3.0;

/// Cosine above which normals count as one direction: within a thousandth of a radian.
const ALIGNED: f32 = 1.0 - 5e-7;

/// Two siblings.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    nodes: [Node; 2],
    panel: Option<Panel>,
}

/// Two clusters with one normal, seen as one.
#[derive(Clone, Copy, Debug)]
struct Panel {
    centre: Vec3,
    radius: f32,
    axis: Vec3,
    faces: Faces,
    /// The first cluster's share of the power.
    first: f32,
}

impl Pair {
    /// The pair of two nodes and the clusters that they stand for.
    pub(super) fn new(nodes: [Node; 2], clusters: [&Cluster; 2]) -> Self {
        Self { nodes, panel: Panel::new(clusters) }
    }

    /// The two.
    #[inline(always)]
    pub(super) fn nodes(&self) -> &[Node; 2] {
        &self.nodes
    }

    /// Probabilities of the two; `None` where neither is of importance.
    ///
    /// In proportion to [importance](Node::importance), or to power where both are far away and
    /// shine in the same direction: distance and cosines are much the same then.
    #[inline(always)]
    pub(super) fn shares(&self, receiver: &Receiver) -> Option<[f32; 2]> {
        if let Some(panel) = &self.panel {
            let to_panel = panel.centre - receiver.position;
            let distance_squared = to_panel.length_squared();
            if distance_squared > panel.radius * panel.radius * (FAR * FAR) {
                return panel.shares(receiver, to_panel, distance_squared);
            }
        }
        let [a, b] = [self.nodes[0].importance(receiver), self.nodes[1].importance(receiver)];
        match (a > 0.0, b > 0.0) {
            (true, true) => Some(split(a, b)),
            (true, false) => Some([1.0, 0.0]),
            (false, true) => Some([0.0, 1.0]),
            (false, false) => None,
        }
    }
}

impl Panel {
    fn new([a, b]: [&Cluster; 2]) -> Option<Self> {
        let both = a.union(b);
        let aligned = both.normals.cos_spread > ALIGNED && a.faces == b.faces;
        aligned.then(|| Self {
            centre: both.centre(),
            radius: both.radius(),
            axis: both.normals.axis,
            faces: both.faces,
            first: split(a.power, b.power)[0],
        })
    }

    /// `None` only where the whole sphere around the panel lies behind the receiver, or the receiver
    /// behind all of the panel.
    #[inline(always)]
    fn shares(
        &self,
        receiver: &Receiver,
        to_panel: Vec3,
        distance_squared: f32,
    ) -> Option<[f32; 2]> {
        // A thousandth of the distance covers the spread of the normals and all rounding.
        const SLACK: f32 = 1e-3;
        let is_behind = |height: f32| {
            let depth = height - self.radius;
            depth > 0.0 && depth * depth > SLACK * SLACK * distance_squared
        };
        let unlit = self.faces == Faces::Front && is_behind(to_panel.dot(self.axis));
        let unseen = receiver.sides == Sides::Front && is_behind(-to_panel.dot(receiver.normal));
        (!unlit && !unseen).then_some([self.first, 1.0 - self.first])
    }
}

/// Shares of two positive amounts.
///
/// `1 − first` instead of `b/(a + b)`: the second is taken for all the rest of the unit interval.
/// What is of some importance keeps it in the face of rounding.
#[inline(always)]
fn split(a: f32, b: f32) -> [f32; 2] {
    let first = (a / (a + b)).clamp(0.5 * f32::EPSILON, f32::ONE_MINUS_EPSILON);
    [first, 1.0 - first]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light_sampler::node::Link;

    /// Two patches of power 1 and 3, side by side at z = 0, that shine along +z and `axis`.
    fn pair(axis: Vec3) -> Pair {
        let clusters = [
            Cluster::patch(Vec3::new(-1.0, 0.0, 0.0), 1.0, Vec3::Z, 0.25),
            Cluster::patch(Vec3::new(1.0, 0.0, 0.0), 1.0, axis, 0.75),
        ];
        let nodes = [0, 1].map(|i| Node::new(&clusters[i], Link::Emitter(i as u32)));
        Pair::new(nodes, [&clusters[0], &clusters[1]])
    }

    fn receiver(position: Vec3, normal: Vec3) -> Receiver {
        Receiver { position, normal, sides: Sides::Front }
    }

    #[test]
    fn far_panels_share_by_power_and_near_ones_by_importance() {
        let shares = |x, z| pair(Vec3::Z).shares(&receiver(Vec3::new(x, 0.0, z), -Vec3::Z));
        assert_eq!(shares(-1.0, 20.0), Some([0.25, 0.75]));
        let [first, second] = shares(-1.0, 1.0).expect("both shine here");
        assert!(first > 0.25 && second > 0.0);
    }

    #[test]
    fn nothing_is_chosen_behind_a_panel_or_a_receiver_and_something_at_their_rims() {
        let shares = |position, normal| pair(Vec3::Z).shares(&receiver(position, normal));
        assert_eq!(shares(-20.0 * Vec3::Z, Vec3::Z), None);
        assert_eq!(shares(20.0 * Vec3::Z, Vec3::Z), None);
        // The panel's plane and the receiver's cross the other's sphere.
        assert!(shares(Vec3::new(20.0, 0.0, 1.0), -Vec3::X).is_some());
        assert!(shares(Vec3::new(0.0, 0.5, 20.0), Vec3::Y).is_some());
    }

    #[test]
    fn emitters_that_shine_elsewhere_are_told_apart_from_afar() {
        let shares = pair(-Vec3::Z).shares(&receiver(20.0 * Vec3::Z, -Vec3::Z));
        assert_eq!(shares, Some([1.0, 0.0]));
    }
}
