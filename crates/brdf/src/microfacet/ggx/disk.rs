//! Visible GGX normals through the projected hemisphere.

use etendue_math::{Real, Vec3, Vector3};

/// A facet normal visible from `wo`, with density `D(h) (wo·h) / σ(wo)`: the same density as
/// [`sample_visible_normal`](super::sample_visible_normal), reached by another map of the square.
///
/// ```text
/// v = normalize(αx x, αy y, z),  s = ½ (1 + vz),  l = √(vx² + vy²)
/// t₁ = √u₁ cos 2πu₀,  t = √u₁ sin 2πu₀,  c = √(1 − t₁²),  t₂ = (1 − s) c + s t
/// n = t₁ T₁ + t₂ T₂ + w v,  w = √(1 − t₁² − t₂²),  T₁ = (−vy, vx, 0)/l,  T₂ = v × T₁
/// h = normalize(αx nx, αy ny, nz)
/// ```
///
/// * `wo`: unit vector above the surface. `u`: uniforms in `[0, 1)`.
///
/// `None` where the vectors underflow.
///
/// # Precision
/// As printed, w and nz subtract nearly equal numbers at the rim of the disk, which is where the grazing
/// normals come from: in `f32` the lost digits turn into slopes off by half. With `q = 1 − u₁` and
/// `e = c + t = q / (c − t)` the same numbers are sums:
///
/// ```text
/// w² = s (c − t) (2 (1 − s) c + s e)
/// nz = s e (l + vz (2 vz c − s e) / (w + l c))
/// ```
///
/// # Source
/// E. Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), 2018, listing 1; rewritten as
/// above.
#[inline]
pub fn sample_visible_normal_by_disk<T: Real>(
    wo: Vec3<T>,
    alpha_x: T,
    alpha_y: T,
    u: [T; 2],
) -> Option<Vec3<T>> {
    let v = Vec3::<T>::new(alpha_x * wo.x(), alpha_y * wo.y(), wo.z()).try_normalize()?;
    let l = (v.x() * v.x() + v.y() * v.y()).sqrt();
    let (cos_phi, sin_phi) = if l > T::ZERO { (v.x() / l, v.y() / l) } else { (T::ONE, T::ZERO) };
    let s = T::HALF * (T::ONE + v.z());
    // 1 − s = ½ (1 − vz) = ¼ l² / s.
    let rest = T::lit(0.25) * l * l / s;

    let radius = u[1].sqrt();
    let (sin, cos) = (T::TWO * T::PI * u[0]).sin_cos();
    let (t1, t) = (radius * cos, radius * sin);
    let q = T::ONE - u[1];
    let c = (q + t * t).sqrt();
    // c + t and c − t: their product is q, and one of them is a sum.
    let larger = c + t.abs();
    let smaller = q / larger;
    let (e, difference) = if t < T::ZERO { (smaller, larger) } else { (larger, smaller) };

    let w = (s * difference * (T::TWO * rest * c + s * e)).sqrt();
    let t2 = rest * c + s * t;
    let z = s * e * (l + v.z() * (T::TWO * v.z() * c - s * e) / (w + l * c));
    // Along the azimuth of v and across it.
    let along = w * l - t2 * v.z();
    Vec3::<T>::new(
        alpha_x * (along * cos_phi - t1 * sin_phi),
        alpha_y * (along * sin_phi + t1 * cos_phi),
        z,
    )
    .try_normalize()
}
