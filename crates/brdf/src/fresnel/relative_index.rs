//! The index of refraction of an interface, as one of its sides sees it.

use etendue_math::{Real, Vector3};

/// η = n(far side) / n(near side) of an interface given by its index from above.
///
/// ```text
/// from above  η,    η − 1,                 k = η² − 1 = (η − 1)(η + 1)
/// from below  1/η,  1/η − 1 = −(η − 1)/η,  k likewise
/// ```
///
/// `1/η` is rounded, and `η − 1` of the rounded number would have lost most digits of an η near 1;
/// the mirrored difference keeps them.
///
/// Reflectance, transmittance and refraction all ask [`scaled_cos_t`](Self::scaled_cos_t) whether
/// there is total internal reflection, so they agree on where it sets in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RelativeIndex<T> {
    /// η, rounded when seen from below.
    eta: T,
    /// `η − 1` to a few ulp of itself.
    excess: T,
    /// `η² − 1` to a few ulp of itself.
    k: T,
    /// The index the interface was given by: η from above, exactly `1/η` from below.
    given: T,
    side: Side,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Above,
    Below,
}

impl<T: Real> RelativeIndex<T> {
    /// As seen from above. `eta` positive, its square finite.
    #[inline(always)]
    pub(crate) fn from_above(eta: T) -> Self {
        let excess = eta - T::ONE;
        Self { eta, excess, k: excess * (eta + T::ONE), given: eta, side: Side::Above }
    }

    /// As seen from above, by `η − 1`, which has digits that η itself would lose near 1.
    #[inline]
    pub(crate) fn from_excess(excess: T) -> Self {
        let eta = T::ONE + excess;
        Self { eta, excess, k: excess * (T::TWO + excess), given: eta, side: Side::Above }
    }

    /// The interface with index `eta` from above, as seen from below.
    #[inline(always)]
    pub(crate) fn from_below(eta: T) -> Self {
        let (inverse, excess) = (T::ONE / eta, -(eta - T::ONE) / eta);
        let k = excess * (inverse + T::ONE);
        Self { eta: inverse, excess, k, given: eta, side: Side::Below }
    }

    /// η.
    #[inline(always)]
    pub(crate) fn eta(self) -> T {
        self.eta
    }

    /// Both sides have the same index.
    #[inline(always)]
    pub(crate) fn is_matched(self) -> bool {
        self.k == T::ZERO
    }

    /// `wo + η wi`, along the half vector of refraction.
    ///
    /// `(wo + wi) + (η − 1) wi`: the first sum is exact where the two nearly cancel.
    #[inline(always)]
    pub(crate) fn half_sum<V: Vector3<Scalar = T>>(self, wo: V, wi: V) -> V {
        (wo + wi) + wi * self.excess
    }

    /// `c − g` without cancellation, for `g` from [`scaled_cos_t`](Self::scaled_cos_t).
    #[inline(always)]
    pub(crate) fn cosine_difference(self, c: T, g: T) -> T {
        -self.k / (g + c)
    }

    /// `g = η cos θt = √(k + c²)`, or `None` under total internal reflection.
    #[inline(always)]
    pub(crate) fn scaled_cos_t(self, c: T) -> Option<T> {
        let mut g2 = self.k + c * c;
        // Further away g² keeps all but 8 of its bits; for η > 1 the sum has no negative term.
        if self.k < T::ZERO && g2.abs() <= self.k * T::lit(-1.0 / 256.0) {
            g2 = self.critical_radicand(c);
        }
        (g2 > T::ZERO).then(|| g2.sqrt())
    }

    /// `k + c²` in twice the working precision.
    ///
    /// ```text
    /// from above  (η² − 1) + c²
    /// from below  ((c/η)² − (1/η² − 1)) η²,  with 1/η the given number
    /// ```
    ///
    /// # Source
    /// T. Dekker, "A Floating-Point Technique for Extending the Available Precision", Numer. Math. 18, 1971.
    #[cold]
    fn critical_radicand(self, c: T) -> T {
        let (square, square_low) = product(self.given, self.given);
        let (k, k_error) = sum(square, -T::ONE);
        let k_low = k_error + square_low;
        let (q, q_low, k, k_low, scale) = match self.side {
            Side::Above => (c, T::ZERO, k, k_low, T::ONE),
            Side::Below => {
                let (q, q_low) = product(c, self.given);
                (q, q_low, -k, -k_low, square)
            }
        };
        let (q2, q2_low) = product(q, q);
        let (high, low) = sum(k, q2);
        (high + (low + (k_low + (q2_low + T::TWO * q * q_low)))) / scale
    }

