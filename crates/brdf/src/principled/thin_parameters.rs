//! What an artist says about a thin principled material.

use etendue_math::{Real, Spectrum};

use super::domains::{self, clamped_unit};
use crate::param::{clamped, within};
use crate::{ParameterError, Reflectance};

/// Parameters of [`PrincipledThin`](crate::PrincipledThin), with the names and defaults of Mitsuba 3.
///
/// All lie in `[0, 1]` except `eta` (`[1e-4, 1e4]`), `diff_trans` (`[0, 2]`) and the sampling rates (`[0, 1e6]`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipledThinParameters<C: Spectrum> {
    /// Colour of everything but untinted reflection. Default 0.5.
    pub base_color: C,
    /// Root of the facets' width. Default 0.5.
    pub roughness: C::Real,
    /// 0: isotropic; 1: ten times as wide along x as along y.
    pub anisotropic: C::Real,
    /// Share of the specular lobes; the rest is diffuse.
    pub spec_trans: C::Real,
    /// Index of the sheet. Default 1.5.
    pub eta: C::Real,
    /// Share of the specular reflection that is tinted with the base colour.
    pub spec_tint: C::Real,
    /// Weight of the sheen.
    pub sheen: C::Real,
    /// Share of the sheen that is tinted with the base colour.
    pub sheen_tint: C::Real,
    /// Share of flat subsurface scattering in the diffuse lobe.
    pub flatness: C::Real,
    /// Twice the share of diffuse light that is transmitted.
    pub diff_trans: C::Real,
    /// Rate at which specular reflection is sampled. Default 1.
    pub specular_reflectance_sampling_rate: C::Real,
    /// Rate of specular transmission. Default 1.
    pub specular_transmittance_sampling_rate: C::Real,
    /// Rate of diffuse reflection. Default 1.
    pub diffuse_reflectance_sampling_rate: C::Real,
    /// Rate of diffuse transmission. Default 1.
    pub diffuse_transmittance_sampling_rate: C::Real,
}

impl<C: Spectrum> Default for PrincipledThinParameters<C> {
    fn default() -> Self {
        let (zero, one, half) = (<C::Real as Real>::ZERO, <C::Real as Real>::ONE, C::Real::HALF);
        Self {
            base_color: C::splat(half),
            roughness: half,
            anisotropic: zero,
            spec_trans: zero,
            eta: C::Real::lit(1.5),
            spec_tint: zero,
            sheen: zero,
            sheen_tint: zero,
            flatness: zero,
            diff_trans: zero,
            specular_reflectance_sampling_rate: one,
            specular_transmittance_sampling_rate: one,
            diffuse_reflectance_sampling_rate: one,
            diffuse_transmittance_sampling_rate: one,
        }
    }
}

impl<C: Spectrum> PrincipledThinParameters<C> {
    /// Every parameter moved into its domain, NaN to its lower end: for values read from textures.
    pub(super) fn clamped(self) -> Self {
        let rate = domains::clamped_rate;
        Self {
            base_color: Reflectance::clamped(self.base_color).value(),
            roughness: clamped_unit(self.roughness),
            anisotropic: clamped_unit(self.anisotropic),
            spec_trans: clamped_unit(self.spec_trans),
            eta: domains::clamped_eta(self.eta),
            spec_tint: clamped_unit(self.spec_tint),
            sheen: clamped_unit(self.sheen),
            sheen_tint: clamped_unit(self.sheen_tint),
            flatness: clamped_unit(self.flatness),
            diff_trans: clamped(self.diff_trans, [0.0, 2.0]),
            specular_reflectance_sampling_rate: rate(self.specular_reflectance_sampling_rate),
            specular_transmittance_sampling_rate: rate(self.specular_transmittance_sampling_rate),
            diffuse_reflectance_sampling_rate: rate(self.diffuse_reflectance_sampling_rate),
            diffuse_transmittance_sampling_rate: rate(self.diffuse_transmittance_sampling_rate),
        }
    }

    /// Checks every domain.
    pub(super) fn check(&self) -> Result<(), ParameterError> {
        let shares = [
            ("roughness", self.roughness),
            ("anisotropic", self.anisotropic),
            ("spec_trans", self.spec_trans),
            ("spec_tint", self.spec_tint),
            ("sheen", self.sheen),
            ("sheen_tint", self.sheen_tint),
            ("flatness", self.flatness),
        ];
        let rates = [
            ("specular_reflectance_sampling_rate", self.specular_reflectance_sampling_rate),
            ("specular_transmittance_sampling_rate", self.specular_transmittance_sampling_rate),
            ("diffuse_reflectance_sampling_rate", self.diffuse_reflectance_sampling_rate),
            ("diffuse_transmittance_sampling_rate", self.diffuse_transmittance_sampling_rate),
        ];
        domains::check(self.base_color, self.eta, &shares, &rates)?;
        within("diff_trans", self.diff_trans, [0.0, 2.0], "in [0, 2]").map(|_| ())
    }
}
