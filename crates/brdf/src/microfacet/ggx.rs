//! GGX (Trowbridge–Reitz) microfacets.

mod bounded;
mod disk;

pub use bounded::{bounded_area, sample_bounded_normal};
pub use disk::sample_visible_normal_by_disk;

use etendue_math::{Real, Vec3, Vector3};

/// Density of facet normals D(h), per steradian of `h` and area of the mean surface.
///
/// ```text
/// D(h) = 1 / (π αx αy ((hx/αx)² + (hy/αy)² + hz²)²)
/// ```
///
/// * `h`: unit facet normal; 0 is returned where `h.z` is not positive.
/// * `alpha_x`, `alpha_y`: widths along the tangents, positive.
///
/// # Precision
/// A few ulp times the condition, for α down to 1e-8. The half *vector* is the argument because in
/// terms of its cosine `1 + (α² − 1) cos²` cancels: 12 % at α = 1e-3 in `f32`, infinite at 1e-4.
///
/// # Source
/// T. Trowbridge and K. Reitz, JOSA 65(5), 1975; B. Walter et al., EGSR 2007, eq. 33; anisotropic form
/// by E. Heitz, JCGT 3(2), 2014, eq. 85.
#[inline]
pub fn ndf<T: Real>(h: Vec3<T>, alpha_x: T, alpha_y: T) -> T {
    if !(h.z() > T::ZERO) {
        return T::ZERO;
    }
    let (x, y) = (h.x() / alpha_x, h.y() / alpha_y);
    let e = x * x + y * y + h.z() * h.z();
    T::FRAC_1_PI / ((alpha_x * e) * (alpha_y * e))
}

/// Smith's function Λ: masked over visible projected area.
///
/// ```text
/// Λ(w) = ½ (√(1 + tan²) − 1) = s² / (2 z (√(z² + s²) + z)),  s² = (αx x)² + (αy y)²
/// ```
///
/// `w` above the surface; the second form does not cancel for small Λ.
///
/// # Source
/// E. Heitz, JCGT 3(2), 2014, eq. 72.
#[inline]
pub fn lambda<T: Real>(w: Vec3<T>, alpha_x: T, alpha_y: T) -> T {
    let (x, y, z) = (alpha_x * w.x(), alpha_y * w.y(), w.z());
    let s2 = x * x + y * y;
    s2 / (T::TWO * z * ((z * z + s2).sqrt() + z))
}

/// Projected area σ of the visible microsurface per area of the mean surface.
///
/// ```text
/// σ(w) = z (1 + Λ(w)) = ½ (z + √(z² + (αx x)² + (αy y)²))
/// ```
///
/// `w` above or on the surface. It stays finite at grazing, where Λ does not.
///
/// # Source
/// E. Heitz et al., "Multiple-Scattering Microfacet BSDFs with the Smith Model", SIGGRAPH 2016, eq. 3.
#[inline]
pub fn projected_area<T: Real>(w: Vec3<T>, alpha_x: T, alpha_y: T) -> T {
    let (x, y, z) = (alpha_x * w.x(), alpha_y * w.y(), w.z());
    T::HALF * (z + (z * z + x * x + y * y).sqrt())
}

/// A rational fit of the height-correlated visibility `G2 / (4 cos θo cos θi)`, without roots; isotropic.
///
/// ```text
/// V ≈ 1 / (2 (2 (1 − α) co ci + α (co + ci)))
/// ```
///
/// It is the exact form with the root in [`projected_area`] replaced by its chord in cos θ, hence exact at
/// α = 0, α = 1 and normal incidence, and never above the exact value.
///
/// * `cos_o`, `cos_i`: cosines in `[0, 1]`; `alpha` in `[0, 1]`. 0 where both cosines, or one and α, vanish.
///
/// # Precision
/// Too dark by at most 29.3 % (a factor 1/√2), where both cosines are about α and α is small; by at most
/// 20 % for α ≥ 0.3 and 14 % for α ≥ 0.5.
///
/// # Source
/// E. Hammon, "PBR Diffuse Lighting for GGX + Smith Microsurfaces", GDC 2017.
#[inline]
pub fn visibility_hammon<T: Real>(cos_o: T, cos_i: T, alpha: T) -> T {
    let product = T::TWO * (T::ONE - alpha) * cos_o * cos_i;
    let area = T::TWO * (product + alpha * (cos_o + cos_i));
    if area > T::ZERO { (T::ONE / area).min(T::MAX) } else { T::ZERO }
}

/// A rational fit of the separable visibility `G1(wo) G1(wi) / (4 cos θo cos θi)`, without roots; isotropic. **For
/// comparison only**: use [`Microfacets::visibility`](super::Microfacets::visibility).
///
/// ```text
/// V ≈ 1 / (4 (co (1 − k) + k) (ci (1 − k) + k)),  k = α/2
/// ```
///
/// It is the separable form with [`projected_area`] interpolated linearly in α between its values at 0 and 1, hence exact there
/// and at normal incidence, and never above the exact value. [`visibility_hammon`] does the same to the height-correlated form.
///
/// * `cos_o`, `cos_i`: cosines in `[0, 1]`; `alpha` in `[0, 1]`. 0 where a cosine and α vanish.
///
/// # Precision
/// Against the separable form too dark by at most 36 % (a factor 0.8²), where both cosines are about ¾ α and α is small.
///
/// # Source
/// C. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", Eurographics 1994, eq. 19, with the k of
/// B. Karis, "Real Shading in Unreal Engine 4", SIGGRAPH 2013 course.
#[inline]
pub fn visibility_schlick<T: Real>(cos_o: T, cos_i: T, alpha: T) -> T {
    let k = T::HALF * alpha;
    let area = |cos: T| cos * (T::ONE - k) + k;
    let area = T::lit(4.0) * area(cos_o) * area(cos_i);
    if area > T::ZERO { (T::ONE / area).min(T::MAX) } else { T::ZERO }
}

