//! Interface between two dielectrics.

use etendue_math::Real;

use super::{RelativeIndex, checked_cosine};

/// Unpolarised reflectance F of a smooth interface between dielectrics.
///
/// ```text
/// k = (η − 1)(η + 1),  g = √(k + c²) = η cos θt
/// r = k / (g + c)²                                     |Rs| amplitude
/// q = (c (g + c) − 1) / (c k / (g + c) + 1)            ratio of the two amplitudes
/// F = ½ r² (1 + q²);   F = 1 where k + c² ≤ 0 (total internal reflection)
/// ```
///
/// * `cos_i`: cosine c of the angle of incidence; see the [module](crate::fresnel).
/// * `eta`: η = n(transmitted side) / n(incident side), positive, its square finite; 0 is returned outside.
///
/// Returns F in `[0, 1]`; 0 for η = 1. For c > 0 it is 1 exactly where [`refract`](super::refract)
/// finds no direction.
///
/// # Precision
/// A few ulp times the condition of the problem: also for η → 1, where the textbook form
/// `((η cos θt − c) / (η cos θt + c))²` has lost every digit at η = 1 + 5e-7 in `f32`.
///
/// # Source
/// R. Cook and K. Torrance, ACM TOG 1(1), 1982, eq. for F in appendix, with `η² − 1` and `g − c`
/// rewritten as products so that nothing cancels.
///
/// # Examples
/// ```
/// use etendue_brdf::fresnel::dielectric;
/// assert!((dielectric(1.0_f64, 1.5) - 0.04).abs() < 1e-15);
/// assert_eq!(dielectric(0.1_f32, 1.0 / 1.5), 1.0); // total internal reflection
/// ```
#[inline]
pub fn dielectric<T: Real>(cos_i: T, eta: T) -> T {
    let index = checked_index(eta);
    checked_cosine(cos_i).zip(index).map_or(T::ZERO, |(c, index)| index.reflectance(c))
}

/// Reflectances `[Rs, Rp]` for light polarised perpendicular and parallel to the plane of incidence.
///
/// Formula, domain and precision as for [`dielectric`]: `Rs = r²`, `Rp = r² q²`.
///
/// # Source
/// As [`dielectric`].
#[inline]
pub fn dielectric_polarized<T: Real>(cos_i: T, eta: T) -> [T; 2] {
    let index = checked_index(eta);
    checked_cosine(cos_i).zip(index).map_or([T::ZERO; 2], |(c, index)| index.polarized(c))
}

/// Unpolarised transmittance `T = 1 − F`, without the cancellation where F → 1.
///
/// ```text
/// T = 2 c g (1 / (c + g)² + η² / (η² c + g)²),  g = √((η − 1)(η + 1) + c²)
/// ```
///
/// Arguments as for [`dielectric`]; 1 for η = 1, 0 for total internal reflection and outside the domain.
///
/// # Precision
/// A few ulp times the condition of the problem, relative to T itself.
///
/// # Source
/// Born and Wolf, Principles of Optics, section 1.5.3, eqs. 39 and 40.
#[inline]
pub fn dielectric_transmittance<T: Real>(cos_i: T, eta: T) -> T {
    let index = checked_index(eta);
    checked_cosine(cos_i).zip(index).map_or(T::ZERO, |(c, index)| index.transmittance(c))
}

/// The index as seen from above, or `None` outside the domain.
#[inline(always)]
pub(super) fn checked_index<T: Real>(eta: T) -> Option<RelativeIndex<T>> {
    (eta > T::ZERO && eta * eta < T::INFINITY).then(|| RelativeIndex::from_above(eta))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_incidence_is_f0() {
        for eta in [0.4_f64, 0.9, 1.0, 1.000_001, 1.33, 2.4, 100.0] {
            let f0 = Real::sqr((eta - 1.0) / (eta + 1.0));
            assert!((dielectric(1.0, eta) - f0).abs() <= 4.0 * f64::EPSILON * f0, "{eta}");
        }
    }

    #[test]
    fn parallel_polarisation_vanishes_at_brewsters_angle() {
        let eta = 1.5_f64;
        // tan θB = η
        let [rs, rp] = dielectric_polarized(1.0 / (1.0 + eta * eta).sqrt(), eta);
        assert!(rp < 1e-30 && rs > 0.1, "{rs} {rp}");
    }

    #[test]
    fn reflectance_and_transmittance_sum_to_one() {
        for i in 0..=1000 {
            let c = f64::from(i) / 1000.0;
            for eta in [0.25, 0.7, 0.999_99, 1.0, 1.000_01, 1.5, 10.0] {
                let sum = dielectric(c, eta) + dielectric_transmittance(c, eta);
                // Near η = 1 at grazing g is a root of a small difference: 1e-16 / 1e-5.
                assert!((sum - 1.0).abs() < 1e-10, "{c} {eta} {sum}");
            }
        }
    }

    #[test]
    fn the_value_does_not_depend_on_the_side_it_is_seen_from() {
        let (c, eta) = (0.6_f64, 1.5);
        let cos_t = (eta * eta - 1.0 + c * c).sqrt() / eta;
        // Two evaluations of a few roundings each.
        assert!((dielectric(c, eta) - dielectric(cos_t, 1.0 / eta)).abs() < 1e-15);
    }

    #[test]
    fn outside_the_domain_nothing_is_reflected_and_nothing_is_nan() {
        for x in [f32::NAN, f32::INFINITY, -0.5, 1.5] {
            assert_eq!(dielectric(x, 1.5), 0.0);
        }
        for eta in [f32::NAN, f32::INFINITY, -1.5, 0.0] {
            assert_eq!(dielectric(0.5, eta), 0.0);
            assert_eq!(dielectric_transmittance(0.5, eta), 0.0);
        }
    }
}
