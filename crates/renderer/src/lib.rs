//! Path tracing of étendue scenes.

mod film;
pub mod image_metrics;
#[cfg(test)]
mod laws;
mod light_sampler;
mod path;
mod render;
mod settings;
mod statistics;
mod tile;
pub use film::{FilmSample, FilterSampler, Image, PixelFilter, PixelSum};
pub use light_sampler::{LightChoice, LightSampler, Receiver, Sides};
pub use render::{Progress, Renderer, Rendering, ThreadError};
pub use settings::{RenderSettings, Strategy};
pub use statistics::{NonFiniteSamples, RayCounts, SampleAddress, Statistics};
