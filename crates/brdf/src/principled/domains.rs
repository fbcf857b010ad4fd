//! The domains of what artists say.

use etendue_math::{Real, Spectrum};

use crate::param::{clamped, within};
use crate::{Ior, ParameterError, Reflectance};

/// Sampling rates.
const RATES: [f64; 2] = [0.0, 1e6];

/// Checks what solid and thin materials have in common: a colour, an index, numbers in `[0, 1]` by name, and
/// sampling rates in `[0, 1e6]`, a limit that keeps their sums finite.
pub(super) fn check<C: Spectrum>(
    base_color: C,
    eta: C::Real,
    shares: &[(&'static str, C::Real)],
    rates: &[(&'static str, C::Real)],
) -> Result<(), ParameterError> {
    Reflectance::new(base_color).map_err(|e| e.named("base_color"))?;
    Ior::new(eta)?;
    for &(name, x) in shares {
        unit(name, x)?;
    }
    for &(name, x) in rates {
        within(name, x, RATES, "in [0, 1e6]")?;
    }
    Ok(())
}

/// Checks a number that must lie in `[0, 1]`.
pub(super) fn unit<T: Real>(name: &'static str, x: T) -> Result<(), ParameterError> {
    within(name, x, [0.0, 1.0], "in [0, 1]").map(|_| ())
}

/// A number moved into `[0, 1]`.
#[inline]
pub(super) fn clamped_unit<T: Real>(x: T) -> T {
    clamped(x, [0.0, 1.0])
}

/// A relative index moved into the domain of [`Ior`].
#[inline]
pub(super) fn clamped_eta<T: Real>(eta: T) -> T {
    clamped(eta, [1e-4, 1e4])
}

/// A sampling rate moved into its domain.
#[inline]
pub(super) fn clamped_rate<T: Real>(rate: T) -> T {
    clamped(rate, RATES)
}
