//! A dielectric interface: facets, or a mirror.

use etendue_math::Real;

use crate::fresnel::RelativeIndex;
use crate::microfacet::{CosineRow, DielectricTable};
use crate::rough::smooth_or_rough::rough_widths;
use crate::{Distribution, Masking, Microfacets, ParameterError};

/// The facets of a roughness and an anisotropy in `[0, 1]`; `None` for a mirror.
///
/// ```text
/// αt = r² √(2 / (1 + (1 − a)²)),  αb = (1 − a) αt
/// ```
///
/// GGX with height-correlated masking. A mirror is what both widths below 1e-8 make, as for
/// [`Conductor`](crate::Conductor).
///
/// # Source
/// OpenPBR 1.1, "Microfacet model".
pub(super) fn facets<T: Real>(
    roughness: T,
    anisotropy: T,
) -> Result<Option<Microfacets<T>>, ParameterError> {
    let narrowing = T::ONE - anisotropy;
    let along = roughness * roughness * (T::TWO / (T::ONE + narrowing * narrowing)).sqrt();
    let widths = rough_widths([along, narrowing * along])?;
    Ok(widths.map(|[x, y]| Microfacets::new(Distribution::Ggx, x, y, Masking::HeightCorrelated)))
}

/// The interface to a medium of an index η ≥ 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interface<T> {
    index: RelativeIndex<T>,
    /// `ε = (η − 1)/(η + 1)`, the root of the reflectance at normal incidence.
    amplitude: T,
}

impl<T: Real> Interface<T> {
    /// Given by `η − 1`, which keeps the digits of an index near 1.
    pub(super) fn of_excess(excess: T) -> Self {
        let amplitude = excess / (T::TWO + excess);
        Self { index: RelativeIndex::from_excess(excess), amplitude }
    }

    /// The same with its reflectance at normal incidence scaled by `weight`, but no higher than that of η = 1e4.
    ///
    /// ```text
    /// ε' = √weight ε,  η' = (1 + ε')/(1 − ε')
    /// ```
    ///
    /// # Source
    /// OpenPBR 1.1, "Dielectric base".
    pub(super) fn weighted(self, weight: T) -> Self {
        let amplitude = (weight.sqrt() * self.amplitude).min(T::lit(9999.0 / 10_001.0));
        Self::of_excess(T::TWO * amplitude / (T::ONE - amplitude))
    }

    /// Nothing is reflected.
    #[inline]
    pub(super) fn is_matched(&self) -> bool {
        self.index.is_matched()
    }

    /// Reflectance at normal incidence.
    #[inline]
    pub(super) fn normal_reflectance(&self) -> T {
        self.amplitude * self.amplitude
    }

    /// F at a cosine in `[0, 1]`.
    #[inline]
    pub(super) fn reflectance(&self, cos: T) -> T {
        self.index.reflectance(cos)
    }

    /// Cosine of the refracted direction.
    #[inline]
    pub(super) fn cos_inside(&self, cos: T) -> T {
        self.index.scaled_cos_t(cos).map_or(T::ZERO, |g| g / self.index.eta())
    }

    /// `1 − E(μ)`: of a mirror exact at the nodes, of facets by the table for `α = r²`, their mean width.
    pub(super) fn passed(&self, roughness: T, is_mirror: bool) -> CosineRow<T> {
        if is_mirror {
            CosineRow::of(|mu| self.index.transmittance(mu))
        } else {
            DielectricTable::ggx().row(self.amplitude, roughness * roughness)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weight_scales_the_reflectance_at_normal_incidence() {
        let glass = Interface::<f64>::of_excess(0.5);
        for weight in [0.0, 1e-9, 0.5, 1.0, 20.0] {
            let weighted = glass.weighted(weight);
            // A dozen roundings.
            let (got, want) = (weighted.reflectance(1.0), 0.04 * weight);
            assert!((got - want).abs() <= 1e-14 * want, "{weight} {got}");
            assert_eq!(weighted.is_matched(), weight == 0.0);
        }
        assert!(glass.weighted(1e4).reflectance(1.0) < 1.0);
    }

    #[test]
    fn anisotropy_keeps_the_mean_square_of_the_widths() {
        for anisotropy in [0.0, 0.3, 1.0] {
            let [x, y] = facets(0.6_f64, anisotropy).unwrap().unwrap().widths();
            assert!((x * x + y * y - 2.0 * Real::powi(0.6, 4)).abs() < 1e-15, "{anisotropy}");
        }
        assert!(facets(0.0_f32, 0.5).unwrap().is_none());
    }
}
