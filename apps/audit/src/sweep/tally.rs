//! What a sweep keeps of its inputs.

use crate::measure::{Measurement, Outcome};

/// The worst error and the numbers that should not occur, over some inputs.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    pub(super) inputs: u64,
    worst: f64,
    at: String,
    nan: u64,
    infinite: u64,
    negative: u64,
    first: String,
}

impl Tally {
    /// The worst error so far.
    #[inline]
    pub(super) fn worst(&self) -> f64 {
        self.worst
    }

    /// Looks at an error, `None` if it is known to be no new worst; NaN counts as infinite.
    #[inline]
    pub(super) fn observe(&mut self, error: Option<f64>, at: impl FnOnce() -> String) {
        let Some(error) = error else { return };
        let error = if error.is_nan() { f64::INFINITY } else { error };
        if error > self.worst {
            self.worst = error;
            self.at = at();
        }
    }

    /// Counts a number that is no value of a model.
    #[inline]
    pub(super) fn inspect(&mut self, value: f64, at: impl FnOnce() -> String) {
        if (0.0..f64::INFINITY).contains(&value) {
            return;
        }
        if self.violations() == 0 {
            self.first = at();
        }
        if value.is_nan() {
            self.nan += 1;
        } else if value < 0.0 {
            self.negative += 1;
        } else {
            self.infinite += 1;
        }
    }

    fn violations(&self) -> u64 {
        self.nan + self.infinite + self.negative
    }

    /// Adds the inputs that came after these.
    pub(super) fn merge(&mut self, next: Self) {
        if next.worst > self.worst {
            (self.worst, self.at) = (next.worst, next.at);
        }
        if self.violations() == 0 {
            self.first = next.first;
        }
        self.inputs += next.inputs;
        self.nan += next.nan;
        self.infinite += next.infinite;
        self.negative += next.negative;
    }

    /// The worst error against its bound.
    pub(super) fn precision(&self) -> Outcome {
        self.measured(self.worst, 64.0, "ulp", self.at.clone())
    }

    /// The numbers that should not occur.
    pub(super) fn finite(&self) -> Outcome {
        let at = if self.violations() == 0 {
            String::new()
        } else {
            let [nan, infinite, negative] = [self.nan, self.infinite, self.negative];
            format!("{nan} NaN, {infinite} infinite, {negative} negative; first {}", self.first)
        };
        self.measured(self.violations() as f64, 0.0, "violations", at)
    }

    fn measured(&self, worst: f64, bound: f64, unit: &'static str, at: String) -> Outcome {
        if self.inputs == 0 {
            return Outcome::NotApplicable("nothing is scattered");
        }
        Outcome::Measured(Measurement { worst, bound, unit, at, evaluations: self.inputs })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn merging_keeps_the_first_of_equals_and_adds_the_counts() {
        let tally = |worst: f64, value: f64, name: &str| {
            let mut tally = Tally { inputs: 1, ..Tally::default() };
            tally.observe(Some(worst), || name.into());
            tally.inspect(value, || name.into());
            tally
        };
        let mut all = tally(1.0, 0.5, "a");
        all.merge(tally(2.0, f64::NAN, "b"));
        all.merge(tally(2.0, -1.0, "c"));
        assert_eq!(
            (all.inputs, all.worst, all.at.as_str(), all.first.as_str()),
            (3, 2.0, "b", "b")
        );
        assert_eq!((all.nan, all.infinite, all.negative), (1, 0, 1));
    }
}