/// A facet normal, seen or not, with density `D(h) hz`.
///
/// ```text
/// h = normalize(αx √u₁ cos 2πu₀, αy √u₁ sin 2πu₀, √(1 − u₁))
/// ```
///
/// `u`: uniforms in `[0, 1)`. `None` where the vector underflows.
///
/// # Precision
/// Both roots are of numbers as exact as the uniforms: the slope `α √(u₁ / (1 − u₁))` keeps its digits
/// for any α.
///
/// # Source
/// B. Walter et al., EGSR 2007, eqs. 35 and 36, as a vector instead of angles.
#[inline]
pub fn sample_normal<T: Real>(alpha_x: T, alpha_y: T, u: [T; 2]) -> Option<Vec3<T>> {
    let (radius, z) = (u[1].sqrt(), (T::ONE - u[1]).safe_sqrt());
    let (sin, cos) = (T::TWO * T::PI * u[0]).sin_cos();
    Vec3::<T>::new(alpha_x * radius * cos, alpha_y * radius * sin, z).try_normalize()
}

/// A facet normal visible from `wo`, with density `D(h) (wo·h) / σ(wo)`.
///
/// ```text
/// v = normalize(αx x, αy y, z)
/// t = u₁ (1 + vz),  c = (√(t (2 − t)) cos 2πu₀, √(t (2 − t)) sin 2πu₀)
/// h = normalize(αx (cx + vx), αy (cy + vy), (1 − u₁)(1 + vz))
/// ```
///
/// * `wo`: unit vector above the surface. `u`: uniforms in `[0, 1)`.
///
/// `None` where the vectors underflow.
///
/// # Precision
/// No slope and no difference of near-equal numbers, so grazing `wo` needs no special case.
///
/// # Source
/// J. Dupuy and A. Benyoub, "Sampling Visible GGX Normals with Spherical Caps", HPG 2023, listing 3;
/// the sine of the cap from `t` instead of `1 − z²`.
#[inline]
pub fn sample_visible_normal<T: Real>(
    wo: Vec3<T>,
    alpha_x: T,
    alpha_y: T,
    u: [T; 2],
) -> Option<Vec3<T>> {
    let v = Vec3::<T>::new(alpha_x * wo.x(), alpha_y * wo.y(), wo.z()).try_normalize()?;
    let cap = T::ONE + v.z();
    let t = u[1] * cap;
    let sin_theta = (t * (T::TWO - t)).safe_sqrt();
    let (sin, cos) = (T::TWO * T::PI * u[0]).sin_cos();
    Vec3::<T>::new(
        alpha_x * (sin_theta * cos + v.x()),
        alpha_y * (sin_theta * sin + v.y()),
        (T::ONE - u[1]) * cap,
    )
    .try_normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Alpha, Microfacets};
    use etendue_math::glam::DVec3;

    #[test]
    fn hammons_fit_is_as_good_as_it_says() {
        let direction = |cos: f64| DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
        let worst_of = |alpha: f64| {
            let facets = Microfacets::ggx(Alpha::new(alpha).unwrap());
            let mut worst: f64 = 0.0;
            for i in 0..60 {
                for j in 0..60 {
                    let [o, i] = [i, j].map(|k| Real::powf(10.0, -0.1 * f64::from(k)));
                    let exact = facets.visibility(direction(o), direction(i));
                    let error = 1.0 - visibility_hammon(o, i, alpha) / exact;
                    // The chord of a convex function lies above it; rounding.
                    assert!(error > -1e-12, "{alpha} {o} {i} {error}");
                    worst = worst.max(error);
                }
            }
            worst
        };
        for (alpha, bound) in [(1e-4, 0.293), (0.01, 0.293), (0.3, 0.2), (0.5, 0.14), (1.0, 1e-12)]
        {
            let worst = worst_of(alpha);
            assert!(worst < bound, "{alpha} {worst}");
        }
        assert!(worst_of(1e-4) > 0.29);
    }

    #[test]
    fn schlicks_fit_is_as_good_as_it_says() {
        let z = 0.75e-4;
        let area = projected_area::<f64>(DVec3::new(1.0, 0.0, z), 1e-4, 1e-4);
        let exact = |o: f64, i: f64| 1.0 / (4.0 * o * i);
        // Where it is worst; z² beside 1.
        let ratio = visibility_schlick(z, z, 1e-4) / exact(area, area);
        assert!((ratio - 0.64).abs() < 1e-3, "{ratio}");
        for alpha in [0.0, 1e-3, 0.1, 0.5, 1.0] {
            for i in 1..=100 {
                let cos = f64::from(i) / 100.0;
                let w = DVec3::new(((1.0 - cos) * (1.0 + cos)).sqrt(), 0.0, cos);
                let area = projected_area::<f64>(w, alpha, alpha);
                let ratio = visibility_schlick(cos, 1.0, alpha) / exact(area, 1.0);
                // One of the two factors; rounding.
                assert!(ratio > 0.8 - 1e-12 && ratio < 1.0 + 1e-12, "{alpha} {cos} {ratio}");
            }
        }
    }
}
