//! Inputs that break reflection code.

use etendue_math::{Real, Vec3, Vector3};

use crate::generators::from_angles;

/// Uniforms at the edges of `[0, 1)`; 2 stands for the largest number below 1.
pub const HOSTILE_UNIFORMS: [f64; 8] = [0.0, 1e-30, 1e-7, 0.25, 0.5, 0.75, 0.999, 2.0];

/// Unit directions whose cosines and azimuths are the edges of what occurs. Every pair of them is
/// tried, so that equal, opposite, mirrored and doubly grazing pairs are all among them.
pub fn unit_grid<T: Real>() -> Vec<Vec3<T>> {
    const COSINES: [f64; 10] = [
        0.0,
        1e-30,
        1e-7,
        1e-4,
        0.01,
        0.3,
        core::f64::consts::FRAC_1_SQRT_2,
        0.95,
        0.999_999_9,
        1.0,
    ];
    const AZIMUTHS: [f64; 5] = [0.0, 0.5 * f64::PI, f64::PI, 1.1, 1.1 + f64::PI];
    COSINES
        .iter()
        .flat_map(|&z| AZIMUTHS.map(|phi| (z, phi)))
        .flat_map(|(z, phi)| [from_angles::<T>(z, phi), from_angles::<T>(-z, phi)])
        .collect()
}

/// Vectors without a direction: zero, NaN or infinite in one or all components.
pub fn poisoned<T: Real>() -> Vec<Vec3<T>> {
    let bad = [T::NAN, T::INFINITY, -T::INFINITY];
    let v = |x, y, z| Vec3::<T>::new(x, y, z);
    let half = T::HALF;
    let mut all = vec![v(T::ZERO, T::ZERO, T::ZERO), v(-T::ZERO, -T::ZERO, -T::ZERO)];
    all.extend(
        bad.iter()
            .flat_map(|&b| [v(b, half, half), v(half, b, half), v(half, half, b), v(b, b, b)]),
    );
    all
}

/// Directions of a length far from 1: 1e±20 and 1e±30, within the range of `f32` but not squared.
pub fn unnormalised<T: Real>() -> Vec<Vec3<T>> {
    [1e-30, 1e-20, 1e20, 1e30]
        .iter()
        .flat_map(|&scale| [0.4, 1e-7, 1.0, -0.7].map(|z| from_angles::<T>(z, 1.1) * T::lit(scale)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_unit_direction_has_its_opposite_and_its_mirror_image_in_the_grid() {
        let grid = unit_grid::<f64>();
        let nearest = |w: etendue_math::glam::DVec3| {
            grid.iter().map(|g| (*g - w).length()).fold(f64::INFINITY, f64::min)
        };
        // The azimuths φ and φ + π differ by rounding of π.
        assert!(
            grid.iter().filter(|w| w.y >= 0.0 && w.x != 0.0).all(|&w| nearest(w.flip_z()) == 0.0)
        );
        assert!(grid.iter().any(|&w| nearest(-w) < 1e-15));
        assert!(poisoned::<f32>().iter().all(|w| w.try_normalize().is_none()));
    }
}
