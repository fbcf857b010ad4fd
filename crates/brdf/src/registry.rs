//! The list of all models: what they take, promise and rest on.

use crate::Lobes;

/// Whether exchanging the two directions changes a model's value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reciprocity {
    /// `f(wo, wi) = f(wi, wo)`.
    Reciprocal,
    /// Reflection is reciprocal; refraction up to the squared index, `f/η²` being symmetric.
    UpToSquaredIndex,
    /// Reflection is reciprocal; what goes through is not, by the model's own definition.
    ReflectionOnly,
    /// Not symmetric, by the model's own definition.
    NonReciprocal {
        /// `|f(a, b) − f(b, a)| / max(f(a, b), f(b, a))` for a the normal and b at cos θ = 0.1, where it is the same for
        /// all parameters with which f is not 0 for both.
        residual: Option<f64>,
    },
}

/// Whether a model can reflect more than it receives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Energy {
    /// Directional albedo ≤ 1 for all parameters. Refracted light counts as flux, that is without the
    /// factor `1/η²` of radiance.
    Conserves,
    /// Directional albedo up to `maximum`, reached at `at`.
    Gains {
        /// The largest directional albedo with white parameters.
        maximum: f64,
        /// The parameters and the angle it belongs to.
        at: &'static str,
    },
    /// Whatever the data say.
    OfData,
}

/// Where a model's directional albedo comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Albedo {
    /// `Bsdf::albedo` answers.
    ClosedForm,
    /// By integration only, see [`directional_albedo`](crate::quadrature::directional_albedo).
    Quadrature,
    /// That of the model inside.
    Inner,
}

/// A parameter and its domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ParameterInfo {
    /// Its name.
    pub name: &'static str,
    /// What is accepted.
    pub domain: &'static str,
}

/// One model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelInfo {
    /// Name in files and commands.
    pub name: &'static str,
    /// The Rust type.
    pub type_name: &'static str,
    /// What its constructors take.
    pub parameters: &'static [ParameterInfo],
    /// Symmetry in the two directions.
    pub reciprocity: Reciprocity,
    /// Energy balance.
    pub energy: Energy,
    /// The parts it can have; a model that wraps or chooses has those of its content.
    pub lobes: Lobes,
    /// Where the directional albedo comes from.
    pub albedo: Albedo,
    /// The density its samples have.
    pub density: &'static str,
    /// Paper or program it is from.
    pub source: &'static str,
}

/// The parameters that models share.
pub(crate) mod parameter {
    use super::ParameterInfo;

    /// A parameter of one model alone.
    pub(crate) const fn named(name: &'static str, domain: &'static str) -> ParameterInfo {
        ParameterInfo { name, domain }
    }

    pub(crate) const REFLECTANCE: ParameterInfo = named("reflectance", "each channel in [0, 1]");
    pub(crate) const SIGMA: ParameterInfo = named("sigma", "radians, finite, not negative");
    pub(crate) const KS: ParameterInfo = named("specular_reflectance", "each channel in [0, 1]");
    pub(crate) const KT: ParameterInfo = named("specular_transmittance", "each channel in [0, 1]");
    pub(crate) const ETA: ParameterInfo = named("eta", "in [1e-4, 1e4]");
    pub(crate) const ROUGH_ETA: ParameterInfo = named("eta", "in [1e-4, 1e4], not 1");
    pub(crate) const COMPLEX_ETA: ParameterInfo = named("eta", "each channel in [0, 1e4]");
    pub(crate) const K: ParameterInfo = named("k", "each channel in [0, 1e4]");
    pub(crate) const ALPHA: ParameterInfo = named("alpha", "in [1e-8, 1e4]");
    pub(crate) const ALPHA_X: ParameterInfo = named("alpha_x", "in [1e-8, 1e4]");
    pub(crate) const ALPHA_Y: ParameterInfo = named("alpha_y", "in [1e-8, 1e4]");
    /// Widths of models that are smooth at 0.
    pub(crate) const ANY_ALPHA: ParameterInfo = named("alpha", "in [0, 1e4]; smooth below 1e-8");
    pub(crate) const ANY_ALPHA_X: ParameterInfo =
        named("alpha_x", "in [0, 1e4]; smooth where both are below 1e-8");
    pub(crate) const ANY_ALPHA_Y: ParameterInfo =
        named("alpha_y", "in [0, 1e4]; smooth where both are below 1e-8");
    pub(crate) const DISTRIBUTION: ParameterInfo =
        named("distribution", "GGX, Beckmann (exact or Walter's fit)");
    pub(crate) const UNIT_ALPHA: ParameterInfo = named("alpha", "in [1e-8, 1]");
    pub(crate) const TABULATED_ALPHA: ParameterInfo =
        named("alpha", "in [1e-8, 1]; Beckmann height-correlated only");
    pub(crate) const MASKING: ParameterInfo = named("masking", "height-correlated, separable");
    pub(crate) const SCATTERING: ParameterInfo = named("scattering", "linear, non-linear");
    pub(crate) const INTERNAL: ParameterInfo = named("internal_reflectance", "exact, Mitsuba");
    pub(crate) const ROUGHNESS: ParameterInfo = named("roughness", "in [0, 1]");
    pub(crate) const NU: ParameterInfo = named("nu", "in [0, 1e12]");
    pub(crate) const NV: ParameterInfo = named("nv", "in [0, 1e12]");
    pub(crate) const RS: ParameterInfo = named("rs", "each channel in [0, 1]");
    pub(crate) const RD: ParameterInfo = named("rd", "each channel in [0, 1]");
    pub(crate) const SAMPLING: ParameterInfo = named("sampling", "see the type");
    pub(crate) const BASE_COLOR: ParameterInfo = named("base_color", "each channel in [0, 1]");
    pub(crate) const ANISOTROPIC: ParameterInfo = named("anisotropic", "in [0, 1]");
    pub(crate) const SPEC_TRANS: ParameterInfo = named("spec_trans", "in [0, 1]");
    pub(crate) const SPEC_TINT: ParameterInfo = named("spec_tint", "in [0, 1]");
    pub(crate) const SHEEN: ParameterInfo = named("sheen", "in [0, 1]");
    pub(crate) const SHEEN_TINT: ParameterInfo = named("sheen_tint", "in [0, 1]");
    pub(crate) const FLATNESS: ParameterInfo = named("flatness", "in [0, 1]");

