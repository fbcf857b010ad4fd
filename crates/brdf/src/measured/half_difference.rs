//! Rusinkiewicz's coordinates of a pair of directions.

use etendue_math::glam::DVec3;
use etendue_math::{Real, Vector3};

use crate::direction::{half_vector, reflect_about};

/// Half and difference angles of a pair of directions, of an isotropic material.
///
/// ```text
/// θh    angle between half vector and normal
/// θd    angle between half vector and either direction
/// φd    angle of wi around h, 0 where wi is tilted away from the normal; modulo π, which is reciprocity
/// ```
///
/// In double precision whatever the model's: at the edge of a bin a rounding decides which entry is read.
///
/// # Source
/// S. Rusinkiewicz, "A New Change of Variables for Efficient BRDF Representation", EGWR 1998.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HalfDifference {
    pub(super) theta_h: f64,
    pub(super) theta_d: f64,
    /// In `[0, π)` but for rounding.
    pub(super) phi_d: f64,
}

impl HalfDifference {
    /// The coordinates of a pair and its half vector; `None` where there is none.
    ///
    /// Angles are taken from sine and cosine, and the frame of `h` meets the difference of the
    /// directions, which near retro-reflection keeps the digits that `wi` alone would lose.
    #[inline]
    pub(super) fn new(wo: DVec3, wi: DVec3) -> Option<(Self, DVec3, f64)> {
        let (h, cos) = half_vector(wo, wi)?;
        let difference = wi - wo;
        let sin = Real::sqrt(h.x * h.x + h.y * h.y);
        let (c, s) = if sin > 0.0 { (h.x / sin, h.y / sin) } else { (1.0, 0.0) };
        let x = (difference.x * c + difference.y * s) * h.z - difference.z * sin;
        let y = difference.y * c - difference.x * s;
        // The opposite vector is the other order of the pair: turned before its angle is taken, not after, both
        // orders have the same bits.
        let turned = y < 0.0 || (y == 0.0 && x < 0.0);
        let (x, y) = if turned { (-x, -y) } else { (x, y) };
        let coordinates = Self {
            theta_h: Real::atan2(sin, h.z),
            theta_d: Real::atan2(Vector3::length(difference) * 0.5, cos),
            phi_d: Real::atan2(y, x),
        };
        Some((coordinates, h, cos))
    }

    /// A pair `[wo, wi]` with these coordinates, its half vector above the x axis. Either may lie below.
    pub(super) fn pair(self) -> [DVec3; 2] {
        let ((sin_h, cos_h), (sin_d, cos_d)) =
            (Real::sin_cos(self.theta_h), Real::sin_cos(self.theta_d));
        let (sin_phi, cos_phi) = Real::sin_cos(self.phi_d);
        let (x, y) = (sin_d * cos_phi, sin_d * sin_phi);
        let wi = DVec3::new(x * cos_h + cos_d * sin_h, y, cos_d * cos_h - x * sin_h);
        [reflect_about(wi, DVec3::new(sin_h, 0.0, cos_h)), wi]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_has_the_coordinates_it_was_made_from() {
        for theta_h in [1e-5, 0.3, 1.2] {
            for theta_d in [1e-5, 0.5, 1.5] {
                for phi_d in [1e-3, 1.0, 3.1] {
                    let want = HalfDifference { theta_h, theta_d, phi_d };
                    let [wo, wi] = want.pair();
                    let (got, _, _) = HalfDifference::new(wo, wi).unwrap();
                    // Roundings of unit vectors; φd has them divided by sin θd.
                    assert!((got.theta_h - theta_h).abs() < 1e-14, "{want:?} {got:?}");
                    assert!((got.theta_d - theta_d).abs() < 1e-14, "{want:?} {got:?}");
                    assert!((got.phi_d - phi_d).abs() < 1e-14 / theta_d, "{want:?} {got:?}");
                }
            }
        }
    }

    #[test]
    fn exchanging_the_directions_keeps_the_coordinates() {
        let (wo, wi) = (DVec3::new(0.36, 0.48, 0.8), DVec3::new(-0.28, 0.0, 0.96));
        let (a, b) = (HalfDifference::new(wo, wi).unwrap(), HalfDifference::new(wi, wo).unwrap());
        assert_eq!(a, b);
        // In the plane of incidence, where φd is 0 or π.
        let (wo, wi) = (DVec3::new(-0.6, 0.0, 0.8), DVec3::new(0.28, 0.0, 0.96));
        assert_eq!(HalfDifference::new(wo, wi), HalfDifference::new(wi, wo));
    }
}
