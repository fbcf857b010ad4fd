//! Radiance HDR.

use etendue_renderer::Image;
use image::Rgb;
use image::codecs::hdr::HdrEncoder;

use super::EncodeResult;

pub(super) fn encode(bytes: &mut Vec<u8>, picture: &Image) -> EncodeResult {
    let pixels: Vec<Rgb<f32>> = picture.pixels().iter().map(|p| Rgb(p.to_array())).collect();
    HdrEncoder::new(bytes).encode(&pixels, picture.width() as usize, picture.height() as usize)?;
    Ok(())
}
