//! Compensated summation.

use crate::Real;

/// A running sum kept as an unevaluated pair of numbers (double-word arithmetic).
///
/// Unlike Kahan's and Neumaier's sums, whose correction term drifts over millions of equal terms,
/// the pair is renormalised at every step.
///
/// # Precision
/// Each step has a relative error of at most 2u² (u = ε/2): n terms of one sign are summed to
/// about `u + 2 n u²` instead of `n u`.
///
/// # Source
/// Joldes, Muller, Popescu, "Tight and Rigorous Error Bounds for Basic Building Blocks of
/// Double-Word Arithmetic", ACM TOMS 44(2), 2017, algorithm 4 (DWPlusFP).
///
/// # Examples
/// ```
/// use etendue_math::CompensatedSum;
/// let mut sum = CompensatedSum::default();
/// for x in [1.0_f32, 1e8, 1.0, -1e8] {
///     sum.add(x);
/// }
/// assert_eq!(sum.total(), 2.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CompensatedSum<T> {
    high: T,
    low: T,
}

impl<T: Real> CompensatedSum<T> {
    /// The sum of these [`total`](Self::total) and [`remainder`](Self::remainder), to go on with one that was stored: bit by bit the same.
    #[inline]
    pub fn from_parts(total: T, remainder: T) -> Self {
        Self { high: total, low: remainder }
    }

    /// Adds one term.
    #[inline]
    pub fn add(&mut self, x: T) {
        // Two-sum: `sum + error` is exactly `high + x`.
        let sum = self.high + x;
        let virtual_x = sum - self.high;
        let error = (self.high - (sum - virtual_x)) + (x - virtual_x);
        // Fast two-sum: the low word stays below half an ulp of the high one.
        let low = self.low + error;
        self.high = sum + low;
        self.low = low - (self.high - sum);
    }

    /// The sum so far.
    #[inline]
    pub fn total(&self) -> T {
        self.high
    }

    /// The part of the sum that `total` rounds away.
    #[inline]
    pub fn remainder(&self) -> T {
        self.low
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stored_sum_goes_on_as_if_nothing_had_happened() {
        let (mut whole, mut stopped) = (CompensatedSum::default(), CompensatedSum::default());
        for i in 0..1000_u16 {
            let x = f32::from(i) * 0.1 - 30.0;
            whole.add(x);
            stopped.add(x);
            stopped = CompensatedSum::from_parts(stopped.total(), stopped.remainder());
        }
        assert_eq!(whole, stopped);
    }

    #[test]
    fn a_million_tenths_make_a_hundred_thousand() {
        // An interpreter gets ten thousand.
        let count = if cfg!(miri) { 10_000 } else { 1_000_000 };
        let exact = count as f32 / 10.0;
        let mut sum = CompensatedSum::default();
        let mut plain = 0.0_f32;
        for _ in 0..count {
            sum.add(0.1_f32);
            plain += 0.1;
        }
        // 0.1 is not an f32: its own error times 10⁶ is 1.5e-3, below the spacing of f32 at 1e5.
        assert_eq!(sum.total(), exact);
        assert!((plain - exact).abs() > 5e-5 * exact, "plain summation loses three digits");
    }
}
