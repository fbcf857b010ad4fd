//! What a check measured.

/// Result of one check on one case in one precision.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The check has nothing to look at, and why.
    NotApplicable(&'static str),
    /// A worst figure and its bound.
    Measured(Measurement),
}

/// The worst figure a check met.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// The worst figure, in [`unit`](Self::unit).
    pub worst: f64,
    /// The largest figure that passes.
    pub bound: f64,
    /// What the figure counts.
    pub unit: &'static str,
    /// The input at which it was met; empty if no figure was above 0.
    pub at: String,
    /// How many points were looked at.
    pub evaluations: u64,
}

impl Measurement {
    /// The figure is within its bound, and something was looked at. False for NaN.
    pub fn passed(&self) -> bool {
        self.worst <= self.bound && self.evaluations > 0
    }
}

impl Outcome {
    /// What was measured, if anything was.
    pub fn measurement(&self) -> Option<&Measurement> {
        match self {
            Self::NotApplicable(_) => None,
            Self::Measured(m) => Some(m),
        }
    }

    /// False if the check failed; a check that does not apply does not fail.
    pub fn passed(&self) -> bool {
        match self {
            Self::NotApplicable(_) => true,
            Self::Measured(m) => m.passed(),
        }
    }
}

/// Keeps the worst of many figures and where it was met.
#[derive(Clone, Debug, Default)]
pub struct Worst {
    figure: f64,
    at: String,
    evaluations: u64,
}

impl Worst {
    /// Looks at one figure; NaN counts as infinite. `at` is only called for a new worst.
    pub fn observe(&mut self, figure: f64, at: impl FnOnce() -> String) {
        self.evaluations += 1;
        let figure = if figure.is_nan() { f64::INFINITY } else { figure };
        if figure > self.figure {
            self.figure = figure;
            self.at = at();
        }
    }

    /// How many figures were looked at.
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// The measurement, judged against `bound`.
    pub fn within(self, bound: f64, unit: &'static str) -> Outcome {
        Outcome::Measured(Measurement {
            worst: self.figure,
            bound,
            unit,
            at: self.at,
            evaluations: self.evaluations,
        })
    }

    /// The same, for checks that look at samples: where the model never scatters there are none,
    /// and whether that is right is for the check `normalisation` to say.
    pub fn within_if_any(self, bound: f64, unit: &'static str) -> Outcome {
        if self.evaluations == 0 {
            Outcome::NotApplicable("nothing is scattered")
        } else {
            self.within(bound, unit)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nan_is_the_worst_figure_there_is() {
        let mut worst = Worst::default();
        worst.observe(3.0, || "three".into());
        worst.observe(f64::NAN, || "nan".into());
        worst.observe(4.0, || "four".into());
        let Outcome::Measured(m) = worst.within(1e300, "1") else { unreachable!() };
        assert_eq!((m.at.as_str(), m.evaluations, m.passed()), ("nan", 3, false));
    }

    #[test]
    fn looking_at_nothing_does_not_pass() {
        assert!(!Worst::default().within(1.0, "1").passed());
    }
}
