//! Films, filters and samplers.

use super::Loss;
use super::element::Element;
use super::exporter::Exporter;
use super::values::{boolean, float, integer};
use crate::film::{Crop, Film, ReconstructionFilter};
use crate::scene::{SamplerKind, SamplingSettings};

/// The film of a scene.
pub(super) fn film(exporter: &mut Exporter<'_>) -> Element {
    let Film { size, crop: Crop { offset, size: crop }, filter, sample_border } =
        exporter.scene.film;
    let named =
        |[x, y]: [&'static str; 2], [of_x, of_y]: [u32; 2]| [integer(x, of_x), integer(y, of_y)];
    let is_cropped = offset != [0, 0] || crop != size;
    let cropped = is_cropped.then(|| {
        let offset = named(["crop_offset_x", "crop_offset_y"], offset);
        offset.into_iter().chain(named(["crop_width", "crop_height"], crop))
    });
    Element::plugin("film", "hdrfilm")
        .with_all(named(["width", "height"], size))
        .with_all(cropped.into_iter().flatten())
        .with_all(sample_border.then(|| boolean("sample_border", true)))
        .with(rfilter(exporter, filter))
}

fn rfilter(exporter: &mut Exporter<'_>, filter: ReconstructionFilter) -> Element {
    let plugin = |kind| Element::plugin("rfilter", kind);
    match filter {
        ReconstructionFilter::Box { radius } => {
            if radius != 0.5 {
                exporter.losses.insert(Loss::BoxFilter);
            }
            plugin("box")
        }
        ReconstructionFilter::Tent { radius } => plugin("tent").with(float("radius", radius)),
        ReconstructionFilter::Gaussian { stddev } => {
            plugin("gaussian").with(float("stddev", stddev))
        }
        ReconstructionFilter::Mitchell { b, c } => {
            plugin("mitchell").with(float("B", b)).with(float("C", c))
        }
        ReconstructionFilter::CatmullRom => plugin("catmullrom"),
        ReconstructionFilter::Lanczos { lobes } => plugin("lanczos").with(integer("lobes", lobes)),
    }
}

/// The sampler of a scene. Of Mitsuba's whose points are spread evenly, that which takes any number of samples.
pub(super) fn sampler(exporter: &mut Exporter<'_>) -> Element {
    let SamplingSettings { sampler, samples_per_pixel: _, seed } = exporter.scene.sampling;
    let kind = match sampler {
        SamplerKind::Independent => "independent",
        SamplerKind::Sobol => "multijitter",
    };
    let seed = u32::try_from(seed).unwrap_or_else(|_| {
        exporter.losses.insert(Loss::Seed);
        0
    });
    Element::plugin("sampler", kind)
        .with(integer("sample_count", "$spp"))
        .with_all((seed != 0).then(|| integer("seed", seed)))
}
