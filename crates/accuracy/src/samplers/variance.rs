//! The variance of an estimator, and how well that is known.

use super::points::PointSet;

/// Sums over the replications of a group, of one direction of view under one lighting.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    /// Σx and Σx² over all samples.
    samples: [f64; 2],
    /// Σm and Σm² over the means of the replications.
    means: [f64; 2],
}

/// Replications are gathered in this many groups, whose scatter is the error of what they say together.
pub const GROUPS: usize = 16;

/// Values of an estimator seen from several directions, replication by replication.
#[derive(Clone, Debug)]
pub(super) struct Spread {
    points: PointSet,
    per_replication: u32,
    replications: u32,
    /// By direction of view, then by group.
    sums: Vec<[Sums; GROUPS]>,
}

/// What the samples say of an estimator.
#[derive(Clone, Debug, PartialEq)]
pub struct Variance {
    /// Mean by direction of view.
    pub means: Vec<f64>,
    /// Standard errors of the same.
    pub mean_errors: Vec<f64>,
    /// Noise over signal: `Σ V_d / Σ mean_d²` over the directions d of view; NaN where all means are 0. V is the variance
    /// of a sample for independent points, and N times the variance of the mean of N points for Sobol' points: equal for
    /// points without structure, and smaller by what the structure is worth.
    pub relative: f64,
    /// Standard error of the same divided by it: from the scatter of 16 groups of replications, hence itself known to a
    /// fifth.
    pub uncertainty: f64,
}

impl Spread {
    /// Nothing yet; `replications` sets of `per_replication` points are to come for each of `directions`.
    pub(super) fn new(
        points: PointSet,
        per_replication: u32,
        replications: u32,
        directions: usize,
    ) -> Self {
        Self {
            points,
            per_replication,
            replications,
            sums: vec![[Sums::default(); GROUPS]; directions],
        }
    }

    /// Adds a replication: the sums of its values and of their squares.
    pub(super) fn add(&mut self, direction: usize, replication: u32, [sum, squares]: [f64; 2]) {
        let sums = &mut self.sums[direction][replication as usize % GROUPS];
        let mean = sum / f64::from(self.per_replication);
        sums.samples[0] += sum;
        sums.samples[1] += squares;
        sums.means[0] += mean;
        sums.means[1] += mean * mean;
    }

    /// What all of them say.
    pub(super) fn variance(&self) -> Variance {
        let all: Vec<Sums> = self.sums.iter().map(total).collect();
        let relative = self.relative(&all, self.replications);
        let groups: Vec<f64> = (0..GROUPS)
            .map(|g| {
                let group: Vec<Sums> = self.sums.iter().map(|groups| groups[g]).collect();
                let replications = (0..self.replications).filter(|r| *r as usize % GROUPS == g);
                self.relative(&group, replications.count() as u32)
            })
            .collect();
        let samples = f64::from(self.per_replication) * f64::from(self.replications);
        Variance {
            means: all.iter().map(|sums| sums.samples[0] / samples).collect(),
            mean_errors: all
                .iter()
                .map(|sums| (self.of_direction(sums, self.replications) / samples).max(0.0).sqrt())
                .collect(),
            relative,
            uncertainty: (spread(&groups) / GROUPS as f64).sqrt() / relative,
        }
    }

    fn relative(&self, directions: &[Sums], replications: u32) -> f64 {
        let samples = f64::from(self.per_replication) * f64::from(replications);
        let noise: f64 = directions.iter().map(|sums| self.of_direction(sums, replications)).sum();
        let signal: f64 = directions
            .iter()
            .map(|sums| {
                let mean = sums.samples[0] / samples;
                mean * mean
            })
            .sum();
        noise / signal
    }

    /// V of one direction.
    fn of_direction(&self, sums: &Sums, replications: u32) -> f64 {
        let n = f64::from(self.per_replication);
        let r = f64::from(replications);
        match self.points {
            PointSet::Independent => unbiased(sums.samples, n * r),
            PointSet::Sobol => n * unbiased(sums.means, r),
        }
    }
}

fn total(groups: &[Sums; GROUPS]) -> Sums {
    let add = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a + c, b + d];
    groups.iter().fold(Sums::default(), |all, sums| Sums {
        samples: add(all.samples, sums.samples),
        means: add(all.means, sums.means),
    })
}

/// Unbiased variance from the sum and the sum of squares of `n` values.
fn unbiased([sum, squares]: [f64; 2], n: f64) -> f64 {
    (squares - sum * sum / n).max(0.0) / (n - 1.0)
}

/// Unbiased variance of values.
fn spread(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / (n - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The spread of `value` over the points, seen from one direction.
    fn of(points: PointSet, value: impl Fn([f32; 2]) -> f64) -> Variance {
        const N: u32 = 64;
        const R: u32 = 512;
        let mut spread = Spread::new(points, N, R, 1);
        for replication in 0..R {
            let mut sums = [0.0; 2];
            for index in 0..N {
                let x = value(points.uniforms(3, replication, index).direction);
                sums[0] += x;
                sums[1] += x * x;
            }
            spread.add(0, replication, sums);
        }
        spread.variance()
    }

    #[test]
    fn a_uniform_number_has_a_relative_variance_of_a_third() {
        let got = of(PointSet::Independent, |[x, _]| f64::from(x));
        // Mean ½, variance 1/12; errors of 4 standard errors of a fixed seed.
        assert!((got.relative * 3.0 - 1.0).abs() < 4.0 * got.uncertainty, "{got:?}");
        assert!((got.means[0] - 0.5).abs() < 4.0 * got.mean_errors[0]);
        // 2¹⁵ samples whose fourth moment is 9/5 of the squared variance: √(0.8/2¹⁵) = 0.005, to a factor of 2.
        assert!((0.0025..0.01).contains(&got.uncertainty), "{got:?}");
    }

    #[test]
    fn strata_pay_where_the_integrand_is_smooth_and_a_constant_has_no_variance() {
        let sobol = of(PointSet::Sobol, |[x, _]| f64::from(x));
        // N strata of width 1/N: N · N⁻³/12 / (1/4) = N⁻²/3.
        assert!((sobol.relative * 3.0 * 4096.0 - 1.0).abs() < 4.0 * sobol.uncertainty, "{sobol:?}");
        assert_eq!(of(PointSet::Independent, |_| 0.5).relative, 0.0);
        assert_eq!(of(PointSet::Sobol, |_| 0.5).relative, 0.0);
    }
}
