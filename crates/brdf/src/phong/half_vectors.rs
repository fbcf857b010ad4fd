//! The distribution of half vectors that Ashikhmin and Shirley reflect light at.

use etendue_math::{Real, Vec3, Vector3};
use etendue_sampling::warp::turn;

use crate::Exponent;

/// An anisotropic power of the cosine between half vector and normal, as a density to sample from.
///
/// ```text
/// p(h) = √((nu + 1)(nv + 1))/(2π) (n·h)^e,   e = nu cos² φ + nv sin² φ,   ∫ p dω = 1
/// ```
///
/// The exponents belong to the tangent directions +x and +y.
///
/// # Precision
/// Within 8 ulp: [`pdf`](Self::pdf) of the vector it is given, for exponents up to 1e12, and [`sample`](Self::sample) in each
/// component. The power is `exp(−½ e log1p(s²/hz²))` with `s² = hx² + hy²`, `e = (nu hx² + nv hy²)/s²`; in terms of the
/// cosine alone `f32` is wrong by 6 % at n = 1e6, and h = n is 0/0. It is evaluated in `f64` for `f32` too: far out in the
/// lobe one rounding of the logarithm counts as often as it is large, some 60 ulp at e⁻⁸⁰.
///
/// # Source
/// M. Ashikhmin and P. Shirley, "An Anisotropic Phong BRDF Model", J. Graphics Tools 5(2), 2000, eqs. 6, 9 and 10.
///
/// # Examples
/// ```
/// use etendue_brdf::{Exponent, PhongHalfVectors};
/// let brushed = PhongHalfVectors::new(Exponent::new(10.0_f32)?, Exponent::new(1e6)?);
/// let (h, pdf) = brushed.sample([0.1, 0.5]);
/// assert!(h.x > 100.0 * h.y);
/// assert!((brushed.pdf(h) / pdf - 1.0).abs() < 1e-5);
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhongHalfVectors<T> {
    nu: T,
    nv: T,
    /// `√(nu + 1)` and `√(nv + 1)`
    roots: [T; 2],
}

impl<T: Real> PhongHalfVectors<T> {
    /// The distribution with these exponents along x and y.
    #[inline]
    pub fn new(nu: Exponent<T>, nv: Exponent<T>) -> Self {
        let (nu, nv) = (nu.value(), nv.value());
        Self { nu, nv, roots: [nu, nv].map(|n| (n + T::ONE).sqrt()) }
    }

    /// `√((nu + 1)(nv + 1))/(2π)`, the density at the normal.
    #[inline(always)]
    fn peak(&self) -> T {
        self.roots[0] * self.roots[1] * (T::HALF * T::FRAC_1_PI)
    }

    /// Density per steradian of the half vector `h`, a unit vector; 0 below the surface.
    #[inline]
    pub fn pdf(&self, h: Vec3<T>) -> T {
        let wide = |x: T| x.to_f64();
        T::lit(self.pdf_wide(Vec3::<f64>::new(wide(h.x()), wide(h.y()), wide(h.z()))))
    }

    /// [`pdf`](Self::pdf) in double precision, of a vector of any length.
    #[inline(always)]
    pub(super) fn pdf_wide(&self, h: Vec3<f64>) -> f64 {
        if !(h.z > 0.0) {
            return 0.0;
        }
        let [nu, nv] = [self.nu, self.nv].map(T::to_f64);
        let (x2, y2, z2) = (h.x * h.x, h.y * h.y, h.z * h.z);
        let s2 = x2 + y2;
        let exponent = nu * x2 + nv * y2;
        let power = if exponent > 0.0 {
            Real::exp(-0.5 * exponent / s2 * Real::ln_1p(s2 / z2))
        } else {
            1.0
        };
        self.peak().to_f64() * power
    }

