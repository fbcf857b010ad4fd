//! Directional albedos by numerical integration.

use etendue_math::quadrature::gauss_legendre;
use etendue_math::{Real, Spectrum, Vec3, Vector3};

use crate::{Bsdf, BsdfReal, BsdfVec};

mod adaptive_albedo;

pub use adaptive_albedo::{SideAlbedos, adaptive_albedo};

/// Directional albedo of the continuous part of a model.
///
/// ```text
/// R(wo) = ∫ f(wo, wi) |cos θi| dωi ≈ Σ f |cos θ| over both hemispheres
/// ```
///
/// with `N` Gauss–Legendre nodes in t, `cos θ = t (2 − t)`, and `2 N` evenly spaced azimuths.
///
/// # Precision
/// 1e-5 with N = 64 for lobes wider than about 0.3; narrow lobes need N ≫ 1/α, or [`adaptive_albedo`]. Delta
/// lobes are not seen. `4 N²` evaluations: for tests and audits.
///
/// # Examples
/// ```
/// use etendue_brdf::{Lambert, Reflectance, quadrature::directional_albedo};
/// use etendue_math::glam::DVec3;
/// let r = directional_albedo::<_, 16>(&Lambert::new(Reflectance::<f64>::white()), DVec3::Z);
/// assert!((r - 1.0).abs() < 1e-14);
/// ```
pub fn directional_albedo<B: Bsdf, const N: usize>(model: &B, wo: BsdfVec<B>) -> B::Color {
    let mut sum = B::Color::black();
    over_sphere::<BsdfReal<B>, N>(|wi, weight| {
        sum += model.eval(wo, wi).scale(wi.z().abs() * weight);
    });
    sum
}

/// The share of directions `sample` finds in the continuous part: `∫ pdf(wo, wi) dωi`, at most 1.
///
/// Nodes and precision as for [`directional_albedo`].
pub fn density_integral<B: Bsdf, const N: usize>(model: &B, wo: BsdfVec<B>) -> BsdfReal<B> {
    let mut sum = BsdfReal::<B>::ZERO;
    over_sphere::<BsdfReal<B>, N>(|wi, weight| sum += model.pdf(wo, wi) * weight);
    sum
}

/// Visits nodes on the sphere with their solid-angle weights.
fn over_sphere<T: Real, const N: usize>(mut visit: impl FnMut(Vec3<T>, T)) {
    let step = T::PI / T::lit(N as f64);
    for (t, w) in gauss_legendre::<T, N>() {
        // cos θ = t (2 − t), d cos θ = 2 (1 − t) dt: smooth in θ at the normal, where lobes are narrow.
        let z = t * (T::TWO - t);
        let weight = w * T::TWO * (T::ONE - t) * step;
        let sin = ((T::ONE - z) * (T::ONE + z)).safe_sqrt();
        for i in 0..2 * N {
            let (sin_phi, cos_phi) = (step * (T::lit(i as f64) + T::HALF)).sin_cos();
            for z in [z, -z] {
                visit(Vec3::<T>::new(sin * cos_phi, sin * sin_phi, z), weight);
            }
        }
    }
}
