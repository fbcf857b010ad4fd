//! How much cameras see, and how far projectors shine.

use alloc::format;

use super::reader::PluginReader;
use crate::SceneError;
use crate::camera::{FieldOfView, FovAxis};
use crate::xml::parse_float;

/// `fov` with `fov_axis` (x), or `focal_length` (50mm).
pub(super) fn field_of_view(reader: &mut PluginReader<'_>) -> Result<FieldOfView, SceneError> {
    let axis = reader.choice(
        "fov_axis",
        &[
            ("x", FovAxis::X),
            ("y", FovAxis::Y),
            ("diagonal", FovAxis::Diagonal),
            ("smaller", FovAxis::Smaller),
            ("larger", FovAxis::Larger),
        ],
    )?;
    let focal_length = reader.string("focal_length")?;
    match (reader.float("fov")?, focal_length) {
        (Some(_), Some(_)) => {
            Err(reader.error("focal_length", "give either “fov” or “focal_length”"))
        }
        (Some(degrees), None) if degrees > 0.0 && degrees < 180.0 => {
            Ok(FieldOfView::Angle { degrees, axis })
        }
        (Some(degrees), None) => {
            let message = format!("“fov” must lie between 0 and 180 degrees, but is {degrees}");
            Err(reader.error("fov", message))
        }
        (None, text) => {
            let text = text.unwrap_or("50mm");
            let millimetres = parse_float(text.strip_suffix("mm").unwrap_or(text));
            millimetres
                .map(|millimetres| FieldOfView::FocalLength { millimetres })
                .ok_or_else(|| reader.error("focal_length", format!("“{text}” is no focal length")))
        }
    }
}
