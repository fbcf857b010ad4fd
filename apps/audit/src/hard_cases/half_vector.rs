//! Nearly opposite directions.

use etendue_brdf::direction;
use etendue_math::glam::Vec3;

use super::{HardCase, decades};
use crate::measure::{Outcome, Worst};

/// The half vector of opposite directions is 0/0.
pub(super) const CASE: HardCase = HardCase {
    name: "opposite directions",
    function: "half_vector",
    problem: "0/0 for opposite directions",
    remedy: "the squared length is tested before it divides; no half vector where it vanishes",
    sound: || sweep(|wo, wi| direction::half_vector(wo, wi).map(|(h, _)| h)),
    naive: || sweep(|wo, wi| Some((wo + wi) / (wo + wi).length())),
};

/// A half vector is either absent or of length 1 within 4 ulp, which is what the root and the
/// quotients round. Sums so small that their squares lose digits to underflow must be absent or
/// right all the same.
fn sweep(form: fn(Vec3, Vec3) -> Option<Vec3>) -> Outcome {
    let mut worst = Worst::default();
    let separations = decades(-18.0, 0.0, 200).chain([0.0]);
    for separation in separations {
        for z in [0.0, 1e-7, 1e-3] {
            let wo = Vec3::new(1.0, 0.0, z);
            let wi = Vec3::new(-1.0, separation, -z);
            let error = form(wo, wi).map_or(0.0, |h| (f64::from(h.length()) - 1.0).abs());
            worst.observe(error / f64::from(f32::EPSILON), || format!("wo {wo:?}, wi {wi:?}"));
        }
    }
    worst.within(4.0, "ulp of 1")
}
