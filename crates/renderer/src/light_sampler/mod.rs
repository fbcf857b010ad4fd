//! Choosing the light to sample: by power, distance and orientation.

mod build;
mod cluster;
mod cone;
mod node;
mod pair;
mod points;
mod receiver;
mod tree;

use etendue_math::Real;
use etendue_scene::Scene;
use etendue_scene::light::{EmissionSides, LightBounds, LightId};

use cluster::{Cluster, Faces};
use cone::Cone;
pub(crate) use points::{PointLight, PointLights};
pub use receiver::{Receiver, Sides};
use tree::{Chosen, LightTree};

/// Chooses one light, or one triangle of an emitting mesh, for a point on a surface.
///
/// Finite lights hang in a light tree, and are chosen by a bound on the irradiance they can bring.
/// Infinite ones (environment, constant, directional) share among themselves what the tree leaves. By how much of them needs
/// light samples ([`Light::excess`](etendue_scene::light::Light::excess)) they count for 1/16 to 1 each: those that count n together are
/// chosen, where there is a tree, with probability n/(n+1), and among them in proportion to what they count and their power.
///
/// A light that can light the receiver never has probability 0, and `probability` returns the bits
/// that `choose` returned.
///
/// # Source
/// Conty Estevez, Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting",
/// PACMCGIT 1(2), 2018; the share of infinite lights as in Pharr, Jakob, Humphreys, "Physically
/// Based Rendering", 4th edition, section 12.6.3.
#[derive(Clone, Debug)]
pub struct LightSampler {
    tree: LightTree,
    /// Light and primitive of each emitter of the tree.
    emitters: Vec<(LightId, u32)>,
    /// For each light, the place of its primitive 0 in `emitter_of`.
    first_primitive: Vec<u32>,
    /// Emitter of each primitive of each light, or [`NOT_IN_TREE`].
    emitter_of: Vec<u32>,
    infinite: Vec<InfiniteLight>,
    infinite_share: f32,
}

#[derive(Clone, Copy, Debug)]
struct InfiniteLight {
    light: LightId,
    /// Among the infinite lights; all sum to 1.
    probability: f32,
}

/// What is known of an infinite light.
#[derive(Clone, Copy, Debug)]
struct Infinite {
    light: LightId,
    power: f32,
    /// How much of it needs light samples.
    excess: f32,
}

impl Infinite {
    /// What it counts among the others and the tree. More than its excess, because scattering knows nothing of what lies between.
    fn count(&self) -> f32 {
        self.excess.max(1.0 / 16.0)
    }

    fn weight(&self) -> f64 {
        f64::from(self.count()) * f64::from(self.power)
    }
}

/// A light, a primitive of it (a triangle of an emitting mesh, else 0), and the probability of
/// having chosen both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightChoice {
    /// The light.
    pub light: LightId,
    /// The primitive.
    pub primitive: u32,
    /// In (0, 1].
    pub probability: f32,
}

const NOT_IN_TREE: u32 = u32::MAX;

impl LightSampler {
    /// Prepares the lights of a scene. Lights without power are never chosen.
    pub fn new(scene: &Scene) -> Self {
        let infinite: Vec<Infinite> = scene
            .infinite_lights()
            .iter()
            .map(|&light| Infinite {
                light,
                power: scene.light_power(light),
                excess: scene.lights[light.0 as usize].excess(),
            })
            .collect();
        Self::from_lights(&scene.finite_lights(), &infinite)
    }

    /// Prepares finite lights, primitive by primitive with their bounds, and infinite lights.
    fn from_lights(finite: &[(LightId, u32, LightBounds)], infinite: &[Infinite]) -> Self {
        let bright = |power: f32| power > 0.0 && power.is_finite();
        let finite: Vec<_> = finite.iter().filter(|(_, _, bounds)| bright(bounds.power)).collect();
        let clusters: Vec<Cluster> = finite.iter().map(|(_, _, bounds)| bounds.into()).collect();
        let tree = LightTree::new(&clusters);
        let emitters: Vec<(LightId, u32)> =
            finite.iter().map(|&&(light, primitive, _)| (light, primitive)).collect();
        let (first_primitive, emitter_of) = index_emitters(&emitters);

        let infinite: Vec<&Infinite> = infinite.iter().filter(|i| bright(i.power)).collect();
        let total: f64 = infinite.iter().map(|i| i.weight()).sum();
        let count: f32 = infinite.iter().map(|i| i.count()).sum();
        let rest = if tree.is_empty() { 0.0 } else { 1.0 };
        let infinite_share = if infinite.is_empty() { 0.0 } else { count / (count + rest) };
        let infinite: Vec<InfiniteLight> = infinite
            .into_iter()
            .map(|i| InfiniteLight { light: i.light, probability: (i.weight() / total) as f32 })
            .collect();
        Self { tree, emitters, first_primitive, emitter_of, infinite, infinite_share }
    }

