//! Interface between a dielectric and a conductor.

use etendue_math::Real;

use super::checked_cosine;

/// Unpolarised reflectance F of a smooth conductor with relative index η + ik.
///
/// ```text
/// s² = (1 − c)(1 + c),  d = (η − 1)(η + 1) − k²,  t = d + c²
/// a² − b² = t,  a b = η k                              (a + ib)² = (η + ik)² − s²
/// Rs = ((a − c)² + b²) / ((a + c)² + b²)
/// Rp = Rs ((a c − s²)² + b² c²) / ((a c + s²)² + b² c²)
/// F = ½ (Rs + Rp)
/// ```
///
/// * `cos_i`: cosine c of the angle of incidence; see the [module](crate::fresnel).
/// * `eta`, `k`: real part and extinction coefficient relative to the medium above, finite and not
///   negative; 0 is returned outside.
///
/// Returns F in `[0, 1]`.
///
/// # Precision
/// A few ulp times the condition of the problem. The larger of a and b comes from a root of a sum,
/// the other from their product, and `a² − c²` is `d + b²` where it would cancel, so that the dielectric
/// limit k → 0, η → 1 keeps its digits.
///
/// # Source
/// Born and Wolf, Principles of Optics, section 14.2, with Rp expressed through Rs.
///
/// # Examples
/// ```
/// use etendue_brdf::fresnel::conductor;
/// // Gold in red light at normal incidence: ((η − 1)² + k²) / ((η + 1)² + k²).
/// let (eta, k) = (0.2_f64, 3.1);
/// let f0 = ((eta - 1.0).powi(2) + k * k) / ((eta + 1.0).powi(2) + k * k);
/// assert!((conductor(1.0, eta, k) - f0).abs() < 1e-15);
/// ```
#[inline]
pub fn conductor<T: Real>(cos_i: T, eta: T, k: T) -> T {
    let valid = eta >= T::ZERO && k >= T::ZERO && eta < T::INFINITY && k < T::INFINITY;
    checked_cosine(cos_i).filter(|_| valid).map_or(T::ZERO, |c| conductor_of_valid(c, eta, k))
}

/// The same for arguments known to lie in their domain, without a branch, so that channels are computed
/// side by side.
#[inline(always)]
pub(crate) fn conductor_of_valid<T: Real>(c: T, eta: T, k: T) -> T {
    let s2 = (T::ONE - c) * (T::ONE + c);
    let d = (eta - T::ONE) * (eta + T::ONE) - k * k;
    let c2 = c * c;
    let t = d + c2;
    let product = eta * k;
    let root = (t * t + T::lit(4.0) * product * product).sqrt();
    let larger = (T::HALF * (root + t.abs())).sqrt();
    let smaller = product / larger;
    let (a, b) = if t >= T::ZERO { (larger, smaller) } else { (smaller, larger) };
    let (sum, b2) = (a + c, b * b);
    // Squares of cosines below the root of the least number.
    let sum2 = (sum * sum).max(T::MIN_POSITIVE);
    // a² − c²: its factor a − c cancels only where a ≈ c; there d + b² is the small number itself.
    let difference = if b < T::HALF { d + b2 } else { (a - c) * sum };
    let bc2 = b2 * c2;
    let (plus, minus) = (a * c + s2, a * c - s2);
    let denominator = plus * plus + bc2;
    // Rs and Rp share a factor: F = ½ Rs (1 + Rp/Rs), over one denominator, whose rounding cancels.
    let numerator = (difference * difference + b2 * sum2) * (denominator + (minus * minus + bc2));
    // 0/0 is grazing incidence on a matched index, where the minimum with NaN is 1 as well.
    (T::HALF * numerator / (sum2 * (sum2 + b2) * denominator)).min(T::ONE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::dielectric;

    #[test]
    fn without_extinction_it_is_a_dielectric() {
        for i in 0..=100 {
            let c = f64::from(i) / 100.0;
            for eta in [0.5, 0.999, 1.001, 1.5, 3.0] {
                let (got, want) = (conductor(c, eta, 0.0), dielectric(c, eta));
                // Close to the critical angle g² keeps an absolute error of ε, F one of √ε at worst.
                assert!((got - want).abs() <= 1e-9 * want.max(1e-9), "{c} {eta} {got} {want}");
            }
        }
    }

    #[test]
    fn the_imaginary_unit_is_a_perfect_mirror() {
        for i in 0..=100 {
            let f = conductor(f64::from(i) / 100.0, 0.0, 1.0);
            // A quotient of two sums of the same terms.
            assert!((f - 1.0).abs() <= 2.0 * f64::EPSILON, "{f}");
        }
    }

    #[test]
    fn reflectance_stays_within_zero_and_one_over_the_whole_domain() {
        for c in [0.0_f32, 1e-7, 1e-3, 0.5, 0.9999999, 1.0] {
            for eta in [0.0_f32, 1e-4, 0.5, 1.0, 1.0000001, 2.0, 1e4] {
                for k in [0.0_f32, 1e-7, 1e-3, 1.0, 10.0, 1e4] {
                    let f = conductor(c, eta, k);
                    assert!((0.0..=1.0).contains(&f), "{c} {eta} {k} {f}");
                }
            }
        }
        assert_eq!(conductor(f32::NAN, 1.0, 1.0), 0.0);
        assert_eq!(conductor(0.5_f32, f32::NAN, 1.0), 0.0);
    }
}
