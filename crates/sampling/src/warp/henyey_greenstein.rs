//! Directions around +z with the density of Henyey and Greenstein.

use etendue_math::{Real, Vec3, Vector3};

use super::{from_poles, into_unit, turn};

/// Henyey and Greenstein's density of directions around +z, with mean cosine `g`.
///
/// ```text
/// p(θ) = (1 − g²) / (4π q^³ᐟ²),   q = 1 + g² − 2g cos θ
/// ```
///
/// For `g = 0` the [uniform sphere](super::uniform_sphere); the closer `g` to 1 (−1), the narrower
/// around +z (−z). As a phase function +z is where light was going.
///
/// # Source
/// Henyey, Greenstein, "Diffuse Radiation in the Galaxy", Astrophysical Journal 93, 1941. All forms
/// here are sums of positive terms: the textbook's inverse divides a difference by `2g` and loses
/// its digits for `g → 0`, and `1 + g² − 2g cos θ` loses them for `g cos θ → 1`.
///
/// # Examples
/// ```
/// use etendue_sampling::warp::henyey_greenstein::HenyeyGreenstein;
/// let isotropic = HenyeyGreenstein::new(0.0_f32).expect("in (−1, 1)");
/// assert_eq!(isotropic.from_square([0.5, 0.25]).y, 1.0);
/// assert!(HenyeyGreenstein::new(1.0_f32).is_none());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HenyeyGreenstein<T> {
    g: T,
}

impl<T: Real> HenyeyGreenstein<T> {
    /// The density with mean cosine `g`; `None` outside (−1, 1), where it is a single direction or
    /// none.
    #[inline]
    pub fn new(g: T) -> Option<Self> {
        (g.abs() < T::ONE).then_some(Self { g })
    }

    /// Mean cosine `g`, in (−1, 1).
    #[inline]
    pub fn mean_cosine(&self) -> T {
        self.g
    }

    /// A direction by its density.
    ///
    /// ```text
    /// D = 1 + g(1 − 2u),   1 − cos θ = 2(1 − g)² u (1 + g(1 − u)) / D²
    ///                      1 + cos θ = 2(1 + g)² (1 − u)(1 − gu) / D²,   φ = 2π u₁
    /// ```
    ///
    /// # Precision
    /// 16 ulp of x and y for every `g`, z to 16 ε: the angle keeps its digits however narrow the
    /// lobe is.
    #[inline]
    pub fn from_square(&self, [u, v]: [T; 2]) -> Vec3<T> {
        let g = self.g;
        let rest = T::ONE - u;
        let d = (T::ONE + g) * rest + (T::ONE - g) * u;
        let square = |x: T| x * x;
        let one_minus_z = T::TWO * square((T::ONE - g) / d) * u * ((T::ONE + g) * rest + u);
        let one_plus_z = T::TWO * square((T::ONE + g) / d) * rest * ((T::ONE - g) * u + rest);
        let z = if one_minus_z < one_plus_z { T::ONE - one_minus_z } else { one_plus_z - T::ONE };
        let sin_theta = (one_minus_z * one_plus_z).sqrt();
        let (sin_phi, cos_phi) = turn::sin_cos(v);
        Vec3::<T>::new(sin_theta * cos_phi, sin_theta * sin_phi, z)
    }

    /// The uniforms of a unit direction; at the poles `u₁` is 0.
    ///
    /// ```text
    /// u = (1 + g)(1 − cos θ) / (√q (√q + 1 − g))
    /// ```
    ///
    /// # Precision
    /// Absolute, 16 ε, of directions that keep the digits of their angle.
    #[inline]
    pub fn to_square(&self, w: Vec3<T>) -> [T; 2] {
        let [one_minus_z, one_plus_z] = from_poles(w);
        let root = self.q(one_minus_z, one_plus_z).sqrt();
        let u = (T::ONE + self.g) * one_minus_z / (root * (root + (T::ONE - self.g)));
        [into_unit(u), turn::from_point(w.x(), w.y())]
    }

    /// Density per steradian of a unit direction.
    ///
    /// # Precision
    /// A few ulp for directions that keep the digits of their angle.
    #[inline]
    pub fn pdf(&self, w: Vec3<T>) -> T {
        let [one_minus_z, one_plus_z] = from_poles(w);
        self.density(one_minus_z, one_plus_z)
    }

    /// Density per steradian of the unit direction `to` around the unit direction `axis`.
    ///
    /// ```text
    /// 1 ∓ cos θ = |to ∓ axis|² / 2
    /// ```
    ///
    /// which keeps the digits of small angles, where the dot product rounds to 1.
    #[inline]
    pub fn pdf_around(&self, axis: Vec3<T>, to: Vec3<T>) -> T {
        let half_square = |w: Vec3<T>| T::HALF * w.length_squared();
        self.density(half_square(to - axis), half_square(to + axis))
    }