    /// How many there are to choose from: with less than two, no random number is needed.
    pub fn count(&self) -> usize {
        self.emitters.len() + self.infinite.len()
    }

    /// Chooses a light by a uniform number `u` in `[0, 1)`. `None` where no light can reach the
    /// receiver, or none was found that can: the light brought there is 0 then.
    #[inline(always)]
    pub fn choose(&self, receiver: &Receiver, u: f32) -> Option<LightChoice> {
        if self.infinite.is_empty() {
            return self.choose_finite(receiver, u);
        }
        if u < self.infinite_share {
            return self.choose_infinite(u / self.infinite_share);
        }
        let rest = 1.0 - self.infinite_share;
        let u = ((u - self.infinite_share) / rest).min(f32::ONE_MINUS_EPSILON);
        let choice = self.choose_finite(receiver, u)?;
        Some(LightChoice { probability: rest * choice.probability, ..choice })
    }

    /// Chooses among the lights in the tree.
    #[inline(always)]
    fn choose_finite(&self, receiver: &Receiver, u: f32) -> Option<LightChoice> {
        let Chosen { emitter, probability } = self.tree.choose(receiver, u)?;
        let (light, primitive) = self.emitters[emitter as usize];
        Some(LightChoice { light, primitive, probability })
    }

    /// The probability with which [`choose`](Self::choose) returns this light and primitive, to the
    /// bit; 0 for those that are unknown.
    #[inline]
    pub fn probability(&self, receiver: &Receiver, light: LightId, primitive: u32) -> f32 {
        match self.emitter_of(light, primitive) {
            Some(emitter) => (1.0 - self.infinite_share) * self.tree.probability(receiver, emitter),
            None => self
                .infinite
                .iter()
                .find(|infinite| infinite.light == light)
                .map_or(0.0, |infinite| self.infinite_share * infinite.probability),
        }
    }

    #[inline(never)]
    fn choose_infinite(&self, mut u: f32) -> Option<LightChoice> {
        let last = self.infinite.len().checked_sub(1)?;
        for (i, infinite) in self.infinite.iter().enumerate() {
            // The last one takes what rounding leaves.
            if u < infinite.probability || i == last {
                let probability = self.infinite_share * infinite.probability;
                return Some(LightChoice { light: infinite.light, primitive: 0, probability });
            }
            u -= infinite.probability;
        }
        None
    }

    #[inline]
    fn emitter_of(&self, light: LightId, primitive: u32) -> Option<u32> {
        let light = light.0 as usize;
        let [first, end] =
            [light, light.saturating_add(1)].map(|l| self.first_primitive.get(l).copied());
        let place = first?.checked_add(primitive)?;
        if place >= end? {
            return None;
        }
        Some(self.emitter_of[place as usize]).filter(|&emitter| emitter != NOT_IN_TREE)
    }
}

/// Where each light's primitives begin in one table, and the table from primitive to emitter.
fn index_emitters(emitters: &[(LightId, u32)]) -> (Vec<u32>, Vec<u32>) {
    let lights = emitters.iter().map(|(light, _)| light.0 as usize + 1).max().unwrap_or(0);
    let mut counts = vec![0_u32; lights];
    for &(light, primitive) in emitters {
        let count = &mut counts[light.0 as usize];
        *count = (*count).max(primitive + 1);
    }
    let mut first = vec![0_u32];
    first.extend(counts.iter().scan(0, |sum, count| {
        *sum += count;
        Some(*sum)
    }));
    let mut table = vec![NOT_IN_TREE; first[lights] as usize];
    for (emitter, &(light, primitive)) in (0..).zip(emitters) {
        table[(first[light.0 as usize] + primitive) as usize] = emitter;
    }
    (first, table)
}

