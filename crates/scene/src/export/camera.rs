//! The camera with its film and its sampler.

use alloc::vec::Vec;

use etendue_math::glam::{DAffine3, DMat3, DVec3};

use super::element::Element;
use super::exporter::Exporter;
use super::values::{float, number, string, to_world};
use super::{Loss, film};
use crate::camera::{FieldOfView, FovAxis, Projection};

/// Mitsuba's clipping distances.
const CLIP: [f32; 2] = [1e-2, 1e4];

/// How far the length of an axis may be from 1 for Mitsuba to take the placement of a camera for a rotation.
const TOLERANCE: f64 = 1e-4;

/// The sensor of a scene.
pub(super) fn sensor(exporter: &mut Exporter<'_>) -> Element {
    let camera = &exporter.scene.camera;
    let mut affine = *camera.to_world().affine();
    let mut scale = 1.0;
    let is_lens =
        matches!(camera.projection(), Projection::Perspective { .. } | Projection::ThinLens { .. });
    if is_lens {
        scale = unscale(exporter, &mut affine);
    }
    let (kind, parameters) = match camera.projection() {
        Projection::Perspective { field_of_view: view, principal_point_offset: [x, y] } => {
            let offset = |name, x: f32| (x != 0.0).then(|| float(name, x));
            let [x, y] =
                [offset("principal_point_offset_x", x), offset("principal_point_offset_y", y)];
            ("perspective", field_of_view(view).into_iter().chain([x, y]).collect())
        }
        Projection::ThinLens { field_of_view: view, aperture_radius, focus_distance } => {
            let lens = [
                Some(float("aperture_radius", aperture_radius * scale as f32)),
                Some(float("focus_distance", focus_distance * scale as f32)),
            ];
            ("thinlens", field_of_view(view).into_iter().chain(lens).collect())
        }
        Projection::Orthographic => ("orthographic", Vec::new()),
        Projection::RadianceMeter => ("radiancemeter", Vec::new()),
        Projection::IrradianceMeter => ("irradiancemeter", Vec::new()),
    };
    let clips = ["near_clip", "far_clip"].into_iter().zip(camera.clip()).zip(CLIP);
    // Meters have none.
    let has_clips = is_lens || camera.projection() == Projection::Orthographic;
    let clips = clips.filter(|((_, own), usual)| has_clips && own != usual);
    let around = exporter.scene.media.around_camera;
    Element::plugin("sensor", kind)
        .with_all(parameters.into_iter().flatten())
        .with_all(clips.map(|((name, own), _)| float(name, own)))
        .with_all(to_world(&affine))
        .with_all(around.and_then(|medium| exporter.medium("medium", medium)))
        .with(film::sampler(exporter))
        .with(film::film(exporter))
}

/// Takes the scaling out of a placement, which Mitsuba has none of: gives its factor.
///
/// What is seen through a pinhole does not depend on it; the sizes of a lens are multiplied by it.
fn unscale(exporter: &mut Exporter<'_>, affine: &mut DAffine3) -> f64 {
    let DMat3 { x_axis: x, y_axis: y, z_axis: z } = affine.matrix3;
    let lengths = [x, y, z].map(DVec3::length);
    let is_rotation = lengths.iter().all(|length| (length - 1.0).abs() <= TOLERANCE);
    let scale = if is_rotation { 1.0 } else { lengths[2] };
    let like = |a: f64, b: f64| (a - b).abs() <= TOLERANCE * b;
    let is_upright = [(x, y), (y, z), (z, x)]
        .iter()
        .all(|(a, b)| a.dot(*b).abs() <= TOLERANCE * a.length() * b.length());
    if !is_upright || !like(lengths[0], lengths[2]) || !like(lengths[1], lengths[2]) {
        exporter.losses.insert(Loss::StretchedCamera);
        // Looks where it looked, with the same side up.
        let (z, handed) = (z.normalize(), affine.matrix3.determinant().signum());
        let y = (y - z * z.dot(y)).normalize();
        affine.matrix3 = DMat3::from_cols(y.cross(z) * handed, y, z);
    } else if !is_rotation {
        affine.matrix3 = DMat3::from_cols(x / lengths[0], y / lengths[1], z / lengths[2]);
    }
    scale
}

/// `fov` with `fov_axis`, or `focal_length`.
pub(super) fn field_of_view(view: FieldOfView) -> [Option<Element>; 2] {
    match view {
        FieldOfView::FocalLength { millimetres } => {
            [Some(string("focal_length", &(number(millimetres) + "mm"))), None]
        }
        FieldOfView::Angle { degrees, axis } => {
            let axis = match axis {
                FovAxis::X => "x",
                FovAxis::Y => "y",
                FovAxis::Diagonal => "diagonal",
                FovAxis::Smaller => "smaller",
                FovAxis::Larger => "larger",
            };
            [Some(float("fov", degrees)), Some(string("fov_axis", axis))]
        }
    }
}
