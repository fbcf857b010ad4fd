//! ꟻLIP: the difference of two pictures as seen when one replaces the other on a screen.
//!
//! ```text
//! each picture ─ opponent colours ─ contrast sensitivity of the eye ─ Hunt-adjusted L*a*b* ┐
//!       │                                                                        HyAB ΔEc ┴► ΔEc^(1 − ΔEf)
//!       └─ luminance ─ edges and points ─────────────────────────────────── larger ΔEf ──┘
//! ```
//!
//! [`ldr`] is for what a screen shows, [`hdr`] the largest over the exposures at which a picture may be shown;
//! [`HdrReference`] is the same for many pictures.
//!
//! # Source
//! P. Andersson et al., FLIP: A Difference Evaluator for Alternating Images, HPG 2020; Visualizing Errors in Rendered High
//! Dynamic Range Images, Eurographics short papers 2021. Agrees with NVIDIA's `flip-evaluator` 1.7 up to the rounding of its
//! single precision.

mod colour;
mod exposure;
mod filter;

use etendue_math::Real;

use super::{SizeMismatch, check_sizes};
use crate::Image;
use colour::{Opponent, hunt_lab, hyab, linear_of};
use filter::{Kernels, Plane};

/// Pixels per degree of the published setting: a screen of 3840 pixels on 0.7 m, seen from 0.7 m.
pub const PIXELS_PER_DEGREE: f64 = 0.7 * (3840.0 / 0.7) * core::f64::consts::PI / 180.0;

/// Differences of the pixels of two pictures as a screen shows them: linear Rec. 709, what is outside `[0, 1]` clipped.
///
/// Row by row from the top, each from 0 (not seen) to 1 (black against white, within rounding). A pixel that is NaN counts
/// as black.
///
/// # Errors
/// Pictures of different sizes, or without pixels.
pub fn ldr(image: &Image, reference: &Image) -> Result<Vec<f64>, SizeMismatch> {
    check_sizes(image, reference)?;
    let kernels = Kernels::new(PIXELS_PER_DEGREE);
    let [image, reference] = [image, reference]
        .map(|picture| Seen::of(picture, |x| Real::clamp_to(x, 0.0, 1.0), &kernels));
    Ok(differences(&image, &reference))
}

/// Differences of the pixels of two pictures of radiance: the largest of [`ldr`] over exposures, tone mapped, from
/// where the brightest pixel of the reference is bright to where its median is.
///
/// # Errors
/// Pictures of different sizes, or without pixels.
pub fn hdr(image: &Image, reference: &Image) -> Result<Vec<f64>, SizeMismatch> {
    HdrReference::new(reference).differences(image)
}

/// A reference for [`hdr`], prepared for many pictures.
pub struct HdrReference {
    size: [u32; 2],
    kernels: Kernels,
    /// By exposure.
    seen: Vec<(f64, Seen)>,
}

impl HdrReference {
    /// Prepares a reference.
    pub fn new(reference: &Image) -> Self {
        let kernels = Kernels::new(PIXELS_PER_DEGREE);
        let seen = exposure::exposures(reference)
            .into_iter()
            .map(|exposure| (exposure, seen_at(reference, exposure, &kernels)))
            .collect();
        Self { size: reference.size(), kernels, seen }
    }

    /// The differences of a picture, as [`hdr`] gives them.
    ///
    /// # Errors
    /// A picture of another size, or without pixels.
    pub fn differences(&self, image: &Image) -> Result<Vec<f64>, SizeMismatch> {
        if image.size() != self.size || image.pixels().is_empty() {
            return Err(SizeMismatch { image: image.size(), reference: self.size });
        }
        let mut largest = vec![0.0; image.pixels().len()];
        for (exposure, reference) in &self.seen {
            let image = seen_at(image, *exposure, &self.kernels);
            for (largest, seen) in largest.iter_mut().zip(differences(&image, reference)) {
                *largest = seen.max(*largest);
            }
        }
        Ok(largest)
    }
}