    /// A half vector with density [`pdf`](Self::pdf), and that density.
    ///
    /// ```text
    /// (cos φ, sin φ) ∝ (√(nv + 1) cos 2πu₀, √(nu + 1) sin 2πu₀)
    /// cos θ = (1 − u₁)^(1/(e + 1)),   sin² θ = −expm1(2 log1p(−u₁)/(e + 1))
    /// p(h)  = √((nu + 1)(nv + 1))/(2π) (1 − u₁)/cos θ
    /// ```
    ///
    /// `u`: uniforms, limited to `[0, 1)`; NaN counts as 0. The azimuth is the published one, quadrant by quadrant,
    /// without its tangents, which in `f32` flip at the quadrants' ends.
    #[inline]
    pub fn sample(&self, u: [T; 2]) -> (Vec3<T>, T) {
        let [turns, u] = u.map(|u| u.clamp_to(T::ZERO, T::ONE_MINUS_EPSILON));
        let (sin, cos) = turn::sin_cos(turns);
        let (x, y) = (self.roots[1] * cos, self.roots[0] * sin);
        let length = (x * x + y * y).sqrt();
        let (cos, sin) = (x / length, y / length);
        let exponent = self.nu * cos * cos + self.nv * sin * sin + T::ONE;
        let log_cos = (-u).ln_1p() / exponent;
        let sin_theta = (-(T::TWO * log_cos).exp_m1()).safe_sqrt();
        let cos_theta = log_cos.exp();
        let h = Vec3::<T>::new(sin_theta * cos, sin_theta * sin, cos_theta);
        (h, self.peak() * ((T::ONE - u) / cos_theta))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn half_vectors<T: Real>(nu: f64, nv: f64) -> PhongHalfVectors<T> {
        let [nu, nv] = [nu, nv].map(|n| Exponent::new(T::lit(n)).unwrap());
        PhongHalfVectors::new(nu, nv)
    }

    #[test]
    fn the_density_is_that_of_the_samples() {
        // The Jacobian of the map, by central differences, is 1/p.
        let lobe = half_vectors::<f64>(12.0, 90.0);
        let step = 1e-5;
        for a in [0.05, 0.2, 0.4, 0.61, 0.93] {
            for b in [0.1, 0.5, 0.9] {
                let along = |d: [f64; 2]| {
                    let at = |s: f64| lobe.sample([a + s * d[0], b + s * d[1]]).0;
                    (at(step) - at(-step)) / (2.0 * step)
                };
                let area = along([1.0, 0.0]).cross(along([0.0, 1.0])).length();
                let (h, pdf) = lobe.sample([a, b]);
                // The third derivative of the map times step².
                assert!((area * pdf - 1.0).abs() < 1e-6, "{a} {b}");
                assert!((lobe.pdf(h) / pdf - 1.0).abs() < 1e-13, "{a} {b}");
            }
        }
    }

    #[test]
    fn the_azimuth_is_the_published_one_in_every_quadrant() {
        let lobe = half_vectors::<f64>(3.0, 50.0);
        let first = |u: f64| Real::atan(Real::sqrt(4.0 / 51.0_f64) * Real::tan(0.5 * f64::PI * u));
        for i in 1..100 {
            let u = f64::from(i) / 100.0;
            if i % 25 == 0 {
                continue;
            }
            let phi = match i / 25 {
                0 => first(4.0 * u),
                1 => f64::PI - first(4.0 * (0.5 - u)),
                2 => f64::PI + first(4.0 * (u - 0.5)),
                _ => 2.0 * f64::PI - first(4.0 * (1.0 - u)),
            };
            let (h, _) = lobe.sample([u, 0.5]);
            assert!((Real::sin(phi) * h.x - Real::cos(phi) * h.y).abs() < 1e-14, "{u}");
            assert!(Real::cos(phi) * h.x >= 0.0 && Real::sin(phi) * h.y >= 0.0, "{u}");
        }
    }

    #[test]
    fn the_normal_has_the_largest_density_and_no_exponent() {
        let lobe = half_vectors::<f32>(1e6, 1e2);
        let peak = lobe.pdf(etendue_math::glam::Vec3::Z);
        let want = (1_000_001.0_f64 * 101.0).sqrt() * 0.5 * f64::FRAC_1_PI;
        // Two roots and three products.
        assert!((f64::from(peak) / want - 1.0).abs() < 4.0 * f64::from(f32::EPSILON));
        assert_eq!(lobe.pdf(etendue_math::glam::Vec3::X), 0.0);
        assert_eq!(lobe.pdf(etendue_math::glam::Vec3::NAN), 0.0);
    }

    #[test]
    fn exponents_of_zero_are_the_uniform_hemisphere() {
        let lobe = half_vectors::<f64>(0.0, 0.0);
        let (h, pdf) = lobe.sample([0.3, 0.25]);
        assert!((h.z - 0.75).abs() < 1e-15);
        assert_eq!([lobe.pdf(h), pdf], [0.5 * f64::FRAC_1_PI; 2]);
    }

    #[test]
    fn every_uniform_gives_a_unit_vector() {
        for n in [0.0, 1.0, 1e6, 1e12] {
            let lobe = half_vectors::<f32>(n, 1.0);
            for u in [f32::NAN, -1.0, 0.0, 1e-30, 0.25, 0.5, f32::ONE_MINUS_EPSILON, 2.0] {
                let (h, pdf) = lobe.sample([u, u]);
                assert!((h.length() - 1.0).abs() < 4.0 * f32::EPSILON && h.z > 0.0, "{n} {u} {h}");
                assert!(pdf > 0.0 && pdf.is_finite(), "{n} {u} {pdf}");
            }
        }
    }
}
