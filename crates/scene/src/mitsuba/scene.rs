//! The scene as a whole.

use alloc::format;

use super::reader::PluginReader;
use super::sensor::Sensor;
use super::{Context, LoadedScene, bsdf, emitter, framing, integrator, sensor, shape, texture};
use crate::scene::{PathSettings, Scene, SceneParts};
use crate::xml::Kind;
use crate::{Location, SceneError};

/// Translates everything a description holds.
///
/// # Errors
/// Whatever a plugin refuses.
pub(super) fn scene(mut context: Context<'_>) -> Result<LoadedScene, SceneError> {
    let root = context.description.root();
    let mut reader = PluginReader::new(root);
    let sensors = reader.children(Kind::Sensor, &context);
    if let Some(child) = sensors.first() {
        context.shutter =
            sensor::shutter(&mut PluginReader::new(context.description.node(child.node)))?;
    }
    for child in reader.children(Kind::Texture, &context) {
        texture::translate(&mut context, child.node)?;
    }
    for child in reader.children(Kind::Bsdf, &context) {
        bsdf::translate(&mut context, child.node)?;
    }
    // These mean something only where a plugin refers to them.
    for kind in [Kind::Medium, Kind::Phase, Kind::Volume, Kind::Film, Kind::Sampler] {
        reader.children(kind, &context);
    }
    for child in reader.children(Kind::Shape, &context) {
        shape::add(&mut context, child.node)?;
    }
    for child in reader.children(Kind::Emitter, &context) {
        emitter::add(&mut context, child.node)?;
    }
    let path = match reader.child(Kind::Integrator, &context)? {
        Some(child) => integrator::translate(&mut context, child.node)?,
        None => PathSettings::default(),
    };
    if let (Some(child), Some(_)) = (sensors.first(), &context.meter) {
        let message = "the irradiance meter inside a shape is not used beside this sensor";
        context.warn(child.location.clone(), message);
    }
    let sensor = match sensors[..] {
        [] if context.meter.is_some() => context.meter.take(),
        [] => {
            context.warn(root.location.clone(), "there is no sensor: the camera frames the scene");
            None
        }
        [child] => Some(sensor::translate(&mut context, child.node)?),
        [first, second, ..] => {
            let message = "only the first sensor is used";
            context.warn(second.location.clone(), message);
            Some(sensor::translate(&mut context, first.node)?)
        }
    };
    // A choice between Mitsuba's acceleration structures.
    reader.ignore(&["embree_use_robust_intersections"]);
    reader.finish(&mut context)?;
    assemble(context, sensor, path)
}

/// Builds the acceleration structure and checks that the parts fit together. Without a sensor the
/// camera frames the scene.
///
/// # Errors
/// A depth that is none, a camera that cannot be placed, parts that do not fit.
pub(super) fn assemble(
    mut context: Context<'_>,
    sensor: Option<Sensor>,
    mut path: PathSettings,
) -> Result<LoadedScene, SceneError> {
    let geometry = core::mem::take(&mut context.geometry).build();
    let file = Location::file(context.file());
    let Sensor { camera, film, sampling } = match sensor {
        Some(sensor) => sensor,
        None => framing::sensor(&context, &geometry.bounds())?,
    };
    if let Some(depth) = context.options.max_depth {
        path.max_depth = integrator::depth(depth).map_err(|_| {
            SceneError::scene(file.clone(), format!("a path cannot have {depth} edges"))
        })?;
    }
    let is_bounded = context.surfaces.iter().any(|surface| surface.boundary.is_some());
    if !path.volumes && (is_bounded || context.media.around_camera.is_some()) {
        let message = "the integrator sees no media; “volpath” does";
        context.warn(file.clone(), message);
    }
    let Context {
        description, surfaces, materials, textures, lights, media, layers, origins, ..
    } = context;
    let mut files = description.files.clone();
    files.extend(context.files);
    let mut warnings = description.warnings.clone();
    warnings.extend(context.warnings);
    let parts = SceneParts {
        geometry,
        surfaces,
        materials,
        textures,
        lights,
        media,
        camera,
        film,
        sampling,
        path,
    };
    let scene = Scene::new(parts).map_err(|error| SceneError::scene(file, format!("{error}")))?;
    Ok(LoadedScene { scene, warnings, files, layers, origins })
}
