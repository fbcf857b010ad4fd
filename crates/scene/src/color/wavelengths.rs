//! The wavelengths of a path.

use core::array::from_fn;

use etendue_math::{Real, Rgb, Sampled, Spectrum};

use super::spectrum::xyz_to_rgb;
use super::{Channels, Curve, cie, primaries};
use crate::Color;

/// How many wavelengths a path carries.
const COUNT: usize = 4;

/// Linear RGB, in our matrix and over the tables of [`cie`], of D65 with unit luminance: white to the rounding of the matrix,
/// which is divided by it.
const WHITE: [f64; 3] = [1.000_094_19, 0.999_981_66, 0.999_906_69];

/// The integral over wavelengths of the table of `y`, linear between its entries: that of [`cie::Y_INTEGRAL`] without the error
/// of Mitsuba's rule.
const Y_INTEGRAL: f64 = 106.857_028_33;

/// The factor that gives D65 unit luminance by the same integral.
const D65_SCALE: f64 = 0.010_112_462_632;

/// A few wavelengths that are followed together.
///
/// The first is drawn in proportion to what a sensor sees of it, roughly; the others lie as far from one another in the
/// distribution function as they can, so that each is drawn like the first. Directions that depend on the wavelength are those
/// of the first.
///
/// ```text
/// p(λ) = k / ((t₁ − t₀) cosh²(k (λ − c)))    360 ≤ λ ≤ 830,   t = tanh(k (360 − c)), tanh(k (830 − c))
/// λᵢ   = c + atanh(t₀ + (t₁ − t₀) frac(u + i/4)) / k,   c = 538 nm, k = 0.0072 nm⁻¹
/// RGB  = ¼ Σ L(λᵢ) M (x, y, z)(λᵢ) / (p(λᵢ) ∫y)
/// ```
///
/// # Source
/// A. Wilkie et al., "Hero Wavelength Spectral Sampling", CGF 33(4), 2014; the density is that of M. Pharr, W. Jakob,
/// G. Humphreys, "Physically Based Rendering", 4th edition, section 4.5.4.
#[derive(Clone, Copy, Debug)]
pub struct Wavelengths {
    /// In nm.
    nm: [f32; COUNT],
    red: [f32; COUNT],
    green: [f32; COUNT],
    daylight: [f32; COUNT],
    /// What a sensor sees of light of each wavelength, over the density of the wavelength.
    response: [Color; COUNT],
}

const CENTRE: f64 = 538.0;
const STEEPNESS: f64 = 0.0072;
/// tanh(k (360 − c)).
const LOWEST: f64 = -0.856_910_625_469_828;
/// tanh(k (830 − c)).
const HIGHEST: f64 = 0.970_591_346_940_269_8;

impl Wavelengths {
    /// The wavelengths of a uniform number in [0, 1).
    pub fn of_number(u: f32) -> Self {
        Self::at(from_fn(|i| {
            let shifted = f64::from(u) + i as f64 / COUNT as f64;
            let t = LOWEST + (HIGHEST - LOWEST) * (shifted - Real::floor(shifted));
            // atanh; no cancellation matters where 538 is added.
            CENTRE + 0.5 * Real::ln((1.0 + t) / (1.0 - t)) / STEEPNESS
        }))
    }

    fn at(nm: [f64; COUNT]) -> Self {
        let table = |table: &[f32; 95]| nm.map(|nm| cie::interpolate(table, nm) as f32);
        let daylight = nm.map(|nm| (cie::interpolate(&cie::D65, nm) * D65_SCALE) as f32);
        let response = nm.map(|nm| {
            let xyz = [&cie::X, &cie::Y, &cie::Z].map(|table| cie::interpolate(table, nm));
            let scale = 1.0 / (COUNT as f64 * density(nm) * Y_INTEGRAL);
            let rgb = xyz_to_rgb(xyz).to_array();
            Rgb::from(from_fn::<_, 3, _>(|i| (rgb[i] / WHITE[i] * scale) as f32))
        });
        Self {
            nm: nm.map(|nm| nm as f32),
            red: table(&primaries::RED),
            green: table(&primaries::GREEN),
            daylight,
            response,
        }
    }

    /// The wavelengths in nm.
    pub fn nanometres(self) -> [f32; COUNT] {
        self.nm
    }
}

/// Density of a wavelength in nm⁻¹.
fn density(nm: f64) -> f64 {
    let e = Real::exp(STEEPNESS * (nm - CENTRE));
    let cosh = 0.5 * (e + 1.0 / e);
    STEEPNESS / ((HIGHEST - LOWEST) * cosh * cosh)
}

impl Channels for Wavelengths {
    type Color = Sampled<f32, COUNT>;

    const FIXED: Option<Self> = None;

    fn of_path(number: impl FnOnce() -> f32) -> Self {
        Self::of_number(number())
    }

    /// The first, which is as likely to be any wavelength as the others.
    #[inline(always)]
    fn leading(_number: impl FnOnce() -> f32) -> usize {
        0
    }

