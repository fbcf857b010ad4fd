//! Two-dimensional tabulated distributions.

use etendue_math::Real;

use crate::table::{accumulate, copy_scaled, largest};
use crate::{TableError, Tabulated1d};

/// A piecewise-constant density over the unit square, from weights in rows: one marginal
/// distribution of rows and one of columns per row. It borrows its cumulative tables.
///
/// For environment maps `x` runs along a row, `y` counts rows, and the weights carry the map's
/// solid-angle factor (sin θ of the row for latitude-longitude maps).
///
/// # Examples
/// ```
/// use etendue_sampling::Tabulated2d;
/// let mut storage = [0.0_f32; 11];
/// assert_eq!(Tabulated2d::<f32>::storage_len(3, 2), Some(11));
/// let map = Tabulated2d::build(&[0.0, 1.0, 0.0, 0.0, 0.0, 3.0], 3, 2, &mut storage)?;
/// let ([x, y], pdf) = map.sample([0.5, 0.9]);
/// assert!(x > 2.0 / 3.0 && y > 0.5);
/// assert_eq!(pdf, 4.5);
/// assert_eq!(map.pdf([0.5, 0.25]), 1.5);
/// # Ok::<(), etendue_sampling::TableError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tabulated2d<'a, T> {
    marginal: Tabulated1d<'a, T>,
    /// Tables of the rows, one after the other, `width + 1` numbers each.
    rows: &'a [T],
    width: usize,
}

impl<'a, T: Real> Tabulated2d<'a, T> {
    /// Numbers that the tables of `width × height` weights take: `(width + 1) height + height + 1`.
    /// `None` where that overflows or a side is 0.
    pub fn storage_len(width: usize, height: usize) -> Option<usize> {
        if width == 0 || height == 0 {
            return None;
        }
        width.checked_add(1)?.checked_mul(height)?.checked_add(height)?.checked_add(1)
    }

    /// Fills `storage` with the tables of `weights` (row by row) and returns the distribution that
    /// borrows it.
    ///
    /// # Errors
    /// As [`Tabulated1d::build`]; the numbers of weights and of storage must fit `width × height`
    /// (see [`Tabulated2d::storage_len`]). Single rows of zeros are never drawn.
    pub fn build(
        weights: &[T],
        width: usize,
        height: usize,
        storage: &'a mut [T],
    ) -> Result<Self, TableError> {
        let needed = Self::storage_len(width, height).ok_or(TableError::Empty)?;
        if weights.len() != width * height {
            return Err(TableError::Length { needed: width * height, given: weights.len() });
        }
        if storage.len() != needed {
            return Err(TableError::Length { needed, given: storage.len() });
        }
        let scale = largest(weights)?;
        let (rows, marginal) = storage.split_at_mut((width + 1) * height);
        let sums = marginal.iter_mut().skip(1);
        let tables = rows.chunks_exact_mut(width + 1).zip(weights.chunks_exact(width));
        for (sum, (table, weights)) in sums.zip(tables) {
            copy_scaled(weights, scale, table);
            *sum = accumulate(table);
        }
        accumulate(marginal);
        Self::from_parts(rows, marginal, width).ok_or(TableError::AllZero)
    }

    /// The distribution of storage that [`Tabulated2d::build`] has filled for the same sides.
    /// `None` where the length or the marginal table does not fit; the rest is not checked, and
    /// storage filled otherwise gives meaningless samples, but no panic.
    #[inline]
    pub fn from_storage(storage: &'a [T], width: usize, height: usize) -> Option<Self> {
        if Self::storage_len(width, height)? != storage.len() {
            return None;
        }
        let (rows, marginal) = storage.split_at((width + 1) * height);
        Self::from_parts(rows, marginal, width)
    }

    #[inline]
    fn from_parts(rows: &'a [T], marginal: &'a [T], width: usize) -> Option<Self> {
        Some(Self { marginal: Tabulated1d::from_cdf(marginal)?, rows, width })
    }

