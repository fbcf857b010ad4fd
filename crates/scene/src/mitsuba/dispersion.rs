//! Indices of refraction that depend on the wavelength.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use etendue_brdf::Ior;
use etendue_brdf::fresnel::{Dispersion, GLASSES};

use super::ior;
use super::reader::PluginReader;
use crate::SceneError;
use crate::material::RelativeDispersion;
use crate::xml::nearest;

/// The relative index of an interface, and how it depends on the wavelength where it does: `int_ior` with its Abbe number
/// `abbe`, or `glass`, `cauchy` or `sellmeier`, and `ext_ior`.
///
/// # Errors
/// Several of these; what is no number, name or list of them; an index outside the domain of [`Ior`] for a wavelength that is
/// seen.
pub(super) fn interface(
    reader: &mut PluginReader<'_>,
) -> Result<(Ior<f32>, Option<Box<RelativeDispersion>>), SceneError> {
    let Some((name, interior)) = given(reader)? else {
        return Ok((ior::relative(reader, "bk7", "air")?, None));
    };
    let exterior = ior::index(reader, "ext_ior", "air")?;
    let relative = RelativeDispersion { interior, exterior };
    let index = relative.checked().map_err(|(nm, error)| {
        reader.error(name, format!("the relative index at {nm} nm: {error}"))
    })?;
    Ok((index, Some(Box::new(relative))))
}

/// The dispersion that is given, and the parameter that gives it.
fn given(reader: &mut PluginReader<'_>) -> Result<Option<(&'static str, Dispersion)>, SceneError> {
    const WAYS: [&str; 4] = ["abbe", "glass", "cauchy", "sellmeier"];
    let mut ways = WAYS.into_iter().filter(|way| reader.has(way));
    let Some(way) = ways.next() else {
        // Names that are supported, for those who misspell them.
        reader.ignore(&WAYS);
        return Ok(None);
    };
    let index = (way != "abbe" && reader.has("int_ior")).then_some("int_ior");
    if let Some(other) = ways.chain(index).next() {
        return Err(reader.error(other, format!("give either “{way}” or “{other}”")));
    }
    let dispersion = match way {
        "abbe" => {
            let index = ior::index(reader, "int_ior", "bk7")?;
            let abbe = reader.float_in("abbe", 1.0, "positive", |abbe| abbe > 0.0)?;
            Dispersion::from_abbe_number(index, abbe)
        }
        "glass" => {
            let name = reader.string("glass")?.unwrap_or_default();
            Dispersion::glass(name).ok_or_else(|| unknown(reader, name))?
        }
        "cauchy" => match coefficients(reader, "cauchy")?[..] {
            [a, b] => Dispersion::Cauchy([a, b, 0.0]),
            [a, b, c] => Dispersion::Cauchy([a, b, c]),
            _ => {
                let message = "“cauchy” must be two or three numbers: A, B in µm² and C in µm⁴";
                return Err(reader.error("cauchy", message));
            }
        },
        _ => {
            let numbers = coefficients(reader, "sellmeier")?;
            let (pairs, rest) = numbers.as_chunks::<2>();
            if pairs.is_empty() || pairs.len() > 4 || !rest.is_empty() {
                let message = "“sellmeier” must be one to four pairs of numbers: B and C in µm² of each resonance";
                return Err(reader.error("sellmeier", message));
            }
            let mut resonances = [[0.0; 2]; 4];
            resonances[..pairs.len()].copy_from_slice(pairs);
            Dispersion::Sellmeier(resonances)
        }
    };
    Ok(Some((way, dispersion)))
}

/// The numbers of a list.
fn coefficients(reader: &mut PluginReader<'_>, name: &'static str) -> Result<Vec<f64>, SceneError> {
    Ok(reader.numbers(name)?.unwrap_or_default())
}

fn unknown(reader: &PluginReader<'_>, name: &str) -> SceneError {
    let names = || GLASSES.iter().map(|glass| glass.name);
    let error = reader.error("glass", format!("“{name}” is not in the catalogue"));
    error.help(match nearest(name, names()) {
        Some(known) => format!("did you mean “{known}”?"),
        None => String::from("known are ") + &names().collect::<Vec<_>>().join(", "),
    })
}
