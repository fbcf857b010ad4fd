//! Volumes.

use alloc::vec::Vec;

use etendue_math::Spectrum as _;

use super::element::Element;
use super::exporter::Exporter;
use super::textures::Meaning;
use super::values::{string, to_world};
use crate::Color;
use crate::color::Curve;
use crate::medium::{GridFilter, PlacedGrid, Volume, VolumeGrid};
use crate::texture::Wrap;

/// A power of two that a colour is at most 1 when divided by: Mitsuba takes no larger one, and a factor beside it.
pub(super) fn unit(color: Color) -> f32 {
    let mut unit = 1.0_f32;
    while color.max_channel() > unit {
        unit *= 2.0;
    }
    unit
}

/// A volume as the parameter `name`: a colour where it is one that nothing bounds, divided by `unit`.
pub(super) fn parameter(
    exporter: &mut Exporter<'_>,
    name: &str,
    volume: &Volume,
    meaning: Meaning,
    curve: Option<&Curve>,
    unit: f32,
) -> Element {
    let is_bounded = to_world(volume.to_world().affine()).is_some();
    if volume.placed_grid().is_some() || is_bounded {
        return plugin(exporter, volume, unit).named(name);
    }
    exporter.constant(name, volume.mean() * unit.recip(), curve, meaning)
}

/// A volume as a plugin; one that is the same everywhere divided by `unit`.
pub(super) fn plugin(exporter: &mut Exporter<'_>, volume: &Volume, unit: f32) -> Element {
    let place = to_world(volume.to_world().affine());
    let Some(placed) = volume.placed_grid() else {
        let color = volume.mean() * unit.recip();
        let value = exporter.constant("value", color, None, Meaning::Matter);
        return Element::plugin("volume", "constvolume").with(value).with_all(place);
    };
    let PlacedGrid { grid, filter, wrap, .. } = placed;
    let name = exporter.name("volume");
    let filename = exporter.file(&name, "vol", vol(grid));
    let filter = match filter {
        GridFilter::Trilinear => None,
        GridFilter::Nearest => Some(string("filter_type", "nearest")),
    };
    let wrap = match wrap {
        Wrap::Clamp => None,
        Wrap::Repeat => Some(string("wrap_mode", "repeat")),
        Wrap::Mirror => Some(string("wrap_mode", "mirror")),
    };
    Element::plugin("volume", "gridvolume")
        .with(filename)
        .with_all(filter)
        .with_all(wrap)
        .with_all(place)
}

/// The beginning of a volume file of values of single precision in the unit cube.
pub(super) fn header(size: [u32; 3], channels: u32) -> Vec<u8> {
    let mut bytes = Vec::from(*b"VOL\x03");
    bytes.extend(1_i32.to_le_bytes());
    bytes.extend(size.iter().chain([&channels]).flat_map(|n| n.to_le_bytes()));
    let bounds = [0.0_f32, 0.0, 0.0, 1.0, 1.0, 1.0];
    bytes.extend(bounds.iter().flat_map(|x| x.to_le_bytes()));
    bytes
}

/// A grid as Mitsuba's volume file, in the unit cube; [`parse_volume`](crate::load::parse_volume) says how.
pub(super) fn vol(grid: &VolumeGrid) -> Vec<u8> {
    let size = grid.size();
    let channels = if grid.has_colours() { 3 } else { 1 };
    let mut bytes = header(size, channels);
    for z in 0..size[2] {
        for y in 0..size[1] {
            for x in 0..size[0] {
                let values = grid.cell([x, y, z]).to_array();
                bytes.extend(values[..channels as usize].iter().flat_map(|v| v.to_le_bytes()));
            }
        }
    }
    bytes
}