    /// ```text
    /// b + (r − b) red(λ) + (g − b) green(λ)
    /// ```
    ///
    /// Exactly the grey for a grey.
    #[inline]
    fn matter(self, rgb: Color) -> Self::Color {
        let Rgb { r, g, b } = rgb;
        // Between the channels also where roundings add up.
        let (least, largest) = (r.min(g).min(b), r.max(g).max(b));
        Sampled(from_fn(|i| {
            let mixed = b + (r - b) * self.red[i] + (g - b) * self.green[i];
            Real::clamp_to(mixed, least, largest)
        }))
    }

    #[inline]
    fn light(self, rgb: Color) -> Self::Color {
        self.matter(rgb) * Sampled(self.daylight)
    }

    #[inline]
    fn curve(self, curve: &Curve, _rgb: Color) -> Self::Color {
        Sampled(self.nm.map(|nm| curve.at(f64::from(nm)) as f32))
    }

    #[inline]
    fn indices(self, index: impl FnMut(f32) -> f32) -> Option<Self::Color> {
        Some(Sampled(self.nm.map(index)))
    }

    #[inline]
    fn seen(self, color: Self::Color) -> Color {
        let pairs = color.0.into_iter().zip(self.response);
        pairs.fold(Color::black(), |sum, (value, response)| sum + response * value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{SpectrumRole, spectrum_to_rgb};

    const STRATA: u16 = 20_000;

    /// The mean of an estimate over all wavelengths.
    fn mean(estimate: impl Fn(Wavelengths) -> Color) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for i in 0..STRATA {
            let u = (f32::from(i) + 0.5) / f32::from(STRATA);
            let color = estimate(Wavelengths::of_number(u)).to_array();
            for (sum, c) in sum.iter_mut().zip(color) {
                *sum += f64::from(c) / f64::from(STRATA);
            }
        }
        sum
    }

    #[test]
    fn the_density_is_that_of_the_wavelengths_drawn() {
        let nm = |u| f64::from(Wavelengths::of_number(u).nm[0]);
        assert!(
            (nm(0.0) - 360.0).abs() < 1e-4 && (nm(1.0 - f32::EPSILON / 2.0) - 830.0).abs() < 1e-2
        );
        for i in 1..64_u8 {
            let (u, du) = (f32::from(i) / 64.0, 1e-3);
            let slope = 2.0 * f64::from(du) / (nm(u + du) - nm(u - du));
            // A difference over a thousandth, of wavelengths of seven digits.
            assert!((slope / density(nm(u)) - 1.0).abs() < 2e-3, "{u}");
        }
        for i in 0..COUNT {
            let shifted = Wavelengths::of_number(i as f32 / COUNT as f32).nm[0];
            assert_eq!(Wavelengths::of_number(0.0).nm[i], shifted);
        }
    }

    #[test]
    fn light_of_a_colour_is_seen_as_that_colour() {
        let colors =
            [[1.0, 1.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.2, 3.0, 0.7]];
        for color in colors {
            let seen = mean(|channels| channels.seen(channels.light(Rgb::from(color))));
            for (seen, color) in seen.into_iter().zip(color) {
                // Tables of six digits, entries of the response of up to 10, and the rule of 20 000 strata over kinks.
                assert!((seen - f64::from(color)).abs() < 1e-4, "{color} {seen}");
            }
        }
    }

    #[test]
    fn reflected_daylight_has_the_colour_of_the_reflectance() {
        let color = Rgb::new(0.7_f32, 0.3, 0.1);
        let white = Color::white();
        let seen = mean(|c| c.seen(c.matter(color) * c.light(white)));
        for (seen, color) in seen.into_iter().zip(color.to_array()) {
            assert!((seen - f64::from(color)).abs() < 1e-4, "{color} {seen}");
        }
    }

    #[test]
    fn curves_have_the_colour_that_is_integrated_over_all_wavelengths() {
        let samples = [(400.0, 0.0), (500.0, 8.0), (600.0, 15.6), (700.0, 18.4)];
        let rgb = spectrum_to_rgb(&samples, SpectrumRole::Emission).to_array();
        let curve = Curve::new(samples.into());
        let seen = mean(|channels| channels.seen(channels.curve(&curve, Color::black())));
        for (seen, rgb) in seen.into_iter().zip(rgb) {
            // The rule of Mitsuba that gives the colour is off by a step in a thousand at the ends.
            assert!((seen / rgb - 1.0).abs() < 2e-3, "{seen} {rgb}");
        }
    }

    #[test]
    fn matter_lies_between_its_channels_and_grey_is_exact() {
        for i in 0..100_u8 {
            let channels = Wavelengths::of_number(f32::from(i) / 100.0);
            assert_eq!(channels.matter(Rgb::new(0.3, 0.3, 0.3)), Sampled([0.3; COUNT]));
            for rgb in [[0.9, 0.1, 0.5], [0.0, 1.0, 1.0], [0.0, 0.0, 1e-20], [7.0, 8.0, 0.0]] {
                let [least, largest] =
                    [f32::min, f32::max].map(|pick| rgb.into_iter().reduce(pick).unwrap_or(0.0));
                let matter = channels.matter(rgb.into());
                assert!(matter.0.iter().all(|x| (least..=largest).contains(x)), "{rgb:?}");
            }
        }
    }

    #[test]
    fn primaries_are_shares() {
        for (red, green) in primaries::RED.into_iter().zip(primaries::GREEN) {
            assert!(red >= 0.0 && green >= 0.0 && red + green <= 1.0 + f32::EPSILON);
        }
    }
}
