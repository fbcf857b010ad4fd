//! The light tree: choosing one of many emitters in logarithmic time.

use etendue_math::Real;

use super::build::{Builder, Emitter};
use super::cluster::Cluster;
use super::node::{Link, Node};
use super::pair::Pair;
use super::receiver::Receiver;

/// A bounding volume hierarchy over emitters with bounds on where they shine.
///
/// At every node the child is chosen in proportion to its importance to the receiver.
///
/// # Source
/// Conty Estevez, Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting",
/// PACMCGIT 1(2), 2018, without the splitting.
#[derive(Clone, Debug)]
pub(super) struct LightTree {
    root: Option<Node>,
    pairs: Vec<Pair>,
    trails: Vec<u64>,
}

/// An emitter by index, and the probability with which it was chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Chosen {
    pub(super) emitter: u32,
    pub(super) probability: f32,
}

impl LightTree {
    /// The tree over the given emitters; those beyond 2³⁰ are left out.
    pub(super) fn new(clusters: &[Cluster]) -> Self {
        let clusters = &clusters[..clusters.len().min(Node::MAX_EMITTERS)];
        let total: f64 = clusters.iter().map(|c| f64::from(c.power)).sum();
        // Shares of the total keep importances finite and away from underflow.
        let share = |power: f32| (f64::from(power) / total) as f32;
        let mut emitters: Vec<Emitter> = (0..)
            .zip(clusters)
            .map(|(index, c)| Emitter { cluster: Cluster { power: share(c.power), ..*c }, index })
            .collect();
        let mut builder = Builder { trails: vec![0; emitters.len()], pairs: Vec::new() };
        let root = builder.build(&mut emitters, 0, 0).map(|subtree| subtree.node);
        Self { root, pairs: builder.pairs, trails: builder.trails }
    }

    /// Whether there is nothing to choose from.
    pub(super) fn is_empty(&self) -> bool {
        self.root.is_none()
    }

    /// Chooses an emitter by one uniform number; `None` where none can light the receiver.
    #[inline(always)]
    pub(super) fn choose(&self, receiver: &Receiver, mut u: f32) -> Option<Chosen> {
        let mut link = self.root_for(receiver)?.link();
        let mut probability = 1.0;
        loop {
            match link {
                Link::Emitter(emitter) => return Some(Chosen { emitter, probability }),
                Link::Pair(index) => {
                    let pair = &self.pairs[index as usize];
                    let shares = pair.shares(receiver)?;
                    // Looked up: a branch would be as good as random.
                    let side = usize::from(u >= shares[0]);
                    link = pair.nodes()[side].link();
                    probability *= shares[side];
                    u = (u - [0.0, shares[0]][side]) / shares[side];
                    u = u.min(f32::ONE_MINUS_EPSILON);
                }
            }
        }
    }

    /// The probability with which `choose` returns `emitter`, the same bits.
    #[inline(always)]
    pub(super) fn probability(&self, receiver: &Receiver, emitter: u32) -> f32 {
        self.try_probability(receiver, emitter).unwrap_or(0.0)
    }

    fn try_probability(&self, receiver: &Receiver, emitter: u32) -> Option<f32> {
        let mut trail = *self.trails.get(emitter as usize)?;
        let mut link = self.root_for(receiver)?.link();
        let mut probability = 1.0;
        while let Link::Pair(index) = link {
            let pair = &self.pairs[index as usize];
            let side = (trail & 1) as usize;
            trail >>= 1;
            probability *= pair.shares(receiver)?[side];
            link = pair.nodes()[side].link();
        }
        Some(probability)
    }

