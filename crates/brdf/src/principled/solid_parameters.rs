//! What an artist says about a principled material.

use etendue_math::{Real, Spectrum};

use super::domains::{self, clamped_unit, unit};
use crate::{ParameterError, Reflectance};

/// Parameters of [`Principled`](crate::Principled), with the names and defaults of Mitsuba 3.
///
/// All lie in `[0, 1]` except `eta` (`[1e-4, 1e4]`) and the sampling rates (`[0, 1e6]`).
///
/// # Examples
/// ```
/// use etendue_brdf::{Principled, PrincipledParameters};
/// let copper = PrincipledParameters { base_color: 0.8_f32, metallic: 1.0, ..Default::default() };
/// assert!(Principled::new(copper).is_ok());
/// assert!(Principled::new(PrincipledParameters { metallic: 1.5, ..copper }).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipledParameters<C: Spectrum> {
    /// Colour of the diffuse lobe and of metal; its square root tints transmission. Default 0.5.
    pub base_color: C,
    /// Root of the facets' width. Default 0.5.
    pub roughness: C::Real,
    /// 0: isotropic; 1: ten times as wide along x as along y.
    pub anisotropic: C::Real,
    /// 0: dielectric; 1: metal.
    pub metallic: C::Real,
    /// Share of specular transmission in the dielectric; the rest is diffuse.
    pub spec_trans: C::Real,
    /// Relative index of refraction, below over above. Default that of `specular` 0.5.
    pub eta: C::Real,
    /// Share of the dielectric reflection that is tinted with the base colour.
    pub spec_tint: C::Real,
    /// Weight of the sheen.
    pub sheen: C::Real,
    /// Share of the sheen that is tinted with the base colour.
    pub sheen_tint: C::Real,
    /// Share of flat subsurface scattering in the diffuse lobe.
    pub flatness: C::Real,
    /// Weight of the clear coat.
    pub clearcoat: C::Real,
    /// 0: satin; 1: gloss.
    pub clearcoat_gloss: C::Real,
    /// Rate at which the diffuse lobe is sampled, relative to the other two. Default 1.
    pub diffuse_reflectance_sampling_rate: C::Real,
    /// Rate of the main specular lobe. Default 1.
    pub main_specular_sampling_rate: C::Real,
    /// Rate of the clear coat. Default 1.
    pub clearcoat_sampling_rate: C::Real,
}

impl<C: Spectrum> Default for PrincipledParameters<C> {
    fn default() -> Self {
        let (zero, one, half) = (<C::Real as Real>::ZERO, <C::Real as Real>::ONE, C::Real::HALF);
        Self {
            base_color: C::splat(half),
            roughness: half,
            anisotropic: zero,
            metallic: zero,
            spec_trans: zero,
            eta: eta_of_specular(half),
            spec_tint: zero,
            sheen: zero,
            sheen_tint: zero,
            flatness: zero,
            clearcoat: zero,
            clearcoat_gloss: zero,
            diffuse_reflectance_sampling_rate: one,
            main_specular_sampling_rate: one,
            clearcoat_sampling_rate: one,
        }
    }
}

impl<C: Spectrum> PrincipledParameters<C> {
    /// The same with `eta` from Disney's parameter `specular` in `[0, 1]`, of which 8 % is the
    /// reflectance at normal incidence.
    ///
    /// ```text
    /// η = 2 / (1 − √(0.08 specular)) − 1
    /// ```
    ///
    /// 0 gives η = 1, no reflection.
    ///
    /// # Errors
    /// [`ParameterError`] outside `[0, 1]`.
    pub fn with_specular(self, specular: C::Real) -> Result<Self, ParameterError> {
        unit("specular", specular)?;
        Ok(Self { eta: eta_of_specular(specular), ..self })
    }

    /// Every parameter moved into its domain, NaN to its lower end: for values read from textures.
    pub(super) fn clamped(self) -> Self {
        let rate = domains::clamped_rate;
        Self {
            base_color: Reflectance::clamped(self.base_color).value(),
            roughness: clamped_unit(self.roughness),
            anisotropic: clamped_unit(self.anisotropic),
            metallic: clamped_unit(self.metallic),
            spec_trans: clamped_unit(self.spec_trans),
            eta: domains::clamped_eta(self.eta),
            spec_tint: clamped_unit(self.spec_tint),
            sheen: clamped_unit(self.sheen),
            sheen_tint: clamped_unit(self.sheen_tint),
            flatness: clamped_unit(self.flatness),
            clearcoat: clamped_unit(self.clearcoat),
            clearcoat_gloss: clamped_unit(self.clearcoat_gloss),
            diffuse_reflectance_sampling_rate: rate(self.diffuse_reflectance_sampling_rate),
            main_specular_sampling_rate: rate(self.main_specular_sampling_rate),
            clearcoat_sampling_rate: rate(self.clearcoat_sampling_rate),
        }
    }

    /// Checks every domain.
    pub(super) fn check(&self) -> Result<(), ParameterError> {
        let shares = [
            ("roughness", self.roughness),
            ("anisotropic", self.anisotropic),
            ("metallic", self.metallic),
            ("spec_trans", self.spec_trans),
            ("spec_tint", self.spec_tint),
            ("sheen", self.sheen),
            ("sheen_tint", self.sheen_tint),
            ("flatness", self.flatness),
            ("clearcoat", self.clearcoat),
            ("clearcoat_gloss", self.clearcoat_gloss),
        ];
        let rates = [
            ("diffuse_reflectance_sampling_rate", self.diffuse_reflectance_sampling_rate),
            ("main_specular_sampling_rate", self.main_specular_sampling_rate),
            ("clearcoat_sampling_rate", self.clearcoat_sampling_rate),
        ];
        domains::check(self.base_color, self.eta, &shares, &rates)
    }
}

fn eta_of_specular<T: Real>(specular: T) -> T {
    T::TWO / (T::ONE - (T::lit(0.08) * specular).sqrt()) - T::ONE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn specular_is_a_reflectance_of_eight_percent() {
        let of = |s| PrincipledParameters::<f64>::default().with_specular(s).map(|p| p.eta);
        // F0 = 0.08 specular, undone by the index; a few roundings of 2.
        for s in [0.1, 0.5, 1.0] {
            let f0 = crate::fresnel::f0_from_ior(of(s).unwrap());
            assert!((f0 - 0.08 * s).abs() < 1e-15, "{s} {f0}");
        }
        assert!(of(0.0) == Ok(1.0) && of(-0.1).is_err() && of(f64::NAN).is_err());
    }
}
