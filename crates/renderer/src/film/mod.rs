//! From samples to pixels: filter importance sampling and compensated sums.

mod filter_sampler;
mod filter_table;
mod image;
mod pixel;

pub use filter_sampler::{FilmSample, FilterSampler, PixelFilter};
pub use image::Image;
pub use pixel::PixelSum;
