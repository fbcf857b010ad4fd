//! Exposures at which a picture of radiance is looked at.

use etendue_math::Real;

use crate::Image;

/// Numerator and denominator of the tone map in powers of x, from x² down: Narkowicz's fit of the ACES curve, for radiance
/// scaled by 0.6.
const NUMERATOR: [f64; 3] = [0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0];
const DENOMINATOR: [f64; 3] = [0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14];

/// What a screen shows of a radiance, in `[0, 1]`.
pub(super) fn tone_map(x: f64) -> f64 {
    let x = x.max(0.0);
    let polynomial = |[a, b, c]: [f64; 3]| (a * x + b) * x + c;
    let (numerator, denominator) = (polynomial(NUMERATOR), polynomial(DENOMINATOR));
    if denominator.is_finite() { (numerator / denominator).min(1.0) } else { 1.0 }
}

/// Where the tone map shows what counts as bright.
const BRIGHT: f64 = 0.85;

/// Factors of radiance, a stop apart or less: from where the reference's brightest pixel is bright to where its median is.
/// At least two.
pub(super) fn exposures(reference: &Image) -> Vec<f64> {
    let mut luminances: Vec<f64> = reference
        .pixels()
        .iter()
        .map(|pixel| f64::from(pixel.luminance()))
        .filter(|y| y.is_finite())
        .collect();
    luminances.sort_by(f64::total_cmp);
    let (Some(&brightest), count) = (luminances.last(), luminances.len()) else { return vec![1.0] };
    let median = f64::midpoint(luminances[(count - 1) / 2], luminances[count / 2]);
    let stops = |factor: f64| Real::ln(factor) / core::f64::consts::LN_2;
    // A black picture is looked at as it is.
    let [start, stop] =
        [brightest, median].map(|y| if y > 0.0 { stops(bright() / y) } else { 0.0 });
    let stop = stop.max(start);
    let count = ((stop - start).ceil() as u32).max(2);
    let step = (stop - start) / f64::from(count - 1);
    (0..count).map(|i| Real::powf(2.0_f64, start + f64::from(i) * step)).collect()
}

/// The radiance that the tone map shows as bright: the positive root of a quadratic equation.
fn bright() -> f64 {
    let [a, b, c] = [0, 1, 2].map(|i| NUMERATOR[i] - BRIGHT * DENOMINATOR[i]);
    // a > 0 > c: no cancellation in the root that is divided by.
    let root = (b * b - 4.0 * a * c).sqrt();
    if b < 0.0 { (root - b) / (2.0 * a) } else { -2.0 * c / (b + root) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::Spectrum;
    use etendue_scene::Color;

    #[test]
    fn what_is_bright_is_shown_so_and_the_map_ends_at_one() {
        assert!((tone_map(bright()) - BRIGHT).abs() < 1e-15);
        assert_eq!((tone_map(0.0), tone_map(-1.0), tone_map(f64::INFINITY)), (0.0, 0.0, 1.0));
        assert!(tone_map(1e200) == 1.0);
    }

    #[test]
    fn exposures_reach_from_the_brightest_to_the_median() {
        let grey = |values: &[f32]| {
            let pixels = values.iter().map(|&v| Color::splat(v)).collect();
            Image::from_pixels([values.len() as u32, 1], pixels).expect("a row")
        };
        let found = exposures(&grey(&[16.0, 1.0, 0.5]));
        // Four stops: four exposures.
        assert_eq!(found.len(), 4);
        // Luminance of grey in f32 is off by its rounding.
        assert!(
            (found[0] * 16.0 / bright() - 1.0).abs() < 1e-6
                && (found[3] / bright() - 1.0).abs() < 1e-6
        );
        assert_eq!(exposures(&grey(&[0.0, 0.0])), [1.0, 1.0]);
    }
}
