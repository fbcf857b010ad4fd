//! One question about a model or a function, as a line of a file puts it.

use alloc::borrow::ToOwned;
use alloc::string::String;

use etendue_math::{Real, Spectrum, Vec3, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use super::reader::DIRECTION;
use super::{NamedError, Output, Parameters, Value, build, direction, function};
use crate::Bsdf;
use crate::quadrature::{SideAlbedos, adaptive_albedo};

/// A question: the fields of one JSON object, with the feature `serde`.
///
/// | asked for | fields |
/// | --- | --- |
/// | value and density of a model | `model`, `params`, `wi`, `wo` |
/// | a function | `fn`, `params` and what it takes of `cos_theta_i`, `h`, `w`, `wi`, `wo`, `xi` |
/// | directional albedo | `fn` = `albedo`, `model`, `params`, `wo` |
///
/// Directions may have any length but 0. Other fields are passed over.
///
/// # Examples
/// ```
/// use etendue_brdf::named::{Answer, Parameters, Row, Value};
/// let row = Row {
///     model: Some("lambert".into()),
///     params: Parameters::new().with_number("albedo", 0.5),
///     wi: Some(Value::Numbers(vec![0.0, 0.0, 2.0])),
///     wo: Some(Value::Numbers(vec![0.6, 0.0, 0.8])),
///     ..Row::default()
/// };
/// let Answer::Bsdf { f, pdf } = row.answer::<f64>()? else { unreachable!() };
/// assert_eq!((2.0 * f, pdf), (pdf, std::f64::consts::FRAC_1_PI));
/// # Ok::<(), etendue_brdf::named::NamedError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(default))]
pub struct Row {
    /// Name of a model.
    pub model: Option<String>,
    /// Name of a function, or `albedo`.
    #[cfg_attr(feature = "serde", serde(rename = "fn"))]
    pub function: Option<String>,
    /// Parameters of the model or function.
    pub params: Parameters,
    /// Cosine of the angle of incidence.
    pub cos_theta_i: Option<Value>,
    /// Facet normal.
    pub h: Option<Value>,
    /// A direction.
    pub w: Option<Value>,
    /// Direction to the light.
    pub wi: Option<Value>,
    /// Direction to the viewer.
    pub wo: Option<Value>,
    /// Two uniforms.
    pub xi: Option<Value>,
}

/// What is said to a [`Row`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer<T: Real> {
    /// Of a model.
    Bsdf {
        /// Value in sr⁻¹.
        f: T,
        /// Density in sr⁻¹ of sampling `wi`; for a matte term under a mirror, that of sampling it from the matte term.
        pdf: T,
    },
    /// Of a function.
    Function(Output<T>),
    /// Directional albedo, of the continuous part of a model.
    Albedo {
        /// Both sides together for an interface between two media, the side of `wo` for a thin sheet.
        value: f64,
        /// By side.
        sides: SideAlbedos<f64>,
    },
}

/// Models of a sheet, whose two sides are the same medium: their albedo is what they reflect.
const SHEETS: &[&str] = &["diffuse-transmitter", "principled-thin"];

/// Models of a mirror and a cosine-sampled matte term. With what probability the latter is chosen is a matter of the
/// sampler, and 0 where it is black; the density within it is a matter of the model.
const MATTE_UNDER_MIRROR: &[&str] = &["coupled", "layered-fresnel", "layered-linear", "plastic"];

impl Row {
    /// The answer in precision `T`.
    ///
    /// Albedos are the model's own closed form in `T` where it has one and nothing but a continuous reflection, and
    /// else integrals of the model in `f64`, with a tolerance that fits `T`.
    ///
    /// # Errors
    /// [`NamedError`] for whatever is unknown, missing, of the wrong kind or outside its domain.
    pub fn answer<T: Real + Spectrum<Real = T>>(&self) -> Result<Answer<T>, NamedError> {
        match (self.function.as_deref(), self.model.as_deref()) {
            (Some("albedo"), Some(model)) => self.albedo::<T>(model),
            (Some("albedo"), None) => Err(NamedError::Missing { of: "albedo", parameter: "model" }),
            (Some(name), _) => function(name, &self.inputs()).map(Answer::Function),
            (None, Some(model)) => {
                let bsdf = build::<T>(model, &self.params)?;
                let (wi, wo) =
                    (unit::<T>("wi", self.wi.as_ref())?, unit::<T>("wo", self.wo.as_ref())?);
                let (f, mut pdf) = bsdf.eval_pdf(wo, wi);
                if MATTE_UNDER_MIRROR.contains(&model) && wo.z() > T::ZERO {
                    pdf = cosine_hemisphere::pdf::<T>(wi);
                }
                Ok(Answer::Bsdf { f, pdf })
            }
            (None, None) => Err(NamedError::Missing { of: "a row", parameter: "model" }),
        }
    }

