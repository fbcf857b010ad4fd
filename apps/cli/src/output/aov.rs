//! Layers beside the picture ("arbitrary output variables").

use etendue_renderer::{Accumulation, Features, Image};
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

/// The three channels of colours.
pub(crate) fn colors(names: [&'static str; 3], axis: impl Fn(usize) -> Vec<f32>) -> Vec<Channel> {
    let channel = |(i, name)| Channel { name, plane: Plane::Color(axis(i)) };
    names.into_iter().enumerate().map(channel).collect()
}
