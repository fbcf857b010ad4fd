//! Layers beside the picture ("arbitrary output variables").

use etendue_renderer::{Accumulation, Features, Image, Statistics};
use etendue_scene::film::Crop;
use etendue_scene::scene::Layer;

/// What is known of pixels beside their colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, clap::ValueEnum)]
pub(crate) enum Aov {
    /// Estimated variance of each channel of the pixel (single differences, noisy)
    Variance,
    /// Number of samples of the pixel
    Samples,
    /// Directional albedo of what is seen first
    Albedo,
    /// Its shading normal in world space
    Normal,
    /// Its depth along the camera's axis; infinite where nothing is hit
    Depth,
    /// Its position in world space
    Position,
    /// Its texture coordinates
    Uv,
    /// The number of its shape, from 1; 0 where nothing is hit
    Shape,
}

impl From<Layer> for Aov {
    fn from(layer: Layer) -> Self {
        match layer {
            Layer::Albedo => Self::Albedo,
            Layer::Normal => Self::Normal,
            Layer::Depth => Self::Depth,
            Layer::Position => Self::Position,
            Layer::Uv => Self::Uv,
            Layer::Shape => Self::Shape,
        }
    }
}

impl Aov {
    /// Whether it comes from the two halves of a progressive render.
    pub(crate) fn is_of_samples(self) -> bool {
        matches!(self, Self::Variance | Self::Samples)
    }
}

/// Numbers of all pixels, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Plane {
    /// A colour, in the precision of the picture.
    Color(Vec<f32>),
    /// A measure, always of 32 bits.
    Measure(Vec<f32>),
    /// A count.
    Count(Vec<u32>),
}

/// A plane and the name of its channel.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Channel {
    /// `layer.component`, as compositors and denoisers expect it.
    pub(crate) name: &'static str,
    pub(crate) plane: Plane,
}

/// What channels are made of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sources<'a> {
    pub(crate) features: &'a [Features],
    pub(crate) variance: &'a Image,
    pub(crate) samples: &'a [u32],
}

impl Sources<'_> {
    /// The channels of one layer.
    pub(crate) fn channels(&self, aov: Aov) -> Vec<Channel> {
        match aov {
            Aov::Variance => colors(["variance.R", "variance.G", "variance.B"], |axis| {
                self.variance.pixels().iter().map(|p| p.to_array()[axis]).collect()
            }),
            Aov::Samples => {
                vec![Channel { name: "samples.N", plane: Plane::Count(self.samples.to_vec()) }]
            }
            Aov::Albedo => colors(["albedo.R", "albedo.G", "albedo.B"], |axis| {
                self.features.iter().map(|f| f.albedo.to_array()[axis]).collect()
            }),
            Aov::Normal => {
                self.measures(["normal.X", "normal.Y", "normal.Z"], |f, axis| f.normal[axis])
            }
            Aov::Depth => self.measures(["depth.Z"], |f, _| f.depth),
            Aov::Position => {
                let names = ["position.X", "position.Y", "position.Z"];
                self.measures(names, |f, axis| f.position[axis])
            }
            Aov::Uv => self.measures(["uv.U", "uv.V"], |f, axis| f.uv[axis]),
            Aov::Shape => {
                let shapes = self.features.iter().map(|f| f.shape).collect();
                vec![Channel { name: "shape.I", plane: Plane::Count(shapes) }]
            }
        }
    }

    fn measures<const N: usize>(
        &self,
        names: [&'static str; N],
        measure: impl Fn(&Features, usize) -> f32,
    ) -> Vec<Channel> {
        let channel = |(axis, name)| {
            let values = self.features.iter().map(|f| measure(f, axis)).collect();
            Channel { name, plane: Plane::Measure(values) }
        };
        names.into_iter().enumerate().map(channel).collect()
    }
}

/// What a part of a render shows beside its mean.
pub(crate) fn of_part(sums: &Accumulation) -> Vec<Channel> {
    let squares = sums.second_moments();
    let mut channels = colors(["square.R", "square.G", "square.B"], |axis| {
        squares.pixels().iter().map(|p| p.to_array()[axis]).collect()
    });
    channels.push(Channel { name: "samples.N", plane: Plane::Count(sums.counts()) });
    channels
}

/// How many samples of each pixel are no light, of renders in which there are such.
///
/// * `crop`: the part of the film that the picture shows.
pub(crate) fn of_bad_samples(statistics: &Statistics, crop: &Crop) -> Vec<Channel> {
    let [width, height] = crop.size.map(|n| n as usize);
    let bad = [("non_finite.N", &statistics.non_finite), ("negative.N", &statistics.negative)];
    let bad = bad.into_iter().filter(|(_, samples)| samples.count() > 0);
    bad.map(|(name, samples)| {
        let mut counts = vec![0; width * height];
        for ([row, column], count) in samples.pixels() {
            let [x, y] = [column - crop.offset[0], row - crop.offset[1]].map(|n| n as usize);
            counts[y * width + x] = count;
        }
        Channel { name, plane: Plane::Count(counts) }
    })
    .collect()
}

/// The three channels of colours.
pub(crate) fn colors(names: [&'static str; 3], axis: impl Fn(usize) -> Vec<f32>) -> Vec<Channel> {
    let channel = |(i, name)| Channel { name, plane: Plane::Color(axis(i)) };
    names.into_iter().enumerate().map(channel).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_renderer::SampleAddress;

    #[test]
    fn samples_that_are_no_light_are_shown_where_they_are() {
        let crop = Crop { offset: [10, 20], size: [2, 3] };
        let mut statistics = Statistics::default();
        assert_eq!(of_bad_samples(&statistics, &crop), []);
        for (column, row, sample) in [(11, 20, 5), (10, 22, 0), (11, 20, 2)] {
            statistics.non_finite.record(SampleAddress { row, column, sample });
        }
        let plane = Plane::Count(vec![0, 2, 0, 0, 1, 0]);
        assert_eq!(of_bad_samples(&statistics, &crop), [Channel { name: "non_finite.N", plane }]);
    }
}