    /// Reflectances `[Rs, Rp]`; see [`dielectric_polarized`](super::dielectric_polarized).
    #[inline(always)]
    pub(super) fn polarized(self, c: T) -> [T; 2] {
        if self.is_matched() {
            return [T::ZERO; 2]; // also at c = 0, where r would be 0/0
        }
        self.scaled_cos_t(c).map_or([T::ONE; 2], |g| self.polarized_of_pair(c, g))
    }

    /// Unpolarised reflectance F; see [`dielectric`](super::dielectric). `c` in `[0, 1]`.
    #[inline(always)]
    pub(crate) fn reflectance(self, c: T) -> T {
        if self.is_matched() {
            return T::ZERO;
        }
        self.scaled_cos_t(c).map_or(T::ONE, |g| self.reflectance_of_pair(c, g))
    }

    /// The reflectance where both angles are known: `g = η cos θt`, `c = cos θi`.
    ///
    /// Below 1 for `c > 0`: 1 is kept for total internal reflection and for grazing incidence.
    #[inline(always)]
    pub(super) fn reflectance_of_pair(self, c: T, g: T) -> T {
        let [rs, rp] = self.polarized_of_pair(c, g);
        let limit = if c > T::ZERO { T::ONE_MINUS_EPSILON } else { T::ONE };
        (T::HALF * (rs + rp)).min(limit)
    }

    #[inline(always)]
    fn polarized_of_pair(self, c: T, g: T) -> [T; 2] {
        let sum = g + c;
        if !(sum > T::ZERO) {
            return [T::ZERO; 2]; // matched indices at grazing incidence
        }
        let r = self.k / (sum * sum);
        let q = (c * sum - T::ONE) / (c * (self.k / sum) + T::ONE);
        let rs = (r * r).min(T::ONE);
        [rs, (rs * q * q).min(T::ONE)]
    }

    /// Transmittance 1 − F; see [`dielectric_transmittance`](super::dielectric_transmittance).
    #[inline(always)]
    pub(crate) fn transmittance(self, c: T) -> T {
        if self.is_matched() {
            return T::ONE;
        }
        self.scaled_cos_t(c).map_or(T::ZERO, |g| self.transmittance_of_pair(c, g))
    }

    /// The transmittance where both angles are known: `g = η cos θt`, `c = cos θi`.
    ///
    /// A direction pair and the half vector it defines obey Snell's law by construction; taking both
    /// cosines makes the value symmetric in the two and total internal reflection impossible.
    #[inline(always)]
    pub(crate) fn transmittance_of_pair(self, c: T, g: T) -> T {
        let s = c + g;
        let p = self.eta * c + g / self.eta;
        if !(s > T::ZERO && p > T::ZERO) {
            return T::ZERO;
        }
        T::TWO * ((c / s) * (g / s) + (c / p) * (g / p)).min(T::HALF)
    }
}

/// `a b` as an unevaluated sum.
#[inline(always)]
pub(super) fn product<T: Real>(a: T, b: T) -> (T, T) {
    let high = a * b;
    (high, a.mul_add(b, -high))
}

/// `a + b` as an unevaluated sum.
#[inline(always)]
pub(super) fn sum<T: Real>(a: T, b: T) -> (T, T) {
    let high = a + b;
    let part = high - a;
    (high, (a - (high - part)) + (b - part))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_index_near_one_keeps_its_digits_from_below() {
        for eta in [0.999_999_f32, 1.000_001, 1.001, 1.5, 100.0] {
            let (narrow, wide) =
                (RelativeIndex::from_below(eta), RelativeIndex::from_below(f64::from(eta)));
            // Three and five roundings.
            for (got, want) in [(narrow.excess, wide.excess), (narrow.k, wide.k)] {
                let error = (f64::from(got) / want - 1.0).abs();
                assert!(error <= 3.0 * f64::from(f32::EPSILON), "{eta} {error}");
            }
        }
    }

    #[test]
    fn total_reflection_sets_in_where_exact_arithmetic_says() {
        for eta in [0.1_f32, 0.4, 0.66667, 0.99, 0.999_999] {
            for (index, given, inside) in [
                (RelativeIndex::from_above(eta), f64::from(eta), false),
                (RelativeIndex::from_below(1.0 / eta), f64::from(1.0 / eta), true),
            ] {
                let mut c = (-index.k).sqrt();
                for _ in 0..16 {
                    c = c.next_down();
                }
                for _ in 0..32 {
                    // The products of two f32 are exact in f64, their sum to 1e-16.
                    let c2 = f64::from(c) * f64::from(c);
                    let square = given * given;
                    let radicand =
                        if inside { c2 * square - (square - 1.0) } else { (square - 1.0) + c2 };
                    if radicand.abs() > 1e-14 {
                        assert_eq!(index.scaled_cos_t(c).is_some(), radicand > 0.0, "{eta} {c}");
                    }
                    c = c.next_up();
                }
            }
        }
    }
}
