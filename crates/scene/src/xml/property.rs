//! Parameters: elements that hold a value.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use etendue_math::glam::{DMat4, DVec3};
use roxmltree::Node as Element;

use super::description::{SpectrumValue, Value};
use super::numbers::{items, parse_float, parse_integer, parse_list};
use super::parse::Attributes;
use super::source::{self, Source};
use super::transform::{look_at, matrix, rotate};
use crate::{Location, SceneError};

/// The elements that [`value`] knows.
pub(super) const ELEMENTS: [&str; 9] =
    ["boolean", "integer", "float", "string", "vector", "point", "rgb", "srgb", "spectrum"];

/// The operations that [`transform`] knows.
const OPERATIONS: [&str; 5] = ["translate", "rotate", "scale", "lookat", "matrix"];

/// The name and the value of a parameter.
///
/// # Errors
/// An element that is no parameter, a missing or superfluous attribute, a value of the wrong form.
pub(super) fn value<'a>(
    source: &'a Source<'a>,
    element: Element<'a, 'a>,
    attributes: &'a Attributes<'a>,
) -> Result<(&'a str, Value), SceneError> {
    let reader = Reader { source, element, attributes };
    let tag = element.tag_name().name();
    let allowed: &[&str] = match tag {
        "vector" | "point" => &["name", "value", "x", "y", "z"],
        "spectrum" => &["name", "value", "filename"],
        _ if ELEMENTS.contains(&tag) => &["name", "value"],
        _ if OPERATIONS.contains(&tag) || tag == "lookAt" => {
            let message = format!("<{tag}> can only stand inside <transform>");
            return Err(source.error(element, message));
        }
        _ => return Err(source.unknown_element(element)),
    };
    source.check_attributes(element, allowed)?;
    source.check_empty(element)?;
    let name = reader.required("name")?;
    let value = match tag {
        "boolean" => match reader.required("value")? {
            text if text.eq_ignore_ascii_case("true") => Value::Boolean(true),
            text if text.eq_ignore_ascii_case("false") => Value::Boolean(false),
            text => return Err(reader.not_a("boolean (true or false)", text)),
        },
        "integer" => {
            let text = reader.required("value")?;
            let number = parse_integer(text).ok_or_else(|| reader.not_a("whole number", text))?;
            Value::Integer(number)
        }
        "float" => Value::Float(reader.float(reader.required("value")?)?),
        "string" => Value::String(reader.required("value")?.into()),
        "rgb" => Value::Rgb(reader.rgb()?),
        "srgb" => Value::Rgb(reader.rgb()?.map(crate::load::srgb::decode)),
        "spectrum" => Value::Spectrum(reader.spectrum()?),
        _ => Value::Vector(reader.vector()?),
    };
    Ok((name, value))
}

/// The product of the operations inside a `<transform>`: each is applied after those before it.
///
/// # Errors
/// An element that is no operation, a value of the wrong form, a rotation about no axis, a line of
/// sight without direction or along its `up` vector.
pub(super) fn transform<'a>(
    source: &'a Source<'a>,
    operations: &'a [(Element<'a, 'a>, Attributes<'a>)],
) -> Result<DMat4, SceneError> {
    let mut product = DMat4::IDENTITY;
    for (element, attributes) in operations {
        let operation = Reader { source, element: *element, attributes }.operation()?;
        product = operation * product;
        if !product.is_finite() {
            return Err(source.error(*element, "the transform overflows"));
        }
    }
    Ok(product)
}

/// The time of a keyframe.
///
/// # Errors
/// None, or one that is no finite number.
pub(super) fn time<'a>(
    source: &'a Source<'a>,
    element: Element<'a, 'a>,
    attributes: &'a Attributes<'a>,
) -> Result<f64, SceneError> {
    let reader = Reader { source, element, attributes };
    reader.float(reader.required("time")?)
}

/// The attributes of one element.
struct Reader<'a> {
    source: &'a Source<'a>,
    element: Element<'a, 'a>,
    attributes: &'a Attributes<'a>,
}

