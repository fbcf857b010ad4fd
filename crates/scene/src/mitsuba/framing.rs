//! A camera for scenes that come without one.

use alloc::format;

use etendue_math::glam::DVec3;
use etendue_math::{Real, Vector3};

use super::sensor::Sensor;
use super::{Context, film, sampler};
use crate::camera::{Camera, FieldOfView, FovAxis, Projection};
use crate::film::Film;
use crate::geometry::{Aabb, Transform};
use crate::scene::SamplingSettings;
use crate::{Location, SceneError};

/// The angle of view along the shorter side of the picture, in degrees.
const FIELD_OF_VIEW: f64 = 35.0;

/// From the scene towards the camera: from the front, a little from the right and from above.
const TOWARDS_CAMERA: DVec3 = DVec3::new(0.5, 0.45, 1.0);

/// A camera that sees the whole bounding sphere of `bounds`, y being up.
///
/// ```text
/// distance = radius / sin(fov / 2)
/// ```
///
/// # Errors
/// A picture without pixels, a scene too large for single precision.
pub(super) fn sensor(context: &Context<'_>, bounds: &Aabb) -> Result<Sensor, SceneError> {
    let file = || Location::file(context.file());
    let film = film::overridden(Film::new(film::DEFAULT_SIZE), context, |_| file())?;
    let refused = |error: &dyn core::fmt::Display| {
        SceneError::scene(file(), format!("no camera can frame the scene: {error}"))
    };
    let (center, radius) = if bounds.is_empty() {
        (DVec3::ZERO, 1.0)
    } else {
        let half_diagonal = 0.5 * Vector3::length(bounds.extent().as_dvec3());
        (bounds.center().as_dvec3(), half_diagonal.max(f64::MIN_POSITIVE))
    };
    let distance = radius / Real::sin(0.5 * FIELD_OF_VIEW.to_radians());
    let origin = center + TOWARDS_CAMERA.normalize() * distance;
    let to_world = Transform::look_at(origin, center, DVec3::Y).map_err(|error| refused(&error))?;
    let projection = Projection::Perspective {
        field_of_view: FieldOfView::Angle { degrees: FIELD_OF_VIEW, axis: FovAxis::Smaller },
        principal_point_offset: [0.0; 2],
    };
    let [near, far] = [1e-3, 1e3].map(|factor| (distance * factor) as f32);
    let camera =
        Camera::new(projection, to_world, near, far, film.size).map_err(|error| refused(&error))?;
    let sampling = sampler::with_overrides(SamplingSettings::default(), context);
    Ok(Sensor { camera, film, sampling })
}
