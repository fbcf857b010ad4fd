//! Models and functions by name, for files and command lines. Needs the feature `alloc`.
//!
//! A [`Parameters`] holds numbers, colours and words by name. [`build`] makes the model of that name from them,
//! in any colour type and either precision; [`function`] evaluates a function of the crate. Whatever is wrong
//! comes back as a [`NamedError`] that names it: an unknown model, an unknown parameter (with the known
//! ones), a missing one, a number outside its domain.
//!
//! Models and their parameters have the names of the [registry](crate::registry). Where the literature has
//! another name for a parameter, or another way to state it, both are understood: `albedo` for the `reflectance` of
//! diffuse models, `alpha` for equal `alpha_x` and `alpha_y`, `ior_int` and `ior_ext` for `eta = ior_int / ior_ext`.
//!
//! A [`Measured`](crate::Measured) material consists of data and cannot be built from parameters.
//!
//! # Examples
//! ```
//! use etendue_brdf::Bsdf;
//! use etendue_brdf::named::{self, Parameters};
//! use etendue_math::glam::DVec3;
//!
//! let parameters = Parameters::new().with_number("albedo", 0.5).with_number("sigma", 0.3);
//! let model = named::build::<f64>("oren-nayar", &parameters)?;
//! assert!(model.eval(DVec3::Z, DVec3::new(0.6, 0.0, 0.8)) > 0.0);
//!
//! let error = named::build::<f64>("oren-nayar", &parameters.with_number("ro", 1.0)).err();
//! let message = "oren-nayar has no parameter \"ro\"; it takes reflectance, sigma, albedo";
//! assert_eq!(error.map(|e| e.to_string()), Some(message.into()));
//! # Ok::<(), named::NamedError>(())
//! ```

use alloc::boxed::Box;
use alloc::vec::Vec;

use etendue_math::{Real, Spectrum, Vec3, Vector3};

use crate::Bsdf;
use crate::registry::ModelInfo;

mod adapter;
#[cfg(feature = "serde")]
mod deserialize;
mod diffuse;
mod error;
mod forward;
mod function;
mod layered;
mod openpbr;
mod parameters;
mod phong;
mod principled;
mod reader;
mod rough;
mod row;
mod smooth;

pub use error::NamedError;
pub use function::{FunctionInfo, Output, function, functions};
pub use parameters::{Description, Parameters, Value};
use reader::Reader;
pub use row::{Answer, Row};

/// What an entry's constructor returns.
type Built<C> = Result<Box<dyn Bsdf<Color = C>>, NamedError>;

/// How one model is built.
struct Entry<C: Spectrum> {
    /// Its name and parameters.
    info: &'static ModelInfo,
    /// Further names of parameters that are understood.
    synonyms: &'static [&'static str],
    /// Its constructor.
    build: fn(&Reader) -> Built<C>,
}

/// Every model; a new one is an entry in the file of its family.
fn entries<C: Spectrum>() -> Vec<Entry<C>> {
    let mut all = Vec::new();
    all.extend(adapter::entries());
    all.extend(diffuse::entries());
    all.extend(layered::entries());
    all.extend(openpbr::entries());
    all.extend(phong::entries());
    all.extend(principled::entries());
    all.extend(rough::entries());
    all.extend(smooth::entries());
    all
}

/// The model `name` with these parameters.
///
/// Parameters that scale (`specular_reflectance`, …) are 1 and choices (`distribution`, …) have their first value unless given;
/// `principled` and `principled-thin` have Mitsuba's defaults, `open-pbr` has OpenPBR's; all others are needed. Rough dielectrics mask
/// separably unless told otherwise, as Walter et al. do, rough conductors height-correlated. `ashikhmin-shirley` samples half vectors, as published, unless a mixture is asked for.
///
/// # Errors
/// [`NamedError`] for an unknown name, and for parameters that are unknown, missing, of the wrong kind or
/// outside their domain.
pub fn build<C: Spectrum>(
    name: &str,
    parameters: &Parameters,
) -> Result<Box<dyn Bsdf<Color = C>>, NamedError> {
    let entries = entries::<C>();
    let Some(entry) = entries.iter().find(|entry| entry.info.name == name) else {
        let mut known: Vec<_> = entries.iter().map(|entry| entry.info.name).collect();
        known.sort_unstable();
        return Err(NamedError::Unknown { name: name.into(), known });
    };
    let own = entry.info.parameters.iter().map(|parameter| parameter.name);
    let known = own.chain(entry.synonyms.iter().copied());
    (entry.build)(&Reader::new(entry.info.name, parameters, known)?)
}

