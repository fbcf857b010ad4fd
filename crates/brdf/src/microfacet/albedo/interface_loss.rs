//! What single scattering at a rough dielectric interface loses.

use etendue_math::Real;

use super::{InterfaceAlbedo, LossTable};

/// Light from one side that single scattering at a rough dielectric interface loses, and the share of the rest
/// that is transmitted.
///
/// ```text
/// l(μ) = 1 − R(μ) − T(μ),  average  2 ∫₀¹ l(μ) μ dμ,  share  T_avg / (R_avg + T_avg)
/// ```
///
/// with R and T of [`InterfaceAlbedo`] at 32 cosines, interpolated linearly in the variable of [`LossTable`].
/// The average is that of the interpolation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InterfaceLoss<T> {
    row: [T; LossTable::ENTRIES],
    alpha: T,
    average: f64,
    transmitted: f64,
}

impl<T: Real> InterfaceLoss<T> {
    /// The loss of light from the side on which the index of the other is `eta`. 16 384 facets.
    pub fn new(interface: &InterfaceAlbedo, eta: f64) -> Self {
        let alpha = interface.alpha();
        let flux = core::array::from_fn::<_, { LossTable::ENTRIES }, _>(|j| {
            interface.at(eta, LossTable::cosine(j, alpha))
        });
        let mean = |row: [f64; LossTable::ENTRIES]| LossTable::mean_of(&row, alpha);
        let (reflected, transmitted) =
            (mean(flux.map(|f| f.reflected)), mean(flux.map(|f| f.transmitted)));
        let row = flux.map(|f| f.lost);
        Self {
            row: row.map(T::lit),
            alpha: T::lit(alpha),
            average: mean(row),
            transmitted: transmitted / (reflected + transmitted),
        }
    }

    /// `l(μ)`; the cosine is limited to `[0, 1]`.
    #[inline]
    pub fn at(&self, cos: T) -> T {
        LossTable::look_up(&self.row, cos.clamp_to(T::ZERO, T::ONE), self.alpha)
    }

    /// The average over the hemisphere.
    pub fn average(&self) -> f64 {
        self.average
    }

    /// The transmitted share of what is not lost, on average over the hemisphere.
    pub fn transmitted_share(&self) -> f64 {
        self.transmitted
    }
}
