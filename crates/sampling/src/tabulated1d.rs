//! One-dimensional tabulated distributions.

use etendue_math::Real;

use crate::TableError;
use crate::table::{accumulate, copy_scaled, largest};
use crate::warp::into_unit;

/// A discrete distribution over `n` entries, which is also the piecewise-constant density over
/// `[0, 1)` with `n` equal pieces. It borrows its cumulative table, `n + 1` numbers from 0 to 1.
///
/// The probability of an entry is the difference of its two numbers in the table, which is exactly
/// how often it is drawn: rounding of the table biases nothing. Entries below `ε/2` of the total
/// may vanish in it; use `f64` tables for more than about 10⁵ entries of very different weight.
///
/// # Examples
/// ```
/// use etendue_sampling::Tabulated1d;
/// let mut cdf = [0.0_f32; 4];
/// let lights = Tabulated1d::build(&[1.0, 0.0, 3.0], &mut cdf)?;
/// let choice = lights.choose(0.5);
/// assert_eq!((choice.index, choice.probability), (2, 0.75));
/// assert_eq!(lights.probability(1), 0.0);
/// // Later, from the stored table:
/// let again = Tabulated1d::from_cdf(&cdf);
/// assert_eq!(again.map(|t| t.len()), Some(3));
/// # Ok::<(), etendue_sampling::TableError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tabulated1d<'a, T> {
    /// At least two numbers.
    cdf: &'a [T],
}

/// An entry drawn from a [`Tabulated1d`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice<T> {
    /// The entry.
    pub index: usize,
    /// Its probability, greater than 0.
    pub probability: T,
    /// What is left of the uniform number: again uniform in `[0, 1)`, with as many bits fewer as
    /// the choice took.
    pub residual: T,
}

impl<'a, T: Real> Tabulated1d<'a, T> {
    /// Fills `cdf`, one longer than `weights`, and returns the distribution that borrows it.
    ///
    /// ```text
    /// cdf[i] = Σ_{j<i} w_j / Σ_j w_j
    /// ```
    ///
    /// Sums are compensated and in order, relative to the largest weight: no overflow, and the same
    /// bits everywhere.
    ///
    /// # Errors
    /// Weights that are negative, NaN, infinite, absent or all 0 (nothing could be chosen, and
    /// inventing a uniform distribution would hide it); a table of the wrong length.
    pub fn build(weights: &[T], cdf: &'a mut [T]) -> Result<Self, TableError> {
        let scale = largest(weights)?;
        let (needed, given) = (weights.len() + 1, cdf.len());
        if needed != given {
            return Err(TableError::Length { needed, given });
        }
        copy_scaled(weights, scale, cdf);
        accumulate(cdf);
        Ok(Self { cdf })
    }

    /// The distribution of a table that [`Tabulated1d::build`] has filled. `None` unless it has at
    /// least two numbers and runs from 0 to 1; what lies between is not checked, and a table that
    /// falls gives meaningless samples, but neither panics nor leaves the range.
    #[inline]
    pub fn from_cdf(cdf: &'a [T]) -> Option<Self> {
        match cdf {
            [first, .., last] if *first == T::ZERO && *last == T::ONE => Some(Self { cdf }),
            _ => None,
        }
    }

    /// Number of entries, at least 1.
    #[inline]
    #[allow(clippy::len_without_is_empty, reason = "a distribution is never empty")]
    pub fn len(&self) -> usize {
        self.cdf.len() - 1
    }

    /// Draws an entry; never one of weight 0.
    ///
    /// `u`: uniform in `[0, 1)`; anything else is limited to it, NaN counts as 0.
    #[inline]
    pub fn choose(&self, u: T) -> Choice<T> {
        let u = into_unit(u);
        // The first number is 0 and u < 1 ≤ the last: an entry of positive width holds u.
        let above = self.cdf.partition_point(|&c| c <= u).clamp(1, self.len());
        let (low, high) = (self.cdf[above - 1], self.cdf[above]);
        let probability = high - low;
        let residual = into_unit((u - low) / probability);
        Choice { index: above - 1, probability, residual }
    }

    /// Probability of entry `index`; 0 beyond the last.
    #[inline]
    pub fn probability(&self, index: usize) -> T {
        match self.cdf.get(index..).unwrap_or(&[]) {
            [low, high, ..] => *high - *low,
            _ => T::ZERO,
        }
    }

    /// Draws a number in `[0, 1)` from the piecewise-constant density, and its density.
    ///
    /// ```text
    /// x = (i + residual)/n,   p(x) = n P(i)
    /// ```
    ///
    /// `x` lies in the piece it was drawn from, also after rounding.
    #[inline]
    pub fn sample(&self, u: T) -> (T, T) {
        let choice = self.choose(u);
        let position = T::lit(choice.index as f64) + choice.residual;
        let mut x = into_unit(position / self.pieces());
        // The division may round across either end of the piece.
        while self.piece(x) > choice.index {
            x = x.next_down();
        }
        while self.piece(x) < choice.index {
            x = x.next_up();
        }
        (into_unit(x), choice.probability * self.pieces())
    }

    /// Density at `x`; 0 outside `[0, 1)` and for NaN.
    #[inline]
    pub fn pdf(&self, x: T) -> T {
        if x >= T::ZERO && x < T::ONE {
            self.probability(self.piece(x)) * self.pieces()
        } else {
            T::ZERO
        }
    }