/// The unit vector along three coordinates, whatever its length: directions in files are rounded.
///
/// `None` where all are 0 or one is not finite.
///
/// # Precision
/// 2 ulp of each component; nothing overflows or underflows.
pub fn direction<T: Real>([x, y, z]: [f64; 3]) -> Option<Vec3<T>> {
    reader::unit::<T>(Vec3::<T>::new(T::lit(x), T::lit(y), T::lit(z)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::registry::{MODELS, ParameterInfo};
    use alloc::string::ToString;
    use etendue_math::Rgb;

    /// A value for every parameter there is: by its domain, by its name where the domain is words.
    fn example(parameter: &ParameterInfo) -> Option<Value> {
        let domain = parameter.domain;
        Some(match parameter.name {
            "inner" | "front" | "back" | "first" | "second" => Value::Word("null".into()),
            "distribution" => Value::Word("beckmann".into()),
            "masking" => Value::Word("height-correlated".into()),
            "scattering" => Value::Word("non-linear".into()),
            "internal_reflectance" => Value::Word("mitsuba".into()),
            "sampling" => return None, // its words differ by model
            "eta" => Value::Number(1.5),
            "sigma" => Value::Number(0.25),
            "k" => Value::Number(3.0),
            "optical_depth" => Value::Number(0.3),
            _ if domain.starts_with("each channel in [0, 1]") => {
                Value::Numbers([0.1, 0.2, 0.3].into())
            }
            _ if domain.starts_with("in [1e-8, 1") || domain == "in [0, 1]" => Value::Number(0.25),
            _ if domain.starts_with("in [") => Value::Number(2.0),
            name => panic!("no value for {name}, {domain}: add one here"),
        })
    }

    /// The models that parameters can describe.
    fn named() -> impl Iterator<Item = &'static ModelInfo> {
        MODELS.iter().filter(|info| info.type_name != "Measured")
    }

    fn examples(info: &ModelInfo) -> Parameters {
        let mut parameters = Parameters::new();
        for parameter in info.parameters {
            if let Some(value) = example(parameter) {
                parameters.set(parameter.name, value);
            }
        }
        parameters
    }

    #[test]
    fn every_registered_model_is_built_from_its_registered_parameters() {
        for info in named() {
            let parameters = examples(info);
            let model = build::<Rgb<f32>>(info.name, &parameters);
            let model = model.unwrap_or_else(|error| panic!("{error}"));
            let (has, stated) = (model.lobes(), info.lobes);
            assert!(has.continuous <= stated.continuous && has.delta <= stated.delta);
            assert!(build::<Rgb<f64>>(info.name, &parameters).is_ok());
        }
        assert_eq!(entries::<f32>().len(), named().count());
    }

    #[test]
    fn every_registered_parameter_is_looked_at() {
        for info in named() {
            for parameter in info.parameters {
                let mut parameters = examples(info);
                parameters.set(parameter.name, Value::Numbers([f64::NAN].into()));
                let error = build::<Rgb<f64>>(info.name, &parameters).err();
                let error = error.unwrap_or_else(|| panic!("{} {}", info.name, parameter.name));
                assert!(error.to_string().contains(parameter.name), "{error}");
            }
        }
    }

    #[test]
    fn errors_name_the_model_the_parameter_and_the_domain() {
        let message = |model: &str, parameters: Parameters| {
            build::<f64>(model, &parameters).err().unwrap().to_string()
        };
        let none = Parameters::new;
        assert!(
            message("lambrt", none())
                .starts_with("there is no \"lambrt\"; known are absorbing-slab, ")
        );
        assert_eq!(message("lambert", none()), "lambert needs the parameter \"reflectance\"");
        assert_eq!(
            message("lambert", none().with_number("albedo", 1.5)),
            "lambert: albedo is 1.5, but must be in [0, 1]"
        );
        assert_eq!(
            message("lambert", none().with_word("albedo", "red")),
            "lambert: albedo must be a number"
        );
        assert_eq!(
            message("lambert", none().with_number("albdo", 0.5)),
            "lambert has no parameter \"albdo\"; it takes reflectance, albedo"
        );
        let ggxx = none().with_number("alpha", 0.1).with_word("distribution", "ggxx");
        assert_eq!(
            message("rough-dielectric", ggxx.with_number("eta", 1.5)),
            "rough-dielectric: distribution must be one of ggx, beckmann, beckmann-walter"
        );
    }

    #[test]
    fn without_roughness_the_delta_model_is_built() {
        for name in ["any-coupled", "any-plastic", "conductor", "dielectric"] {
            let info = named().find(|info| info.name == name).unwrap();
            let mut parameters = examples(info);
            for width in ["alpha", "alpha_x", "alpha_y"] {
                if parameters.get(width).is_some() {
                    parameters.set(width, Value::Number(0.0));
                }
            }
            let has_delta = |p| build::<Rgb<f32>>(name, p).unwrap().lobes().delta;
            assert!(has_delta(&parameters) && !has_delta(&examples(info)), "{name}");
        }
    }

    #[test]
    fn synonyms_are_the_same_model() {
        let by = |a: &str, b: &str| {
            let parameters = Parameters::new().with_number(a, 0.25).with_number(b, 0.25);
            build::<f64>("oren-nayar", &parameters).unwrap()
        };
        let [wo, wi] = [[0.6, 0.0, 0.8], [0.0, 0.8, 0.6]].map(|w| direction::<f64>(w).unwrap());
        assert_eq!(by("albedo", "sigma").eval(wo, wi), by("sigma", "reflectance").eval(wo, wi));
    }

    #[test]
    fn directions_are_normalised_at_any_scale() {
        for scale in [1e-38, 1.0, 8e37] {
            let w = direction::<f32>([3.0 * scale, 0.0, -4.0 * scale]).unwrap();
            assert!((w.x - 0.6).abs() < 1e-7 && (w.z + 0.8).abs() < 1e-7, "{w}");
        }
        assert!(direction::<f64>([0.0; 3]).is_none());
        assert!(direction::<f64>([f64::INFINITY, 0.0, 1.0]).is_none());
        assert!(direction::<f64>([f64::NAN, 0.0, 1.0]).is_none());
    }
}
