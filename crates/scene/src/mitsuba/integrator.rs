//! Integrators, all of which are our path tracer.

use alloc::format;

use super::reader::PluginReader;
use super::{Context, Family};
use crate::SceneError;
use crate::effect::Element;
use crate::scene::{Layer, PathSettings, Shows};
use crate::xml::{Kind, NodeId};

/// The integrators there are.
const INTEGRATORS: &Family<PathSettings> = &[
    ("aov", aov),
    ("depth", distance),
    ("direct", direct),
    ("moment", moment),
    ("path", path),
    ("ptracer", particles),
    ("volpath", volumetric_path),
    ("volpathmis", volumetric_path),
];

/// Edges that all paths may have: those in a room that absorbs nothing would have them.
const MOST_EDGES: u32 = 1 << 16;

/// The paths the integrator of a scene asks for.
pub(super) fn translate(context: &mut Context<'_>, id: NodeId) -> Result<PathSettings, SceneError> {
    let node = context.description.node(id);
    context.origins.note(Element::Paths, node);
    context.translate(INTEGRATORS, node)
}

/// `max_depth` (−1, unlimited), `rr_depth` (5), `hide_emitters` (false), `strict_normals` (false), `spectral` (false).
fn path<'a>(
    reader: &mut PluginReader<'a>,
    _: &mut Context<'a>,
) -> Result<PathSettings, SceneError> {
    let max_depth = depth(reader.integer("max_depth")?.unwrap_or(-1)).map_err(|_| {
        reader.error("max_depth", "“max_depth” must be −1 (unlimited) or not negative")
    })?;
    let roulette = reader.integer("rr_depth")?.unwrap_or(5);
    let roulette_depth = u32::try_from(roulette).ok().filter(|&n| n > 0).ok_or_else(|| {
        reader.error("rr_depth", format!("“rr_depth” must be positive, not {roulette}"))
    })?;
    if max_depth.is_none_or(|depth| depth > MOST_EDGES) && roulette_depth > MOST_EDGES {
        let message = format!(
            "paths might never end: nothing bounds them before “rr_depth”, which is {roulette}"
        );
        let error = SceneError::resource(reader.location("rr_depth"), message);
        return Err(error.help(format!("state an “rr_depth” or a “max_depth” up to {MOST_EDGES}")));
    }
    Ok(PathSettings {
        max_depth,
        roulette_depth,
        hide_emitters: reader.boolean("hide_emitters", false)?,
        strict_normals: reader.boolean("strict_normals", false)?,
        volumes: false,
        spectral: reader.boolean("spectral", false)?,
        shows: Shows::Light,
    })
}

/// Paths from the lights, in Mitsuba; here the same light by paths from the camera. The parameters of `path`.
fn particles<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<PathSettings, SceneError> {
    // How the work is divided.
    reader.ignore(&["samples_per_pass"]);
    path(reader, context)
}

/// No light: how far away things are.
#[expect(clippy::unnecessary_wraps, reason = "the signature of its family")]
fn distance<'a>(_: &mut PluginReader<'a>, _: &mut Context<'a>) -> Result<PathSettings, SceneError> {
    Ok(PathSettings { shows: Shows::Distance, ..PathSettings::default() })
}

/// The parameters of `path`; knows media. Its `rr_depth` is the last number of edges at which no path is
/// ended by chance, that of `path` the first at which some are.
fn volumetric_path<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<PathSettings, SceneError> {
    let path = path(reader, context)?;
    let roulette_depth = path.roulette_depth.saturating_add(1);
    Ok(PathSettings { volumes: true, roulette_depth, ..path })
}

/// Direct light: paths of two edges. `hide_emitters` (false), `strict_normals` (false).
fn direct<'a>(
    reader: &mut PluginReader<'a>,
    _: &mut Context<'a>,
) -> Result<PathSettings, SceneError> {
    // How many samples go to lights and how many to surfaces is decided per path here.
    reader.ignore(&["shading_samples", "emitter_samples", "bsdf_samples"]);
    Ok(PathSettings {
        max_depth: Some(2),
        hide_emitters: reader.boolean("hide_emitters", false)?,
        strict_normals: reader.boolean("strict_normals", false)?,
        ..PathSettings::default()
    })
}

/// A wrapper that adds layers: `aovs` (pairs `name:type`, whose names are not kept), and one integrator, `path` if none.
fn aov<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<PathSettings, SceneError> {
    const LAYERS: [(&str, Layer); 6] = [
        ("albedo", Layer::Albedo),
        ("depth", Layer::Depth),
        ("position", Layer::Position),
        ("sh_normal", Layer::Normal),
        ("shape_index", Layer::Shape),
        ("uv", Layer::Uv),
    ];
    for item in reader.string("aovs")?.unwrap_or_default().split([',', ' ']) {
        let Some((_, kind)) = item.split_once(':') else {
            if item.is_empty() {
                continue;
            }
            return Err(reader.error("aovs", format!("“{item}” is no pair “name:type”")));
        };
        match LAYERS.iter().find(|(name, _)| *name == kind) {
            Some(&(_, layer)) => context.layers.push(layer),
            None => {
                let known = LAYERS.map(|(name, _)| name).join(", ");
                let error = reader.error("aovs", format!("there is no layer “{kind}”"));
                return Err(error.help(format!("there are {known}")));
            }
        }
    }
    match reader.children(Kind::Integrator, context)[..] {
        [] => Ok(PathSettings::default()),
        [inner] => translate(context, inner.node),
        [_, second, ..] => {
            let message = "“aov” can show one picture only";
            Err(SceneError::scene(second.location.clone(), message))
        }
    }
}

/// A wrapper that adds the second moment to the picture, which is not a matter of the scene here.
fn moment<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<PathSettings, SceneError> {
    match reader.children(Kind::Integrator, context)[..] {
        [inner] => translate(context, inner.node),
        _ => Err(reader.error("integrator", "“moment” needs one integrator inside")),
    }
}

/// A `max_depth` below −1.
pub(super) struct NegativeDepth;

/// The largest number of edges that a `max_depth` stands for; −1 is unlimited.
pub(super) fn depth(max_depth: i64) -> Result<Option<u32>, NegativeDepth> {
    match max_depth {
        -1 => Ok(None),
        0.. => Ok(Some(u32::try_from(max_depth).unwrap_or(u32::MAX))),
        _ => Err(NegativeDepth),
    }
}
