//! How much light a rough dielectric interface lets through, tabulated over the angle.

use etendue_math::quadrature::gauss_legendre;
use etendue_math::{Real, Vec3, Vector3};

use crate::direction::reflect_about;
use crate::fresnel::{dielectric, dielectric_transmittance, refract_about};
use crate::{Alpha, Distribution, InternalReflectance, Ior, Masking, Microfacets};

/// Nodes of the table, evenly spaced in `cos θ` from 0 to 1.
const ENTRIES: usize = 64;
/// Nodes per dimension of the quadrature over visible normals.
const NODES: usize = 32;

/// Directional transmittance of a rough dielectric interface and its average internal reflectance.
///
/// ```text
/// T(wo)  = ∫ D_v(h) (1 − F(wo·h)) G2(wo, wt)/G1(wo) dh,  wt refracted at h, below the surface
/// R(wo)  = ∫ D_v(h) F(wo·h) G2(wo, wr)/G1(wo) dh,        wr reflected at h, above the surface
/// F_in   = 2 ∫₀¹ R(μ) μ dμ from the side of the base
/// ```
///
/// T is tabulated at 64 cosines and interpolated linearly. Computed once per material (some 10⁵
/// facet evaluations, tens of milliseconds); a [`RoughPlastic`](crate::RoughPlastic) borrows it.
///
/// # Precision
/// Entries within 1e-4 for α ≥ 0.1: 32 × 32 Gauss–Legendre nodes over the uniforms of the visible normals.
///
/// # Source
/// Mitsuba's roughplastic (W. Jakob), `eval_transmittance` and `eval_reflectance`.
#[derive(Clone, Debug, PartialEq)]
pub struct TransmittanceTable<T> {
    eta: T,
    facets: Microfacets<T>,
    transmittance: [T; ENTRIES],
    internal: T,
}

impl<T: Real> TransmittanceTable<T> {
    /// Tabulates the interface to a base with relative index `eta` and isotropic width `alpha`.
    pub fn new(
        eta: Ior<T>,
        distribution: Distribution,
        alpha: Alpha<T>,
        masking: Masking,
        internal: InternalReflectance,
    ) -> Self {
        let facets = Microfacets::new(distribution, alpha, alpha, masking);
        let eta = eta.value();
        let rule = gauss_legendre::<T, NODES>();
        let mut transmittance = [T::ZERO; ENTRIES];
        for (i, entry) in transmittance.iter_mut().enumerate() {
            *entry = mean_over_facets(&facets, &rule, direction(node::<T>(i)), |wo: Vec3<T>, h| {
                let wt = refract_about(wo, h, eta).filter(|w| w.z() < T::ZERO)?;
                Some(dielectric_transmittance(wo.dot(h), eta) * facets.weight(wo, wt))
            });
        }
        let inverse = T::ONE / eta;
        let reflectance = |mu: T| {
            mean_over_facets(&facets, &rule, direction(mu), |wo: Vec3<T>, h| {
                let wr = reflect_about(wo, h);
                (wr.z() > T::ZERO).then(|| dielectric(wo.dot(h), inverse) * facets.weight(wo, wr))
            })
        };
        let internal = match internal {
            InternalReflectance::Exact => {
                // F has a root's kink at the critical cosine: μ = m t below it, m + (1 − m) t² above.
                let m = (T::ONE - inverse * inverse).safe_sqrt();
                rule.iter()
                    .map(|&(t, w)| {
                        let (below, above) = (m * t, m + (T::ONE - m) * t * t);
                        let slope = T::TWO * (T::ONE - m) * t;
                        w * T::TWO
                            * (m * below * reflectance(below) + slope * above * reflectance(above))
                    })
                    .sum()
            }
            InternalReflectance::Mitsuba => {
                let sum: T = (0..ENTRIES).map(|i| node::<T>(i) * reflectance(node(i))).sum();
                T::TWO * sum / T::lit(ENTRIES as f64)
            }
        };
        Self { eta, facets, transmittance, internal }
    }

    /// Relative index of the base.
    #[inline(always)]
    pub fn eta(&self) -> T {
        self.eta
    }

    /// The rough interface.
    #[inline(always)]
    pub fn facets(&self) -> &Microfacets<T> {
        &self.facets
    }

    /// Average internal reflectance F_in.
    #[inline(always)]
    pub fn internal_reflectance(&self) -> T {
        self.internal
    }

    /// T at `cos θ`, interpolated; the cosine is limited to `[0, 1]`.
    #[inline]
    pub fn transmittance(&self, cos: T) -> T {
        let x = cos.clamp_to(T::ZERO, T::ONE) * T::lit((ENTRIES - 1) as f64);
        let i = (x.to_f64() as usize).min(ENTRIES - 2);
        let t = x - T::lit(i as f64);
        self.transmittance[i] * (T::ONE - t) + self.transmittance[i + 1] * t
    }
}

/// Cosine of entry `i`; the first is kept off the horizon, where no facet is visible.
fn node<T: Real>(i: usize) -> T {
    T::lit((i as f64 / (ENTRIES - 1) as f64).max(1e-6))
}

fn direction<T: Real>(cos: T) -> Vec3<T> {
    Vec3::<T>::new(((T::ONE - cos) * (T::ONE + cos)).safe_sqrt(), T::ZERO, cos)
}

/// Mean of a function over the normals visible from `wo`; `None` counts as 0.
fn mean_over_facets<T: Real>(
    facets: &Microfacets<T>,
    rule: &[(T, T); NODES],
    wo: Vec3<T>,
    value: impl Fn(Vec3<T>, Vec3<T>) -> Option<T>,
) -> T {
    let mut sum = T::ZERO;
    for &(x, wx) in rule {
        for &(y, wy) in rule {
            let h = facets.sample_visible_normal(wo, [x, y]);
            sum += wx * wy * h.and_then(|h| value(wo, h)).unwrap_or(T::ZERO);
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(alpha: f64, internal: InternalReflectance) -> TransmittanceTable<f64> {
        let (eta, alpha) = (Ior::new(1.5).unwrap(), Alpha::new(alpha).unwrap());
        TransmittanceTable::new(eta, Distribution::Ggx, alpha, Masking::Separable, internal)
    }

    #[test]
    fn a_nearly_smooth_interface_transmits_what_a_smooth_one_does() {
        let table = table(1e-4, InternalReflectance::Exact);
        for i in 8..ENTRIES {
            let cos: f64 = node(i);
            // Within the lobe of width 1e-4 the Fresnel term is constant to 1e-3.
            assert!((table.transmittance(cos) - dielectric_transmittance(cos, 1.5)).abs() < 1e-3);
        }
        let smooth = crate::fresnel::dielectric_average(1.0 / 1.5);
        // The width of the lobe again, amplified by the slope at the critical angle.
        assert!((table.internal_reflectance() - smooth).abs() < 2e-3);
    }

    #[test]
    fn transmission_stays_below_what_reflection_leaves() {
        let table = table(0.3, InternalReflectance::Exact);
        // Golden sum R + T for α = 0.3, 1 → 1.5, at cos = 1, .7, .5, .3, .1, less a reflection of at least 0.03.
        for (cos, sum) in
            [(1.0, 0.9884), (0.7, 0.9708), (0.5, 0.9469), (0.3, 0.9081), (0.1, 0.8498)]
        {
            let t = table.transmittance(cos);
            assert!(t < sum - 0.03 && t > 0.4, "{cos} {t}");
        }
    }
}
