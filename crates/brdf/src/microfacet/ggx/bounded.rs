//! Visible GGX normals whose reflections stay above the surface, as far as a cap can tell.

use etendue_math::{Real, Vec3, Vector3};

/// `(k, 1 − k)`: how far the cap of reflected directions shrinks.
///
/// ```text
/// a = min(αx, αy, 1),  s = 1 + √(x² + y²)
/// k = (1 − a²) s² / (s² + a² z²),  1 − k = a² (s² + z²) / (s² + a² z²)
/// ```
#[inline(always)]
fn shrinkage<T: Real>(wo: Vec3<T>, alpha_x: T, alpha_y: T) -> (T, T) {
    let a = alpha_x.min(alpha_y).min(T::ONE);
    let s = T::ONE + (wo.x() * wo.x() + wo.y() * wo.y()).sqrt();
    let (a2, s2, z2) = (a * a, s * s, wo.z() * wo.z());
    let denominator = s2 + a2 * z2;
    ((T::ONE - a2) * s2 / denominator, a2 * (s2 + z2) / denominator)
}

/// What takes the place of the projected area σ(wo) for [`sample_bounded_normal`].
///
/// ```text
/// A(wo) = ½ (k z + √(z² + (αx x)² + (αy y)²)) ≤ σ(wo)
/// ```
///
/// * `wo`: above the surface.
///
/// The density of normals is `D(h) (wo·h) / A(wo)`, that of reflected directions `D(h) / (4 A(wo))`.
///
/// # Source
/// K. Eto and Y. Tokuyoshi, "Bounded VNDF Sampling for Smith–GGX Reflections", SIGGRAPH Asia 2023
/// Technical Communications, eqs. 5, 6 and 8.
#[inline]
pub fn bounded_area<T: Real>(wo: Vec3<T>, alpha_x: T, alpha_y: T) -> T {
    let (x, y, z) = (alpha_x * wo.x(), alpha_y * wo.y(), wo.z());
    let (k, _) = shrinkage(wo, alpha_x, alpha_y);
    T::HALF * (k * z + (z * z + x * x + y * y).sqrt())
}

/// A facet normal visible from `wo` whose reflection of `wo` is not certain to fall below the surface.
///
/// ```text
/// v = normalize(αx x, αy y, z),  b = k vz,  t = u₁ (1 + b)
/// c = (√(t (2 − t)) cos 2πu₀, √(t (2 − t)) sin 2πu₀)
/// h = normalize(αx (cx + vx), αy (cy + vy), (1 − u₁)(1 + b) + (1 − k) vz)
/// ```
///
/// with k as in [`bounded_area`]: the cap of [`sample_visible_normal`](super::sample_visible_normal)
/// without the part below `−k vz`, from which no reflection comes back above the surface. All
/// reflections that do stay above keep a density, hence the estimator is unbiased.
///
/// * `wo`: unit vector above the surface. `u`: uniforms in `[0, 1)`.
///
/// `None` where the vectors underflow.
///
/// # Precision
/// `vz − b` is `(1 − k) vz` with `1 − k` from its own sum, and the sine of the cap comes from t: nothing
/// cancels for small α or grazing `wo`.
///
/// # Source
/// K. Eto and Y. Tokuyoshi 2023, listing 1, rewritten as above.
#[inline]
pub fn sample_bounded_normal<T: Real>(
    wo: Vec3<T>,
    alpha_x: T,
    alpha_y: T,
    u: [T; 2],
) -> Option<Vec3<T>> {
    let v = Vec3::<T>::new(alpha_x * wo.x(), alpha_y * wo.y(), wo.z()).try_normalize()?;
    let (k, rest) = shrinkage(wo, alpha_x, alpha_y);
    let cap = T::ONE + k * v.z();
    let t = u[1] * cap;
    let sin_theta = (t * (T::TWO - t)).safe_sqrt();
    let (sin, cos) = (T::TWO * T::PI * u[0]).sin_cos();
    Vec3::<T>::new(
        alpha_x * (sin_theta * cos + v.x()),
        alpha_y * (sin_theta * sin + v.y()),
        (T::ONE - u[1]) * cap + rest * v.z(),
    )
    .try_normalize()
}
