//! Images as OpenEXR files: single precision, compressed without loss.

use alloc::vec::Vec;
use std::io::Cursor;

use ::exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, Text,
    WritableImage as _,
};

use super::ExportError;
use crate::texture::BitmapImage;

/// The texels as they are held: linear, one channel where they are grey.
pub(super) fn exr(image: &BitmapImage) -> Result<Vec<u8>, ExportError> {
    let (width, height) = (image.width(), image.height());
    let names: &[&str] = if image.is_grey() { &["Y"] } else { &["R", "G", "B"] };
    let channel = |(index, &name): (usize, &&str)| {
        let texels = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
        let values = texels.map(|(column, row)| image.texel(column, row).to_array()[index]);
        AnyChannel::new(Text::from(name), FlatSamples::F32(values.collect()))
    };
    let channels = AnyChannels::sort(names.iter().enumerate().map(channel).collect());
    let size = (width as usize, height as usize);
    let layer = Layer::new(size, LayerAttributes::default(), Encoding::SMALL_LOSSLESS, channels);
    let mut bytes = Vec::new();
    Image::from_layer(layer).write().to_buffered(Cursor::new(&mut bytes))?;
    Ok(bytes)
}
