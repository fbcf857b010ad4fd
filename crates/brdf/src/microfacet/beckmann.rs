//! Beckmann microfacets: Gaussian slopes.

use etendue_math::special::erf_inv;
use etendue_math::{Real, Vec3, Vector3};

const FRAC_1_SQRT_PI: f64 = 0.5 * core::f64::consts::FRAC_2_SQRT_PI;

/// Density of facet normals D(h), per steradian of `h` and area of the mean surface.
///
/// ```text
/// D(h) = exp(−((hx/(αx hz))² + (hy/(αy hz))²)) / (π αx αy hz⁴)
/// ```
///
/// * `h`: unit facet normal; 0 is returned where `h.z` is not positive.
/// * `alpha_x`, `alpha_y`: widths along the tangents, positive.
///
/// # Precision
/// A few ulp times the condition of the exponential, for α down to 1e-8 (see [`ggx::ndf`](super::ggx::ndf)).
///
/// # Source
/// P. Beckmann and A. Spizzichino 1963; B. Walter et al., EGSR 2007, eq. 25.
#[inline]
pub fn ndf<T: Real>(h: Vec3<T>, alpha_x: T, alpha_y: T) -> T {
    if !(h.z() > T::ZERO) {
        return T::ZERO;
    }
    let (x, y) = (h.x() / (alpha_x * h.z()), h.y() / (alpha_y * h.z()));
    let weight = (-(x * x + y * y)).exp();
    if !(weight > T::ZERO) {
        return T::ZERO; // also keeps 0/0 away at grazing h
    }
    let z2 = h.z() * h.z();
    weight * T::FRAC_1_PI / ((alpha_x * z2) * (alpha_y * z2))
}

/// `(z, s)` with `s² = (αx x)² + (αy y)²`; Smith's argument is `a = z / s`.
#[inline(always)]
fn stretched<T: Real>(w: Vec3<T>, alpha_x: T, alpha_y: T) -> (T, T) {
    let (x, y) = (alpha_x * w.x(), alpha_y * w.y());
    (w.z(), (x * x + y * y).sqrt())
}

/// Smith's function Λ, exact.
///
/// ```text
/// Λ(w) = ½ (exp(−a²) / (a √π) − erfc(a)),  a = z / √((αx x)² + (αy y)²)
///      = exp(−a²) K / (2 √π a (a + K)),  K = ½/(a + 1/(a + 1½/(a + 2/(a + …))))
/// ```
///
/// `w` above the surface.
///
/// # Precision
/// A few ulp times the condition. From a = 2 on, where the difference cancels, Laplace's continued
/// fraction of erfc takes its place, in which the common term is gone.
///
/// # Source
/// B. Walter et al., EGSR 2007, eq. 26 as Λ; E. Heitz, JCGT 3(2), 2014, eq. 66.
#[inline]
pub fn lambda<T: Real>(w: Vec3<T>, alpha_x: T, alpha_y: T) -> T {
    let (z, s) = stretched(w, alpha_x, alpha_y);
    let a = z / s;
    if !(a < T::INFINITY) {
        return T::ZERO;
    }
    let gauss = (-a * a).exp() * T::lit(FRAC_1_SQRT_PI);
    if a < T::TWO {
        T::HALF * (gauss / a - a.erfc())
    } else {
        let k = laplace_fraction(a);
        T::HALF * gauss * (k / (a * (a + k)))
    }
}

/// `K(a) = ½/(a + 1/(a + 1½/(a + …)))`, by which `erfc(a) = exp(−a²) / (√π (a + K))`, to the last
/// digits for `a ≥ 2`.
fn laplace_fraction<T: Real>(a: T) -> T {
    // The error falls by about exp(−4 a √(2n)) with n terms.
    let terms = if T::SIGNIFICAND_BITS > 24 { 40 } else { 10 };
    (1..=terms).rev().fold(T::ZERO, |k, n| T::lit(0.5 * f64::from(n)) / (a + k))
}

/// Projected area σ of the visible microsurface, exact; see [`ggx::projected_area`](super::ggx::projected_area).
///
/// ```text
/// σ(w) = z (1 + Λ(w)) = ½ (z (1 + erf a) + s exp(−a²)/√π),  a = z / s
/// ```
///
/// # Source
/// As [`lambda`].
#[inline]
pub fn projected_area<T: Real>(w: Vec3<T>, alpha_x: T, alpha_y: T) -> T {
    let (z, s) = stretched(w, alpha_x, alpha_y);
    projected_area_of(z, s)
}

#[inline(always)]
fn projected_area_of<T: Real>(z: T, s: T) -> T {
    let a = z / s;
    // erf is 1 and exp(−a²) nothing from here on in f64, let alone f32; s = 0 comes here too.
    if !(a < T::lit(6.0)) {
        return z;
    }
    T::HALF * (z * (T::ONE + a.erf()) + s * (-a * a).exp() * T::lit(FRAC_1_SQRT_PI))
}

/// `z / G1(w)` with Walter's rational fit of G1: what stands in for σ where pictures must agree
/// with renderers that use the fit.
///
/// ```text
/// G1 = (3.535 a + 2.181 a²) / (1 + 2.276 a + 2.577 a²)   a < 1.6, else 1
/// ```
///
/// # Precision
/// The fit is off by up to 0.35 % from the exact G1.
///
/// # Source
/// B. Walter et al., EGSR 2007, eq. 27.
#[inline]
pub fn projected_area_walter<T: Real>(w: Vec3<T>, alpha_x: T, alpha_y: T) -> T {
    let (z, s) = stretched(w, alpha_x, alpha_y);
    let a = z / s;
    if !(a < T::lit(1.6)) {
        return z;
    }
    // z / G1 with the factor a cancelled: finite at grazing.
    s * (T::ONE + a * (T::lit(2.276) + a * T::lit(2.577))) / (T::lit(3.535) + a * T::lit(2.181))
}

