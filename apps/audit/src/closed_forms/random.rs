//! Means of random processes.

use core::fmt;

use etendue_math::Real;

use crate::budget::Budget;
use crate::generators::uniforms;

/// Standard errors that a mean may be off. With fixed seeds and some hundred means per run: one sound
/// implementation in ten thousand would fail, once and for all.
pub(super) const ERRORS: f64 = 5.0;

/// Uniform numbers one after another, as walks of unknown length ask for them.
pub(super) fn numbers<T: Real>(stream: u64) -> impl FnMut() -> T {
    let (mut index, mut triple, mut used) = (0, [T::ZERO; 3], 3);
    move || {
        if used == 3 {
            (triple, used) = (uniforms::<T>(stream, index), 0);
            index += 1;
        }
        used += 1;
        triple[used - 1]
    }
}

/// How many paths a mean is taken of: enough in a quick run to tell a wrong factor from chance.
pub(super) fn paths(budget: Budget) -> usize {
    20_000 + budget.samples / 2
}

/// A mean and its standard error, number by number.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Mean {
    sum: f64,
    squares: f64,
    count: f64,
}

impl Mean {
    /// Of `count` numbers.
    pub(super) fn of(count: usize, mut number: impl FnMut() -> f64) -> Self {
        let mut mean = Self::default();
        for _ in 0..count {
            mean.add(number());
        }
        mean
    }

    /// One number more.
    pub(super) fn add(&mut self, x: f64) {
        self.sum += x;
        self.squares += x * x;
        self.count += 1.0;
    }

    /// The mean.
    pub(super) fn value(self) -> f64 {
        self.sum / self.count
    }

    fn variance(self) -> f64 {
        (self.squares / self.count - self.value() * self.value()).max(0.0) / self.count
    }

    /// How many standard errors the mean is away from what it should be, itself known within
    /// `rounding`.
    pub(super) fn deviation(self, want: f64, rounding: f64) -> f64 {
        ((self.value() - want).abs() - rounding).max(0.0) / self.variance().sqrt().max(1e-12)
    }

    /// The same of two means that should be one.
    pub(super) fn difference(self, other: Self) -> f64 {
        let error = (self.variance() + other.variance()).sqrt();
        (self.value() - other.value()).abs() / error.max(1e-12)
    }
}

impl fmt::Display for Mean {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ± {}", self.value(), self.variance().sqrt())
    }
}