    /// The rate at which a lobe is sampled.
    pub(crate) const fn sampling_rate(name: &'static str) -> ParameterInfo {
        named(name, "in [0, 1e6]")
    }
}

/// Every type that implements [`Bsdf`](crate::Bsdf), in alphabetical order of the names; each
/// entry stands in the file of its model.
///
/// A test of `etendue-audit` compares it with the sources, so that a new model cannot be forgotten.
pub const MODELS: &[ModelInfo] = &[
    #[cfg(feature = "smooth")]
    crate::smooth::absorbing_slab::INFO,
    #[cfg(feature = "layered")]
    crate::layered::any_coupled::INFO,
    #[cfg(feature = "layered")]
    crate::layered::any_plastic::INFO,
    #[cfg(feature = "phong")]
    crate::phong::ashikhmin_shirley::INFO,
    #[cfg(feature = "phong")]
    crate::phong::ashikhmin_shirley_diffuse::INFO,
    #[cfg(feature = "phong")]
    crate::phong::ashikhmin_shirley_specular::INFO,
    #[cfg(feature = "adapters")]
    crate::adapter::blend::INFO,
    #[cfg(feature = "diffuse")]
    crate::diffuse::burley::INFO,
    #[cfg(feature = "rough")]
    crate::rough::conductor::INFO,
    #[cfg(feature = "layered")]
    crate::layered::coupled::INFO,
    #[cfg(feature = "rough")]
    crate::rough::dielectric::INFO,
    #[cfg(feature = "diffuse")]
    crate::diffuse::diffuse_transmitter::INFO,
    #[cfg(feature = "diffuse")]
    crate::diffuse::eon::INFO,
    #[cfg(feature = "diffuse")]
    crate::diffuse::eon::INFO_APPROXIMATE,
    #[cfg(feature = "rough")]
    crate::rough::kulla_conty::INFO,
    #[cfg(feature = "rough")]
    crate::rough::kulla_conty_dielectric::INFO,
    #[cfg(feature = "diffuse")]
    crate::diffuse::lambert::INFO,
    #[cfg(feature = "layered")]
    crate::layered::layered_fresnel::INFO,
    #[cfg(feature = "layered")]
    crate::layered::layered_linear::INFO,
    #[cfg(feature = "adapters")]
    crate::adapter::mask::INFO,
    #[cfg(feature = "measured")]
    crate::measured::merl::INFO,
    #[cfg(feature = "smooth")]
    crate::smooth::null::INFO,
    #[cfg(feature = "openpbr")]
    crate::openpbr::surface::INFO,
    #[cfg(feature = "diffuse")]
    crate::diffuse::oren_nayar::INFO,
    #[cfg(feature = "diffuse")]
    crate::diffuse::oren_nayar_fujii::INFO,
    #[cfg(feature = "diffuse")]
    crate::diffuse::oren_nayar_qualitative::INFO,
    #[cfg(feature = "phong")]
    crate::phong::modified_phong::INFO,
    #[cfg(feature = "layered")]
    crate::layered::plastic::INFO,
    #[cfg(feature = "principled")]
    crate::principled::solid::INFO,
    #[cfg(feature = "principled")]
    crate::principled::thin::INFO,
    #[cfg(feature = "rough")]
    crate::rough::rough_conductor::INFO,
    #[cfg(feature = "layered")]
    crate::layered::rough_coupled::INFO,
    #[cfg(feature = "rough")]
    crate::rough::rough_dielectric::INFO,
    #[cfg(feature = "layered")]
    crate::layered::rough_plastic::INFO,
    #[cfg(feature = "smooth")]
    crate::smooth::smooth_conductor::INFO,
    #[cfg(feature = "smooth")]
    crate::smooth::smooth_dielectric::INFO,
    #[cfg(feature = "smooth")]
    crate::smooth::thin_dielectric::INFO,
    #[cfg(feature = "rough")]
    crate::rough::turquin::INFO,
    #[cfg(feature = "adapters")]
    crate::adapter::two_sided::INFO,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_in_order_and_unique() {
        assert!(MODELS.windows(2).all(|pair| pair[0].name < pair[1].name));
    }
}
