//! The list of all models: what they take, promise and rest on.

use crate::Lobes;

/// Whether exchanging the two directions changes a model's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reciprocity {
    /// `f(wo, wi) = f(wi, wo)`.
    Reciprocal,
    /// Reflection is reciprocal; refraction up to the squared index, `f/η²` being symmetric.
    UpToSquaredIndex,
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

const fn parameter(name: &'static str, domain: &'static str) -> ParameterInfo {
    ParameterInfo { name, domain }
}

const REFLECTANCE: ParameterInfo = parameter("reflectance", "each channel in [0, 1]");
const SIGMA: ParameterInfo = parameter("sigma", "radians, finite, not negative");
const KS: ParameterInfo = parameter("specular_reflectance", "each channel in [0, 1]");
const KT: ParameterInfo = parameter("specular_transmittance", "each channel in [0, 1]");
const ETA: ParameterInfo = parameter("eta", "in [1e-4, 1e4]");
const ROUGH_ETA: ParameterInfo = parameter("eta", "in [1e-4, 1e4], not 1");
const COMPLEX_ETA: ParameterInfo = parameter("eta", "each channel in [0, 1e4]");
const K: ParameterInfo = parameter("k", "each channel in [0, 1e4]");
const ALPHA_X: ParameterInfo = parameter("alpha_x", "in [1e-8, 1e4]");
const ALPHA_Y: ParameterInfo = parameter("alpha_y", "in [1e-8, 1e4]");
const DISTRIBUTION: ParameterInfo =
    parameter("distribution", "GGX, Beckmann (exact or Walter's fit)");
const MASKING: ParameterInfo = parameter("masking", "height-correlated, separable");
const SCATTERING: ParameterInfo = parameter("scattering", "linear, non-linear");
const INTERNAL: ParameterInfo = parameter("internal reflectance", "exact, Mitsuba");

const CONTINUOUS: Lobes = Lobes { continuous: true, delta: false, transmission: false };
const DELTA: Lobes = Lobes { continuous: false, delta: true, transmission: false };
const DELTA_THROUGH: Lobes = Lobes { continuous: false, delta: true, transmission: true };

