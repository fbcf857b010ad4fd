//! A rectangle or parallelogram, uniform in area.

use etendue_math::{Real, Vec3, Vector3};

use super::{accurate_cross, into_unit};

/// A corner and the two edges that leave it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle<T: Real> {
    /// The corner at `u = [0, 0]`.
    pub corner: Vec3<T>,
    /// Both edges: to `u = [1, 0]` and to `u = [0, 1]`.
    pub edges: [Vec3<T>; 2],
}

impl<T: Real> Rectangle<T> {
    /// The point `corner + u₀ e₀ + u₁ e₁`, uniform in area.
    #[inline]
    pub fn from_square(&self, [u, v]: [T; 2]) -> Vec3<T> {
        self.corner + self.edges[0] * u + self.edges[1] * v
    }

    /// The uniforms of a point: its coordinates in the (possibly oblique) edges, limited to
    /// `[0, 1)`.
    ///
    /// A rectangle without area gives `[0, 0]`.
    #[inline]
    pub fn to_square(&self, point: Vec3<T>) -> [T; 2] {
        let [e0, e1] = self.edges;
        let (d, n) = (point - self.corner, accurate_cross(e0, e1));
        let scale = n.length_squared();
        let [u, v] = [accurate_cross(d, e1).dot(n), accurate_cross(e0, d).dot(n)];
        [into_unit(u / scale), into_unit(v / scale)]
    }

    /// Density per area: `1/|e₀ × e₁|`, 0 for a rectangle without area.
    #[inline]
    pub fn pdf(&self) -> T {
        let area = accurate_cross(self.edges[0], self.edges[1]).length();
        if area > T::ZERO { T::ONE / area } else { T::ZERO }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{check_inverse, check_jacobian};
    use etendue_math::glam::DVec3;

    const OBLIQUE: Rectangle<f64> = Rectangle {
        corner: DVec3::new(1.0, -2.0, 3.0),
        edges: [DVec3::new(2.0, 0.5, 0.0), DVec3::new(-0.3, 1.0, 0.7)],
    };

    #[test]
    fn inverse_undoes_the_map() {
        // Coordinates up to 4 are subtracted again: about 4 ε over the shortest edge, 1.2.
        check_inverse(|u| OBLIQUE.from_square(u), |p| OBLIQUE.to_square(p), 16.0 * f64::EPSILON);
    }

    #[test]
    fn density_is_that_of_the_map() {
        // The map is affine: a constant Jacobian is the whole distribution, and the density times
        // the area is 1.
        check_jacobian(|u| OBLIQUE.from_square(u), |_| OBLIQUE.pdf());
    }

    #[test]
    fn no_area_means_no_density() {
        let line = Rectangle::<f64> { edges: [DVec3::X, DVec3::X * 2.0], ..OBLIQUE };
        assert_eq!(line.pdf(), 0.0);
        assert_eq!(line.to_square(OBLIQUE.corner), [0.0, 0.0]);
    }
}
