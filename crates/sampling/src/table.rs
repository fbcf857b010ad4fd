//! Building cumulative tables, and what can be wrong with the weights.

use core::fmt;

use etendue_math::{CompensatedSum, Real};

/// Why a table of weights was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TableError {
    /// There are no weights, or a side of the table is 0.
    Empty,
    /// A slice has not the length that the number of weights asks for.
    Length {
        /// The length that is needed.
        needed: usize,
        /// The length that was given.
        given: usize,
    },
    /// The weight at this index is negative, NaN or infinite.
    Weight {
        /// Index into the weights.
        index: usize,
    },
    /// All weights are 0: there is nothing to choose.
    AllZero,
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "the table has no entries"),
            Self::Length { needed, given } => {
                write!(f, "a slice of {needed} numbers is needed, {given} were given")
            }
            Self::Weight { index } => {
                write!(f, "weight {index} is negative, infinite or not a number")
            }
            Self::AllZero => write!(f, "all weights are 0"),
        }
    }
}

impl core::error::Error for TableError {}

/// The largest weight; an error unless all are finite, none is negative and one is positive.
pub(crate) fn largest<T: Real>(weights: &[T]) -> Result<T, TableError> {
    if weights.is_empty() {
        return Err(TableError::Empty);
    }
    let mut largest = T::ZERO;
    for (index, &weight) in weights.iter().enumerate() {
        // Written so that NaN is refused.
        if !(weight >= T::ZERO && weight.is_finite()) {
            return Err(TableError::Weight { index });
        }
        largest = largest.max(weight);
    }
    if largest > T::ZERO { Ok(largest) } else { Err(TableError::AllZero) }
}

/// Turns a table whose numbers after the first are weights into their cumulative sums divided by
/// the total, and returns the total; with nothing but zeros the table is uniform.
///
/// Weights lie in `[0, 1]` or are sums of few of those, so that nothing overflows.
pub(crate) fn accumulate<T: Real>(table: &mut [T]) -> T {
    let mut sum = CompensatedSum::default();
    let mut previous = T::ZERO;
    if let Some(first) = table.first_mut() {
        *first = T::ZERO;
    }
    for entry in table.iter_mut().skip(1) {
        sum.add(*entry);
        // A table must not fall, not even by the last bit of the compensation.
        previous = sum.total().max(previous);
        *entry = previous;
    }
    let total = previous;
    let count = T::lit(table.len() as f64 - 1.0);
    for (i, entry) in table.iter_mut().enumerate() {
        *entry = if total > T::ZERO { *entry / total } else { T::lit(i as f64) / count };
    }
    total
}

/// Copies weights divided by `scale` behind the first number of a table.
pub(crate) fn copy_scaled<T: Real>(weights: &[T], scale: T, table: &mut [T]) {
    for (entry, &weight) in table.iter_mut().skip(1).zip(weights) {
        *entry = weight / scale;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    extern crate alloc;
    use alloc::string::ToString;

    #[test]
    fn sums_of_many_equal_weights_stay_even() {
        let mut cdf = [0.1_f32; 4001];
        accumulate(&mut cdf);
        for (i, &c) in cdf.iter().enumerate() {
            // One rounding of the sum and one of the quotient.
            assert!((f64::from(c) - i as f64 / 4e3).abs() <= f64::from(f32::EPSILON), "{i}");
        }
    }

    #[test]
    fn refusals_say_what_is_wrong() {
        assert_eq!(largest::<f32>(&[]), Err(TableError::Empty));
        assert_eq!(largest(&[0.0, 0.0_f32]), Err(TableError::AllZero));
        for bad in [-1.0, f64::NAN, f64::INFINITY] {
            let error = largest(&[1.0, bad]).unwrap_err();
            assert_eq!(error.to_string(), "weight 1 is negative, infinite or not a number");
        }
    }
}
