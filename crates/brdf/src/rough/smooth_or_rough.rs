//! The choice between a delta model and its rough twin, and what a type that has made it forwards.

use etendue_math::Real;

use crate::{Alpha, ParameterError};

/// Checked widths, or `None` for a smooth surface.
pub(crate) fn rough_widths<T: Real>(
    alpha: [T; 2],
) -> Result<Option<[Alpha<T>; 2]>, ParameterError> {
    let least = T::lit(Alpha::<T>::RANGE[0]);
    for a in alpha {
        if !(a >= T::ZERO) {
            return Err(ParameterError::number("alpha", a, "in [0, 1e4]"));
        }
    }
    if alpha[0] < least && alpha[1] < least {
        return Ok(None);
    }
    Ok(Some([Alpha::new(alpha[0].max(least))?, Alpha::new(alpha[1].max(least))?]))
}

/// Forwards the interface to whichever variant is there.
macro_rules! either {
    ($self:ident, $model:ident => $call:expr; $($variant:ident),+) => {
        match $self { $(Self::$variant($model) => $call),+ }
    };
}
pub(crate) use either;
