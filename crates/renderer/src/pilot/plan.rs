//! What a pilot says of the whole picture.

use etendue_math::Real;

use super::pixel::{Pilot, Spread};

/// How paths are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Plan {
    /// Light samples at the first vertex that scatters.
    pub(super) lights: u32,
    /// Pixels of which those of one colour are a group.
    pub(super) rectangle: [u32; 2],
}

/// Numbers of light samples to choose from: more than four are no longer the smaller part of a path.
const LIGHTS: [u32; 3] = [1, 2, 4];

/// Rectangles to choose from; half of their pixels are a group.
const RECTANGLES: [[u32; 2]; 3] = [[4, 4], [8, 4], [2, 1]];

impl Plan {
    /// That of the pilot: groups of 8.
    pub(super) const PILOT: Self = Self { lights: 1, rectangle: RECTANGLES[0] };

    /// The plan for a picture of which so much is known: the one that promises the least error times rays.
    ///
    /// * `times`: how many times the samples of the pilot the picture is going to have.
    pub(super) fn of(pilots: &[Pilot], times: f64) -> Self {
        let Some(shares) = Shares::of(pilots, times) else { return Self::PILOT };
        let plans = RECTANGLES
            .into_iter()
            .flat_map(|rectangle| LIGHTS.map(|lights| Self { lights, rectangle }));
        let price = |plan: &Self| shares.error(*plan) * shares.rays(*plan);
        plans.min_by(|a, b| price(a).total_cmp(&price(b))).unwrap_or(Self::PILOT)
    }

    /// How much less than 1 a path may carry before roulette ends it. Where the rest of a path is shared it is worth more: 4 makes a
    /// tenth less error at equal time than 1 in a Cornell box.
    pub(super) fn patience(self) -> f32 {
        if self.group() > 1.0 { 4.0 } else { 1.0 }
    }

    fn group(self) -> f64 {
        f64::from(self.rectangle[0] * self.rectangle[1] / 2)
    }
}

/// What the error of a picture and its rays consist of, in the mean over the pixels.
#[derive(Clone, Copy, Debug)]
struct Shares {
    /// Relative variance, with all samples that the picture is going to have, of what paths find up to the first vertex that scatters,
    /// of the rest that they do not share, of what they share in the pilot's groups, and of the same without sharing; in any unit.
    variances: [f64; 4],
    /// Rays per path up to the first vertex that scatters, from there on, and to share.
    rays: [f64; 3],
}

/// The sums of [`Spread`]s.
#[derive(Clone, Copy, Debug, Default)]
struct Fall {
    of_all: f64,
    of_half: f64,
}

impl Fall {
    fn add(&mut self, spread: Spread) {
        if (spread.of_all + spread.of_half).is_finite() {
            self.of_all += f64::from(spread.of_all);
            self.of_half += f64::from(spread.of_half);
        }
    }

    /// The variance with so many times the samples.
    ///
    /// Four runs know that of a quarter of the samples, two halves that of half of them: with each doubling it falls by what it fell
    /// between these, from 2 for independent samples to 4 for even points where the light is smooth.
    fn after(self, times: f64) -> f64 {
        let of_quarter = 4.0 * self.of_all;
        let fall = (of_quarter / self.of_half).clamp(2.0, 4.0);
        if fall.is_nan() {
            0.0
        } else {
            self.of_half * Real::powf(fall, -Real::ln(2.0 * times) / core::f64::consts::LN_2)
        }
    }
}

impl Shares {
    /// `None` where nothing varies.
    fn of(pilots: &[Pilot], times: f64) -> Option<Self> {
        let [mut first, mut own, mut lent, mut alone] = [Fall::default(); 4];
        let mut rays = [0.0; 3];
        for pilot in pilots {
            first.add(pilot.first);
            own.add(pilot.own);
            lent.add(pilot.lent);
            alone.add(pilot.alone);
            for (sum, rays) in rays.iter_mut().zip(pilot.rays) {
                *sum += f64::from(rays);
            }
        }
        let [first, own, lent, alone] = [first, own, lent, alone].map(|part| part.after(times));
        let variances = [first, (own - first).max(0.0), lent, alone];
        let rays = rays.map(|sum| sum / pilots.len() as f64);
        (variances.iter().sum::<f64>() > 0.0).then_some(Self { variances, rays })
    }