    /// The root, if it can be of any importance. Importances are not asked for here: a tree of more than one emitter decides at
    /// its first pair, and a single one is chosen in any case.
    #[inline(always)]
    fn root_for(&self, receiver: &Receiver) -> Option<&Node> {
        let root = self.root.as_ref()?;
        let decides_below = matches!(root.link(), Link::Pair(_));
        (decides_below || root.may_reach(receiver)).then_some(root)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light_sampler::receiver::Sides;
    use etendue_math::glam::Vec3;
    use etendue_math::hash_u32;

    const DRAWS: u32 = 20_000;

    fn random(seed: u32) -> f32 {
        f32::from_random_bits(u64::from(hash_u32(seed)) << 32)
    }

    fn random_clusters(count: u32) -> Vec<Cluster> {
        (0..count)
            .map(|i| {
                let r = |k: u32| random(i * 8 + k) * 2.0 - 1.0;
                let position = Vec3::new(r(0), r(1), r(2)) * 10.0;
                let axis = Vec3::new(r(3), r(4), r(5)).try_normalize().unwrap_or(Vec3::Z);
                Cluster::patch(position, 0.01, axis, 0.1 + random(i * 8 + 6))
            })
            .collect()
    }

    const RECEIVER: Receiver =
        Receiver { position: Vec3::new(0.5, 0.25, -0.75), normal: Vec3::Z, sides: Sides::Front };

    #[test]
    fn chosen_probabilities_are_the_asked_ones_to_the_bit() {
        for count in [1, 2, 3, 10, 1000] {
            let tree = LightTree::new(&random_clusters(count));
            for i in 0..2000 {
                if let Some(chosen) = tree.choose(&RECEIVER, random(i)) {
                    assert_eq!(tree.probability(&RECEIVER, chosen.emitter), chosen.probability);
                    assert!(chosen.probability > 0.0);
                }
            }
        }
    }

    #[test]
    fn probabilities_sum_to_one_and_frequencies_follow_them() {
        let tree = LightTree::new(&random_clusters(20));
        let asked: Vec<f32> = (0..20).map(|e| tree.probability(&RECEIVER, e)).collect();
        let mut counts = [0_u32; 20];
        // A cluster may be of importance where neither of its children is: nothing is chosen then.
        let mut nothing = 0_u32;
        for i in 0..DRAWS {
            let u = (i as f32 + 0.5) / DRAWS as f32;
            match tree.choose(&RECEIVER, u) {
                Some(chosen) => counts[chosen.emitter as usize] += 1,
                None => nothing += 1,
            }
        }
        let sum = asked.iter().sum::<f32>() + nothing as f32 / DRAWS as f32;
        // The share of nothing is known to a few draws.
        assert!((sum - 1.0).abs() < 1e-3, "{asked:?}");
        assert!(counts.iter().filter(|&&count| count > 0).count() > 3);
        for (count, p) in counts.iter().zip(&asked) {
            // Equidistant numbers: a light's share is one interval per path, off by at most one
            // draw, and a few for rounding of the remapped u.
            assert!((*count as f32 - p * DRAWS as f32).abs() <= 3.0, "{count} {p}");
        }
    }

    #[test]
    fn every_emitter_that_can_shine_here_can_be_chosen() {
        let clusters = random_clusters(500);
        let tree = LightTree::new(&clusters);
        for (index, c) in (0..).zip(&clusters) {
            let to_light = c.centre() - RECEIVER.position;
            let seen = to_light.dot(RECEIVER.normal) > 0.02;
            let shines = -to_light.dot(c.normals.axis) > 0.02;
            if seen && shines {
                assert!(tree.probability(&RECEIVER, index) > 0.0, "{index}");
            }
        }
    }

    #[test]
    fn a_near_light_is_preferred_to_an_equal_far_one() {
        let near = Cluster::point(Vec3::new(0.0, 0.0, 1.0), 1.0);
        let far = Cluster::point(Vec3::new(0.0, 0.0, 10.0), 1.0);
        let tree = LightTree::new(&[far, near]);
        let at_origin = Receiver { position: Vec3::ZERO, ..RECEIVER };
        let p = tree.probability(&at_origin, 1);
        // 1/1 against 1/100, a few roundings.
        assert!((p - 100.0 / 101.0).abs() < 1e-5, "{p}");
    }

    #[test]
    fn lights_in_one_place_and_a_hundred_thousand_lights_make_a_tree() {
        let same = vec![Cluster::point(Vec3::ONE, 1.0); 1000];
        let tree = LightTree::new(&same);
        // 1000 equal lights: 1/1000 each but for the unevenness of halving 1000 ten times.
        let p = tree.probability(&RECEIVER, 123);
        assert!((1.0 / 1024.0 - 1e-6..1.0 / 512.0).contains(&p), "{p}");

        let many = LightTree::new(&random_clusters(100_000));
        let chosen = many.choose(&RECEIVER, 0.4).expect("some of them can be seen");
        assert_eq!(many.probability(&RECEIVER, chosen.emitter), chosen.probability);
    }

    #[test]
    fn without_emitters_there_is_no_choice() {
        let tree = LightTree::new(&[]);
        assert!(tree.is_empty());
        assert_eq!(tree.choose(&RECEIVER, 0.5), None);
        assert_eq!(tree.probability(&RECEIVER, 0), 0.0);
    }
}
