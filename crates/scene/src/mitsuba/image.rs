//! Images as textures and environment maps.

use alloc::format;

use super::Context;
use super::reader::PluginReader;
use crate::SceneError;
use crate::load::{Encoding, Image, load_image};
use crate::texture::{BitmapError, BitmapImage};

/// The image that the parameter `filename` names.
///
/// # Errors
/// A missing name, a file that is no image, texels that are NaN or infinite.
pub(super) fn image(
    reader: &mut PluginReader<'_>,
    context: &mut Context<'_>,
    encoding: Encoding,
) -> Result<BitmapImage, SceneError> {
    let Some(name) = reader.string("filename")? else {
        return Err(reader.error("filename", format!("{} has no “filename”", reader.title())));
    };
    let named = |mut error: SceneError| {
        let place = reader.location("filename");
        error.message = format!("{} (named at {place})", error.message);
        error
    };
    let path = reader.node().search.resolve(name).map_err(named)?;
    let image = load_image(&path, encoding).map_err(named)?;
    context.read(&path, size_of_val(image.data())).map_err(named)?;
    texels(&image).map_err(|e| reader.error("filename", format!("{name}: {e}")))
}

/// A loaded image as the texels of a texture.
///
/// # Errors
/// Texels that are NaN or infinite.
pub(super) fn texels(image: &Image) -> Result<BitmapImage, BitmapError> {
    let channels = image.channels() as u32;
    BitmapImage::from_f32(image.width(), image.height(), channels, image.data())
}