/// Mean of the differences of pixels; 0 for none.
pub fn mean(differences: &[f64]) -> f64 {
    differences.iter().sum::<f64>() / differences.len().max(1) as f64
}

/// What is seen of one picture on a screen.
struct Seen {
    /// Hunt-adjusted L*a*b* by pixel.
    colours: Vec<[f64; 3]>,
    /// Strength of edges and of points by pixel.
    features: [Vec<f64>; 2],
}

impl Seen {
    fn of(image: &Image, channel: impl Fn(f64) -> f64, kernels: &Kernels) -> Self {
        let shown = |x: f32| channel(if x.is_nan() { 0.0 } else { f64::from(x) });
        let pixels: Vec<Opponent> =
            image.pixels().iter().map(|p| Opponent::of(p.to_array().map(shown))).collect();
        let size = image.size().map(|n| n as usize);
        Self {
            colours: perceived(&pixels, size, kernels),
            features: features(&pixels, size, kernels),
        }
    }
}

fn seen_at(image: &Image, exposure: f64, kernels: &Kernels) -> Seen {
    Seen::of(image, |x| exposure::tone_map(x * exposure), kernels)
}

/// Exponent of colour differences.
const COLOUR_EXPONENT: f64 = 0.7;
/// Exponent of feature differences.
const FEATURE_EXPONENT: f64 = 0.5;
/// Where the map of colour differences bends: this share of the largest is mapped to …
const BEND: f64 = 0.4;
/// … this.
const BENT: f64 = 0.95;

fn differences(image: &Seen, reference: &Seen) -> Vec<f64> {
    let [green, blue] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(hunt_lab);
    let largest = Real::powf(hyab(green, blue), COLOUR_EXPONENT);
    let bend = BEND * largest;
    let remapped = |difference: f64| {
        let power = Real::powf(difference, COLOUR_EXPONENT);
        if power < bend {
            BENT / bend * power
        } else {
            BENT + (power - bend) / (largest - bend) * (1.0 - BENT)
        }
    };
    (0..image.colours.len())
        .map(|i| {
            let colour = remapped(hyab(image.colours[i], reference.colours[i]));
            let [edge, point] =
                [0, 1].map(|kind| (image.features[kind][i] - reference.features[kind][i]).abs());
            let feature = edge.max(point) * core::f64::consts::FRAC_1_SQRT_2;
            Real::powf(colour, 1.0 - Real::powf(feature, FEATURE_EXPONENT))
        })
        .collect()
}

/// Colours through the eye's contrast sensitivity, brought back into what a screen can show.
fn perceived(pixels: &[Opponent], size: [usize; 2], kernels: &Kernels) -> Vec<[f64; 3]> {
    let plane =
        |channel: fn(&Opponent) -> f64| Plane::new(size, pixels.iter().map(channel).collect());
    let luminance = kernels.achromatic(&plane(|p| p.y));
    let red_green = kernels.red_green(&plane(|p| p.cx));
    let blue_yellow = kernels.blue_yellow(&plane(|p| p.cz));
    (0..pixels.len())
        .map(|i| {
            let seen = Opponent { y: luminance[i], cx: red_green[i], cz: blue_yellow[i] };
            hunt_lab(linear_of(seen).map(|x| Real::clamp_to(x, 0.0, 1.0)))
        })
        .collect()
}

/// Strength of edges and of points in luminance.
fn features(pixels: &[Opponent], size: [usize; 2], kernels: &Kernels) -> [Vec<f64>; 2] {
    let luminance = Plane::new(size, pixels.iter().map(|p| (p.y + 16.0) / 116.0).collect());
    let strength = |derivative: &[f64]| {
        let [x, y] = kernels.along_both_axes(&luminance, derivative);
        x.iter().zip(&y).map(|(x, y)| (x * x + y * y).sqrt()).collect()
    };
    [strength(kernels.edge()), strength(kernels.point())]
}

#[cfg(test)]
mod tests;