impl<'a> Reader<'a> {
    fn optional(&self, name: &str) -> Option<&'a str> {
        self.attributes.iter().find(|(n, _)| *n == name).map(|(_, v)| v.as_str())
    }

    fn required(&self, name: &str) -> Result<&'a str, SceneError> {
        self.optional(name).ok_or_else(|| self.source.missing_attribute(self.element, name))
    }

    fn not_a(&self, noun: &str, text: &str) -> SceneError {
        self.source.error(self.element, format!("“{text}” is not a {noun}"))
    }

    fn float(&self, text: &str) -> Result<f64, SceneError> {
        parse_float(text).ok_or_else(|| self.not_a("finite number", text))
    }

    fn list(&self, text: &str) -> Result<Vec<f64>, SceneError> {
        parse_list(text).map_err(|item| self.not_a("finite number", item))
    }

    /// One number or three.
    fn triple(&self, text: &str) -> Result<[f64; 3], SceneError> {
        match self.list(text)?[..] {
            [x] => Ok([x; 3]),
            [x, y, z] => Ok([x, y, z]),
            _ => Err(self.not_a("number or three numbers", text)),
        }
    }

    /// `value`, or `x`, `y`, `z` with `default` for those that are missing.
    fn xyz(&self, default: f64) -> Result<DVec3, SceneError> {
        let axes = ["x", "y", "z"].map(|name| self.optional(name));
        let Some(text) = self.optional("value") else {
            let mut components = [default; 3];
            for (component, text) in components.iter_mut().zip(axes) {
                if let Some(text) = text {
                    *component = self.float(text)?;
                }
            }
            return Ok(components.into());
        };
        if axes.iter().any(Option::is_some) {
            let message = "“value” cannot stand beside “x”, “y” or “z”";
            return Err(self.source.error(self.element, message));
        }
        Ok(self.triple(text)?.into())
    }

    /// As [`Self::xyz`], without a default.
    fn vector(&self) -> Result<DVec3, SceneError> {
        if self.optional("value").is_none() {
            for name in ["x", "y", "z"] {
                self.required(name)?;
            }
        }
        self.xyz(0.0)
    }

    /// Three numbers, one for all three, or `#rrggbb`, whose digits are linear shares of 255 as in
    /// Mitsuba 0.6.
    fn rgb(&self) -> Result<[f64; 3], SceneError> {
        let text = self.required("value")?;
        let Some(digits) = text.trim().strip_prefix('#') else {
            return self.triple(text);
        };
        let is_hexadecimal = digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit());
        match u32::from_str_radix(digits, 16) {
            Ok(bits) if is_hexadecimal => {
                Ok([bits >> 16, bits >> 8, bits].map(|b| f64::from(b & 0xff) / 255.0))
            }
            _ => Err(self.not_a("colour of the form #rrggbb", text)),
        }
    }

    fn spectrum(&self) -> Result<SpectrumValue, SceneError> {
        match (self.optional("value"), self.optional("filename")) {
            (Some(text), None) => self.inline_spectrum(text),
            (None, Some(name)) => {
                let named = |error| self.source.named(self.element, error);
                let path = self.source.search.resolve(name).map_err(named)?;
                let text = source::read(&path).map_err(named)?;
                let mut samples = Vec::new();
                for (number, line) in (1..).zip(text.lines()) {
                    let content = line.split('#').next().unwrap_or_default();
                    match parse_list(content).as_deref() {
                        Ok([]) => {}
                        Ok(&[wavelength, value]) => samples.push((wavelength, value)),
                        _ => {
                            let message = "expected a wavelength and a value";
                            return Err(SceneError::scene(Location::line(path, number), message));
                        }
                    }
                }
                increasing(samples)
                    .map_err(|message| SceneError::scene(Location::file(path), message))
            }
            _ => {
                let message = "<spectrum> needs either “value” or “filename”";
                Err(self.source.error(self.element, message))
            }
        }
    }

    /// One number, or pairs `wavelength:value`.
    fn inline_spectrum(&self, text: &str) -> Result<SpectrumValue, SceneError> {
        if !text.contains(':') {
            return match self.list(text)?[..] {
                [value] => Ok(SpectrumValue::Uniform(value)),
                _ => Err(self.not_a("number or list of wavelength:value pairs", text)),
            };
        }
        let pair = |item: &str| {
            let (wavelength, value) = item.split_once(':')?;
            Some((parse_float(wavelength)?, parse_float(value)?))
        };
        let samples: Result<Vec<_>, _> = items(text)
            .map(|item| pair(item).ok_or_else(|| self.not_a("wavelength:value pair", item)))
            .collect();
        increasing(samples?).map_err(|message| self.source.error(self.element, message))
    }

    /// One operation of a transform.
    fn operation(&self) -> Result<DMat4, SceneError> {
        let (source, element) = (self.source, self.element);
        source.check_empty(element)?;
        let tag = element.tag_name().name();
        let allowed: &[&str] = match tag {
            "translate" | "scale" => &["value", "x", "y", "z"],
            "rotate" => &["angle", "value", "x", "y", "z"],
            "lookat" | "lookAt" => &["origin", "target", "up"],
            "matrix" => &["value"],
            _ => {
                let message = format!("<{tag}> is no transform operation");
                return Err(source.error(element, message).help(OPERATIONS.join(", ")));
            }
        };
        source.check_attributes(element, allowed)?;
        match tag {
            "translate" => Ok(DMat4::from_translation(self.xyz(0.0)?)),
            "scale" => Ok(DMat4::from_scale(self.xyz(1.0)?)),
            "rotate" => {
                let angle = self.float(self.required("angle")?)?;
                rotate(self.xyz(0.0)?, angle).map_err(|e| source.error(element, e.to_string()))
            }
            "matrix" => {
                let text = self.required("value")?;
                matrix(&self.list(text)?)
                    .ok_or_else(|| source.error(element, "a matrix has 9 or 16 numbers"))
            }
            _ => {
                let point = |text| -> Result<DVec3, SceneError> {
                    match self.list(text)?[..] {
                        [x, y, z] => Ok(DVec3::new(x, y, z)),
                        _ => Err(self.not_a("triple of numbers", text)),
                    }
                };
                let origin = point(self.required("origin")?)?;
                let target = point(self.required("target")?)?;
                let up = self.optional("up").map_or(Ok(DVec3::ZERO), point)?;
                look_at(origin, target, up).map_err(|e| source.error(element, e.to_string()))
            }
        }
    }
}

/// A sampled spectrum, whose wavelengths must increase.
///
/// # Errors
/// Fewer than two samples, wavelengths that do not increase.
pub(crate) fn increasing(samples: Vec<(f64, f64)>) -> Result<SpectrumValue, String> {
    if samples.len() < 2 {
        return Err("a spectrum needs two wavelengths or more".into());
    }
    match samples.windows(2).find(|w| w[0].0 >= w[1].0) {
        Some(w) => Err(format!("wavelength {} does not lie above {}", w[1].0, w[0].0)),
        None => Ok(SpectrumValue::Samples(samples)),
    }
}
