//! Textures: an image, how it is looked up, and what of it.

use alloc::format;

use etendue_math::glam::{DMat4, DVec4};
use etendue_math::{Real, Spectrum};

use super::builder::Builder;
use super::json::Json;
use crate::effect::Element;
use crate::texture::{Bitmap, Filter, Product, Texture, TextureId, Textures, UvTransform, Wrap};
use crate::{Color, SceneError};

const TRANSFORM: &str = "KHR_texture_transform";

/// What of an image is looked up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Part {
    /// Its colour, in sRGB encoding.
    Color,
    /// One channel, 0 to 3, as a plain number.
    Channel(usize),
    /// Directions in the frame of the surface.
    Normal {
        /// The factor of x and y.
        scale: Number,
        /// Whether the texture is mirrored on the surface.
        is_mirrored: bool,
    },
    /// The [gloss](gloss) of a clear coat whose roughness is the second channel times a factor.
    Gloss(Number),
}

/// A number as a part of a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Number(u32);

impl From<f32> for Number {
    fn from(number: f32) -> Self {
        Self(number.to_bits())
    }
}

impl From<Number> for f32 {
    fn from(Number(bits): Number) -> Self {
        Self::from_bits(bits)
    }
}

/// What makes a texture another one.
pub(super) type Key = (usize, Part, [u8; 2], bool, [Number; 6]);

/// Gloss of the coat whose facets have the width of a roughness: `α = 0.1 − 0.099 gloss` here, `α = roughness²` there.
///
/// Coats that are rougher than a root of 0.1 are as rough as they can be.
pub(super) fn gloss(roughness: f32) -> f32 {
    ((0.1 - roughness * roughness) / 0.099).clamp(0.0, 1.0)
}

/// The set of texture coordinates that a reference to a texture names.
pub(super) fn set(reference: &Json<'_>) -> Result<usize, SceneError> {
    let own = reference.index("texCoord")?;
    let transform = reference.extension(TRANSFORM)?;
    let other = transform.map(|transform| transform.index("texCoord")).transpose()?.flatten();
    Ok(other.or(own).unwrap_or(0))
}

/// The texture that a reference names.
///
/// # Errors
/// What does not exist or cannot be read.
pub(super) fn of(
    builder: &mut Builder<'_>,
    reference: &Json<'_>,
    part: Part,
) -> Result<TextureId, SceneError> {
    let document = builder.document();
    let Some((_, texture)) = document.named(reference, "index", "textures")? else {
        return Err(reference.error("has no “index”"));
    };
    let Some((image, json)) = document.named(&texture, "source", "images")? else {
        let error = texture.error("has no “source”, or one that only an extension knows");
        return Err(error.help("export the model with PNG or JPEG images"));
    };
    let (wraps, filter) = match document.named(&texture, "sampler", "samplers")? {
        Some((_, sampler)) => look_up(&sampler)?,
        None => ([Wrap::Repeat; 2], Filter::Bilinear),
    };
    let (uv, key) = transform(reference)?;
    if matches!(part, Part::Normal { .. }) && (key[1], key[2]) != (0.0.into(), 0.0.into()) {
        builder
            .warn(&reference.warning("the directions of a turned normal map do not turn with it"));
    }
    let key = (image, part, wraps.map(|wrap| wrap as u8), filter == Filter::Nearest, key);
    if let Some(&texture) = builder.textures_made.get(&key) {
        return Ok(texture);
    }
    let pixels = builder.pixels(image, &json)?;
    let image = match part {
        Part::Channel(3) if !pixels.has_alpha() => return Ok(builder.constant(1.0)),
        Part::Color => pixels.color(),
        Part::Channel(channel) => pixels.channel(channel),
        Part::Normal { scale, is_mirrored } => pixels.normals(scale.into(), is_mirrored),
        Part::Gloss(factor) => pixels.mapped(1, |roughness| gloss(roughness * f32::from(factor))),
    };
    let image = image.map_err(|error| json.error(error))?;
    builder.buffers.unfold(document.file(), image.bytes(), &json)?;
    let bitmap = Bitmap::new(image, filter, wraps[0], uv).with_wraps(wraps);
    let id = builder.model.textures.add(Texture::Bitmap(bitmap));
    builder.note(Element::Texture(id), &json)?;
    builder.textures_made.insert(key, id);
    Ok(id)
}

/// How a sampler looks up images. Levels of detail are not used: pixels are means of many samples.
fn look_up(sampler: &Json<'_>) -> Result<([Wrap; 2], Filter), SceneError> {
    let wrap = |name: &str| {
        let Some(value) = sampler.get(name)? else { return Ok(Wrap::Repeat) };
        match value.as_index()? {
            33071 => Ok(Wrap::Clamp),
            33648 => Ok(Wrap::Mirror),
            10497 => Ok(Wrap::Repeat),
            other => Err(value.error(format!("{other} is none of 33071, 33648 and 10497"))),
        }
    };
    let filter = match sampler.get("magFilter")? {
        None => Filter::Bilinear,
        Some(value) => match value.as_index()? {
            9728 => Filter::Nearest,
            9729 => Filter::Bilinear,
            other => return Err(value.error(format!("{other} is neither 9728 nor 9729"))),
        },
    };
    Ok(([wrap("wrapS")?, wrap("wrapT")?], filter))
}

/// What is done to texture coordinates, and the same as a key: the matrix by columns.
///
/// ```text
/// u' = T R S u    R = (cos φ, sin φ; −sin φ, cos φ)
/// ```
///
/// # Source
/// `KHR_texture_transform`, whose turns are anticlockwise in a picture, with v from its top.
fn transform(reference: &Json<'_>) -> Result<(UvTransform, [Number; 6]), SceneError> {
    let mut columns = [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]];
    if let Some(json) = reference.extension(TRANSFORM)? {
        let offset = json.numbers::<2>("offset")?.unwrap_or([0.0; 2]);
        let scale = json.numbers::<2>("scale")?.unwrap_or([1.0; 2]);
        let (sin, cos) = Real::sin_cos(json.number("rotation")?.unwrap_or(0.0));
        // Not −0: keys compare bits.
        columns =
            [[cos * scale[0], 0.0 - sin * scale[0]], [sin * scale[1], cos * scale[1]], offset];
    }
    let column = |i: usize| DVec4::new(columns[i][0], columns[i][1], 0.0, 0.0);
    let matrix = DMat4::from_cols(column(0), column(1), DVec4::Z, column(2) + DVec4::W);
    let Some(uv) = UvTransform::from_matrix4(matrix) else {
        return Err(reference.error("the transform of its coordinates is beyond single precision"));
    };
    let [[a, b], [c, d], [e, f]] = columns;
    Ok((uv, [a, b, c, d, e, f].map(|x| Number::from(x as f32))))
}

/// The product of two textures; of constants a constant.
pub(super) fn product(textures: &mut Textures, a: TextureId, b: TextureId) -> TextureId {
    let one = Color::splat(1.0);
    match (constant(textures, a), constant(textures, b)) {
        (Some(a), Some(b)) => textures.constant(a * b),
        (Some(factor), None) if factor == one => b,
        (None, Some(factor)) if factor == one => a,
        (Some(factor), None) | (None, Some(factor)) if factor.is_black() => {
            textures.constant(factor)
        }
        _ => textures.add(Texture::Product(Product { factors: [a, b] })),
    }
}

/// The colour of a texture that is the same everywhere.
pub(super) fn constant(textures: &Textures, id: TextureId) -> Option<Color> {
    match textures.get(id) {
        Some(&Texture::Constant(color)) => Some(color),
        _ => None,
    }
}
