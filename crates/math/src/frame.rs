//! Orthonormal frames.

use crate::{Real, Vec3, Vector3};

/// An orthonormal, right-handed frame whose third axis is a surface normal.
///
/// # Examples
/// ```
/// use etendue_math::{Frame, glam::DVec3};
/// let frame = Frame::<f64>::from_normal(DVec3::new(0.0, 0.6, 0.8));
/// let w = DVec3::new(0.0, 0.0, 1.0);
/// assert!((frame.to_local(w).z - 0.8).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<T: Real> {
    /// First tangent (x of the local frame).
    pub s: Vec3<T>,
    /// Second tangent (y of the local frame).
    pub t: Vec3<T>,
    /// Normal (z of the local frame).
    pub n: Vec3<T>,
}

impl<T: Real> Frame<T> {
    /// The frame around a unit normal, tangents chosen without branches on the direction.
    ///
    /// # Source
    /// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017, listing 3.
    #[inline]
    pub fn from_normal(n: Vec3<T>) -> Self {
        let sign = T::ONE.copysign(n.z());
        let a = -T::ONE / (sign + n.z());
        let b = n.x() * n.y() * a;
        let s = Vec3::<T>::new(T::ONE + sign * n.x() * n.x() * a, sign * b, -sign * n.x());
        let t = Vec3::<T>::new(b, sign + n.y() * n.y() * a, -n.y());
        Self { s, t, n }
    }

    /// The frame around a unit normal whose first tangent is the part of `s` orthogonal to `n`;
    /// any frame around `n` where that part vanishes.
    ///
    /// ```text
    /// s' = normalize(s − n (n·s)),  t = n × s'
    /// ```
    #[inline]
    pub fn from_normal_and_tangent(n: Vec3<T>, s: Vec3<T>) -> Self {
        match (s - n * n.dot(s)).try_normalize() {
            // A tangent nearly parallel to n leaves only rounding noise: test that it is orthogonal.
            Some(s) if s.dot(n).abs() < T::lit(1e-3) => Self { s, t: n.cross(s), n },
            _ => Self::from_normal(n),
        }
    }

    /// World to local coordinates.
    #[inline(always)]
    pub fn to_local(&self, w: Vec3<T>) -> Vec3<T> {
        Vec3::<T>::new(w.dot(self.s), w.dot(self.t), w.dot(self.n))
    }

    /// Local to world coordinates.
    #[inline(always)]
    pub fn to_world(&self, w: Vec3<T>) -> Vec3<T> {
        self.s * w.x() + self.t * w.y() + self.n * w.z()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_orthonormal_for_every_octant_and_pole() {
        let c = [-1.0_f32, -1e-4, 0.0, 1e-4, 1.0];
        for n in c.iter().flat_map(|&x| c.iter().flat_map(move |&y| c.map(|z| [x, y, z]))) {
            let Some(n) = glam::Vec3::from(n).try_normalize() else { continue };
            let f = Frame::<f32>::from_normal(n);
            for (a, b, want) in [
                (f.s, f.s, 1.0),
                (f.t, f.t, 1.0),
                (f.s, f.t, 0.0),
                (f.s, f.n, 0.0),
                (f.t, f.n, 0.0),
                (f.s.cross(f.t), f.n, 1.0),
            ] {
                // A handful of products of unit numbers: a few ε.
                assert!((a.dot(b) - want).abs() < 8.0 * f32::EPSILON, "{n}: {}", a.dot(b));
            }
        }
    }

    #[test]
    fn a_tangent_along_the_normal_still_gives_a_frame() {
        let n = glam::Vec3::Z;
        for s in [glam::Vec3::Z, glam::Vec3::ZERO, glam::Vec3::NAN] {
            let f = Frame::<f32>::from_normal_and_tangent(n, s);
            assert_eq!(f.s.dot(f.n), 0.0);
        }
    }
}