    /// The uniform number that [`Tabulated1d::sample`] maps to `x`, `x` limited to `[0, 1)`.
    ///
    /// # Precision
    /// Absolute: `n ε` of a piece.
    #[inline]
    pub fn to_uniform(&self, x: T) -> T {
        let x = into_unit(x);
        let index = self.piece(x);
        let within = x * self.pieces() - T::lit(index as f64);
        into_unit(self.cdf[index] + within * self.probability(index))
    }

    #[inline]
    fn pieces(&self) -> T {
        T::lit(self.len() as f64)
    }

    /// The piece that holds `x`, limited to `[0, 1)`.
    #[inline]
    pub(crate) fn piece(&self, x: T) -> usize {
        ((x * self.pieces()).to_f64() as usize).min(self.len() - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{chi_squared_deviation, uniforms};

    const WEIGHTS: [f64; 7] = [0.0, 2.0, 1.0, 0.0, 0.0, 4.0, 0.0];

    #[test]
    fn entries_of_weight_zero_are_never_drawn() {
        let mut cdf = [0.0; 8];
        let table = Tabulated1d::build(&WEIGHTS, &mut cdf).unwrap();
        let edges = table.cdf.iter().flat_map(|&c| [c, c.next_down(), c.next_up()]);
        for u in edges.chain([0.0, f64::ONE_MINUS_EPSILON, 1.0, 2.0, -1.0, f64::NAN]) {
            let choice = table.choose(u);
            assert!(WEIGHTS[choice.index] > 0.0, "{u}");
            assert_eq!(choice.probability, table.probability(choice.index));
            assert!((0.0..1.0).contains(&choice.residual), "{u}");
            let (x, pdf) = table.sample(u);
            assert!(pdf > 0.0 && pdf == table.pdf(x), "{u}");
        }
    }

    #[test]
    fn entries_are_drawn_as_often_as_their_weight_says() {
        let mut cdf = [0.0; 8];
        let table = Tabulated1d::build(&WEIGHTS, &mut cdf).unwrap();
        let mut counts = [0.0; 7];
        let mut halves = [0.0; 2];
        for [u, _] in uniforms(10_000) {
            let choice = table.choose(u);
            counts[choice.index] += 1.0;
            halves[(choice.residual * 2.0) as usize] += 1.0;
        }
        let expected = WEIGHTS.map(|w| w / 7.0 * 1e4);
        // 5 standard deviations of a fixed seed.
        assert!(chi_squared_deviation(&counts, &expected) < 5.0, "{counts:?}");
        assert!(chi_squared_deviation(&halves, &[5e3; 2]) < 5.0, "{halves:?}");
    }

    #[test]
    fn density_integrates_to_one_and_the_inverse_undoes_the_map() {
        let mut cdf = [0.0; 8];
        let table = Tabulated1d::build(&WEIGHTS, &mut cdf).unwrap();
        let integral: f64 = (0..7).map(|i| table.pdf((f64::from(i) + 0.5) / 7.0) / 7.0).sum();
        // Seven differences of rounded numbers.
        assert!((integral - 1.0).abs() < 7.0 * f64::EPSILON);
        for [u, _] in uniforms::<f64>(1000) {
            let (x, pdf) = table.sample(u);
            assert_eq!(pdf, table.pdf(x), "{u}");
            // Positions of up to 7 are subtracted again.
            assert!((table.to_uniform(x) - u).abs() < 8.0 * f64::EPSILON, "{u}");
        }
        assert_eq!([table.pdf(-0.1), table.pdf(1.0), table.pdf(f64::NAN)], [0.0; 3]);
    }

    #[test]
    fn positions_stay_in_their_piece_in_single_precision() {
        // Every second entry is 0: a position that slipped would have density 0.
        let mut weights = [0.0_f32; 3999];
        weights.iter_mut().step_by(2).for_each(|w| *w = 1.0);
        let mut cdf = [0.0_f32; 4000];
        let table = Tabulated1d::build(&weights, &mut cdf).unwrap();
        for &c in table.cdf.iter().step_by(if cfg!(miri) { 499 } else { 1 }) {
            for u in [c, c.next_down(), c.next_up()] {
                let (x, pdf) = table.sample(u);
                assert_eq!(pdf, table.pdf(x), "{u}");
                assert!(pdf > 0.0 && (0.0..1.0).contains(&x), "{u}");
            }
        }
    }

    #[test]
    fn extreme_weights_neither_overflow_nor_vanish() {
        let mut cdf = [0.0_f32; 4];
        let table = Tabulated1d::build(&[f32::MAX, f32::MAX, 0.0], &mut cdf).unwrap();
        assert_eq!(table.probability(0), 0.5);
        let table = Tabulated1d::build(&[1e-45, 0.0, 1e-45], &mut cdf).unwrap();
        assert_eq!(table.probability(2), 0.5);
    }

    #[test]
    fn tables_that_are_none_are_refused() {
        let mut short = [0.0_f32; 3];
        let error = Tabulated1d::build(&[1.0; 3], &mut short).unwrap_err();
        assert_eq!(error, TableError::Length { needed: 4, given: 3 });
        for bad in [&[] as &[f32], &[1.0], &[0.0, 0.5], &[0.1, 1.0], &[0.0, f32::NAN]] {
            assert_eq!(Tabulated1d::from_cdf(bad), None);
        }
        // Falls and holds NaN between valid ends: no panic.
        let wrong = Tabulated1d::from_cdf(&[0.0, f32::NAN, 0.9, 0.1, 1.0]).unwrap();
        for [u, _] in uniforms(100) {
            assert!(wrong.choose(u).index < 4);
            assert!(wrong.to_uniform(u) < 1.0);
        }
    }
}
