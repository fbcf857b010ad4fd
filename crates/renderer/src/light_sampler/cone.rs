//! Cones of directions.

use etendue_math::Real;
use etendue_math::glam::Vec3;

/// All directions within an angle of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cone {
    /// Unit axis.
    pub(super) axis: Vec3,
    /// Cosine of the half angle; −1 for the whole sphere.
    pub(super) cos_spread: f32,
}

impl Cone {
    /// The whole sphere.
    pub(super) fn everything() -> Self {
        Self { axis: Vec3::Z, cos_spread: -1.0 }
    }

    /// A cone that contains both; the smallest one but for rounding.
    ///
    /// # Source
    /// Conty Estevez, Kulla 2018, algorithm 1.
    pub(super) fn union(&self, other: &Self) -> Self {
        let (wide, narrow) =
            if self.cos_spread <= other.cos_spread { (self, other) } else { (other, self) };
        let (theta_a, theta_b) = (Real::acos(wide.cos_spread), Real::acos(narrow.cos_spread));
        let theta_d = angle_between(wide.axis, narrow.axis);
        if theta_d + theta_b <= theta_a {
            return *wide;
        }
        let theta = 0.5 * (theta_a + theta_d + theta_b);
        if theta >= f32::PI {
            return Self::everything();
        }
        // The axis turns from the wide cone's towards the narrow one's.
        let across = narrow.axis - wide.axis * narrow.axis.dot(wide.axis);
        let Some(across) = across.try_normalize() else {
            return Self::everything();
        };
        let turn = theta - theta_a;
        let axis = wide.axis * Real::cos(turn) + across * Real::sin(turn);
        Self { axis, cos_spread: Real::cos(theta) }
    }
}

/// The angle between two unit vectors, accurate for nearly parallel ones.
fn angle_between(a: Vec3, b: Vec3) -> f32 {
    // |a × b| and a·b are sine and cosine; acos alone loses half of the digits near 0 and π.
    Real::atan2(a.cross(b).length(), a.dot(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contains(cone: &Cone, direction: Vec3, margin: f32) -> bool {
        angle_between(cone.axis, direction) <= Real::acos(cone.cos_spread) + margin
    }

    #[test]
    fn the_union_contains_both_cones() {
        let axes = [Vec3::X, Vec3::Y, -Vec3::X, Vec3::new(0.6, 0.0, 0.8), Vec3::Z];
        let spreads = [1.0_f32, 0.9, 0.3, -0.5, -1.0];
        for a in axes {
            for b in axes {
                for (cos_a, cos_b) in spreads.iter().flat_map(|&x| spreads.map(|y| (x, y))) {
                    let (a, b) =
                        (Cone { axis: a, cos_spread: cos_a }, Cone { axis: b, cos_spread: cos_b });
                    let union = a.union(&b);
                    for part in [a, b] {
                        let frame = etendue_math::Frame::<f32>::from_normal(part.axis);
                        let sin = (1.0 - part.cos_spread * part.cos_spread).safe_sqrt();
                        for (x, y) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
                            let rim = Vec3::new(sin * x, sin * y, part.cos_spread);
                            // acos near 1 turns an ε of the cosine into √ε = 3.5e-4 of angle.
                            assert!(contains(&union, frame.to_world(rim), 2e-3), "{a:?} {b:?}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn a_cone_inside_another_leaves_it_unchanged() {
        let wide = Cone { axis: Vec3::Z, cos_spread: 0.0 };
        let narrow = Cone { axis: Vec3::new(0.6, 0.0, 0.8), cos_spread: 0.99 };
        assert_eq!(wide.union(&narrow), wide);
        assert_eq!(narrow.union(&wide), wide);
    }
}
