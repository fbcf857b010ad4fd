//! Where a family is compared.

use std::rc::Rc;

use super::reference::Reference;

/// A set of points, the same in every run, and the sums over points that are energies.
///
/// Scalars are numbers of `f32`, so that variants in either precision are given the same ones: what differs is how they
/// compute, not what they are told.
pub struct Domain<P> {
    /// The domain in words.
    pub words: String,
    /// What of the domain is compared: all points count alike in means.
    pub points: Vec<P>,
    /// A point in the quantities of the domain.
    pub place: fn(&P) -> String,
    /// The energies compared; empty where the quantity has none.
    pub probes: Vec<Probe<P>>,
}

/// An energy: a directional albedo or the like, as a weighted sum of values.
pub struct Probe<P> {
    /// Where the energy is taken, in the quantities of the domain.
    pub place: String,
    /// Points and the weights of their values.
    pub nodes: Vec<(P, f64)>,
}

impl<P> Domain<P> {
    /// A function at all points.
    pub fn values(&self, f: impl Fn(&P) -> f64) -> Vec<f64> {
        self.points.iter().map(f).collect()
    }

    /// Energies of a function.
    pub fn energies(&self, f: impl Fn(&P) -> f64) -> Vec<f64> {
        let sum = |probe: &Probe<P>| probe.nodes.iter().map(|(point, w)| w * f(point)).sum();
        self.probes.iter().map(sum).collect()
    }

    /// The reference that is a function's values and energies to the last digits.
    pub(super) fn reference(
        self: &Rc<Self>,
        exact: impl Fn(&P) -> f64 + 'static,
    ) -> Box<dyn Fn() -> Reference>
    where
        P: 'static,
    {
        let domain = Rc::clone(self);
        Box::new(move || Reference {
            values: domain.values(&exact),
            energies: domain.energies(&exact),
            uncertainty: None,
        })
    }
}

/// `count` numbers from `low` to `high`, evenly spaced.
pub(super) fn linear([low, high]: [f64; 2], count: usize) -> impl Iterator<Item = f64> + Clone {
    let step = (high - low) / (count - 1).max(1) as f64;
    (0..count).map(move |i| low + step * i as f64)
}

/// `count` positive numbers from `low` to `high`, evenly spaced by their logarithms.
pub(super) fn logarithmic(ends: [f64; 2], count: usize) -> impl Iterator<Item = f64> + Clone {
    use etendue_math::Real;
    linear(ends.map(Real::ln), count).map(Real::exp)
}

/// The nearest number of `f32`.
pub(super) fn narrow(x: f64) -> f64 {
    f64::from(x as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_reach_both_ends() {
        assert_eq!(linear([1.0, 2.0], 3).collect::<Vec<_>>(), [1.0, 1.5, 2.0]);
        let decades: Vec<f64> = logarithmic([0.01, 100.0], 5).collect();
        for (got, want) in decades.iter().zip([0.01, 0.1, 1.0, 10.0, 100.0]) {
            // An exponential of a logarithm.
            assert!((got / want - 1.0).abs() < 1e-14, "{decades:?}");
        }
    }

    #[test]
    fn an_energy_is_the_weighted_sum_of_values() {
        let probe = Probe { place: String::new(), nodes: vec![(1.0, 0.5), (3.0, 2.0)] };
        let place = |x: &f64| x.to_string();
        let domain = Domain { words: String::new(), points: vec![2.0], place, probes: vec![probe] };
        assert_eq!(domain.energies(|x| 10.0 * x), [65.0]);
        assert_eq!(domain.values(|x| 10.0 * x), [20.0]);
    }
}
