//! Path tracing of étendue scenes.

mod film;
pub mod image_metrics;
mod light_sampler;
mod statistics;
pub use film::{FilmSample, FilterSampler, Image, PixelFilter, PixelSum};
pub use light_sampler::{Receiver, Sides};
pub use statistics::{NonFiniteSamples, RayCounts, SampleAddress, Statistics};
