//! Sheen: what cloth adds at grazing angles.

use etendue_math::{Real, Spectrum};

use super::fresnel::{fifth_power, tint};

/// Burley's sheen.
///
/// ```text
/// f = sheen · ((1 − sheen_tint) + sheen_tint · tint(base)) · (1 − wi·h)⁵
/// ```
///
/// # Source
/// B. Burley, SIGGRAPH 2012 course notes, section 5.5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sheen<C> {
    color: C,
}

impl<C: Spectrum> Sheen<C> {
    /// `weight` and `sheen_tint` in `[0, 1]`.
    pub(super) fn new(base: C, weight: C::Real, sheen_tint: C::Real) -> Self {
        let one = <C::Real as Real>::ONE;
        let color = tint(base).map(|c| (one - sheen_tint) + sheen_tint * c).scale(weight);
        Self { color }
    }

    /// Value at `cos_d = wi·h`.
    #[inline]
    pub(super) fn eval(&self, cos_d: C::Real) -> C {
        self.color.scale(fifth_power(cos_d))
    }
}
