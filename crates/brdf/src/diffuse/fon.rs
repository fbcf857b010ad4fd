//! Fujii's form of Oren and Nayar's lobe for white facets: the shape and its albedos.
//!
//! Shared by [`OrenNayarFujii`](crate::OrenNayarFujii) and [`Eon`](crate::Eon), and usable alone. Cosines are
//! limited to `[0, 1]`; NaN counts as 0.

use etendue_math::{Real, Vector3};

use crate::Roughness;

/// `1/2 − 2/(3π)`: what the lobe of roughness r adds to the albedo at grazing, over that at the normal.
const AT_GRAZING: f64 = 0.5 - 2.0 / (3.0 * core::f64::consts::PI);
/// `2/3 − 28/(15π)`: the same on average over the hemisphere.
const ON_AVERAGE: f64 = 2.0 / 3.0 - 28.0 / (15.0 * core::f64::consts::PI);
/// `AT_GRAZING − ON_AVERAGE`, where the thirds cancel: `6/(5π) − 1/6`.
pub(super) const AVERAGE_DEFICIT: f64 = 6.0 / (5.0 * core::f64::consts::PI) - 1.0 / 6.0;

/// The fit of `G(μ)/π` in powers of `1 − μ`, from the first on.
const FIT: [f64; 4] = [0.057_108_528_9, 0.491_881_867, -0.332_181_442, 0.071_442_995_3];
/// `1/2 − 2/(3π) − fit`, expanded in powers of μ: near μ = 0 powers of `1 − μ` would cancel.
pub(super) const FIT_DEFICIT: [f64; 5] = [
    AT_GRAZING - (FIT[0] + FIT[1] + FIT[2] + FIT[3]),
    FIT[0] + 2.0 * FIT[1] + 3.0 * FIT[2] + 4.0 * FIT[3],
    -(FIT[1] + 3.0 * FIT[2] + 6.0 * FIT[3]),
    FIT[2] + 4.0 * FIT[3],
    -FIT[3],
];

/// Albedo of the lobe at normal incidence, its smallest.
///
/// ```text
/// A = 1 / (1 + (1/2 − 2/(3π)) r)
/// ```
///
/// # Source
/// Portsmouth, Kutz and Hill 2025 (see [`Eon`](crate::Eon)), listing 1.
#[inline(always)]
pub fn normal_albedo<T: Real>(roughness: Roughness<T>) -> T {
    T::ONE / (T::ONE + T::lit(AT_GRAZING) * roughness.value())
}

/// `π/A` times the lobe.
///
/// ```text
/// 1 + r s/t,   s = wo·wi − μo μi,   t = max(μo, μi) where s > 0, else 1
/// ```
///
/// Where s < 0 this is `(1 − r) + r (1 + s)` with `1 + s = ½ [(xo + xi)² + (yo + yi)² + zo² + zi²]`, a sum of
/// squares: at opposite grazing, where the lobe of r = 1 vanishes, the plain difference would leave no digit.
#[inline(always)]
pub(super) fn shape<V: Vector3>(wo: V, wi: V, roughness: V::Scalar) -> V::Scalar {
    let one = <V::Scalar as Real>::ONE;
    let s = wo.x() * wi.x() + wo.y() * wi.y();
    if s > V::Scalar::ZERO {
        // Directions that are almost in the surface would overflow.
        return one + roughness * (s / wo.z().max(wi.z())).min(V::Scalar::MAX * V::Scalar::HALF);
    }
    let squares = (wo.x() + wi.x()).sqr() + (wo.y() + wi.y()).sqr() + wo.z().sqr() + wi.z().sqr();
    (one - roughness) + roughness * V::Scalar::HALF * squares
}

/// Directional albedo of the lobe, exact.
///
/// ```text
/// E(μ) = A (1 + r G(μ)/π)
/// G(μ) = S (acos μ − S μ) + 2/3 [(S/μ)(1 − S³) − S],   S = √(1 − μ²)
/// ```
///
/// * `cos`: μ, the cosine of the direction.
/// * returns a share of 1 in `[A, 1]`; 1 at μ = 0, where the published form is 0/0.
///
/// # Precision
/// 2 ulp: see [`albedo_deficit`].
///
/// # Source
/// Portsmouth, Kutz and Hill 2025 (see [`Eon`](crate::Eon)), listing 1.
///
/// # Examples
/// ```
/// use etendue_brdf::{Roughness, fon};
/// let rough = Roughness::new(1.0_f32)?;
/// assert_eq!(fon::albedo(0.0, rough), 1.0);
/// let error = fon::albedo(1.0, rough) - fon::normal_albedo(rough);
/// assert!(error.abs() <= f32::EPSILON);
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[inline]
pub fn albedo<T: Real>(cos: T, roughness: Roughness<T>) -> T {
    T::ONE - albedo_deficit(cos, roughness)
}

/// `1 − E(μ)` of [`albedo`], without cancellation.
///
/// ```text
/// 1 − E = r A D/π
/// D = (π/2 − 2/3) μ²/(1 + S) + S asin μ + S² μ − 2/3 S μ (1 + S + S²)/(1 + S)
/// ```
///
/// # Precision
/// 8 ulp, also for μ → 0, where it is `r A μ/π`, and for r → 0.
#[inline]
pub fn albedo_deficit<T: Real>(cos: T, roughness: Roughness<T>) -> T {
    roughness.value() * normal_albedo(roughness) * deficit(cos)
}

