//! What a pilot says of the whole picture.

use etendue_math::Real;
use etendue_scene::Color;

use super::guide::DARK;
use super::pixel::Pilot;

/// How paths are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Plan {
    /// Light samples at the first vertex that scatters.
    pub(super) lights: u32,
    /// Pixels of which those of one colour are a group.
    pub(super) rectangle: [u32; 2],
}

/// Binary logarithm of the largest number of light samples: four of them are no longer the smaller part of a path.
const MOST_LEVEL: f64 = 2.0;

impl Plan {
    /// That of the pilot: groups of 8.
    pub(super) const PILOT: Self = Self { lights: 1, rectangle: [4, 4] };

    /// The plan for a picture of which so much is known.
    ///
    /// With relative variances V and rays c up to the first vertex that scatters, and of all that comes after,
    ///
    /// ```text
    /// q = √((V_first / c_first) / (V_later / c_later))
    /// ```
    ///
    /// is how many times as often the first part should be drawn as the second: so many light samples, to a power of two. Where it
    /// is the other part that is worth more, groups are of 16.
    ///
    /// # Source
    /// Bolin, Meyer, "An Error Metric for Monte Carlo Ray Tracing", EGWR 1997.
    pub(super) fn of(pilots: &[Pilot]) -> Self {
        let [mut first, mut later] = [[0.0_f64; 2]; 2];
        for pilot in pilots {
            let relative = |variance: Color| {
                let channels = variance.to_array().into_iter().zip(pilot.mean.to_array());
                channels.map(|(v, m)| f64::from(v / (m * m + DARK))).sum::<f64>()
            };
            let [all, own] = [pilot.variance, pilot.first_variance].map(relative);
            if (all + own).is_finite() {
                first[0] += own;
                later[0] += (all - own).max(0.0);
                first[1] += f64::from(pilot.rays[0]);
                later[1] += f64::from(pilot.rays[1]);
            }
        }
        // Comparisons with NaN are false: where nothing varies, or there is no second part, all stays as it was.
        let ratio = (first[0] * later[1] / (first[1] * later[0])).sqrt();
        let level =
            if ratio > 1.0 { (Real::ln(ratio) / core::f64::consts::LN_2).round() } else { 0.0 };
        let rectangle = if ratio < 1.0 { [8, 4] } else { Self::PILOT.rectangle };
        Self { lights: 1 << (level.min(MOST_LEVEL) as u32), rectangle }
    }
}

#[cfg(test)]
mod tests {
    use etendue_math::Spectrum;

    use super::*;

    fn plan(first: f32, all: f32) -> Plan {
        let pilot = Pilot {
            mean: Color::splat(1.0),
            variance: Color::splat(all),
            first_variance: Color::splat(first),
            rays: [2.0, 2.0],
        };
        Plan::of(&[pilot; 3])
    }

    #[test]
    fn what_varies_more_is_drawn_more_often() {
        assert_eq!(plan(1.0, 101.0), Plan { lights: 1, rectangle: [8, 4] });
        assert_eq!(plan(1.0, 2.0), Plan::PILOT);
        assert_eq!(plan(4.0, 5.0), Plan { lights: 2, rectangle: [4, 4] });
        assert_eq!(plan(100.0, 101.0), Plan { lights: 4, rectangle: [4, 4] });
    }

    #[test]
    fn a_picture_that_does_not_vary_changes_nothing() {
        assert_eq!(plan(0.0, 0.0), Plan::PILOT);
        assert_eq!(plan(f32::NAN, 1.0), Plan::PILOT);
        assert_eq!(Plan::of(&[]), Plan::PILOT);
    }
}