    /// ```text
    /// V_first / lights + V_own + V_alone (V_lent / V_alone)^(log₈ group)
    /// ```
    ///
    /// Between no group and the pilot's groups of 8, and beyond, what is shared varies as a power of the size of the group.
    fn error(&self, plan: Plan) -> f64 {
        let [first, own, lent, alone] = self.variances;
        // Sharing is without gain at the worst; what nothing varies of stays 0.
        let gain = if alone > 0.0 { (lent / alone).min(1.0) } else { 0.0 };
        let power = Real::ln(plan.group()) / Real::ln(Plan::PILOT.group());
        first / f64::from(plan.lights) + own + alone * Real::powf(gain, power)
    }

    /// A light sample is one ray, where there are rays to lights at all; those to share are one less for each path than its group has.
    fn rays(&self, plan: Plan) -> f64 {
        let [first, later, shared] = self.rays;
        let pairs = (plan.group() - 1.0) / (Plan::PILOT.group() - 1.0);
        let light = (first - 1.0).clamp(0.0, 1.0);
        first + light * f64::from(plan.lights - 1) + later + shared * pairs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What falls by half with each doubling of the samples.
    fn spread(variance: f32) -> Spread {
        Spread { of_all: variance, of_half: 2.0 * variance }
    }

    /// Sharing leaves a quarter of the variance.
    fn pilot(first: f32, own: f32, lent: f32, rays: [f32; 3]) -> Pilot {
        let [first, own, lent, alone] = [first, own, lent, 4.0 * lent].map(spread);
        Pilot { first, own, lent, alone, rays, ..Pilot::default() }
    }

    /// The plan by relative variances, with equally many rays of each kind.
    fn plan(first: f32, own: f32, lent: f32) -> Plan {
        Plan::of(&[pilot(first, own, lent, [2.0, 2.0, 2.0]); 3], 4.0)
    }

    #[test]
    fn what_varies_more_is_drawn_more_often() {
        // What is shared varies, and what is found by lights; then only what is shared, what is own, and light samples.
        assert_eq!(plan(1.0, 1.0, 1.0), Plan { lights: 4, rectangle: [8, 4] });
        assert_eq!(plan(0.0, 0.0, 2.0), Plan { lights: 1, rectangle: [8, 4] });
        assert_eq!(plan(0.0, 2.0, 0.0), Plan { lights: 1, rectangle: [2, 1] });
        assert_eq!(plan(2.0, 2.0, 0.0), Plan { lights: 4, rectangle: [2, 1] });
    }

    #[test]
    fn groups_are_as_large_as_their_rays_are_worth() {
        let with =
            |to_share| Plan::of(&[pilot(0.0, 0.0, 2.0, [2.0, 2.0, to_share])], 4.0).rectangle;
        assert_eq!([1.0, 6.0, 60.0].map(with), [[8, 4], [4, 4], [2, 1]]);
        let mut useless = pilot(0.0, 0.0, 2.0, [2.0, 2.0, 1.0]);
        useless.alone = useless.lent;
        assert_eq!(Plan::of(&[useless], 4.0).rectangle, [2, 1]);
    }

    #[test]
    fn what_more_samples_make_go_away_by_itself_needs_no_care() {
        let mut pilot = pilot(1.0, 1.0, 1.0, [2.0, 2.0, 2.0]);
        for spread in [&mut pilot.first, &mut pilot.own] {
            spread.of_half = 1.0;
        }
        assert_eq!(Plan::of(&[pilot], 4.0), Plan { lights: 1, rectangle: [8, 4] });
    }

    #[test]
    fn the_variance_falls_as_the_pilot_saw_it_fall() {
        let after = |of_half: f64| Fall { of_all: 1.0, of_half }.after(4.0);
        // By 2 and by 4 with each of three doublings; nothing falls slower or faster.
        for (of_half, expected) in [(2.0, 0.25), (1.0, 1.0 / 64.0), (9.0, 9.0 / 8.0)] {
            // Rounding of logarithm and power.
            assert!((after(of_half) / expected - 1.0_f64).abs() < 1e-14, "{of_half}");
        }
        assert_eq!(Fall::default().after(4.0), 0.0);
    }

    #[test]
    fn a_picture_that_does_not_vary_changes_nothing() {
        assert_eq!(plan(0.0, 0.0, 0.0), Plan::PILOT);
        assert_eq!(plan(f32::NAN, f32::NAN, f32::NAN), Plan::PILOT);
        assert_eq!(Plan::of(&[], 4.0), Plan::PILOT);
    }
}
