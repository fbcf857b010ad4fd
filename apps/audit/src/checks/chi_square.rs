//! Samples are distributed as the density says.

use etendue_brdf::Density;
use etendue_math::{Real, Vec3};

use super::Context;
use super::delta::lobes_of;
use crate::generators::viewers;
use crate::measure::{Outcome, Worst};
use crate::partition::coordinates;
use crate::scalar::{Scalar, narrow, widen};
use crate::statistics::chi_square_p;
use crate::subject::{Case, Subject, Width};

/// Asserts that Pearson's χ² test cannot tell the samples from the density.
///
/// ```text
/// χ² = Σ (observed − expected)²/expected,   expected = N ∫ pdf over the cell
/// ```
///
/// Cells are shaped by other samples than those counted; delta lobes and "no sample" are one cell
/// each; cells are pooled in order of expectation until each holds at least 5. Directions with
/// `f = 0`, which samplers may drop, count as "no sample".
///
/// Tolerance: the p-value may not fall below the significance of one test, corrected after Šidák
/// for all tests of the run at 1 % overall; seeds are fixed, so the verdict never varies. The
/// figure is −log₁₀ p.
pub(super) fn check<T: Scalar>(subject: &Subject<T>, context: &Context) -> Outcome {
    if subject.case.width != Width::Wide {
        return Outcome::NotApplicable("a lobe too narrow for cells");
    }
    if !subject.case.bsdf.lobes().continuous {
        return Outcome::NotApplicable("no continuous part");
    }
    let mut worst = Worst::default();
    for wo in viewers::<T>(context.budget.viewers) {
        let table = contingency(subject.case, wo, context);
        if let Some((statistic, degrees)) = pearson(table) {
            let p = chi_square_p(statistic, degrees).max(1e-300);
            worst.observe(-Real::ln(p) / core::f64::consts::LN_10, || {
                format!("{}: χ² {statistic:.1}, {degrees} degrees", subject.at_view(wo))
            });
        }
    }
    worst.within_if_any(-Real::ln(context.significance) / core::f64::consts::LN_10, "−log10 p")
}

/// Observed and expected counts: cells, then delta lobes, then "no sample".
fn contingency<T: Scalar>(case: &Case<T>, wo: Vec3<T>, context: &Context) -> Vec<[f64; 2]> {
    const STREAM: u64 = 41;
    let n = context.budget.samples;
    let partition = case.partition(wo, context.budget.pilot);
    let expected = partition.integrate_each(1e-4, |w| {
        let wi = narrow::<T>(w);
        if case.bsdf.eval(wo, wi) == T::ZERO { 0.0 } else { case.bsdf.pdf(wo, wi).to_f64() }
    });
    let deltas = lobes_of(case, wo);
    let mut table: Vec<[f64; 2]> = expected
        .iter()
        .map(|i| i.value)
        .chain(deltas.iter().map(|l| l.probability))
        .map(|p| [0.0, p * n as f64])
        .collect();
    let accounted: f64 = table.iter().map(|c| c[1]).sum();
    table.push([0.0, (n as f64 - accounted).max(0.0)]);
    let last = table.len() - 1;
    for i in 0..n as u64 {
        let index = match case.draw(wo, STREAM, i) {
            None => last,
            Some(s) => match s.density {
                Density::Continuous(_) => partition.find(coordinates(widen::<T>(s.wi))),
                Density::Delta(_) => {
                    deltas.iter().position(|l| l.drew(&s)).map_or(last, |k| expected.len() + k)
                }
            },
        };
        table[index][0] += 1.0;
    }
    table
}

/// The statistic and its degrees of freedom, or `None` where nothing is sampled at all.
fn pearson(mut table: Vec<[f64; 2]>) -> Option<(f64, usize)> {
    table.sort_unstable_by(|a, b| a[1].total_cmp(&b[1]));
    let total: f64 = table.iter().map(|c| c[1]).sum();
    let mut pooled: Vec<[f64; 2]> = Vec::new();
    let mut pool = [0.0; 2];
    for cell in table {
        pool = [pool[0] + cell[0], pool[1] + cell[1]];
        if pool[1] >= 5.0 {
            pooled.push(pool);
            pool = [0.0; 2];
        }
    }
    // What is left over expects less than 5 and joins the largest cell, unless it was never
    // expected at all: then a single count there is already wrong.
    if pool[0] > 0.0 && pool[1] < 1e-6 * total {
        return Some((f64::MAX, 1));
    }
    if let Some(largest) = pooled.last_mut() {
        *largest = [largest[0] + pool[0], largest[1] + pool[1]];
    }
    let statistic = pooled.iter().map(|c| Real::sqr(c[0] - c[1]) / c[1]).sum();
    (pooled.len() > 1).then(|| (statistic, pooled.len() - 1))
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::broken::{Fault, verdict};

    #[test]
    fn a_sound_sampler_passes_and_a_biased_one_is_caught() {
        assert!(verdict(Fault::None, check).passed());
        assert!(!verdict(Fault::BiasedSampler, check).passed());
        assert!(!verdict(Fault::SwappedAngle, check).passed());
    }
}
