//! How far one picture is from another.

pub mod flip;

use etendue_math::Spectrum;
use etendue_scene::Color;

use crate::Image;

/// Two pictures have different sizes, or no pixels at all, and cannot be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SizeMismatch {
    /// Size of the picture.
    pub image: [u32; 2],
    /// Size of the reference.
    pub reference: [u32; 2],
}

impl core::fmt::Display for SizeMismatch {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let ([w, h], [rw, rh]) = (self.image, self.reference);
        write!(f, "a picture of {w}×{h} cannot be compared with a reference of {rw}×{rh}")
    }
}

impl core::error::Error for SizeMismatch {}

/// The distance of a picture `x` from a reference `r`, over all channels of all pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Mean squared error, `mean((x − r)²)`.
    pub mse: f64,
    /// Relative mean squared error, `mean((x − r)² / (r² + 0.01))`.
    pub relative_mse: f64,
    /// Peak signal-to-noise ratio in decibels, `10 log₁₀(peak² / mse)` with the largest channel
    /// of the reference as peak; infinite for equal pictures.
    pub psnr: f64,
    /// Relative difference of the means, `(Σx − Σr) / Σ|r|`; 0 for two black pictures.
    pub mean_difference: f64,
    /// The largest `|x − r|`.
    pub max_difference: f64,
    /// Pixels left out of all the above because one of the two was NaN or infinite.
    pub non_finite_pixels: u64,
}

/// Compares a picture with a reference.
///
/// # Errors
/// Pictures of different sizes, or without pixels.
///
/// # Examples
/// ```
/// use etendue_renderer::{Image, image_metrics::compare};
/// let reference = Image::from_pixels([1, 1], vec![[1.0, 1.0, 1.0].into()]).expect("one pixel");
/// let brighter = Image::from_pixels([1, 1], vec![[1.5, 1.5, 1.5].into()]).expect("one pixel");
/// let comparison = compare(&brighter, &reference)?;
/// assert_eq!(comparison.mse, 0.25);
/// assert_eq!(comparison.mean_difference, 0.5);
/// # Ok::<(), etendue_renderer::image_metrics::SizeMismatch>(())
/// ```
pub fn compare(image: &Image, reference: &Image) -> Result<Comparison, SizeMismatch> {
    check_sizes(image, reference)?;
    let mut sums = Sums::default();
    for (&x, &r) in image.pixels().iter().zip(reference.pixels()) {
        sums.add(x, r);
    }
    Ok(sums.comparison())
}

/// The difference picture: black where the two agree, red where the picture is brighter than the
/// reference, blue where it is darker, green where it is NaN or infinite.
///
/// ```text
/// d = (Y(x) − Y(r)) / (Y(r) + 0.01),   intensity = min(|d|, 1)
/// ```
///
/// # Errors
/// Pictures of different sizes, or without pixels.
pub fn difference_picture(image: &Image, reference: &Image) -> Result<Image, SizeMismatch> {
    check_sizes(image, reference)?;
    let mut picture = Image::black(image.size());
    for y in 0..image.height() {
        for x in 0..image.width() {
            picture.set([x, y], false_colour(image.pixel([x, y]), reference.pixel([x, y])));
        }
    }
    Ok(picture)
}

fn false_colour(x: Color, r: Color) -> Color {
    if !(x.is_finite() && r.is_finite()) {
        return Color::new(0.0, 1.0, 0.0);
    }
    let relative = (x.luminance() - r.luminance()) / (r.luminance().abs() + 0.01);
    let intensity = relative.abs().min(1.0);
    if relative > 0.0 { Color::new(intensity, 0.0, 0.0) } else { Color::new(0.0, 0.0, intensity) }
}

fn check_sizes(image: &Image, reference: &Image) -> Result<(), SizeMismatch> {
    if image.size() == reference.size() && !image.pixels().is_empty() {
        Ok(())
    } else {
        Err(SizeMismatch { image: image.size(), reference: reference.size() })
    }
}