    /// Number of columns and of rows, at least 1 each.
    #[inline]
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.marginal.len()]
    }

    /// Draws a point of the unit square and its density; never a cell of weight 0.
    ///
    /// ```text
    /// y from the marginal by u₁, x from the table of y's row by u₀
    /// p(x, y) = width · height · weight/Σ weights
    /// ```
    #[inline]
    pub fn sample(&self, [u, v]: [T; 2]) -> ([T; 2], T) {
        let (y, pdf_y) = self.marginal.sample(v);
        let Some(row) = self.row_at(y) else { return ([T::ZERO, y], T::ZERO) };
        let (x, pdf_x) = row.sample(u);
        ([x, y], pdf_x * pdf_y)
    }

    /// Density at a point; 0 outside the unit square and for NaN.
    #[inline]
    pub fn pdf(&self, [x, y]: [T; 2]) -> T {
        let pdf_y = self.marginal.pdf(y);
        self.row_at(y).map_or(T::ZERO, |row| row.pdf(x) * pdf_y)
    }

    /// The uniforms that [`Tabulated2d::sample`] maps to a point, which is limited to the square.
    #[inline]
    pub fn to_square(&self, [x, y]: [T; 2]) -> [T; 2] {
        let u = self.row_at(y).map_or(T::ZERO, |row| row.to_uniform(x));
        [u, self.marginal.to_uniform(y)]
    }

    /// The distribution of columns in the row that holds `y`.
    #[inline]
    fn row_at(&self, y: T) -> Option<Tabulated1d<'a, T>> {
        let stride = self.width + 1;
        let start = self.marginal.piece(y) * stride;
        Tabulated1d::from_cdf(self.rows.get(start..start + stride)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{check_inverse, chi_squared_deviation, uniforms};

    const WEIGHTS: [f64; 12] = [1.0, 2.0, 0.0, 5.0, 0.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.5, 1.5];
    const STORAGE: usize = 5 * 3 + 4;

    #[test]
    fn cells_are_drawn_as_often_as_their_weight_says() {
        let mut storage = [0.0; STORAGE];
        let map = Tabulated2d::build(&WEIGHTS, 4, 3, &mut storage).unwrap();
        let mut counts = [0.0; 12];
        for u in uniforms(10_000) {
            let ([x, y], pdf) = map.sample(u);
            let cell = (y * 3.0) as usize * 4 + (x * 4.0) as usize;
            counts[cell] += 1.0;
            assert_eq!(pdf, map.pdf([x, y]));
            // The weights sum to 13; a handful of roundings.
            assert!((pdf / (WEIGHTS[cell] / 13.0 * 12.0) - 1.0).abs() < 8.0 * f64::EPSILON);
        }
        let expected = WEIGHTS.map(|w| w / 13.0 * 1e4);
        // 5 standard deviations of a fixed seed.
        assert!(chi_squared_deviation(&counts, &expected) < 5.0, "{counts:?}");
    }

    #[test]
    fn density_integrates_to_one_and_the_inverse_undoes_the_map() {
        let mut storage = [0.0; STORAGE];
        let map = Tabulated2d::build(&WEIGHTS, 4, 3, &mut storage).unwrap();
        let center = |i: u8| [(f64::from(i % 4) + 0.5) / 4.0, (f64::from(i / 4) + 0.5) / 3.0];
        let integral: f64 = (0..12).map(|i| map.pdf(center(i)) / 12.0).sum();
        assert!((integral - 1.0).abs() < 12.0 * f64::EPSILON);
        // Positions of up to 4 are subtracted again.
        check_inverse(|u| map.sample(u).0, |p| map.to_square(p), 8.0 * f64::EPSILON);
    }

    #[test]
    fn points_outside_have_no_density_and_nothing_panics() {
        let mut storage = [0.0; STORAGE];
        let map = Tabulated2d::build(&WEIGHTS, 4, 3, &mut storage).unwrap();
        for bad in [-1.0, 1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(map.pdf([bad, 0.5]), 0.0);
            assert_eq!(map.pdf([0.1, bad]), 0.0);
            let (_, pdf) = map.sample([bad, bad]);
            assert!(pdf > 0.0);
            assert!(map.to_square([bad, bad]).iter().all(|u| (0.0..1.0).contains(u)));
        }
    }

    #[test]
    fn storage_can_be_kept_and_read_again() {
        let mut storage = [0.0; STORAGE];
        let built = *Tabulated2d::build(&WEIGHTS, 4, 3, &mut storage).as_ref().unwrap();
        let (point, size) = (built.sample([0.3, 0.6]), built.size());
        let again = Tabulated2d::from_storage(&storage, 4, 3).unwrap();
        assert_eq!((again.sample([0.3, 0.6]), again.size()), (point, size));
        assert_eq!(Tabulated2d::from_storage(&storage, 3, 4), None);
        assert_eq!(Tabulated2d::from_storage(&storage, 0, 3), None);
    }

    #[test]
    fn impossible_tables_are_refused() {
        let mut storage = [0.0_f32; STORAGE];
        let mut error = |weights: &[f32], width, height| {
            Tabulated2d::build(weights, width, height, &mut storage).unwrap_err()
        };
        assert_eq!(error(&[], 0, 3), TableError::Empty);
        assert_eq!(error(&[0.0; 12], 4, 3), TableError::AllZero);
        assert_eq!(error(&[1.0; 11], 4, 3), TableError::Length { needed: 12, given: 11 });
        assert_eq!(error(&[1.0; 8], 4, 2), TableError::Length { needed: 13, given: 19 });
        assert_eq!(error(&[1.0; 12], usize::MAX, 3), TableError::Empty);
        let mut weights = [1.0; 12];
        weights[7] = f32::NAN;
        assert_eq!(error(&weights, 4, 3), TableError::Weight { index: 7 });
    }
}
