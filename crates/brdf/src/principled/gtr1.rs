//! Berry's distribution of facet normals: GTR with exponent 1.

use etendue_math::{Real, Vec3, Vector3};
use etendue_sampling::warp::turn;

/// Generalised Trowbridge–Reitz facets with exponent γ = 1, whose tails are longer than GGX's.
///
/// ```text
/// D(h) = (1 − α²) / (−π ln α² (hx² + hy² + α² hz²))
/// ```
///
/// Both the sine and the cosine of a sampled normal come from `expm1`:
///
/// ```text
/// sin² θ = α² expm1(−u ln α²) / (1 − α²),  cos² θ = −expm1((1 − u) ln α²) / (1 − α²)
/// ```
///
/// because `1 − cos²` has no digits left near the normal, where the lobe is.
///
/// # Source
/// B. Burley, "Physically Based Shading at Disney", SIGGRAPH 2012 course notes, eqs. 4 and 5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Gtr1<T> {
    alpha2: T,
    ln_alpha2: T,
}

impl<T: Real> Gtr1<T> {
    /// α in `(0, 1)`.
    pub(super) fn new(alpha: T) -> Self {
        let alpha2 = alpha * alpha;
        Self { alpha2, ln_alpha2: alpha2.ln() }
    }

    /// D(h), `h` above the surface.
    #[inline]
    pub(super) fn ndf(&self, h: Vec3<T>) -> T {
        let spread = h.x() * h.x() + h.y() * h.y() + self.alpha2 * h.z() * h.z();
        (T::ONE - self.alpha2) * T::FRAC_1_PI / (-self.ln_alpha2 * spread)
    }

    /// A normal with density `D(h) h.z`.
    #[inline]
    pub(super) fn sample(&self, u: [T; 2]) -> Vec3<T> {
        let (sin_phi, cos_phi) = turn::sin_cos(u[0]);
        let rest = T::ONE - self.alpha2;
        let sin = (self.alpha2 * (-u[1] * self.ln_alpha2).exp_m1() / rest).safe_sqrt();
        let cos = (-((T::ONE - u[1]) * self.ln_alpha2).exp_m1() / rest).safe_sqrt();
        Vec3::<T>::new(sin * cos_phi, sin * sin_phi, cos)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::glam::DVec3;
    use etendue_math::quadrature::gauss_legendre;

    #[test]
    fn facets_cover_the_mean_surface() {
        for alpha in [0.1, 0.01, 0.001] {
            let facets = Gtr1::<f64>::new(alpha);
            // ∫ D cos dω = 2π ∫ D t dt with t = sin θ = α^(1 − x) stretched over [α/100, 1].
            let (low, mut sum) = (Real::ln(alpha / 100.0), 0.0);
            for (x, w) in gauss_legendre::<f64, 64>() {
                let t = Real::exp(low * (1.0 - x));
                let h = DVec3::new(t, 0.0, ((1.0 - t) * (1.0 + t)).sqrt());
                sum += w * -low * t * t * facets.ndf(h) * 2.0 * f64::PI;
            }
            // Below α/100 lies less than 1e-4/(−2 ln α) of it.
            assert!((sum - 1.0).abs() < 3e-5, "{alpha} {sum}");
        }
    }

    #[test]
    fn sampling_inverts_the_distribution() {
        let facets = Gtr1::<f64>::new(0.01);
        for u in [0.0, 1e-9, 0.25, 0.5, 0.999, 1.0 - 1e-9] {
            let h = facets.sample([0.3, u]);
            // P(sin² < s) = ln(1 + s (1 − α²)/α²) / −ln α²
            let s = h.x * h.x + h.y * h.y;
            let got = Real::ln_1p(s * (1.0 - 1e-4) / 1e-4) / -Real::ln(1e-4);
            // Some roundings, divided by the logarithm.
            assert!((got - u).abs() < 1e-14 && (h.length() - 1.0).abs() < 1e-14, "{u} {got}");
        }
    }
}
