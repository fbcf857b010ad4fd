//! References that are means of random estimates.

use std::rc::Rc;

use etendue_math::Real;
use etendue_math::glam::DVec3;

use super::directions::Pair;
use crate::functions::domain::Domain;
use crate::functions::reference::{Reference, Uncertainty};

/// Polar angles of viewer and light, in degrees: few, because each pair takes thousands of paths.
pub(super) const POLAR: [f64; 4] = [10.0, 35.0, 60.0, 80.0];
/// Azimuths between them.
pub(super) const AZIMUTHS: [f64; 4] = [0.0, 60.0, 120.0, 180.0];
/// Polar angles of the viewers at which energies are compared.
pub(super) const VIEWS: [f64; 3] = [20.0, 50.0, 80.0];
/// The pairs in words.
pub(super) const WORDS: &str = "polar angles of viewer and light 10°, 35°, 60° and 80°, azimuths between them from 0° to 180° \
                                in steps of 60°";

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

/// The reference whose values are `value(pair, address)` and whose energies, each at the material and viewer of a probe,
/// are `albedo(case, wo, address)`; no two of either kind have the same address. The uncertainty is the standard errors,
/// of the values relative ones.
pub(super) fn reference(
    domain: &Rc<Domain<Pair>>,
    value: impl Fn(&Pair, u64) -> Mean + 'static,
    albedo: impl Fn(usize, DVec3, u64) -> Mean + 'static,
) -> Box<dyn Fn() -> Reference> {
    let domain = Rc::clone(domain);
    Box::new(move || {
        let values = (0..).zip(&domain.points).map(|(i, pair)| value(pair, i));
        let energies = (0..).zip(&domain.probes).map(|(i, probe)| {
            let (seen, _) = &probe.nodes[0];
            albedo(seen.case, DVec3::from(seen.wo), i)
        });
        of_means(&values.collect::<Vec<_>>(), &energies.collect::<Vec<_>>())
    })
}

fn of_means(values: &[Mean], energies: &[Mean]) -> Reference {
    let squares: f64 = values.iter().map(|mean| Real::sqr(mean.error / mean.value)).sum();
    let uncertainty = Uncertainty {
        rms: (squares / values.len() as f64).sqrt(),
        energy: energies.iter().map(|mean| mean.error).fold(0.0, f64::max),
        method: "the standard errors of its means",
    };
    let value = |mean: &Mean| mean.value;
    Reference {
        values: values.iter().map(value).collect(),
        energies: energies.iter().map(value).collect(),
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