/// A facet normal, seen or not, with density `D(h) hz`.
///
/// ```text
/// h = normalize(αx r cos 2πu₀, αy r sin 2πu₀, 1),  r = √(−ln(1 − u₁))
/// ```
///
/// `u`: uniforms in `[0, 1)`. `None` where the vector underflows.
///
/// # Source
/// B. Walter et al., EGSR 2007, eqs. 28 and 29, as a vector instead of angles.
#[inline]
pub fn sample_normal<T: Real>(alpha_x: T, alpha_y: T, u: [T; 2]) -> Option<Vec3<T>> {
    let radius = (-(-u[1]).ln_1p()).safe_sqrt();
    let (sin, cos) = (T::TWO * T::PI * u[0]).sin_cos();
    Vec3::<T>::new(alpha_x * radius * cos, alpha_y * radius * sin, T::ONE).try_normalize()
}

/// A facet normal visible from `wo`, with density `D(h) (wo·h) / σ(wo)`, σ exact.
///
/// With `(s, z)` the unit vector along `(√((αx x)² + (αy y)²), z)`, the slope p along the stretched
/// azimuth of `wo` has the distribution function
///
/// ```text
/// P(p) = (z (1 + erf p) + s exp(−p²)/√π) / (2 σ),  p ≤ z/s
/// ```
///
/// inverted by Newton's method inside a shrinking bracket; the slope across is a plain Gaussian.
///
/// * `wo`: unit vector above the surface. `u`: uniforms in `[0, 1)`.
///
/// `None` where the vectors underflow.
///
/// # Precision
/// P is met to 8 ε; slopes are limited to ±6 standard widths in `f64` and ±4 in `f32`, beyond
/// which the precision of the uniforms does not reach.
///
/// # Source
/// E. Heitz and E. d'Eon, "Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible
/// Normals", EGSR 2014; start value by W. Jakob, "An Improved Visible Normal Sampling Routine for the
/// Beckmann Distribution", 2014. Written with sine and cosine instead of their quotients, so that
/// grazing and normal incidence need no special case.
#[inline(never)] // a call costs nothing beside Newton's method, and leaves GGX beside it inlined
pub fn sample_visible_normal<T: Real>(
    wo: Vec3<T>,
    alpha_x: T,
    alpha_y: T,
    u: [T; 2],
) -> Option<Vec3<T>> {
    visible_strip(wo, alpha_x, alpha_y, u[0])?(u[1])
}

/// The normals of [`sample_visible_normal`] with the same `u[0]`, as a function of `u[1]`: Newton's method
/// runs once for all of them.
#[inline(always)]
pub(crate) fn visible_strip<T: Real>(
    wo: Vec3<T>,
    alpha_x: T,
    alpha_y: T,
    u: T,
) -> Option<impl Fn(T) -> Option<Vec3<T>>> {
    let v = Vec3::<T>::new(alpha_x * wo.x(), alpha_y * wo.y(), wo.z()).try_normalize()?;
    let s = (v.x() * v.x() + v.y() * v.y()).sqrt();
    let (cos_phi, sin_phi) = if s > T::ZERO { (v.x() / s, v.y() / s) } else { (T::ONE, T::ZERO) };
    let limit = T::lit(if T::SIGNIFICAND_BITS > 24 { 6.0 } else { 4.0 });
    let along = slope_along(v.z(), s, u, limit);
    Some(move |u: T| {
        let across = erf_inv(T::TWO * u - T::ONE).max(-limit).min(limit);
        Vec3::<T>::new(
            -alpha_x * (cos_phi * along - sin_phi * across),
            -alpha_y * (sin_phi * along + cos_phi * across),
            T::ONE,
        )
        .try_normalize()
    })
}

/// Solves `P(p) = u` for the slope p in `[−limit, min(limit, z/s)]`.
#[inline]
fn slope_along<T: Real>(z: T, s: T, u: T, limit: T) -> T {
    let cot = z / s;
    let (mut low, mut high) = (-limit, limit.min(cot));
    let top = if cot < limit { cot.erf() } else { T::ONE };
    let target = T::TWO * u * projected_area_of(z, s);
    // Exact at grazing incidence, where the function is least linear.
    let start = top - (top + T::ONE) * (-u.max(T::MIN_POSITIVE).ln()).safe_sqrt().erf();
    let mut p = erf_inv(start);
    // What the roundings of the function leave; less would iterate on noise.
    let tolerance = T::lit(8.0) * T::EPSILON;
    for _ in 0..24 {
        if !(p > low && p < high) {
            p = T::HALF * (low + high);
        }
        let gauss = (-p * p).exp() * T::lit(FRAC_1_SQRT_PI);
        let excess = z * (T::ONE + p.erf()) + s * gauss - target;
        if excess.abs() <= tolerance {
            break;
        }
        if excess > T::ZERO {
            high = p;
        } else {
            low = p;
        }
        p -= excess / (T::TWO * gauss * (z - s * p));
    }
    p
}