    /// Parameters and arguments of a function together.
    fn inputs(&self) -> Parameters {
        let mut inputs = self.params.clone();
        for (name, value) in [
            ("cos_theta_i", &self.cos_theta_i),
            ("h", &self.h),
            ("w", &self.w),
            ("wi", &self.wi),
            ("wo", &self.wo),
            ("xi", &self.xi),
        ] {
            if let Some(value) = value {
                inputs.set(name, value.clone());
            }
        }
        inputs
    }

    fn albedo<T: Real + Spectrum<Real = T>>(&self, name: &str) -> Result<Answer<T>, NamedError> {
        let model = build::<T>(name, &self.params)?;
        let lobes = model.lobes();
        if !lobes.delta && !lobes.transmission {
            let closed = model.albedo(unit::<T>("wo", self.wo.as_ref())?);
            if let Some(reflected) = closed.map(Real::to_f64) {
                let sides = SideAlbedos { reflected, transmitted: 0.0 };
                return Ok(Answer::Albedo { value: reflected, sides });
            }
        }
        // Well below what is asked of T. The jump of a rough interface's transmission where a facet stands upright lies
        // along no axis of any coordinates; more digits of it would take minutes.
        let least = if lobes.transmission && !SHEETS.contains(&name) { 1e-9 } else { 2e-13 };
        let tolerance = (0.1 * T::EPSILON.to_f64()).max(least);
        let model = build::<f64>(name, &self.params)?;
        let sides = adaptive_albedo(&*model, unit::<f64>("wo", self.wo.as_ref())?, tolerance);
        let sum = sides.reflected + sides.transmitted;
        Ok(Answer::Albedo {
            value: if SHEETS.contains(&name) { sides.reflected } else { sum },
            sides,
        })
    }
}

/// The unit vector of a field.
fn unit<T: Real>(name: &'static str, value: Option<&Value>) -> Result<Vec3<T>, NamedError> {
    let unit = match value {
        None => return Err(NamedError::Missing { of: "a row", parameter: name }),
        Some(Value::Numbers(x)) => <[f64; 3]>::try_from(x.as_slice()).ok().and_then(direction::<T>),
        Some(_) => None,
    };
    let error =
        || NamedError::Kind { of: "a row", parameter: name, expected: DIRECTION.to_owned() };
    unit.filter(|w| Vector3::is_finite(*w)).ok_or_else(error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    #[test]
    fn what_is_missing_is_named() {
        let message = |row: Row| row.answer::<f32>().unwrap_err().to_string();
        assert_eq!(message(Row::default()), "a row needs the parameter \"model\"");
        let albedo = Row { function: Some("albedo".into()), ..Row::default() };
        assert_eq!(message(albedo), "albedo needs the parameter \"model\"");
        let null = Row { model: Some("null".into()), ..Row::default() };
        assert_eq!(message(null.clone()), "a row needs the parameter \"wi\"");
        let flat = Some(Value::Numbers([1.0, 0.0].into()));
        let message = message(Row { wi: flat, ..null });
        assert_eq!(message, "a row: wi must be three finite numbers, not all 0");
    }

    #[test]
    fn albedos_count_both_sides_of_an_interface_and_no_delta_lobe() {
        let albedo = |model: &str, params: Parameters| {
            let row = Row {
                model: Some(model.into()),
                function: Some("albedo".into()),
                params,
                wo: Some(Value::Numbers([0.0, 0.6, -0.8].into())),
                ..Row::default()
            };
            let Ok(Answer::Albedo { value, sides }) = row.answer::<f32>() else { panic!() };
            (value, sides)
        };
        let glass = Parameters::new().with_number("eta", 1.5);
        let (rough, sides) = albedo("rough-dielectric", glass.clone().with_number("alpha", 0.1));
        assert_eq!(rough, sides.reflected + sides.transmitted);
        assert!(rough > 0.9 && rough < 1.0 && sides.transmitted > 0.5, "{sides:?}");
        assert_eq!(albedo("smooth-dielectric", glass).0, 0.0);
    }
}
