//! When a progressive render ends, and where its samples go.

/// What a progressive render aims at. It ends at whatever comes first; with neither limit it goes on
/// until it is halted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Goal {
    /// Where samples go.
    pub allocation: Allocation,
    /// Samples per pixel, in the mean over the picture, that are not exceeded. Below 2 counts as 2: an
    /// error can only be seen between two samples.
    pub samples_per_pixel: Option<u32>,
    /// The relative error of the picture ([`ImageError`](super::ImageError)) below which the upper end
    /// of its interval must lie. Looked at from 16 samples per pixel on.
    pub error: Option<f64>,
}

/// Where the samples of a picture go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Allocation {
    /// To the pixels whose error is large, in proportion to their standard deviation.
    #[default]
    Adaptive,
    /// To all pixels alike.
    Uniform,
}

/// Whether a render is to end before its goal. Once it is not [`Halt::No`] it has to stay so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Halt {
    /// It goes on.
    No,
    /// At the next pixel, but not before every pixel has a sample in either half.
    WhenWhole,
    /// At the next pixel. Pixels without samples are black.
    Now,
}
