//! Names of older scene files in today's spelling.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use etendue_math::glam::{DMat4, DVec3};

use super::description::{Node, Property, Value};
use crate::SceneError;

/// `camelCase` to `snake_case`, in files of every version, since converted ones keep old names: an underscore where a capital follows a small letter, and the whole
/// run of capitals in small letters, so `intIOR` is `int_ior`. Names with a leading capital run are
/// left alone, as Mitsuba leaves them.
pub(crate) fn snake_case(name: &str) -> String {
    let mut result = String::with_capacity(name.len() + 4);
    let mut previous = ' ';
    let mut lowering = false;
    for c in name.chars() {
        if c.is_ascii_uppercase() && previous.is_ascii_lowercase() {
            result.push('_');
            lowering = true;
        }
        lowering &= c.is_ascii_uppercase();
        result.push(if lowering { c.to_ascii_lowercase() } else { c });
        previous = c;
    }
    result
}

/// Brings a plugin of a version 0.x or 1.x file up to date.
///
/// `diffuse_reflectance` of a `diffuse` is its `reflectance`, and `uoffset`, `voffset`, `uscale`,
/// `vscale` become
///
/// ```text
/// to_uv = scale(uscale, vscale) · translate(uoffset, voffset)
/// ```
///
/// which is what Mitsuba 2 and 3 make of them (version 0.6 itself scaled first).
///
/// # Errors
/// An offset or a scale that is no number.
///
/// # Source
/// Mitsuba 3, `src/core/parser.cpp`, `upgrade_from_v1`.
pub(crate) fn upgrade(node: &mut Node) -> Result<(), SceneError> {
    if node.plugin == "diffuse" {
        let named = node.properties.iter_mut().map(|p| &mut p.name);
        for name in named.chain(node.children.iter_mut().map(|c| &mut c.name)) {
            if name == "diffuse_reflectance" {
                *name = "reflectance".into();
            }
        }
    }
    let mut factors = [0.0, 0.0, 1.0, 1.0];
    let mut location = None;
    for (name, factor) in ["uoffset", "voffset", "uscale", "vscale"].into_iter().zip(&mut factors) {
        let Some(at) = node.properties.iter().position(|p| p.name == name) else { continue };
        let property = node.properties.remove(at);
        *factor = match property.value {
            Value::Float(x) => x,
            Value::Integer(n) => n as f64,
            _ => {
                let message = format!("{name} must be a float");
                return Err(SceneError::scene(property.location, message));
            }
        };
        location.get_or_insert(property.location);
    }
    if let Some(location) = location {
        let [u_offset, v_offset, u_scale, v_scale] = factors;
        let value = Value::Transform(
            DMat4::from_scale(DVec3::new(u_scale, v_scale, 1.0))
                * DMat4::from_translation(DVec3::new(u_offset, v_offset, 0.0)),
        );
        node.properties.push(Property { name: "to_uv".into(), value, location });
    }
    Ok(())
}

/// The version of a scene file, from `major.minor.patch`.
pub(crate) fn parse_version(text: &str) -> Option<[u32; 3]> {
    let parts: Option<Vec<u32>> = text.trim().split('.').map(|part| part.parse().ok()).collect();
    parts?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_split_where_a_capital_follows_a_small_letter() {
        for (old, new) in [
            ("intIOR", "int_ior"),
            ("toWorld", "to_world"),
            ("alphaU", "alpha_u"),
            ("maxDepth", "max_depth"),
            ("sampleCount", "sample_count"),
            ("nonlinear", "nonlinear"),
            ("RRDepth", "RRDepth"),
            ("specularReflectance", "specular_reflectance"),
            ("", ""),
        ] {
            assert_eq!(snake_case(old), new);
        }
    }

    #[test]
    fn versions_have_three_parts() {
        assert_eq!(parse_version(" 0.6.0"), Some([0, 6, 0]));
        for bad in ["", "3", "3.0", "3.0.x", "3.0.0.0", "-1.0.0"] {
            assert_eq!(parse_version(bad), None, "{bad:?}");
        }
    }
}
