//! Cameras.

use alloc::format;

use etendue_math::glam::{DAffine3, DVec3};

use super::document::Document;
use super::json::Json;
use super::node::Node;
use crate::SceneError;
use crate::camera::{FieldOfView, FovAxis, Projection};
use crate::geometry::{Transform, TransformError};

/// How the scene is seen.
#[derive(Clone, Debug)]
pub(crate) struct View {
    /// What is seen.
    pub(crate) lens: Lens,
    /// From the camera's frame, which looks along +z with +x to the left, to the world.
    pub(crate) to_world: Transform,
    /// Nothing nearer is seen, and nothing farther.
    pub(crate) clip: [f32; 2],
    /// Width over height, where the file says it.
    pub(crate) aspect: Option<f64>,
}

/// How much is seen, from the bottom to the top of the picture.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Lens {
    /// An angle in degrees.
    Perspective(f64),
    /// A length, half of it above the axis.
    Orthographic(f64),
}

/// Where what has no far plane ends: as far as rays can go without leaving the range of `f32`.
const FAR: f64 = 1e30;

/// The camera of the first node that has one.
///
/// Looking along −z with +x to the right, as here, is looking along +z with +x to the left in a frame turned by half a turn
/// about y. Scales of nodes change nothing.
///
/// # Errors
/// A camera that does not exist, or parameters outside their domain.
pub(super) fn first(document: &Document, nodes: &[Node<'_>]) -> Result<Option<View>, SceneError> {
    for Node { json, to_world, .. } in nodes {
        if let Some((_, camera)) = document.named(json, "camera", "cameras")? {
            let frame = frame(to_world, to_world.matrix3.y_axis);
            let frame =
                frame.map_err(|error| json.error(format!("cannot hold a camera: {error}")))?;
            return of(&camera, &frame).map(Some);
        }
    }
    Ok(None)
}

/// The frame at a node whose +z is the node's −z, with +y on the side of `up`.
///
/// # Errors
/// A node that has no such direction, or one along `up`; a place out of range.
pub(super) fn frame(node: &DAffine3, up: DVec3) -> Result<Transform, TransformError> {
    let turned = Transform::look_at(DVec3::ZERO, -node.matrix3.z_axis, up)?;
    Transform::translate(node.translation)?.compose(&turned)
}

fn of(camera: &Json<'_>, to_world: &Transform) -> Result<View, SceneError> {
    let kind = camera.need("type")?;
    let name = kind.as_text()?;
    if !["perspective", "orthographic"].contains(&name) {
        return Err(kind.error(format!("“{name}” is neither perspective nor orthographic")));
    }
    let json = camera.need(name)?;
    let positive = |name: &str, value: f64| {
        if value > 0.0 {
            Ok(value)
        } else {
            Err(json.error(format!("{name} must be positive, not {value}")))
        }
    };
    let (lens, aspect, near) = if name == "perspective" {
        let angle = json.need("yfov")?;
        let fov = angle.as_number()?.to_degrees();
        if !(fov > 0.0 && fov < 180.0) {
            return Err(angle.error("must lie between 0 and π"));
        }
        let aspect = json.number("aspectRatio")?.map(|aspect| positive("aspectRatio", aspect));
        (
            Lens::Perspective(fov),
            aspect.transpose()?,
            positive("znear", json.need("znear")?.as_number()?)?,
        )
    } else {
        let [x, y] = ["xmag", "ymag"].map(|name| json.need(name)?.as_number());
        // Mirrored pictures are made by negative ones, which nobody is known to mean.
        let (x, y) = (positive("xmag", x?)?, positive("ymag", y?)?);
        // A near plane may lie in the camera itself; rays start a little in front of it.
        let near = json.need("znear")?.as_number()?.max(f64::from(f32::MIN_POSITIVE));
        (Lens::Orthographic(2.0 * y), Some(x / y), near)
    };
    let far = json.number("zfar")?.unwrap_or(FAR);
    if near >= far {
        return Err(json.error(format!("zfar must be larger than znear, {near}, not {far}")));
    }
    Ok(View { lens, to_world: *to_world, clip: [near as f32, far as f32], aspect })
}

impl Lens {
    /// The projection, and what the camera's frame is scaled by, for a film of `width / height`.
    pub(crate) fn projection(self, aspect: f64) -> (Projection, f64) {
        match self {
            Self::Perspective(degrees) => {
                let field_of_view = FieldOfView::Angle { degrees, axis: FovAxis::Y };
                (Projection::Perspective { field_of_view, principal_point_offset: [0.0; 2] }, 1.0)
            }
            // The film of an orthographic camera is two units wide.
            Self::Orthographic(height) => (Projection::Orthographic, 0.5 * height * aspect),
        }
    }
}

impl View {
    /// The camera's frame with its film stretched by `scale`.
    pub(crate) fn scaled(&self, scale: f64) -> Result<Transform, TransformError> {
        self.to_world.compose(&Transform::scale(DVec3::new(scale, scale, 1.0))?)
    }
}
