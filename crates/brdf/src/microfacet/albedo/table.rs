//! The tables behind [`FacetLoss`](super::FacetLoss).

use etendue_math::Real;
use etendue_math::quadrature::gauss_legendre;

use super::facet_loss;
use crate::{Alpha, Distribution, Masking, Microfacets};

/// `1 − E(μ, α)` of one kind of facets with F = 1, and its average over μ.
///
/// ```text
/// rows     αᵢ = (i/31)²
/// columns  xⱼ = j/31,  x (x + 0.6) / 1.6 = y = μ (1 + α) / (μ + α)
/// average  2 ∫₀¹ (1 − E(μ)) μ dμ of the interpolated rows, at αⱼ = (j/63)²
/// ```
///
/// The features of E lie at μ ~ α: in the variable y they stay in place whatever α, and the first row is the
/// limit α → 0; x crowds the columns a little at grazing. The average is that of the interpolation, not of E itself: what is divided by the average
/// then integrates to 1.
///
/// 4.3 KB each, linked only where used.
///
/// # Source
/// `cargo run --release -p etendue-brdf --example generate_albedo_tables` writes `table_data.rs`.
#[derive(Clone, Debug, PartialEq)]
pub struct LossTable {
    loss: [[f32; Self::ENTRIES]; Self::ENTRIES],
    average: [f32; Self::AVERAGES],
}

include!("table_data.rs");

impl LossTable {
    /// Nodes over the angle, and over the width.
    pub const ENTRIES: usize = 32;
    /// Nodes of the average over the width.
    pub const AVERAGES: usize = 64;

    /// Computes the table of a kind of facets: seconds.
    pub fn generate(distribution: Distribution, masking: Masking) -> Self {
        let mut table =
            Self { loss: [[0.0; Self::ENTRIES]; Self::ENTRIES], average: [0.0; Self::AVERAGES] };
        for (i, row) in table.loss.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = Self::entry(distribution, masking, i, j);
            }
        }
        for j in 0..Self::AVERAGES {
            let alpha = grid(j, Self::AVERAGES);
            table.average[j] = Self::mean_of(&table.row(alpha), alpha) as f32;
        }
        table
    }

    /// Entry of row `i` and column `j`, computed.
    pub fn entry(distribution: Distribution, masking: Masking, i: usize, j: usize) -> f32 {
        // The limits α → 0 and μ → 0 are reached to the last digit of an f32 here.
        let width = grid::<f64>(i, Self::ENTRIES).max(1e-5);
        let cos = Self::cosine(j, width);
        let facets =
            Alpha::new(width).map(|alpha| Microfacets::new(distribution, alpha, alpha, masking));
        facets.map_or(0.0, |facets| facet_loss(&facets, cos).max(0.0) as f32)
    }

    /// The cosine of column `j` in the row of a width.
    pub(super) fn cosine(j: usize, width: f64) -> f64 {
        let y = y_of_column(j as f64 / (Self::ENTRIES - 1) as f64).max(1e-8);
        (y * width / (1.0 + width - y)).min(1.0)
    }

    /// The entries row by row, and the averages.
    pub fn data(&self) -> (&[[f32; Self::ENTRIES]; Self::ENTRIES], &[f32; Self::AVERAGES]) {
        (&self.loss, &self.average)
    }

    /// A row between the columns that the cosine `mu` lies between, linearly.
    ///
    /// The place is counted from the nearer end of the row, `x` from grazing or `1 − x` from normal: both
    /// ends keep their digits, where `1 − x` by subtraction would lose those of a nearly smooth surface.
    #[inline]
    pub(super) fn look_up<T: Real>(row: &[T; Self::ENTRIES], mu: T, alpha: T) -> T {
        const LAST: usize = LossTable::ENTRIES - 1;
        // y and 1 − y, each without a difference of nearly equal numbers.
        let sum = mu + alpha;
        let (near, far) = (mu * ((T::ONE + alpha) / sum), alpha * ((T::ONE - mu) / sum));
        let from_grazing = near < far;
        // The smaller root of x² + a x = (1 + a) y, or of x'² − (2 + a) x' + (1 + a) y' = 0 for x' = 1 − x.
        let x = if from_grazing {
            smaller_root(near, T::lit(CROWDING), T::lit(4.0 * (1.0 + CROWDING)))
        } else {
            smaller_root(far, T::lit(2.0 + CROWDING), T::lit(-4.0 * (1.0 + CROWDING)))
        };
        let x = x * T::lit(LAST as f64);
        let i = (x.to_f64() as usize).min(LAST - 1);
        let t = x - T::lit(i as f64);
        let (this, next) = if from_grazing { (i, i + 1) } else { (LAST - i, LAST - i - 1) };
        row[this] * (T::ONE - t) + row[next] * t
    }

    /// The row of a width in `(0, 1]`.
    pub(super) fn row<T: Real>(&self, alpha: T) -> [T; Self::ENTRIES] {
        let (i, t) = locate(alpha, Self::ENTRIES);
        core::array::from_fn(|j| {
            let [low, high] = [i, i + 1].map(|i| T::lit(self.loss[i][j].into()));
            low * (T::ONE - t) + high * t
        })
    }

    /// The average of a width in `(0, 1]`.
    pub(super) fn average<T: Real>(&self, alpha: T) -> T {
        let (i, t) = locate(alpha, Self::AVERAGES);
        let [low, high] = [i, i + 1].map(|i| T::lit(self.average[i].into()));
        low * (T::ONE - t) + high * t
    }

    /// `2 ∫₀¹ l(μ) μ dμ` of the interpolated row, piece by piece in y.
    pub(super) fn mean_of(row: &[f64; Self::ENTRIES], alpha: f64) -> f64 {
        let last = (Self::ENTRIES - 1) as f64;
        if alpha == 0.0 {
            return 0.0;
        }
        let mut sum = 0.0;
        for j in 0..Self::ENTRIES - 1 {
            for (s, weight) in gauss_legendre::<f64, 16>() {
                // Where α is small, all of μ lies in the last piece: s = 1 − t⁴ reaches into it.
                let cube = s * s * s;
                let (s, weight) = (1.0 - s * cube, weight * 4.0 * cube);
                let x = (j as f64 + s) / last;
                let (y, stretch) = (y_of_column(x), (2.0 * x + CROWDING) / (1.0 + CROWDING));
                let rest = alpha + (1.0 - y);
                // μ = α y / (1 + α − y), dμ/dy = α (1 + α) / (1 + α − y)².
                let (mu, slope) = (alpha * y / rest, alpha * (1.0 + alpha) / (rest * rest));
                sum += weight / last * stretch * 2.0 * mu * slope * Self::look_up(row, mu, alpha);
            }
        }
        sum
    }
}

