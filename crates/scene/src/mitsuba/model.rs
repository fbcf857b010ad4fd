//! A glTF model as a scene.

use alloc::format;
use std::path::Path;

use super::origins::Origin;
use super::sensor::Sensor;
use super::{Context, LoadOptions, LoadedScene, bare, film, sampler, scene};
use crate::camera::Camera;
use crate::film::Film;
use crate::gltf::{self, Model, View};
use crate::load::Sandbox;
use crate::scene::{PathSettings, SamplingSettings};
use crate::{Location, SceneError};

/// The model of a file: in the light that it has, else in white light from everywhere; seen by its first camera, else by one that
/// frames it.
///
/// Paths know media where there are some, and where light passes surfaces straight on: lights of a point or a direction would
/// not be seen behind them.
///
/// # Errors
/// A file that is no model, a bsdf that is none.
pub(super) fn scene(
    path: &Path,
    options: &LoadOptions,
    sandbox: Sandbox,
) -> Result<LoadedScene, SceneError> {
    let description = bare::described(path, options)?;
    let mut context = Context::new(&description, options, sandbox);
    let Model {
        textures,
        materials,
        geometry,
        surfaces,
        lights,
        media,
        view,
        warnings,
        files,
        places,
    } = gltf::load(path, &context.sandbox)?;
    context.textures = textures;
    context.materials = materials;
    context.geometry = geometry;
    context.surfaces = surfaces;
    context.lights = lights;
    context.media = media;
    context.warnings.extend(warnings);
    context.files.extend(files);
    for (element, place) in places {
        let location = Location::file(path);
        context.origins.note_place(element, Origin { element: place, location });
    }
    if let Some(material) = bare::given(&mut context)? {
        for surface in &mut context.surfaces {
            surface.material = material;
        }
    }
    if context.lights.is_empty() {
        context.lights.push(bare::WHITE_SKY);
    }
    let sensor = view.map(|view| sensor(&view, &context)).transpose()?;
    let passes = |surface: &crate::SurfaceInfo| context.materials.may_pass(surface.material);
    let volumes = !context.media.list.is_empty() || context.surfaces.iter().any(passes);
    scene::assemble(context, sensor, PathSettings { volumes, ..PathSettings::default() })
}

/// The longer side of a picture, in pixels.
const LONGER_SIDE: u32 = film::DEFAULT_SIZE[0];

/// The sensor of a camera: its picture has the aspect that the file states.
fn sensor(view: &View, context: &Context<'_>) -> Result<Sensor, SceneError> {
    let file = || Location::file(context.file());
    let size = match view.aspect {
        Some(aspect) => {
            let longer = f64::from(LONGER_SIDE);
            // A film has a pixel at least.
            [aspect.min(1.0), aspect.recip().min(1.0)].map(|side| (side * longer).round() as u32)
        }
        None => film::DEFAULT_SIZE,
    };
    let film = film::overridden(Film::new(size), context, |_| file())?;
    let sampling = sampler::with_overrides(SamplingSettings::default(), context);
    let [width, height] = film.size.map(f64::from);
    let (projection, scale) = view.lens.projection(width / height);
    let refused = |error: &dyn core::fmt::Display| {
        SceneError::scene(file(), format!("its camera cannot be used: {error}"))
    };
    let to_world = view.scaled(scale).map_err(|error| refused(&error))?;
    let [near, far] = view.clip;
    let camera =
        Camera::new(projection, to_world, near, far, film.size).map_err(|error| refused(&error))?;
    Ok(Sensor { camera, film, sampling })
}
