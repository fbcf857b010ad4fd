//! Indices of refraction, by number or by name.

use alloc::format;
use alloc::string::{String, ToString};

use etendue_brdf::Ior;

use super::reader::PluginReader;
use crate::SceneError;
use crate::xml::{Value, nearest};

/// The media Mitsuba knows.
///
/// # Source
/// Mitsuba 3, `include/mitsuba/render/ior.h`; most from Hecht, *Optics*, 4th edition, at 589 nm and
/// 0 to 20 °C.
const MEDIA: [(&str, f64); 23] = [
    ("vacuum", 1.0),
    ("helium", 1.000036),
    ("hydrogen", 1.000132),
    ("air", 1.000277),
    ("carbon dioxide", 1.00045),
    ("water", 1.3330),
    ("acetone", 1.36),
    ("ethanol", 1.361),
    ("carbon tetrachloride", 1.461),
    ("glycerol", 1.4729),
    ("benzene", 1.501),
    ("silicone oil", 1.52045),
    ("bromine", 1.661),
    ("water ice", 1.31),
    ("fused quartz", 1.458),
    ("pyrex", 1.470),
    ("acrylic glass", 1.49),
    ("polypropylene", 1.49),
    ("bk7", 1.5046),
    ("sodium chloride", 1.544),
    ("amber", 1.55),
    ("pet", 1.5750),
    ("diamond", 2.419),
];

/// The index of a named medium, letter case aside.
fn by_name(name: &str) -> Option<f64> {
    MEDIA.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|&(_, index)| index)
}

/// The index that the parameter `name` gives as a number or as the name of a medium.
///
/// # Errors
/// A number that is not positive, an unknown name.
pub(super) fn index(
    reader: &mut PluginReader<'_>,
    name: &'static str,
    default: &str,
) -> Result<f64, SceneError> {
    let medium = match reader.property(name).map(|p| &p.value) {
        Some(Value::String(medium)) => medium.as_str(),
        Some(_) => return reader.float_in(name, 1.0, "positive", |index| index > 0.0),
        None => default,
    };
    by_name(medium).ok_or_else(|| {
        let error = reader.error(name, format!("“{medium}” is no known medium"));
        error.help(match nearest(medium, MEDIA.iter().map(|(known, _)| *known)) {
            Some(known) => format!("did you mean “{known}”?"),
            None => {
                let names = MEDIA.map(|(known, _)| known.to_string());
                format!("known are {}", names.join(", "))
            }
        })
    })
}

/// `int_ior` relative to `ext_ior`.
///
/// # Errors
/// As [`index`], or a ratio outside the domain of [`Ior`].
pub(super) fn relative(
    reader: &mut PluginReader<'_>,
    interior: &str,
    exterior: &str,
) -> Result<Ior<f32>, SceneError> {
    let interior = index(reader, "int_ior", interior)?;
    let exterior = index(reader, "ext_ior", exterior)?;
    Ior::new((interior / exterior) as f32)
        .map_err(|e| reader.error("int_ior", String::from("the relative index: ") + &e.to_string()))
}
