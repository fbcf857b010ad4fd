//! Microfacet distributions with Smith masking.
//!
//! One quantity carries all of Smith's model here: the projected area `σ(w) = cos θ (1 + Λ(w))` of
//! the facets seen from `w`. With it nothing divides by a vanishing cosine:
//!
//! ```text
//! G1(w) = cos θ / σ(w)
//! D_v(h) = D(h) (wo·h) / σ(wo)                                   density of visible normals
//! V = G2 / (4 cos θi cos θo) = 1 / (4 σi σo)                                      separable
//!                            = 1 / (4 (cos θi σo + cos θo σi − cos θi cos θo))    height-correlated
//! ```
//!
//! | question | exact | cheaper | reference |
//! | --- | --- | --- | --- |
//! | visibility of GGX | [`Microfacets::visibility`] | [`ggx::visibility_hammon`], up to 29 % dark; [`ggx::visibility_schlick`] | |
//! | Smith's Λ of Beckmann | [`beckmann::lambda`] | [`beckmann::projected_area_walter`], 0.35 % | |
//! | energy that single scattering loses | [`facet_loss`] | [`FacetLoss`], 1e-3 (GGX) | [`walk`] |
//! | the same between two dielectrics | [`InterfaceAlbedo`] | [`InterfaceLoss`], interpolated | [`walk`] |
//!
//! How normals are drawn is a choice of its own: [`NormalSampling`].

mod albedo;
pub mod beckmann;
pub mod ggx;
pub mod sampling;
mod smith;
pub mod walk;

pub(crate) use albedo::{CosineRow, Place, isotropic_width};
pub use albedo::{
    DielectricTable, FacetLoss, InterfaceAlbedo, InterfaceFlux, InterfaceLoss, LossTable,
    facet_loss,
};
pub use sampling::{AllNormals, BoundedCaps, NormalSampling, ProjectedDisk, VisibleNormals};
pub use smith::{Masking, Microfacets};

/// Distribution of facet normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distribution {
    /// Trowbridge–Reitz: long tails.
    Ggx,
    /// Gaussian slopes.
    Beckmann {
        /// Which form of Smith's function shadows and masks.
        lambda: BeckmannLambda,
    },
}

/// Form of Smith's Λ for Beckmann facets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BeckmannLambda {
    /// With the error function.
    #[default]
    Exact,
    /// Walter's rational fit, up to 0.35 % off: for pictures that must agree with renderers using it.
    /// Sampling densities keep the exact form, which is what the sampler follows.
    Walter,
}
