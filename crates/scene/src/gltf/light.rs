//! Lights of a point or a direction: `KHR_lights_punctual`.

use alloc::format;

use etendue_math::glam::{DAffine3, DVec3, Vec3};

use super::camera::frame;
use super::document::Document;
use super::json::Json;
use super::node::Node;
use crate::geometry::Transform;
use crate::light::{DirectionalLight, Light, PointLight, SpotLight};
use crate::{Color, SceneError};

const EXTENSION: &str = "KHR_lights_punctual";

/// The light of a node, if it has one, and what the document says of it.
///
/// Candela are taken as W sr⁻¹ and lux as W m⁻², number for number.
///
/// # Errors
/// A light that does not exist, parameters outside their domain.
pub(super) fn of<'a>(
    document: &'a Document,
    node: &Node<'_>,
) -> Result<Option<(Light, Json<'a>)>, SceneError> {
    let Some(reference) = node.json.extension(EXTENSION)? else { return Ok(None) };
    let number = reference.need("light")?;
    let index = number.as_index()?;
    let lights = document.root().extension(EXTENSION)?;
    let lights = lights.map(|extension| extension.get("lights")).transpose()?.flatten();
    let light = lights.map(|lights| lights.item(index)).transpose()?.flatten();
    let Some(json) = light else {
        return Err(number.error(format!("there is no extensions.{EXTENSION}.lights[{index}]")));
    };
    translate(&json, &node.to_world).map(|light| Some((light, json)))
}

fn translate(json: &Json<'_>, to_world: &DAffine3) -> Result<Light, SceneError> {
    let color = super::color(json, "color", [1.0; 3])?;
    let intensity = json.number_in("intensity", 1.0, 0.0..=f64::MAX)? as f32;
    let emitted = color * intensity;
    if !emitted.to_array().iter().all(|x| x.is_finite()) {
        return Err(json.error("“color” times “intensity” is beyond single precision"));
    }
    // Light is the same all around the axis.
    let side =
        to_world.matrix3.z_axis.try_normalize().map_or(DVec3::Y, |z| z.any_orthonormal_vector());
    let frame = || frame(to_world, side).map_err(|e| json.error(format!("cannot be placed: {e}")));
    let kind = json.need("type")?;
    Ok(match kind.as_text()? {
        "point" => {
            let position = to_world.translation.as_vec3();
            if !position.is_finite() {
                return Err(json.error("cannot be placed: its node is out of range"));
            }
            Light::Point(PointLight { position, intensity: emitted })
        }
        "directional" => {
            let direction = frame()?.vector(Vec3::Z);
            Light::Directional(DirectionalLight { direction, irradiance: emitted })
        }
        "spot" => Light::Spot(spot(json, emitted, &frame()?)?),
        other => {
            return Err(kind.error(format!("“{other}” is none of point, spot and directional")));
        }
    })
}

fn spot(json: &Json<'_>, intensity: Color, frame: &Transform) -> Result<SpotLight, SceneError> {
    let cone = json.get("spot")?;
    let angle = |name: &str, default: f64| match &cone {
        Some(cone) => cone.number_in(name, default, 0.0..=core::f64::consts::FRAC_PI_2),
        None => Ok(default),
    };
    let inner = angle("innerConeAngle", 0.0)?;
    let outer = angle("outerConeAngle", core::f64::consts::FRAC_PI_4)?;
    SpotLight::new(*frame, intensity, None, outer.to_degrees(), inner.to_degrees())
        .map_err(|error| json.error(error))
}