/// `D(μ)/π` of [`albedo_deficit`].
#[inline]
pub(super) fn deficit<T: Real>(cos: T) -> T {
    let mu = cos.clamp_to(T::ZERO, T::ONE);
    let s = ((T::ONE - mu) * (T::ONE + mu)).sqrt();
    let [third, over] = [T::lit(2.0 / 3.0), T::ONE / (T::ONE + s)];
    let constant = T::lit(core::f64::consts::FRAC_PI_2 - 2.0 / 3.0) * mu * mu * over;
    let linear = mu.atan2(s) + s * mu - third * mu * (T::ONE + s + s * s) * over;
    (constant + s * linear) * T::FRAC_1_PI
}

/// Directional albedo of the lobe, fitted: no arc cosine, no root.
///
/// ```text
/// E(μ) ≈ A (1 + r Σ gₖ (1 − μ)ᵏ),   g₁…g₄ = 0.0571085289, 0.491881867, −0.332181442, 0.0714429953
/// ```
///
/// # Precision
/// Within 4.7e-4 of [`albedo`]; 1.000356 at μ = 0, r = 1.
///
/// # Source
/// Portsmouth, Kutz and Hill 2025 (see [`Eon`](crate::Eon)), listing 1.
#[inline]
pub fn albedo_fit<T: Real>(cos: T, roughness: Roughness<T>) -> T {
    T::ONE - roughness.value() * normal_albedo(roughness) * deficit_fit(cos)
}

/// `1/2 − 2/(3π) − Σ gₖ (1 − μ)ᵏ` of [`albedo_fit`]; negative for μ < 0.0015.
#[inline]
pub(super) fn deficit_fit<T: Real>(cos: T) -> T {
    let mu = cos.clamp_to(T::ZERO, T::ONE);
    let [c0, c1, c2, c3, c4] = FIT_DEFICIT.map(T::lit);
    c0 + mu * (c1 + mu * (c2 + mu * (c3 + mu * c4)))
}

/// Average albedo of the lobe under uniform illumination, exact.
///
/// ```text
/// 2 ∫₀¹ E(μ) μ dμ = A (1 + (2/3 − 28/(15π)) r)
/// ```
///
/// # Source
/// Portsmouth, Kutz and Hill 2025 (see [`Eon`](crate::Eon)), listing 1.
#[inline]
pub fn average_albedo<T: Real>(roughness: Roughness<T>) -> T {
    normal_albedo(roughness) * (T::ONE + T::lit(ON_AVERAGE) * roughness.value())
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::quadrature::gauss_legendre;

    fn rough(r: f64) -> Roughness<f64> {
        Roughness::new(r).unwrap()
    }

    #[test]
    fn the_published_form_is_the_stable_one_where_it_can_be_evaluated() {
        for mu in [0.01_f64, 0.1, 0.3, 0.7, 0.99] {
            let s = (1.0 - mu * mu).sqrt();
            let g = s * (Real::acos(mu) - s * mu) + 2.0 / 3.0 * (s / mu * (1.0 - s * s * s) - s);
            let r = rough(0.8);
            let published = normal_albedo(r) * (1.0 + 0.8 * g / f64::PI);
            // (1 − S³)/μ amplifies the rounding of S by 1/μ.
            assert!((albedo(mu, r) - published).abs() < 1e-15 / mu, "{mu}");
        }
    }

    #[test]
    fn the_deficit_vanishes_linearly_at_grazing_in_single_precision() {
        let r = Roughness::new(1.0_f32).unwrap();
        for k in 1..120 {
            let mu = Real::powi(0.5_f32, k);
            let want = albedo_deficit(f64::from(mu), rough(1.0));
            let error = (f64::from(albedo_deficit(mu, r)) / want - 1.0).abs();
            assert!(error < 8.0 * f64::from(f32::EPSILON), "{mu}: {error}");
        }
        // D/π → μ/π, with a correction of relative order μ.
        let slope = albedo_deficit(1e-9, rough(1.0)) / 1e-9 / normal_albedo(rough(1.0));
        assert!((slope - f64::FRAC_1_PI).abs() < 1e-8, "{slope}");
    }

    #[test]
    fn the_average_is_the_integral_of_the_albedo() {
        for r in [0.0, 0.3, 1.0].map(rough) {
            let integral: f64 = gauss_legendre::<f64, 64>()
                .iter()
                // μ = t², for the root in S at μ = 1 is of the other end: smooth enough for 1e-9.
                .map(|&(t, w)| w * 2.0 * t * 2.0 * t * t * albedo(t * t, r))
                .sum();
            assert!((integral - average_albedo(r)).abs() < 1e-7, "{r:?} {integral}");
            let deficit = r.value() * normal_albedo(r) * AVERAGE_DEFICIT;
            assert!((1.0 - average_albedo(r) - deficit).abs() < 1e-15);
        }
    }

    #[test]
    fn the_fit_is_within_its_error_of_the_albedo() {
        let worst = (0..=1000)
            .map(|i| f64::from(i) / 1000.0)
            .map(|mu| (albedo_fit(mu, rough(1.0)) - albedo(mu, rough(1.0))).abs())
            .fold(0.0, f64::max);
        assert!(worst < 4.8e-4 && worst > 3e-4, "{worst}");
        assert!((albedo_fit(0.0, rough(1.0)) - 1.000_356).abs() < 1e-6);
    }

    #[test]
    fn cosines_outside_the_domain_are_those_of_its_ends() {
        let r = rough(0.5);
        assert_eq!(albedo(f64::NAN, r), 1.0);
        assert_eq!(albedo(-0.3, r), 1.0);
        assert_eq!(albedo(1.5, r), normal_albedo(r));
    }
}