/// Every type that implements [`Bsdf`](crate::Bsdf), in alphabetical order of the names.
///
/// A test compares it with the sources, so that a new model cannot be forgotten here.
pub const MODELS: &[ModelInfo] = &[
    ModelInfo {
        name: "conductor",
        type_name: "Conductor",
        parameters: &[COMPLEX_ETA, K, DISTRIBUTION, ALPHA_X, ALPHA_Y, MASKING, KS],
        reciprocity: Reciprocity::Reciprocal,
        energy: Energy::Conserves,
        lobes: Lobes { continuous: true, delta: true, transmission: false },
        albedo: Albedo::Inner,
        density: "that of the variant chosen at construction",
        source: "smooth-conductor, or rough-conductor for alpha >= 1e-8",
    },
    ModelInfo {
        name: "dielectric",
        type_name: "Dielectric",
        parameters: &[ETA, DISTRIBUTION, ALPHA_X, ALPHA_Y, MASKING, KS, KT],
        reciprocity: Reciprocity::UpToSquaredIndex,
        energy: Energy::Conserves,
        lobes: Lobes { continuous: true, delta: true, transmission: true },
        albedo: Albedo::Inner,
        density: "that of the variant chosen at construction",
        source: "null for eta = 1, smooth-dielectric, or rough-dielectric for alpha >= 1e-8",
    },
    ModelInfo {
        name: "lambert",
        type_name: "Lambert",
        parameters: &[REFLECTANCE],
        reciprocity: Reciprocity::Reciprocal,
        energy: Energy::Conserves,
        lobes: CONTINUOUS,
        albedo: Albedo::ClosedForm,
        density: "cosine",
        source: "Lambert 1760",
    },
    ModelInfo {
        name: "mask",
        type_name: "Mask",
        parameters: &[parameter("opacity", "in [0, 1]"), parameter("inner", "any model")],
        reciprocity: Reciprocity::Reciprocal,
        energy: Energy::Conserves,
        lobes: Lobes { continuous: true, delta: true, transmission: true },
        albedo: Albedo::Inner,
        density: "the inner one with probability opacity",
        source: "Mitsuba, mask",
    },
    ModelInfo {
        name: "null",
        type_name: "Null",
        parameters: &[],
        reciprocity: Reciprocity::Reciprocal,
        energy: Energy::Conserves,
        lobes: DELTA_THROUGH,
        albedo: Albedo::ClosedForm,
        density: "delta",
        source: "index-matched limit of a dielectric",
    },
    ModelInfo {
        name: "oren-nayar",
        type_name: "OrenNayar",
        parameters: &[REFLECTANCE, SIGMA],
        reciprocity: Reciprocity::Reciprocal,
        energy: Energy::Gains { maximum: 1.0509, at: "sigma = 0.3, cos -> 0" },
        lobes: CONTINUOUS,
        albedo: Albedo::Quadrature,
        density: "cosine",
        source: "Oren and Nayar 1994, eqs. 27 to 29",
    },
    ModelInfo {
        name: "oren-nayar-qualitative",
        type_name: "OrenNayarQualitative",
        parameters: &[REFLECTANCE, SIGMA],
        reciprocity: Reciprocity::Reciprocal,
        energy: Energy::Gains { maximum: 1.0152, at: "sigma = 0.2, cos -> 0" },
        lobes: CONTINUOUS,
        albedo: Albedo::Quadrature,
        density: "cosine",
        source: "Oren and Nayar 1994, eq. 30",
    },
    ModelInfo {
        name: "plastic",
        type_name: "Plastic",
        parameters: &[ETA, REFLECTANCE, KS, SCATTERING, INTERNAL],
        reciprocity: Reciprocity::Reciprocal,
        energy: Energy::Conserves,
        lobes: Lobes { continuous: true, delta: true, transmission: false },
        albedo: Albedo::ClosedForm,
        density: "mirror or cosine, by Fresnel and mean colours",
        source: "Mitsuba, plastic; Wolff 1994",
    },
    ModelInfo {
        name: "rough-conductor",
        type_name: "RoughConductor",
        parameters: &[COMPLEX_ETA, K, DISTRIBUTION, ALPHA_X, ALPHA_Y, MASKING, KS],
        reciprocity: Reciprocity::Reciprocal,
        energy: Energy::Conserves,
        lobes: CONTINUOUS,
        albedo: Albedo::Quadrature,
        density: "visible normals",
        source: "Walter et al. 2007; Heitz 2014, 2018; Dupuy and Benyoub 2023",
    },
    ModelInfo {
        name: "rough-dielectric",
        type_name: "RoughDielectric",
        parameters: &[ROUGH_ETA, DISTRIBUTION, ALPHA_X, ALPHA_Y, MASKING, KS, KT],
        reciprocity: Reciprocity::UpToSquaredIndex,
        energy: Energy::Conserves,
        lobes: Lobes { continuous: true, delta: false, transmission: true },
        albedo: Albedo::Quadrature,
        density: "visible normals, reflection with probability F",
        source: "Walter et al. 2007; Heitz and d'Eon 2014",
    },
    ModelInfo {
        name: "rough-plastic",
        type_name: "RoughPlastic",
        parameters: &[
            ETA,
            DISTRIBUTION,
            parameter("alpha", "in [1e-8, 1e4]"),
            MASKING,
            REFLECTANCE,
            KS,
            SCATTERING,
            INTERNAL,
        ],
        reciprocity: Reciprocity::Reciprocal,
        energy: Energy::Conserves,
        lobes: CONTINUOUS,
        albedo: Albedo::Quadrature,
        density: "mixture of visible normals and cosine",
        source: "Mitsuba, roughplastic",
    },
    ModelInfo {
        name: "smooth-conductor",
        type_name: "SmoothConductor",
        parameters: &[COMPLEX_ETA, K, KS],
        reciprocity: Reciprocity::Reciprocal,
        energy: Energy::Conserves,
        lobes: DELTA,
        albedo: Albedo::ClosedForm,
        density: "delta",
        source: "Born and Wolf, section 14.2",
    },
    ModelInfo {
        name: "smooth-dielectric",
        type_name: "SmoothDielectric",
        parameters: &[ETA, KS, KT],
        reciprocity: Reciprocity::UpToSquaredIndex,
        energy: Energy::Conserves,
        lobes: DELTA_THROUGH,
        albedo: Albedo::ClosedForm,
        density: "delta, reflection with probability F",
        source: "Born and Wolf, section 1.5",
    },
    ModelInfo {
        name: "thin-dielectric",
        type_name: "ThinDielectric",
        parameters: &[ETA, KS, KT],
        reciprocity: Reciprocity::Reciprocal,
        energy: Energy::Conserves,
        lobes: DELTA_THROUGH,
        albedo: Albedo::ClosedForm,
        density: "delta, reflection with probability 2F/(1 + F)",
        source: "Mitsuba, thindielectric",
    },
    ModelInfo {
        name: "two-sided",
        type_name: "TwoSided",
        parameters: &[parameter("front", "any model"), parameter("back", "any model")],
        reciprocity: Reciprocity::Reciprocal,
        energy: Energy::Conserves,
        lobes: Lobes { continuous: true, delta: true, transmission: false },
        albedo: Albedo::Inner,
        density: "that of the side",
        source: "Mitsuba, twosided",
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::String;
    use alloc::vec::Vec;
    use std::fs;

    /// Types behind every `Bsdf for Type` in the sources.
    fn implementations() -> Vec<String> {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src");
        let mut found = Vec::new();
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let Ok(text) = fs::read_to_string(&path) else { continue };
            for line in text.lines().filter(|l| l.starts_with("impl")) {
                if let Some((_, rest)) = line.split_once(" Bsdf for ") {
                    found.push(rest.chars().take_while(|c| c.is_alphanumeric()).collect());
                }
            }
        }
        found.sort();
        found
    }

    #[test]
    fn every_implementation_is_listed_and_every_listed_type_exists() {
        let mut listed: Vec<_> = MODELS.iter().map(|m| String::from(m.type_name)).collect();
        listed.sort();
        assert_eq!(listed, implementations());
    }

    #[test]
    fn names_are_in_order_and_unique() {
        assert!(MODELS.windows(2).all(|pair| pair[0].name < pair[1].name));
    }
}