/// How evenly the columns are spaced in y: wholly for large values, as squares for 0. Chosen for the
/// smallest error of the interpolation.
const CROWDING: f64 = 0.6;

/// `2 (1 + a) y / (b + √(b² ± 4 (1 + a) y))`, with `c = ±4 (1 + a)`.
#[inline(always)]
fn smaller_root<T: Real>(y: T, b: T, c: T) -> T {
    T::HALF * c.abs() * y / (b + (b * b + c * y).sqrt())
}

/// `y = x (x + a) / (1 + a)` of a column `x` in `[0, 1]`, `a` the [`CROWDING`].
fn y_of_column(x: f64) -> f64 {
    x * (x + CROWDING) / (1.0 + CROWDING)
}

/// Node `i` of `n` widths: `(i / (n − 1))²`.
fn grid<T: Real>(i: usize, n: usize) -> T {
    (T::lit(i as f64) / T::lit((n - 1) as f64)).sqr()
}

/// The interval of widths that `alpha` lies in, and where in it.
fn locate<T: Real>(alpha: T, n: usize) -> (usize, T) {
    let x = alpha.clamp_to(T::ZERO, T::ONE).sqrt() * T::lit((n - 1) as f64);
    let i = (x.to_f64() as usize).min(n - 2);
    let (low, high) = (grid::<T>(i, n), grid::<T>(i + 1, n));
    (i, (alpha - low) / (high - low))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BeckmannLambda;
    use crate::microfacet::FacetLoss;

    const EXACT: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Exact };
    const KINDS: [(&LossTable, Distribution, Masking); 3] = [
        (&LossTable::GGX, Distribution::Ggx, Masking::HeightCorrelated),
        (&LossTable::GGX_SEPARABLE, Distribution::Ggx, Masking::Separable),
        (&LossTable::BECKMANN, EXACT, Masking::HeightCorrelated),
    ];

    #[test]
    fn entries_are_what_the_generator_computes() {
        for (table, distribution, masking) in KINDS {
            for (i, j) in [(0, 16), (3, 31), (12, 1), (20, 9), (31, 0), (31, 31)] {
                let (got, want) = (table.loss[i][j], LossTable::entry(distribution, masking, i, j));
                // The float functions of another backend: far below the interpolation.
                assert!((got - want).abs() < 1e-7, "{distribution:?} {i} {j}: {got} {want}");
            }
            for j in [1, 20, 63] {
                let alpha = grid(j, LossTable::AVERAGES);
                let want = LossTable::mean_of(&table.row(alpha), alpha);
                // One rounding to f32.
                assert!((f64::from(table.average[j]) / want - 1.0).abs() < 1e-7, "{j}");
            }
        }
    }

    #[test]
    fn the_interpolation_is_as_good_as_it_says() {
        for ((_, distribution, masking), bound) in KINDS.into_iter().zip([1e-3, 1e-3, 4e-3]) {
            for i in 0..40 {
                // Widths from 1e-4 to 1, and cosines around each.
                let alpha = Real::powf(10.0, -0.1 * f64::from(i));
                let width = Alpha::new(alpha).unwrap();
                let facets = Microfacets::new(distribution, width, width, masking);
                let loss = FacetLoss::new(&facets).unwrap();
                for j in 1..40 {
                    let y = f64::from(j) / 40.0;
                    let cos = alpha * y / (1.0 + alpha - y);
                    let error = (loss.at(cos) - facet_loss(&facets, cos)).abs();
                    assert!(error < bound, "{distribution:?} {masking:?} {alpha} {cos}: {error}");
                }
            }
        }
    }
}
