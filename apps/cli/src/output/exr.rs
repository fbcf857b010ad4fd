//! OpenEXR: linear, half or float, with metadata.

use std::io::Cursor;

use ::exr::meta::attribute::AttributeValue;
use ::exr::prelude::{
    Encoding, Image, Layer, LayerAttributes, SpecificChannels, Text, Vec2, WritableImage,
};
use etendue_renderer::Image as Picture;
use half::f16;

use super::{EncodeResult, Metadata};

/// Sample type of an EXR file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Precision {
    /// 16-bit floating point; values beyond 65 504 become the largest finite half.
    Half,
    /// 32-bit floating point.
    Float,
}

pub(super) fn encode(
    bytes: &mut Vec<u8>,
    picture: &Picture,
    precision: Precision,
    metadata: &Metadata,
) -> EncodeResult {
    let [width, height] = picture.size().map(|n| n as usize);
    let at =
        |position: Vec2<usize>| picture.pixels()[position.y() * width + position.x()].to_array();
    let software_name = Some(Text::from("etendue"));
    let mut attributes = LayerAttributes { software_name, ..LayerAttributes::default() };
    for (name, value) in metadata.entries() {
        let value = AttributeValue::Text(Text::new_or_none(&value).unwrap_or_default());
        attributes.other.insert(Text::from(name), value);
    }
    let encoding = Encoding::SMALL_LOSSLESS;
    let mut cursor = Cursor::new(bytes);
    match precision {
        Precision::Float => {
            let channels = SpecificChannels::rgb(|p| {
                let [r, g, b] = at(p);
                (r, g, b)
            });
            Image::from_layer(Layer::new((width, height), attributes, encoding, channels))
                .write()
                .to_buffered(&mut cursor)?;
        }
        Precision::Half => {
            let channels = SpecificChannels::rgb(|p| {
                let [r, g, b] = at(p).map(half_or_largest);
                (r, g, b)
            });
            Image::from_layer(Layer::new((width, height), attributes, encoding, channels))
                .write()
                .to_buffered(&mut cursor)?;
        }
    }
    Ok(())
}

fn half_or_largest(x: f32) -> f16 {
    let largest = f16::MAX.to_f32();
    f16::from_f32(if x.is_nan() { x } else { x.clamp(-largest, largest) })
}
