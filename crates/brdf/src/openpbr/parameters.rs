//! What an artist says about an OpenPBR surface.

use etendue_math::{Real, Spectrum};

use crate::param::within;
use crate::{ParameterError, Reflectance};

/// Parameters of [`OpenPbr`](crate::OpenPbr), with the names and defaults of OpenPBR 1.1.
///
/// All lie in `[0, 1]` except `specular_weight` (`[0, 1e4]`) and the two indices (`[1, 1e4]`).
///
/// # Examples
/// ```
/// use etendue_brdf::{OpenPbr, OpenPbrParameters};
/// let copper = OpenPbrParameters { base_color: 0.8_f32, base_metalness: 1.0, ..Default::default() };
/// assert!(OpenPbr::new(copper).is_ok());
/// assert!(OpenPbr::new(OpenPbrParameters { base_metalness: 1.5, ..copper }).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenPbrParameters<C: Spectrum> {
    /// Factor of `base_color`. Default 1.
    pub base_weight: C::Real,
    /// Colour of the diffuse base, and of metal at normal incidence. Default 0.8.
    pub base_color: C,
    /// Roughness of the diffuse base. Default 0.
    pub base_diffuse_roughness: C::Real,
    /// 0: dielectric; 1: metal. Default 0.
    pub base_metalness: C::Real,
    /// Factor of the dielectric's reflectance at normal incidence, by way of its index; of metal, up to 1, a
    /// factor of all it reflects. Default 1.
    pub specular_weight: C::Real,
    /// Factor of the dielectric's reflection; of metal, the tint at 82°. Default 1.
    pub specular_color: C,
    /// Root of the facets' width α. Default 0.3.
    pub specular_roughness: C::Real,
    /// 0: isotropic; 1: stretched along the first tangent as far as can be. Default 0.
    pub specular_roughness_anisotropy: C::Real,
    /// Index of the dielectric base. Default 1.5.
    pub specular_ior: C::Real,
    /// Share of the surface that is coated. Default 0.
    pub coat_weight: C::Real,
    /// Transmittance of the coat, crossed twice along the normal. Default 1.
    pub coat_color: C,
    /// Root of the coat's facets' width. Default 0.
    pub coat_roughness: C::Real,
    /// As `specular_roughness_anisotropy`, of the coat. Default 0.
    pub coat_roughness_anisotropy: C::Real,
    /// Index of the coat. Default 1.6.
    pub coat_ior: C::Real,
    /// Share of the darkening by light that the coat sends back to the base. Default 1.
    pub coat_darkening: C::Real,
    /// Share of the surface that is covered by fuzz. Default 0.
    pub fuzz_weight: C::Real,
    /// Colour of the fuzz. Default 1.
    pub fuzz_color: C,
    /// 0: fibres that stand upright; 1: dust. Default 0.5.
    pub fuzz_roughness: C::Real,
}

impl<C: Spectrum> Default for OpenPbrParameters<C> {
    fn default() -> Self {
        let (zero, one) = (<C::Real as Real>::ZERO, <C::Real as Real>::ONE);
        Self {
            base_weight: one,
            base_color: C::splat(C::Real::lit(0.8)),
            base_diffuse_roughness: zero,
            base_metalness: zero,
            specular_weight: one,
            specular_color: C::white(),
            specular_roughness: C::Real::lit(0.3),
            specular_roughness_anisotropy: zero,
            specular_ior: C::Real::lit(1.5),
            coat_weight: zero,
            coat_color: C::white(),
            coat_roughness: zero,
            coat_roughness_anisotropy: zero,
            coat_ior: C::Real::lit(1.6),
            coat_darkening: one,
            fuzz_weight: zero,
            fuzz_color: C::white(),
            fuzz_roughness: C::Real::HALF,
        }
    }
}

impl<C: Spectrum> OpenPbrParameters<C> {
    /// Checks every domain.
    pub(super) fn check(&self) -> Result<(), ParameterError> {
        for (parameter, color) in [
            ("base_color", self.base_color),
            ("specular_color", self.specular_color),
            ("coat_color", self.coat_color),
            ("fuzz_color", self.fuzz_color),
        ] {
            Reflectance::new(color).map_err(|e| ParameterError { parameter, ..e })?;
        }
        for (name, x) in [
            ("base_weight", self.base_weight),
            ("base_diffuse_roughness", self.base_diffuse_roughness),
            ("base_metalness", self.base_metalness),
            ("specular_roughness", self.specular_roughness),
            ("specular_roughness_anisotropy", self.specular_roughness_anisotropy),
            ("coat_weight", self.coat_weight),
            ("coat_roughness", self.coat_roughness),
            ("coat_roughness_anisotropy", self.coat_roughness_anisotropy),
            ("coat_darkening", self.coat_darkening),
            ("fuzz_weight", self.fuzz_weight),
            ("fuzz_roughness", self.fuzz_roughness),
        ] {
            within(name, x, [0.0, 1.0], "in [0, 1]")?;
        }
        within("specular_weight", self.specular_weight, [0.0, 1e4], "in [0, 1e4]")?;
        within("specular_ior", self.specular_ior, [1.0, 1e4], "in [1, 1e4]")?;
        within("coat_ior", self.coat_ior, [1.0, 1e4], "in [1, 1e4]")?;
        Ok(())
    }
}
