//! How much light a rough dielectric interface lets through, tabulated over the angle.

use etendue_math::Real;
use etendue_math::quadrature::gauss_legendre;

use crate::microfacet::InterfaceAlbedo;
use crate::{Alpha, Distribution, InternalReflectance, Ior, Masking, Microfacets};

/// Nodes of the table, evenly spaced in `cos θ` from 0 to 1.
const ENTRIES: usize = 64;
/// Nodes of the average over the hemisphere, on either side of the critical angle.
const NODES: usize = 32;

/// Directional transmittance of a rough dielectric interface and its average internal reflectance.
///
/// ```text
/// T(μ)  of light from above,  F_in = 2 ∫₀¹ R(μ) μ dμ of light from the side of the base
/// ```
///
/// with R and T of [`InterfaceAlbedo`]. T is tabulated at 64 cosines and interpolated linearly. Computed once
/// per material; a [`RoughPlastic`](crate::RoughPlastic) borrows it.
///
/// # Precision
/// For α ≥ 0.1 entries within 1e-5 where the base is the denser medium, and F_in within 5e-4. The table is
/// computed in `f64` and rounded once, in either precision.
///
/// # Cost
/// 128 directions of 512 facets: 4 to 8 ms for GGX and 25 ms for Beckmann facets on a desktop processor. One without
/// floating point computes some 10⁷ double operations in software, estimated at a minute on a Cortex-M0 at 48 MHz.
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
        let albedo = InterfaceAlbedo::new(&facets.in_double());
        let index = eta.value().to_f64();
        // Quadrature rounds: an interface that transmits all would seem to transmit more.
        let share = |x: f64| T::lit(Real::clamp_to(x, 0.0, 1.0));
        let transmittance = core::array::from_fn(|i| share(albedo.at(index, node(i)).transmitted));
        let reflectance = |mu: f64| albedo.at(1.0 / index, mu).reflected;
        let internal = match internal {
            InternalReflectance::Exact => {
                // F has a root's kink at the critical cosine: μ = m t below it, m + (1 − m) t² above.
                let m = (1.0 - 1.0 / (index * index)).safe_sqrt();
                gauss_legendre::<f64, NODES>()
                    .iter()
                    .map(|&(t, w)| {
                        let (below, above) = (m * t, m + (1.0 - m) * t * t);
                        let slope = 2.0 * (1.0 - m) * t;
                        2.0 * w
                            * (m * below * reflectance(below) + slope * above * reflectance(above))
                    })
                    .sum()
            }
            InternalReflectance::Mitsuba => {
                let sum: f64 = (0..ENTRIES).map(|i| node(i) * reflectance(node(i))).sum();
                2.0 * sum / ENTRIES as f64
            }
        };
        Self { eta: eta.value(), facets, transmittance, internal: share(internal) }
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

    /// T at `cos θ`, interpolated, in `[0, 1]`; the cosine is limited to `[0, 1]`.
    #[inline]
    pub fn transmittance(&self, cos: T) -> T {
        let x = cos.clamp_to(T::ZERO, T::ONE) * T::lit((ENTRIES - 1) as f64);
        let i = (x.to_f64() as usize).min(ENTRIES - 2);
        let t = x - T::lit(i as f64);
        self.transmittance[i] * (T::ONE - t) + self.transmittance[i + 1] * t
    }
}

/// Cosine of entry `i`; the first is kept off the horizon, where no facet is visible.
fn node(i: usize) -> f64 {
    (i as f64 / (ENTRIES - 1) as f64).max(1e-6)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BeckmannLambda;
    use crate::fresnel::dielectric_transmittance;

    fn table(alpha: f64, internal: InternalReflectance) -> TransmittanceTable<f64> {
        let (eta, alpha) = (Ior::new(1.5).unwrap(), Alpha::new(alpha).unwrap());
        TransmittanceTable::new(eta, Distribution::Ggx, alpha, Masking::Separable, internal)
    }

    #[test]
    fn a_nearly_smooth_interface_transmits_what_a_smooth_one_does() {
        let table = table(1e-4, InternalReflectance::Exact);
        for i in 8..ENTRIES {
            let cos = node(i);
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

    #[test]
    fn no_more_is_transmitted_than_arrives_where_indices_nearly_match() {
        const EXACT: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Exact };
        let internal = InternalReflectance::Exact;
        for exponent in [0, 10, 30, 45, 52] {
            let eta = Ior::new(1.0 + Real::powi(0.5_f64, exponent)).unwrap();
            for alpha in [1e-6, 0.01, 0.3, 1.0, 30.0] {
                let (alpha, masking) = (Alpha::new(alpha).unwrap(), Masking::HeightCorrelated);
                for distribution in [Distribution::Ggx, EXACT] {
                    let table =
                        TransmittanceTable::new(eta, distribution, alpha, masking, internal);
                    let within = |x: &f64| (0.0..=1.0).contains(x);
                    assert!(table.transmittance.iter().all(within), "{table:?}");
                    assert!(within(&table.internal), "{table:?}");
                }
            }
        }
    }
}