    #[inline]
    fn density(&self, one_minus_cos: T, one_plus_cos: T) -> T {
        let q = self.q(one_minus_cos, one_plus_cos);
        let numerator = (T::ONE - self.g) * (T::ONE + self.g);
        T::lit(0.25) * T::FRAC_1_PI * numerator / (q * q.sqrt())
    }

    /// `q`, measured from the pole where it is smallest.
    #[inline]
    fn q(&self, one_minus_cos: T, one_plus_cos: T) -> T {
        let g = self.g.abs();
        let distance = if self.g < T::ZERO { one_plus_cos } else { one_minus_cos };
        (T::ONE - g) * (T::ONE - g) + T::TWO * g * distance
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{check_density_on_sphere, check_inverse, check_jacobian, uniforms};
    use etendue_math::glam::{DVec3, Vec3};

    fn lobe<T: Real>(g: f64) -> HenyeyGreenstein<T> {
        HenyeyGreenstein::new(T::lit(g)).expect("in (−1, 1)")
    }

    #[test]
    fn inverse_undoes_the_map() {
        for g in [0.0, 1e-9, 0.3, -0.3, 0.9, -0.9] {
            let wide = lobe::<f64>(g);
            let bound = 16.0 * f64::EPSILON;
            check_inverse(|u| wide.from_square(u), |w| wide.to_square(w), bound);
            let narrow = lobe::<f32>(g);
            let bound = 16.0 * f64::from(f32::EPSILON);
            check_inverse(|u| narrow.from_square(u), |w| narrow.to_square(w), bound);
        }
    }

    #[test]
    fn density_is_that_of_the_map() {
        for g in [0.0, 0.5, -0.5, 0.8] {
            let lobe = lobe::<f64>(g);
            check_jacobian(|u| lobe.from_square(u), |w| lobe.pdf(w));
            check_density_on_sphere(|u| lobe.from_square(u), |w| lobe.pdf(w));
        }
    }

    #[test]
    fn the_mean_cosine_is_g() {
        for g in [-0.9, -0.2, 0.0, 1e-6, 0.7] {
            let lobe = lobe::<f64>(g);
            // The midpoint rule over the first uniform, whose integrand is smooth.
            let n = 1000;
            let mean = (0..n)
                .map(|i| lobe.from_square([(f64::from(i) + 0.5) / f64::from(n), 0.3]).z)
                .sum::<f64>()
                / f64::from(n);
            assert!((mean - g).abs() < 1e-5, "{mean} {g}");
        }
    }

    #[test]
    fn single_precision_keeps_the_angle_for_every_g() {
        for g in [0.0, 1e-7, -1e-7, 1e-3, 0.5, 0.999_999, -0.999_999] {
            let (narrow, wide) = (lobe::<f32>(g), lobe::<f64>(f64::from(g as f32)));
            for [u, v] in uniforms::<f32>(500) {
                let w = narrow.from_square([u, v]);
                let exact = wide.from_square([u, v].map(f64::from));
                let error = (w.as_dvec3() - exact).truncate().length();
                let size = exact.truncate().length();
                // The documented 16 ulp of the sine.
                assert!(error <= 16.0 * f64::from(f32::EPSILON) * size, "{g} {u}: {error} {size}");
                assert!((w.length() - 1.0).abs() < 8.0 * f32::EPSILON);
            }
        }
    }

    #[test]
    fn the_density_between_directions_keeps_small_angles() {
        let lobe = lobe::<f32>(0.999);
        let to = Vec3::new(1e-4, 0.0, 1.0);
        let q = 1e-6 + 0.999 * 1e-8;
        let exact = (1.0 - 0.999_f64 * 0.999) / (4.0 * f64::PI * q * Real::sqrt(q));
        // g itself has an ulp of 6e-8, 3e-5 of 1 − g; cubed, and halved by rounding.
        assert!((f64::from(lobe.pdf_around(Vec3::Z, to)) / exact - 1.0).abs() < 1e-4);
        assert!((f64::from(lobe.pdf(to)) / exact - 1.0).abs() < 1e-4);
    }

    #[test]
    fn only_mean_cosines_between_minus_one_and_one_are_accepted() {
        for bad in [1.0, -1.0, 1.5, f64::NAN, f64::INFINITY] {
            assert_eq!(HenyeyGreenstein::new(bad), None);
        }
        let lobe = lobe::<f64>(0.3);
        assert_eq!(lobe.mean_cosine(), 0.3);
        assert!(lobe.pdf(DVec3::Z) > lobe.pdf(-DVec3::Z));
    }
}