impl From<&LightBounds> for Cluster {
    fn from(light: &LightBounds) -> Self {
        let faces = match light.sides {
            EmissionSides::One => Faces::Front,
            EmissionSides::Both => Faces::Both,
        };
        Self {
            low: light.bounds.min,
            high: light.bounds.max,
            normals: Cone { axis: light.axis, cos_spread: light.cos_theta_o },
            cos_emission: light.cos_theta_e,
            faces,
            power: light.power,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::glam::Vec3;
    use etendue_scene::geometry::Aabb;

    const RECEIVER: Receiver =
        Receiver { position: Vec3::ZERO, normal: Vec3::Z, sides: Sides::Front };

    fn lamp(light: u32, primitive: u32, position: Vec3, power: f32) -> (LightId, u32, LightBounds) {
        let bounds = LightBounds {
            bounds: Aabb::from_points([position]),
            power,
            axis: Vec3::Z,
            cos_theta_o: -1.0,
            cos_theta_e: 0.0,
            sides: EmissionSides::One,
        };
        (LightId(light), primitive, bounds)
    }

    fn sky(light: u32, power: f32, excess: f32) -> Infinite {
        Infinite { light: LightId(light), power, excess }
    }

    #[test]
    fn what_scattering_finds_as_well_is_chosen_less_often() {
        let lamps = [lamp(1, 0, Vec3::Z, 1.0)];
        let with = |infinite: &[Infinite], light| {
            let lights = LightSampler::from_lights(&lamps, infinite);
            lights.probability(&RECEIVER, LightId(light), 0)
        };
        // 1/16 of 17/16, and one of two: three roundings.
        assert!((with(&[sky(0, 5.0, 0.0)], 0) - 1.0 / 17.0).abs() < 1e-7);
        assert!((with(&[sky(0, 5.0, 1.0)], 0) - 0.5).abs() < 1e-7);
        // Equal powers: half as much of the share for half the excess.
        let both = [sky(0, 2.0, 1.0), sky(2, 2.0, 0.5)];
        assert!((with(&both, 0) / with(&both, 2) - 2.0).abs() < 1e-6);
    }

    #[test]
    fn finite_and_infinite_lights_are_chosen_with_the_probabilities_asked_for() {
        let finite = [
            lamp(1, 0, Vec3::new(1.0, 0.0, 1.0), 2.0),
            lamp(1, 2, Vec3::new(0.0, 3.0, 1.0), 1.0),
            lamp(4, 0, Vec3::new(0.0, 0.0, 2.0), 5.0),
        ];
        let infinite = [sky(0, 3.0, 1.0), sky(3, 1.0, 1.0)];
        let lights = LightSampler::from_lights(&finite, &infinite);
        assert_eq!(lights.count(), 5);
        let all = [(1, 0), (1, 2), (4, 0), (0, 0), (3, 0)];
        let sum: f32 = all.iter().map(|&(l, p)| lights.probability(&RECEIVER, LightId(l), p)).sum();
        // Five roundings.
        assert!((sum - 1.0).abs() < 1e-6, "{sum}");
        // Two of three shares, three quarters of them.
        let sky = lights.probability(&RECEIVER, LightId(0), 0);
        assert!((sky - 0.5).abs() < 1e-6, "{sky}");
        for i in 0..1000 {
            let chosen = lights.choose(&RECEIVER, i as f32 / 1000.0).expect("all are seen");
            let asked = lights.probability(&RECEIVER, chosen.light, chosen.primitive);
            assert_eq!(chosen.probability, asked);
        }
    }

    #[test]
    fn unknown_lights_and_primitives_have_no_probability() {
        let lights = LightSampler::from_lights(&[lamp(1, 1, Vec3::Z, 1.0)], &[]);
        assert_eq!(lights.probability(&RECEIVER, LightId(1), 1), 1.0);
        for (light, primitive) in [(1, 0), (1, 2), (0, 0), (7, 0), (u32::MAX, u32::MAX)] {
            assert_eq!(lights.probability(&RECEIVER, LightId(light), primitive), 0.0);
        }
    }

    #[test]
    fn without_lights_or_with_black_ones_nothing_is_chosen() {
        let none = LightSampler::from_lights(&[], &[]);
        let black =
            LightSampler::from_lights(&[lamp(0, 0, Vec3::Z, 0.0)], &[sky(1, f32::NAN, 1.0)]);
        for lights in [none, black] {
            assert_eq!(lights.count(), 0);
            assert_eq!(lights.choose(&RECEIVER, 0.3), None);
        }
    }
}
