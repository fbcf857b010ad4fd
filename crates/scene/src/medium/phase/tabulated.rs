//! Phase functions that are tables.

use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;

use etendue_math::Real;
use etendue_math::glam::Vec3;
use etendue_sampling::warp::{linear::Linear, turn};
use etendue_sampling::{TableError, Tabulated1d};

/// A phase function by its values at cosines that are evenly spaced from −1, backwards, to 1; linear in between.
///
/// ```text
/// p(cos θ) = f(cos θ) / (2π ∫ f dμ)
/// ```
///
/// # Source
/// Mitsuba 3's `tabphase`.
#[derive(Clone, Debug)]
pub struct TabulatedPhase {
    values: Box<[f32]>,
    /// Of the pieces between values.
    cdf: Box<[f32]>,
}

impl TabulatedPhase {
    /// A phase function proportional to `values`, which need not integrate to anything in particular.
    ///
    /// # Errors
    /// Less than two values; one that is negative, NaN or infinite; nothing but zeros.
    pub fn new(values: &[f32]) -> Result<Self, TableError> {
        if let Some(index) = values.iter().position(|v| !(*v >= 0.0 && v.is_finite())) {
            return Err(TableError::Weight { index });
        }
        let halves: Vec<f32> = values.iter().map(|value| 0.5 * value).collect();
        let pieces: Vec<f32> = halves.windows(2).map(|ends| ends[0] + ends[1]).collect();
        let mut cdf = vec![0.0; pieces.len() + 1];
        Tabulated1d::build(&pieces, &mut cdf)?;
        Ok(Self { values: values.into(), cdf: cdf.into() })
    }

    /// The values at cosines from −1 to 1.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// The piece, from one value to the next, of this index.
    #[inline]
    fn piece(&self, index: usize) -> Option<Linear<f32>> {
        Linear::new(self.values[index], self.values[index + 1])
    }

    fn pieces(&self) -> usize {
        self.cdf.len() - 1
    }

    /// Density per steradian within a piece: its probability, over the solid angle that it covers.
    #[inline]
    fn density(&self, table: &Tabulated1d<'_, f32>, index: usize, within: f32) -> f32 {
        let shape = self.piece(index).map_or(0.0, |piece| piece.pdf(within));
        shape * table.probability(index) * (self.pieces() as f32 * 0.25 * f32::FRAC_1_PI)
    }

    /// Density per steradian of directions at an angle with this cosine to the direction of travel.
    #[inline]
    pub(super) fn eval(&self, cos: f32) -> f32 {
        let Some(table) = Tabulated1d::from_cdf(&self.cdf) else { return 0.0 };
        let pieces = self.pieces();
        let place = Real::clamp_to(0.5 * (1.0 + cos), 0.0, 1.0) * pieces as f32;
        let index = (place as usize).min(pieces - 1);
        self.density(&table, index, place - index as f32)
    }

    /// A direction around +z and its density.
    #[inline]
    pub(super) fn sample(&self, [u, turned]: [f32; 2]) -> (Vec3, f32) {
        let choice = Tabulated1d::from_cdf(&self.cdf).map(|table| (table, table.choose(u)));
        let Some((table, choice)) = choice else { return (Vec3::Z, 0.0) };
        let piece = self.piece(choice.index);
        let within = piece.map_or(0.0, |piece| piece.from_unit(choice.residual));
        // Both from the ends, where sines are small.
        let per_piece = 2.0 / self.pieces() as f32;
        let one_plus = (choice.index as f32 + within) * per_piece;
        let rest = self.pieces() - choice.index - 1;
        let one_minus = (rest as f32 + (1.0 - within)) * per_piece;
        let z = if one_plus < 1.0 { one_plus - 1.0 } else { 1.0 - one_minus };
        let sin = Real::sqrt(one_plus * one_minus);
        let (sin_phi, cos_phi) = turn::sin_cos(turned);
        let direction = Vec3::new(sin * cos_phi, sin * sin_phi, z);
        (direction, self.density(&table, choice.index, within))
    }
}