#[derive(Default)]
struct Sums {
    channels: u64,
    non_finite_pixels: u64,
    squared: f64,
    relative: f64,
    difference: f64,
    reference: f64,
    max_difference: f64,
    peak: f64,
}

impl Sums {
    fn add(&mut self, x: Color, r: Color) {
        if !(x.is_finite() && r.is_finite()) {
            self.non_finite_pixels += 1;
            return;
        }
        for (x, r) in x.to_array().into_iter().zip(r.to_array()) {
            let (x, r) = (f64::from(x), f64::from(r));
            let squared = (x - r) * (x - r);
            self.channels += 1;
            self.squared += squared;
            self.relative += squared / (r * r + 0.01);
            self.difference += x - r;
            self.reference += r.abs();
            self.max_difference = self.max_difference.max((x - r).abs());
            self.peak = self.peak.max(r.abs());
        }
    }

    fn comparison(&self) -> Comparison {
        let count = self.channels.max(1) as f64;
        let mse = self.squared / count;
        let mean_difference =
            if self.difference == 0.0 { 0.0 } else { self.difference / self.reference };
        let psnr = if mse == 0.0 {
            f64::INFINITY
        } else {
            10.0 / core::f64::consts::LN_10 * etendue_math::Real::ln(self.peak * self.peak / mse)
        };
        Comparison {
            mse,
            relative_mse: self.relative / count,
            psnr,
            mean_difference,
            max_difference: self.max_difference,
            non_finite_pixels: self.non_finite_pixels,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(values: &[f32]) -> Image {
        let pixels = values.iter().map(|&v| Color::splat(v)).collect();
        Image::from_pixels([values.len() as u32, 1], pixels).expect("one row")
    }

    #[test]
    fn equal_pictures_have_no_error_and_infinite_psnr() {
        let image = grey(&[0.0, 0.5, 2.0]);
        let c = compare(&image, &image).expect("equal sizes");
        assert_eq!((c.mse, c.relative_mse, c.mean_difference), (0.0, 0.0, 0.0));
        assert_eq!(c.psnr, f64::INFINITY);
    }

    #[test]
    fn errors_are_those_of_their_formulas() {
        let c = compare(&grey(&[1.0, 0.0]), &grey(&[2.0, 0.5])).expect("equal sizes");
        // ((1−2)² + (0−0.5)²)/2 and (1/(4+0.01) + 0.25/(0.25+0.01))/2, all numbers exact in f32.
        assert_eq!(c.mse, 0.625);
        assert!((c.relative_mse - f64::midpoint(1.0 / 4.01, 0.25 / 0.26)).abs() < 1e-15);
        // 10 log₁₀(4/0.625) = 8.0618 dB, given to four decimals.
        assert!((c.psnr - 8.0618).abs() < 1e-4);
        assert_eq!(c.mean_difference, -1.5 / 2.5);
        assert_eq!(c.max_difference, 1.0);
    }

    #[test]
    fn pixels_that_are_not_finite_are_counted_and_shown() {
        let c = compare(&grey(&[f32::NAN, 1.0]), &grey(&[1.0, 1.0])).expect("equal sizes");
        assert_eq!((c.non_finite_pixels, c.mse), (1, 0.0));
        let picture = difference_picture(&grey(&[f32::NAN, 2.0, 0.0]), &grey(&[1.0; 3]));
        let picture = picture.expect("equal sizes");
        assert_eq!(picture.pixel([0, 0]), Color::new(0.0, 1.0, 0.0));
        assert!(picture.pixel([1, 0]).r > 0.9 && picture.pixel([2, 0]).b > 0.9);
    }

    #[test]
    fn pictures_of_different_or_no_size_are_refused() {
        assert!(compare(&grey(&[1.0]), &grey(&[1.0, 1.0])).is_err());
        assert!(compare(&Image::black([0, 0]), &Image::black([0, 0])).is_err());
    }
}
