//! The strategies of one model under one lighting against each other.

use super::{Measurement, Outcome, PointSet, Variance};

/// Relative variances below this are the rounding of `f32`: a few hundred ulp of standard deviation.
pub(super) const EXACT: f64 = 1e-10;

/// One model under one lighting.
#[derive(Clone, Copy)]
pub(super) struct Contest<'a> {
    /// Its strategies.
    pub(super) outcomes: &'a [Outcome],
    point_nanoseconds: [f64; 2],
    lighting: usize,
}

impl<'a> Contest<'a> {
    /// Every model under a lighting, by its number in [`Lighting::ALL`](super::Lighting::ALL).
    pub(super) fn all(measurement: &'a Measurement, lighting: usize) -> Vec<Self> {
        let point_nanoseconds = measurement.point_nanoseconds;
        let models = measurement.outcomes.chunk_by(|a, b| a.model == b.model);
        models.map(|outcomes| Self { outcomes, point_nanoseconds, lighting }).collect()
    }

    pub(super) fn variance(&self, outcome: &'a Outcome, set: PointSet) -> &'a Variance {
        &outcome.variances[set as usize][self.lighting]
    }

    /// Nanoseconds of a sample, its point included.
    pub(super) fn nanoseconds(&self, outcome: &Outcome, set: PointSet) -> f64 {
        self.point_nanoseconds[set as usize] + outcome.timing.nanoseconds
    }

    /// `1 / (variance · time)`; `None` where there is no variance.
    fn efficiency(&self, outcome: &'a Outcome, set: PointSet) -> Option<f64> {
        let variance = self.variance(outcome, set).relative;
        (variance >= EXACT).then(|| 1.0 / (variance * self.nanoseconds(outcome, set)))
    }

    /// The largest efficiency of those that have one.
    fn largest(&self) -> f64 {
        let pairs = self.outcomes.iter().flat_map(|o| PointSet::ALL.map(|set| (o, set)));
        pairs.filter_map(|(o, set)| self.efficiency(o, set)).fold(0.0, f64::max)
    }

    /// Efficiency as a share of the largest one; `None` where there is no variance.
    pub(super) fn relative_efficiency(&self, outcome: &'a Outcome, set: PointSet) -> Option<f64> {
        Some(self.efficiency(outcome, set)? / self.largest())
    }

    /// Whether no other is better: with either kind of points it has no variance, or the largest efficiency where all have
    /// some.
    pub(super) fn is_best(&self, outcome: &'a Outcome) -> bool {
        let is_exact =
            |o: &'a Outcome| PointSet::ALL.iter().any(|&s| self.efficiency(o, s).is_none());
        if self.outcomes.iter().any(is_exact) {
            return is_exact(outcome);
        }
        let largest = self.largest();
        PointSet::ALL.iter().any(|&set| self.efficiency(outcome, set) == Some(largest))
    }

    /// The same between the kinds of points: the better one's share of the largest efficiency, `None` for no variance.
    pub(super) fn best_share(&self, outcome: &'a Outcome) -> Option<f64> {
        let [independent, sobol] = PointSet::ALL.map(|set| self.relative_efficiency(outcome, set));
        Some(independent?.max(sobol?))
    }
}
