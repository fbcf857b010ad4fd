//! References that are means of random estimates.

use etendue_math::Real;

use crate::functions::reference::{Reference, Uncertainty};

/// A mean and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mean {
    pub(super) value: f64,
    pub(super) error: f64,
}

impl Mean {
    /// Of estimates, summed in their order.
    pub(super) fn of(estimates: impl Iterator<Item = f64>) -> Self {
        // Welford's recurrence: the variance of nearly equal numbers does not cancel.
        let (mut count, mut mean, mut squares) = (0.0, 0.0, 0.0);
        for x in estimates {
            count += 1.0;
            let difference = x - mean;
            mean += difference / count;
            squares += difference * (x - mean);
        }
        Self { value: mean, error: (squares / (count * (count - 1.0))).sqrt() }
    }
}

/// The reference, with the standard errors of its values, relative, and energies.
pub(super) fn reference(values: Vec<Mean>, energies: Vec<Mean>) -> Reference {
    let squares: f64 = values.iter().map(|mean| Real::sqr(mean.error / mean.value)).sum();
    let uncertainty = Uncertainty {
        rms: (squares / values.len() as f64).sqrt(),
        energy: energies.iter().map(|mean| mean.error).fold(0.0, f64::max),
        method: "the standard errors of its means",
    };
    let value = |mean: Mean| mean.value;
    Reference {
        values: values.into_iter().map(value).collect(),
        energies: energies.into_iter().map(value).collect(),
        uncertainty: Some(uncertainty),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_and_standard_error_are_those_of_the_formulas() {
        let mean = Mean::of([1.0, 2.0, 3.0, 4.0].into_iter());
        assert_eq!(mean.value, 2.5);
        // Variance 5/3 of four.
        assert!((mean.error - (5.0_f64 / 12.0).sqrt()).abs() < 1e-15);
        assert_eq!(Mean::of([0.5; 3].into_iter()), Mean { value: 0.5, error: 0.0 });
    }
}
