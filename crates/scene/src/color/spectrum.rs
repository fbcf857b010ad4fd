//! From spectra to linear RGB.

use etendue_math::Rgb;

use super::cie;
use super::curve::interpolate;

/// What a spectrum describes, which decides how it becomes a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpectrumRole {
    /// A share of light, seen under daylight: 1 everywhere is white.
    Reflectance,
    /// A property of matter such as an index of refraction, seen under daylight, not bounded by 1.
    Material,
    /// Emitted light: 1 everywhere is the slightly reddish white of equal energy.
    Emission,
}

/// The steps of the quadrature, as in Mitsuba.
const STEPS: u32 = 1000;

/// Linear RGB of a sampled spectrum, which is linear between its samples and 0 outside them.
///
/// ```text
/// XYZ = 1/∫y dλ · ∫ v(λ) e(λ) (x, y, z)(λ) dλ      e = D65 of unit luminance, or 1 for emission
/// RGB = M · XYZ                                    M: Rec. 709 primaries, white point D65
/// ```
///
/// `samples` are pairs of a wavelength in nanometres, increasing, and a value; with fewer than two the
/// colour is black. The result is not clamped: colours outside the gamut have negative components.
///
/// # Precision
/// That of a midpoint rule of 1000 steps over 360–830 nm; agrees with Mitsuba to single precision.
///
/// # Source
/// Mitsuba 3, `src/core/spectrum.cpp`, `spectrum_list_to_srgb`.
pub fn spectrum_to_rgb(samples: &[(f64, f64)], role: SpectrumRole) -> Rgb<f64> {
    let mut xyz = [0.0; 3];
    for step in 0..STEPS {
        let range = cie::LAST_WAVELENGTH - cie::FIRST_WAVELENGTH;
        let wavelength = cie::FIRST_WAVELENGTH + f64::from(step) / f64::from(STEPS - 1) * range;
        let illuminant = match role {
            SpectrumRole::Emission => 1.0,
            SpectrumRole::Reflectance | SpectrumRole::Material => {
                cie::interpolate(&cie::D65, wavelength) * cie::D65_SCALE
            }
        };
        let weight = interpolate(samples, wavelength) * illuminant;
        for (sum, table) in xyz.iter_mut().zip([&cie::X, &cie::Y, &cie::Z]) {
            *sum += weight * cie::interpolate(table, wavelength);
        }
    }
    let step = (cie::LAST_WAVELENGTH - cie::FIRST_WAVELENGTH) / f64::from(STEPS);
    xyz_to_rgb(xyz.map(|sum| sum * step / cie::Y_INTEGRAL))
}

/// Linear RGB of emitted light with the value 1 at every wavelength.
pub fn equal_energy_white() -> Rgb<f64> {
    xyz_to_rgb([1.0; 3])
}

/// CIE XYZ to linear RGB with Rec. 709 primaries and white point D65.
pub(super) fn xyz_to_rgb([x, y, z]: [f64; 3]) -> Rgb<f64> {
    Rgb::new(
        3.240479 * x - 1.537150 * y - 0.498535 * z,
        -0.969256 * x + 1.875991 * y + 0.041556 * z,
        0.055648 * x - 0.204043 * y + 1.057311 * z,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    type Case<'a> = (&'a [(f64, f64)], SpectrumRole, [f64; 3]);

    /// Spectra and the colours Mitsuba 3.9.1, `scalar_rgb`, makes of them.
    #[test]
    fn colours_are_those_of_mitsuba() {
        use SpectrumRole::{Emission, Material, Reflectance};
        let grey = [(400.0, 0.78), (500.0, 0.78), (600.0, 0.78), (700.0, 0.78)];
        let lamp = [(400.0, 0.0), (500.0, 8.0), (600.0, 15.6), (700.0, 18.4)];
        let orange = [(400.0, 0.1), (500.0, 0.5), (600.0, 0.9), (700.0, 0.2)];
        let index = [(400.0, 1.5), (700.0, 2.5)];
        let wide = [(360.0, 2.0), (830.0, 2.0)];
        let cases: [Case<'_>; 6] = [
            (&grey, Reflectance, [0.776367, 0.77981, 0.776029]),
            (&lamp, Emission, [20.7108, 10.8546, 2.77115]),
            (&orange, Reflectance, [0.833826, 0.689122, 0.265243]),
            (&orange, Emission, [0.974324, 0.661608, 0.229711]),
            (&index, Material, [2.29716, 1.97609, 1.62841]),
            (&wide, Emission, [2.40977, 1.89646, 1.81853]),
        ];
        for (samples, role, expected) in cases {
            let rgb = spectrum_to_rgb(samples, role).to_array();
            for (ours, theirs) in rgb.into_iter().zip(expected) {
                // Mitsuba adds a thousand terms in single precision and prints six digits.
                assert!((ours / theirs - 1.0).abs() < 2e-5, "{rgb:?} {expected:?}");
            }
        }
    }

    #[test]
    fn equal_energy_white_is_that_of_a_constant_spectrum() {
        let white = spectrum_to_rgb(&[(300.0, 1.0), (900.0, 1.0)], SpectrumRole::Emission);
        let pairs = white.to_array().into_iter().zip(equal_energy_white().to_array());
        for (sampled, exact) in pairs {
            // The tables integrate to 1 in x, y and z to four digits, and M amplifies by five.
            assert!((sampled - exact).abs() < 2e-3, "{sampled} {exact}");
        }
        // mi.load_dict: emitter with <spectrum value="0.5"/> has this radiance, to six digits.
        let mitsuba = [0.602397, 0.474146, 0.454458];
        for (ours, theirs) in equal_energy_white().to_array().into_iter().zip(mitsuba) {
            assert!((0.5 * ours - theirs).abs() < 1e-6);
        }
    }
}
