//! Participating media.

mod phase;
pub(super) mod volume;

use alloc::boxed::Box;
use alloc::format;

use etendue_math::Spectrum;

use super::reader::PluginReader;
use super::value::{Role, color_and_curve_or};
use super::{Context, Family};
use crate::SceneError;
use crate::effect::Element;
use crate::medium::{Boundary, Density, Extinction, Medium, MediumCurves, MediumId, Phase, Volume};
use crate::xml::{Kind, NodeId};

/// The media there are.
const MEDIA: &Family<Medium> = &[("heterogeneous", heterogeneous), ("homogeneous", homogeneous)];

/// The medium a node describes, translated once however often it is referred to.
fn translate(context: &mut Context<'_>, id: NodeId) -> Result<MediumId, SceneError> {
    if let Some(&medium) = context.medium_ids.get(&id) {
        return Ok(medium);
    }
    let node = context.description.node(id);
    let medium = context.translate(MEDIA, node)?;
    let medium_id = MediumId(context.media.list.len() as u32);
    context.media.list.push(medium);
    context.origins.note(Element::Medium(medium_id), node);
    context.medium_ids.insert(id, medium_id);
    Ok(medium_id)
}

/// The media named `interior` and `exterior` inside a shape.
pub(super) fn boundary<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Option<Boundary>, SceneError> {
    let mut boundary = None;
    for child in reader.children(Kind::Medium, context) {
        let sides: &mut Boundary = boundary.get_or_insert_default();
        let side = match child.name.as_str() {
            "interior" => &mut sides.interior,
            "exterior" => &mut sides.exterior,
            _ => {
                let message =
                    format!("{} does not say on which side the medium is", reader.title());
                let help =
                    "name it “interior” or “exterior”, as in <ref name=\"interior\" id=\"…\"/>";
                return Err(SceneError::scene(child.location.clone(), message).help(help));
            }
        };
        *side = Some(translate(context, child.node)?);
    }
    Ok(boundary)
}

/// The medium inside a sensor.
pub(super) fn around<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Option<MediumId>, SceneError> {
    let child = reader.child(Kind::Medium, context)?;
    child.map(|child| translate(context, child.node)).transpose()
}

/// `sigma_t` (colour, 1) and what all media have; or, as in version 0.6, `sigma_s` and `sigma_a` in the place of `sigma_t` and
/// `albedo`.
fn homogeneous<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Medium, SceneError> {
    if let Some(name) = ["sigma_s", "sigma_a"].into_iter().find(|name| reader.has(name)) {
        return scattering_and_absorption(reader, context, name);
    }
    let scale = scale(reader)?;
    if reader.has("sigma_t") && volume::is_volume(reader, context, "sigma_t") {
        let message = "the “sigma_t” of a homogeneous medium cannot be a volume";
        return Err(reader.error("sigma_t", message).help("a heterogeneous medium may have one"));
    }
    let (sigma_t, curve) = color_and_curve_or(reader, context, "sigma_t", Role::Material, 1.0)?;
    let sigma_t = sigma_t * scale;
    if !sigma_t.to_array().iter().all(|sigma| sigma.is_finite()) {
        return Err(reader.error("scale", "“sigma_t” times “scale” is too large"));
    }
    let mut medium = medium(reader, context, Extinction::Homogeneous(sigma_t))?;
    medium.curves.extinction = curve.map(|curve| curve.map(|sigma| sigma * f64::from(scale)));
    Ok(medium)
}

/// `sigma_s` and `sigma_a` (colours, 0): `σt = σs + σa`, and the albedo is `σs / σt`. `given` is one that is there.
fn scattering_and_absorption<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    given: &str,
) -> Result<Medium, SceneError> {
    if let Some(other) = ["sigma_t", "albedo"].into_iter().find(|name| reader.has(name)) {
        return Err(reader.error(given, format!("give either “{given}” or “{other}”")));
    }
    let scale = scale(reader)?;
    let [s, a] = [
        color_and_curve_or(reader, context, "sigma_s", Role::Material, 0.0)?.0 * scale,
        color_and_curve_or(reader, context, "sigma_a", Role::Material, 0.0)?.0 * scale,
    ];
    let sigma_t = s + a;
    if !sigma_t.to_array().iter().all(|sigma| sigma.is_finite()) {
        return Err(reader.error("scale", "“sigma_s” and “sigma_a” times “scale” are too large"));
    }
    let albedo = s.zip(sigma_t, |s, t| if t > 0.0 { s / t } else { 0.0 });
    let medium = medium(reader, context, Extinction::Homogeneous(sigma_t))?;
    Ok(Medium { albedo: Volume::constant(albedo), ..medium })
}

/// `sigma_t` (volume, 1) and what all media have.
fn heterogeneous<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Medium, SceneError> {
    let scale = scale(reader)?;
    let sigma_t = volume::or(reader, context, "sigma_t", Role::Material, 1.0)?;
    let density = Density::new(sigma_t, scale).map_err(|thickness| {
        let message = format!(
            "the medium is too dense: its optical thickness, “sigma_t” times “scale” times its \
             extent, is {thickness:.3e}"
        );
        let help = format!("up to {:e} is possible", Density::THICKEST);
        reader.error("sigma_t", message).help(help)
    })?;
    medium(reader, context, Extinction::Heterogeneous(Box::new(density)))
}

fn scale(reader: &mut PluginReader<'_>) -> Result<f32, SceneError> {
    Ok(reader.float_in("scale", 1.0, "not negative", |scale| scale >= 0.0)? as f32)
}

/// What all media have: `albedo` (volume, 0.75), `sample_emitters` (true), one phase function
/// (isotropic).
fn medium<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    extinction: Extinction,
) -> Result<Medium, SceneError> {
    let (albedo, curve) =
        volume::with_curve_or(reader, context, "albedo", Role::Reflectance, 0.75)?;
    let curves = MediumCurves { albedo: curve, ..MediumCurves::default() };
    let samples_lights = reader.boolean("sample_emitters", true)?;
    // Whether colours differ is seen from the values.
    reader.ignore(&["has_spectral_extinction"]);
    let phase = match reader.child(Kind::Phase, context)? {
        Some(child) => phase::translate(context, child.node)?,
        None => Phase::Isotropic,
    };
    Ok(Medium { extinction, albedo, curves, phase, samples_lights })
}
