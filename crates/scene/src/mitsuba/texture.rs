//! Textures.

use super::image::image;
use super::reader::PluginReader;
use super::value::{Role, color_or, texture_or};
use super::{Context, Family, medium, spectrum};
use alloc::format;

use crate::SceneError;
use crate::effect::Element;
use crate::load::Encoding;
use crate::texture::{
    AttributeTexture, Bitmap, Checkerboard, Filter, Texture, TextureId, VolumeTexture, Wrap,
};
use crate::xml::{NodeId, Property, Value};

/// The textures there are, spectra with a type included.
const TEXTURES: &Family<TextureId> = &[
    ("bitmap", bitmap),
    ("blackbody", spectrum::of_matter),
    ("checkerboard", checkerboard),
    ("d65", d65),
    ("irregular", spectrum::of_matter),
    ("mesh_attribute", mesh_attribute),
    ("rawconstant", raw_constant),
    ("regular", spectrum::of_matter),
    ("srgb", srgb),
    ("uniform", uniform),
    ("volume", volume),
];

/// The texture a node describes, translated once however often it is referred to.
pub(super) fn translate(context: &mut Context<'_>, id: NodeId) -> Result<TextureId, SceneError> {
    if let Some(&texture) = context.texture_ids.get(&id) {
        return Ok(texture);
    }
    let node = context.description.node(id);
    let texture = context.translate(TEXTURES, node)?;
    context.origins.note(Element::Texture(texture), node);
    context.texture_ids.insert(id, texture);
    Ok(texture)
}

fn bitmap<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<TextureId, SceneError> {
    // Version 0.6 asked for gamma 1 where today's files say raw.
    let linear = reader.float("gamma")?.is_some_and(|gamma| gamma == 1.0);
    let encoding = if reader.boolean("raw", linear)? { Encoding::Raw } else { Encoding::Srgb };
    let filter = reader.choice(
        "filter_type",
        &[
            ("bilinear", Filter::Bilinear),
            ("nearest", Filter::Nearest),
            // Version 0.6's filters across levels of detail.
            ("trilinear", Filter::Trilinear),
            ("ewa", Filter::Trilinear),
        ],
    )?;
    let wrap = reader.choice(
        "wrap_mode",
        &[("repeat", Wrap::Repeat), ("mirror", Wrap::Mirror), ("clamp", Wrap::Clamp)],
    )?;
    let uv = reader.uv_transform("to_uv")?;
    // How the image is stored, and how far levels of detail are stretched, which is not done here.
    reader.ignore(&["accel", "format", "cache", "max_anisotropy"]);
    let image = image(reader, context, encoding)?;
    Ok(context.textures.add(Texture::Bitmap(Bitmap::new(image, filter, wrap, uv))))
}

fn checkerboard<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<TextureId, SceneError> {
    let color0 = texture_or(reader, context, "color0", Role::Reflectance, 0.4)?;
    let color1 = texture_or(reader, context, "color1", Role::Reflectance, 0.2)?;
    let uv = reader.uv_transform("to_uv")?;
    Ok(context.textures.add(Texture::Checkerboard(Checkerboard { color0, color1, uv })))
}

/// `name`, which begins with `vertex_` or `face_`, and `scale` (1).
fn mesh_attribute<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<TextureId, SceneError> {
    let Some(name) = reader.string("name")? else {
        return Err(reader.error("name", "the attribute has no “name”"));
    };
    if !["vertex_", "face_"].iter().any(|owner| name.starts_with(owner)) {
        let message = format!("“{name}” begins with neither “vertex_” nor “face_”");
        return Err(reader.error("name", message));
    }
    let valid = |x| (0.0..=f64::from(f32::MAX)).contains(&x);
    let scale = reader.float_in("scale", 1.0, "not negative", valid)? as f32;
    Ok(context.textures.add(Texture::Attribute(AttributeTexture { name: name.into(), scale })))
}

/// `volume` (volume, 0.75), looked up where the surface is in the world.
fn volume<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<TextureId, SceneError> {
    let volume = medium::volume::or(reader, context, "volume", Role::Reflectance, 0.75)?;
    Ok(context.textures.add(Texture::Volume(VolumeTexture { volume })))
}

/// `<spectrum type="uniform">`
fn uniform<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<TextureId, SceneError> {
    texture_or(reader, context, "value", Role::Material, 1.0)
}

/// One or three numbers that are no colour: `value`.
fn raw_constant<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<TextureId, SceneError> {
    if let Some(Property { value: Value::Vector(v), .. }) = reader.property("value") {
        if v.min_element() < 0.0 {
            return Err(reader.error("value", "“value” must not be negative"));
        }
        return Ok(context.textures.constant(v.as_vec3().to_array().into()));
    }
    texture_or(reader, context, "value", Role::Material, 1.0)
}

/// `<spectrum type="srgb">`
fn srgb<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<TextureId, SceneError> {
    texture_or(reader, context, "color", Role::Material, 1.0)
}

/// `<spectrum type="d65">`, which is white in RGB.
fn d65<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<TextureId, SceneError> {
    let scale = reader.float_in("scale", 1.0, "not negative", |x| x >= 0.0)? as f32;
    let color = color_or(reader, context, "color", Role::Emission, 1.0)?;
    Ok(context.textures.constant(color * scale))
}
