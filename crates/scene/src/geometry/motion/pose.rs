//! A placement taken apart.

use etendue_math::Real;
use etendue_math::glam::{DMat3, DQuat, DVec3, DVec4};

use crate::geometry::Transform;

/// An affine map as a translation after a rotation after a stretch: `x ↦ T + R S x`.
///
/// `S` is symmetric, and definite: positive where the map keeps the handedness of space, negative where it mirrors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pose {
    pub(super) translation: DVec3,
    /// A quaternion of unit length: x, y, z, w.
    pub(super) rotation: DVec4,
    pub(super) stretch: DMat3,
}

impl Pose {
    /// The polar decomposition of a map.
    ///
    /// ```text
    /// Q₀ = M,  Q ← (γ Q + Q⁻ᵀ/γ)/2,  γ² = |Q⁻¹|/|Q|,  R = Q sgn det Q,  S = Rᵀ M
    /// ```
    ///
    /// # Source
    /// Shoemake, Duff, "Matrix Animation and Polar Decomposition", Graphics Interface 1992; the factor γ, with which few
    /// steps suffice however unequal the stretch is: Higham, "Computing the Polar Decomposition – with Applications",
    /// SIAM J. Sci. Stat. Comput. 7(4), 1986.
    pub(super) fn of(map: &Transform) -> Self {
        /// Stretches unequal by 10¹⁴ take 9 steps.
        const MOST_STEPS: u32 = 32;
        /// Convergence is quadratic: the step after one of 10⁻¹⁰ is one of rounding.
        const LAST_STEP: f64 = 1e-10;
        let linear = map.affine().matrix3;
        let mut q = linear;
        for _ in 0..MOST_STEPS {
            let opposite = q.inverse().transpose();
            let gamma = Real::sqrt(norm(&opposite) / norm(&q));
            let next = (q * gamma + opposite * (1.0 / gamma)) * 0.5;
            let step = norm(&(next - q));
            q = next;
            if step < LAST_STEP {
                break;
            }
        }
        let handedness = f64::copysign(1.0, q.determinant());
        let rotation = q * handedness;
        let stretch = rotation.transpose() * linear;
        let quaternion = DVec4::from(DQuat::from_mat3(&rotation));
        Self {
            translation: map.affine().translation,
            rotation: quaternion / Real::sqrt(quaternion.dot(quaternion)),
            stretch: (stretch + stretch.transpose()) * 0.5,
        }
    }
}

/// Root of the sum of the squares of all entries.
fn norm(m: &DMat3) -> f64 {
    let squares = |column: DVec3| column.dot(column);
    Real::sqrt(squares(m.x_axis) + squares(m.y_axis) + squares(m.z_axis))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::tests::Random;
    use etendue_math::glam::DAffine3;

    #[test]
    fn a_pose_is_a_rotation_a_definite_stretch_and_the_map_again() {
        let mut random = Random(11);
        for i in 0..300 {
            // Columns of lengths from 10⁻⁴ to 10⁴, every second one mirrored.
            let column = |r: &mut Random| {
                r.point().as_dvec3() * Real::powf(10.0_f64, 8.0 * f64::from(r.uniform()) - 4.0)
            };
            let columns = [0; 4].map(|_| column(&mut random));
            let [x, y, z, b] = columns;
            let Ok(map) = Transform::from_affine(DAffine3::from_cols(x, y, z, b)) else { continue };
            let pose = Pose::of(&map);
            let rotation = DMat3::from_quat(DQuat::from_vec4(pose.rotation));
            assert!((pose.rotation.length() - 1.0).abs() < 1e-15);
            // Rounding of a product, relative to the longest column.
            let size = norm(&map.affine().matrix3);
            let again = rotation * pose.stretch;
            assert!(norm(&(again - map.affine().matrix3)) < 1e-13 * size, "{i} {map:?}");
            // Definite: the signs of the leading minors, up to rounding of the whole.
            let sign = if map.is_mirrored() { -1.0 } else { 1.0 };
            let s = pose.stretch * sign;
            let minor = s.x_axis.x * s.y_axis.y - s.x_axis.y * s.y_axis.x;
            assert!(s.x_axis.x > 0.0 && minor > -1e-13 * size * size, "{i} {s}");
            assert!(s.determinant() > -1e-13 * size * size * size, "{i} {s}");
        }
    }
}
