//! OpenEXR images.

use alloc::format;
use alloc::string::{String, ToString as _};
use alloc::vec;
use alloc::vec::Vec;
use std::io::Cursor;
use std::path::Path;

use ::exr::block::chunk::CompressedBlock;
use ::exr::block::reader::ChunksReader as _;
use ::exr::meta::MetaData;
use ::exr::prelude::{Compression, ReadChannels as _, ReadLayers as _, Vec2, read};

use crate::error::SceneError;

use super::{Image, check_size, malformed};

pub(super) fn parse(bytes: &[u8], path: &Path) -> Result<Image, SceneError> {
    let fail = |error| malformed(path, format!("{error}"));
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(fail)?;
    for header in meta.headers.iter().filter(|h| !h.deep) {
        let channels = &header.channels.list;
        let Vec2(width, height) = header.layer_size;
        check_size(width as u64, height as u64, channels.len(), bytes, path)?;
        if let Some(channel) = channels.iter().find(|c| c.sampling != Vec2(1, 1)) {
            let message = format!("the channel '{}' is subsampled", channel.name);
            return Err(malformed(path, message).help("convert the image to RGB"));
        }
    }
    if meta.headers.iter().any(|h| is_dwa(h.compression)) {
        check_dwa(bytes, &meta).map_err(|message| malformed(path, message))?;
    }
    // One thread: a panic on a worker of the decoder's own pool would end the process.
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(fail)?;
    let layer = image.layer_data;
    let list = &layer.channel_data.list;
    let names: Vec<String> = list.iter().map(|c| c.name.to_string()).collect();
    let Some(chosen) = choose(&names) else {
        let message = format!("no colours among the channels {}", names.join(", "));
        return Err(malformed(path, message).help("expected R G B, Y, or a single channel"));
    };
    let Vec2(width, height) = layer.size;
    let mut data = vec![0.0; width * height * chosen.len()];
    for (offset, &channel) in chosen.iter().enumerate() {
        let samples = data[offset..].iter_mut().step_by(chosen.len());
        samples.zip(list[channel].sample_data.values_as_f32()).for_each(|(to, from)| *to = from);
    }
    let (width, height) = (width as u32, height as u32);
    Ok(Image { width, height, channels: chosen.len(), data, srgb_decoded: false })
}

fn is_dwa(compression: Compression) -> bool {
    matches!(compression, Compression::DWAA(_) | Compression::DWAB(_))
}

/// Checks the sizes that DWA chunks declare. The decoder believes them: it would ask for up to 2⁶³
/// bytes and so end the process, which no caller can stop.
///
/// ```text
/// chunk    eleven u64: version, sizes of four compressed sections and of what they unfold to, mode
/// ```
///
/// # Source
/// OpenEXR, `internal_dwa_compressor.h`, `DataSizesSingle`.
fn check_dwa(bytes: &[u8], meta: &MetaData) -> Result<(), String> {
    const COUNTERS: usize = 11;
    /// Room for padding to blocks of 8 × 8 pixels, however small the image.
    const SLACK: u64 = 1 << 20;
    let chunks = ::exr::block::read(Cursor::new(bytes), false).and_then(|r| r.all_chunks(false));
    let mut chunks = chunks.map_err(|e| format!("{e}"))?;
    while let Some(chunk) = chunks.read_next_chunk() {
        let chunk = chunk.map_err(|e| format!("{e}"))?;
        let Some(header) = meta.headers.get(chunk.layer_index) else { continue };
        let content = match &chunk.compressed_block {
            CompressedBlock::ScanLine(block) => &block.compressed_pixels_le,
            CompressedBlock::Tile(block) => &block.compressed_pixels_le,
            _ => continue,
        };
        if !is_dwa(header.compression) {
            continue;
        }
        let place = header.get_block_data_indices(&chunk.compressed_block);
        let place = place.and_then(|indices| header.get_absolute_block_pixel_coordinates(indices));
        let pixels = place.map_err(|e| format!("{e}"))?.size.area();
        let raw = pixels.saturating_mul(header.channels.bytes_per_pixel);
        if content.len() == raw {
            continue; // stored as it is, without counters
        }
        let most = SLACK + 4 * raw as u64;
        let (counters, _) = content.as_chunks::<8>();
        let mut sizes = counters.iter().take(COUNTERS).map(|&c| u64::from_le_bytes(c));
        if let Some(size) = sizes.find(|&size| size > most) {
            return Err(format!("a DWA chunk declares {size} values, more than the image has"));
        }
    }
    Ok(())
}

/// The channels that make the picture, in order: `R G B` or `Y` with or without `A`, unnamed before
/// those of a group such as `diffuse.R`; else the only one.
fn choose(names: &[String]) -> Option<Vec<usize>> {
    let groups = names.iter().map(|name| name.rfind('.').map_or("", |dot| &name[..=dot]));
    for group in core::iter::once("").chain(groups) {
        let find = |channel| names.iter().position(|n| n.strip_prefix(group) == Some(channel));
        let colors = match (find("R"), find("G"), find("B"), find("Y")) {
            (Some(r), Some(g), Some(b), _) => vec![r, g, b],
            (_, _, _, Some(y)) if find("RY").is_none() && find("BY").is_none() => vec![y],
            _ => continue,
        };
        return Some(colors.into_iter().chain(find("A")).collect());
    }
    (names.len() == 1).then(|| vec![0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    #[test]
    fn unnamed_channels_come_before_groups_and_colours_before_luminance() {
        let chosen =
            |names: &[&str]| choose(&names.iter().map(ToString::to_string).collect::<Vec<_>>());
        assert_eq!(chosen(&["A", "B", "G", "R", "Z", "n.R"]), Some(vec![3, 2, 1, 0]));
        assert_eq!(chosen(&["a.Z", "b.A", "b.B", "b.G", "b.R"]), Some(vec![4, 3, 2, 1]));
        assert_eq!(chosen(&["A", "Y"]), Some(vec![1, 0]));
        assert_eq!(chosen(&["density"]), Some(vec![0]));
        assert_eq!(chosen(&["BY", "RY", "Y"]), None);
        assert_eq!(chosen(&["u", "v"]), None);
        assert_eq!(chosen(&[]), None);
    }
}
