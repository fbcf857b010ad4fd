//! Multiple importance sampling: how to share a sample among strategies that could have drawn it.
//!
//! Densities are of one measure; with `nᵢ` samples per strategy pass `nᵢ pᵢ`. All functions are
//! total: a density of 0, below 0 or NaN counts as "cannot draw it", an infinite one as
//! "certainly drew it". `p/(p + q)` as written would be inf/inf for two large densities.
//!
//! # Source
//! E. Veach, L. Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering",
//! SIGGRAPH 1995.

use etendue_math::Real;

/// `other/own` of guarded densities; `None` where the weight of `own` is 0 whatever the other does.
#[inline]
fn ratio<T: Real>(own: T, other: T) -> Option<T> {
    // `clamp_to` turns NaN into 0.
    let [own, other] = [own, other].map(|p| p.clamp_to(T::ZERO, T::INFINITY));
    if own == T::ZERO {
        None
    } else if own == other {
        // Two infinite densities share evenly.
        Some(T::ONE)
    } else {
        Some(other / own)
    }
}

/// Balance heuristic for a sample drawn with density `own` that `other` could have drawn too.
///
/// ```text
/// w = p/(p + q) = 1/(1 + q/p)
/// ```
///
/// In `[0, 1]`, and the weights of the two strategies sum to 1 unless both densities are 0.
///
/// # Examples
/// ```
/// use etendue_sampling::mis;
/// assert_eq!(mis::balance(3.0_f32, 1.0), 0.75);
/// assert_eq!(mis::balance(f32::MAX, f32::MAX), 0.5);
/// ```
#[inline]
pub fn balance<T: Real>(own: T, other: T) -> T {
    ratio(own, other).map_or(T::ZERO, |q| T::ONE / (T::ONE + q))
}

/// Power heuristic with exponent 2 for a sample drawn with density `own` that `other` could have
/// drawn too.
///
/// ```text
/// w = p²/(p² + q²) = 1/(1 + (q/p)²)
/// ```
///
/// In `[0, 1]`, and the weights of the two strategies sum to 1 unless both densities are 0.
#[inline]
pub fn power<T: Real>(own: T, other: T) -> T {
    ratio(own, other).map_or(T::ZERO, |q| T::ONE / (T::ONE + q * q))
}

/// Balance heuristic among any number of strategies, for a sample drawn by strategy `own` (an index
/// into `densities`; 0 beyond its end).
///
/// ```text
/// w = pᵢ/Σ pⱼ = 1/Σ (pⱼ/pᵢ)
/// ```
#[inline]
pub fn balance_among<T: Real>(densities: &[T], own: usize) -> T {
    let Some(&own) = densities.get(own) else { return T::ZERO };
    let sum: Option<T> = densities.iter().map(|&other| ratio(own, other)).sum();
    sum.map_or(T::ZERO, |sum| T::ONE / sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOSTILE: [f32; 9] =
        [0.0, 1e-45, f32::MIN_POSITIVE, 1e-20, 1.0, 3.0, 1e20, f32::MAX, f32::INFINITY];

    #[test]
    fn weights_of_two_strategies_sum_to_one() {
        for p in HOSTILE {
            for q in HOSTILE {
                let want = if p == 0.0 && q == 0.0 { 0.0 } else { 1.0 };
                // Two divisions.
                let bound = 2.0 * f32::EPSILON;
                assert!((balance(p, q) + balance(q, p) - want).abs() <= bound, "{p} {q}");
                assert!((power(p, q) + power(q, p) - want).abs() <= bound, "{p} {q}");
            }
        }
    }

    #[test]
    fn invalid_densities_count_as_zero() {
        for bad in [f64::NAN, -1.0, f64::NEG_INFINITY] {
            assert_eq!(balance(1.0, bad), 1.0);
            assert_eq!(balance(bad, 1.0), 0.0);
            assert_eq!(power(1.0, bad), 1.0);
            assert_eq!(power(bad, bad), 0.0);
            assert_eq!(balance_among(&[1.0, bad, 3.0], 2), 0.75);
        }
    }

    #[test]
    fn many_strategies_agree_with_two() {
        for p in HOSTILE {
            for q in HOSTILE {
                assert_eq!(balance_among(&[p, q], 0), balance(p, q), "{p} {q}");
            }
        }
        let densities = [0.5, 2.0, 0.0, f64::INFINITY];
        let sum: f64 = (0..4).map(|i| balance_among(&densities, i)).sum();
        assert_eq!(sum, 1.0);
        assert_eq!(balance_among(&densities, 4), 0.0);
    }
}
