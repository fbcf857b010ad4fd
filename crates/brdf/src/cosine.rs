//! Cosine-weighted hemisphere sampling, the density of the diffuse models.

use etendue_math::{Real, Vec3, Vector3};

/// A direction with density `cos θ / π`.
///
/// ```text
/// r = √u₀,  φ = 2π u₁,  w = (r cos φ, r sin φ, √(1 − u₀))
/// ```
///
/// `√(1 − u₀)` and not `√(1 − x² − y²)`: the latter loses its digits at the horizon.
#[inline(always)]
pub(crate) fn from_square<T: Real>(u: [T; 2]) -> Vec3<T> {
    let (sin, cos) = (T::TWO * T::PI * u[1]).sin_cos();
    let r = u[0].sqrt();
    Vec3::<T>::new(r * cos, r * sin, (T::ONE - u[0]).safe_sqrt())
}

/// Density per steradian at `cos θ`, 0 below the surface.
#[inline(always)]
pub(crate) fn pdf<T: Real>(cos: T) -> T {
    cos.max(T::ZERO) * T::FRAC_1_PI
}
