//! PNG: 8 bits per channel, sRGB, with an exposure.

use etendue_math::Real;
use etendue_renderer::Image;
use etendue_scene::load::srgb;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

use super::EncodeResult;

pub(super) fn encode(bytes: &mut Vec<u8>, picture: &Image, exposure: f32) -> EncodeResult {
    let gain = Real::powf(2.0_f32, exposure);
    let samples: Vec<u8> = picture
        .pixels()
        .iter()
        .flat_map(|pixel| pixel.to_array())
        .map(|x| quantise(x * gain))
        .collect();
    PngEncoder::new(bytes).write_image(
        &samples,
        picture.width(),
        picture.height(),
        ExtendedColorType::Rgb8,
    )?;
    Ok(())
}

/// Linear to 8-bit sRGB, rounded; NaN becomes black.
fn quantise(linear: f32) -> u8 {
    (srgb::encode(Real::clamp_to(linear, 0.0, 1.0)) * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_of_the_range_are_kept_and_nan_is_black() {
        assert_eq!(quantise(0.0), 0);
        assert_eq!(quantise(1.0), 255);
        assert_eq!(quantise(7.0), 255);
        assert_eq!(quantise(f32::NAN), 0);
        // 18 % grey is 118 in sRGB.
        assert_eq!(quantise(0.18), 118);
    }
}
