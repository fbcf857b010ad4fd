//! OpenEXR: linear, half or float, with metadata.

use std::io::Cursor;
use std::path::Path;

use ::exr::meta::MetaData;
use ::exr::meta::attribute::AttributeValue;
use ::exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, Text,
    WritableImage,
};
use etendue_renderer::Image as Picture;
use half::f16;

use super::aov::{Channel, Plane, colors};
use super::metadata::PART;
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
    layers: &[Channel],
    precision: Precision,
    metadata: &Metadata,
) -> EncodeResult {
    let size = picture.size().map(|n| n as usize);
    let software_name = Some(Text::from("etendue"));
    let mut attributes = LayerAttributes { software_name, ..LayerAttributes::default() };
    for (name, value) in metadata.entries() {
        let value = AttributeValue::Text(Text::new_or_none(&value).unwrap_or_default());
        attributes.other.insert(Text::from(name), value);
    }
    let rgb = colors(["R", "G", "B"], |axis| {
        picture.pixels().iter().map(|pixel| pixel.to_array()[axis]).collect()
    });
    let channels = rgb.iter().chain(layers).map(|channel| {
        AnyChannel::new(Text::from(channel.name), samples(&channel.plane, precision))
    });
    let channels = AnyChannels::sort(channels.collect());
    // The picture of a part is looked at now and then, and noise all over: no time is spent on making it small.
    let encoding =
        if metadata.part.is_some() { Encoding::FAST_LOSSLESS } else { Encoding::SMALL_LOSSLESS };
    Image::from_layer(Layer::new((size[0], size[1]), attributes, encoding, channels))
        .write()
        .to_buffered(&mut Cursor::new(bytes))?;
    Ok(())
}

/// Bytes of the part of a render that follows an EXR picture; `None` where it is no EXR picture or says nothing of one.
pub(crate) fn part_length(path: &Path) -> Option<u64> {
    let meta = MetaData::read_from_file(path, false).ok()?;
    let mut attributes = meta.headers.into_iter().map(|header| header.own_attributes.other);
    match attributes.find_map(|mut other| other.remove(&Text::from(PART)))? {
        AttributeValue::Text(length) => length.to_string().parse().ok(),
        _ => None,
    }
}

/// Colours in the precision asked for; positions, depths and counts would not survive in half.
fn samples(plane: &Plane, precision: Precision) -> FlatSamples {
    match (plane, precision) {
        (Plane::Color(values), Precision::Half) => {
            FlatSamples::F16(values.iter().copied().map(half_or_largest).collect())
        }
        (Plane::Color(values), Precision::Float) | (Plane::Measure(values), _) => {
            FlatSamples::F32(values.clone())
        }
        (Plane::Count(values), _) => FlatSamples::U32(values.clone()),
    }
}

fn half_or_largest(x: f32) -> f16 {
    let largest = f16::MAX.to_f32();
    f16::from_f32(if x.is_nan() { x } else { x.clamp(-largest, largest) })
}
