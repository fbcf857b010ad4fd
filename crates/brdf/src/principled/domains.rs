//! The domains of what artists say.

use etendue_math::{Real, Spectrum};

use crate::param::within;
use crate::{Ior, ParameterError, Reflectance};

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
        within(name, x, [0.0, 1e6], "in [0, 1e6]")?;
    }
    Ok(())
}

/// Checks a number that must lie in `[0, 1]`.
pub(super) fn unit<T: Real>(name: &'static str, x: T) -> Result<(), ParameterError> {
    within(name, x, [0.0, 1.0], "in [0, 1]").map(|_| ())
}
