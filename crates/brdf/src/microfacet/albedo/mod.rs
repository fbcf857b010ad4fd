//! Directional albedo of rough surfaces, tabulated: what compensation of energy starts from.

mod cosine_row;
mod dielectric_table;
mod integral;
mod interface;
mod interface_loss;
mod table;

pub(crate) use cosine_row::{CosineRow, Place};
pub use dielectric_table::DielectricTable;
pub use integral::facet_loss;
pub use interface::{InterfaceAlbedo, InterfaceFlux};
pub use interface_loss::InterfaceLoss;
pub use table::LossTable;

use etendue_math::Real;

use super::{BeckmannLambda, Distribution, Masking, Microfacets};
use crate::ParameterError;

/// `1 − E(μ)`, what single scattering loses, of one rough surface; F = 1.
///
/// Looked up in a [`LossTable`], its row interpolated for the width once, at construction.
///
/// # Precision
/// Within 1e-3 of [`facet_loss`] for GGX and 4e-3 for Beckmann, for all angles and α in `[1e-8, 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacetLoss<T> {
    row: [T; LossTable::ENTRIES],
    alpha: T,
    average: T,
}

impl<T: Real> FacetLoss<T> {
    /// The loss of the surface `facets`.
    ///
    /// # Errors
    /// [`ParameterError`] where there is no table: anisotropic facets, α > 1, Beckmann facets with
    /// separable masking or Walter's fit.
    pub fn new(facets: &Microfacets<T>) -> Result<Self, ParameterError> {
        let table = match (facets.distribution(), facets.masking()) {
            (Distribution::Ggx, Masking::HeightCorrelated) => &LossTable::GGX,
            (Distribution::Ggx, Masking::Separable) => &LossTable::GGX_SEPARABLE,
            (
                Distribution::Beckmann { lambda: BeckmannLambda::Exact },
                Masking::HeightCorrelated,
            ) => &LossTable::BECKMANN,
            (Distribution::Beckmann { lambda: BeckmannLambda::Walter }, _) => {
                let domain = "ggx or beckmann, for which there are tables";
                return Err(ParameterError::choice("distribution", "beckmann-walter", domain));
            }
            (Distribution::Beckmann { .. }, Masking::Separable) => {
                let domain = "height-correlated for Beckmann facets";
                return Err(ParameterError::choice("masking", "separable", domain));
            }
        };
        let alpha = isotropic_width(facets)?;
        Ok(Self { row: table.row(alpha), alpha, average: table.average(alpha) })
    }

    /// `1 − E(μ)`; the cosine is limited to `[0, 1]`.
    #[inline]
    pub fn at(&self, cos: T) -> T {
        LossTable::look_up(&self.row, cos.clamp_to(T::ZERO, T::ONE), self.alpha)
    }

    /// `1 − E_avg = 2 ∫₀¹ (1 − E(μ)) μ dμ` of the interpolated loss.
    #[inline(always)]
    pub fn average(&self) -> T {
        self.average
    }
}

/// The one width, at most 1, of facets that tables over the angle alone can describe.
pub(crate) fn isotropic_width<T: Real>(facets: &Microfacets<T>) -> Result<T, ParameterError> {
    let [alpha, other] = facets.widths();
    if alpha != other || alpha > T::ONE {
        let domain = "the same along both tangents and at most 1";
        return Err(ParameterError::number("alpha", other, domain));
    }
    Ok(alpha)
}
