//! The sRGB transfer function.

use etendue_math::Real;

/// Linear light of an sRGB-encoded value.
///
/// ```text
/// x / 12.92                      x ≤ 0.04045
/// ((x + 0.055) / 1.055)^2.4      otherwise
/// ```
///
/// `x`: encoded value, nominally in [0, 1]; the same branches apply outside. NaN stays NaN.
///
/// # Precision
/// Relative error below 8 ε.
///
/// # Source
/// IEC 61966-2-1:1999, 5.2.
///
/// # Examples
/// ```
/// use etendue_scene::load::srgb;
/// assert!((srgb::decode(0.5f64) - 0.21404114).abs() < 1e-8);
/// ```
pub fn decode<T: Real>(x: T) -> T {
    if x <= T::lit(0.04045) {
        x / T::lit(12.92)
    } else {
        ((x + T::lit(0.055)) / T::lit(1.055)).powf(T::lit(2.4))
    }
}

/// The sRGB encoding of linear light, the inverse of [`decode`].
///
/// ```text
/// 12.92 x                        x ≤ 0.0031308
/// 1.055 x^(1/2.4) − 0.055        otherwise
/// ```
///
/// `x`: linear value, nominally in [0, 1]; the same branches apply outside. NaN stays NaN.
///
/// # Precision
/// Relative error below 8 ε. The standard's two thresholds are rounded: encoded values jump by 3e-8
/// between the branches.
///
/// # Source
/// IEC 61966-2-1:1999, 5.2.
pub fn encode<T: Real>(x: T) -> T {
    if x <= T::lit(0.0031308) {
        x * T::lit(12.92)
    } else {
        T::lit(1.055) * x.powf(T::lit(1.0 / 2.4)) - T::lit(0.055)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        assert_eq!(decode(0.0f64), 0.0);
        assert_eq!(decode(1.0f64), 1.0);
        // ((0.5 + 0.055) / 1.055)^2.4 to 16 digits.
        assert!((decode(0.5f64) - 0.214_041_140_482_232_4).abs() < 1e-15);
        assert!((encode(1.0f64) - 1.0).abs() < 1e-15);
        assert!((encode(0.001f64) - 0.01292).abs() < 1e-17);
        assert!(decode(f32::NAN).is_nan() && encode(f32::NAN).is_nan());
    }

    #[test]
    fn every_byte_survives_a_round_trip() {
        for byte in 0..=255u8 {
            let x = f32::from(byte) / 255.0;
            assert_eq!((encode(decode(x)) * 255.0).round(), f32::from(byte));
        }
    }

    #[test]
    fn both_directions_are_monotonic() {
        let steps = || (0..=4096u16).map(|i| f64::from(i) / 4096.0);
        assert!(steps().zip(steps().skip(1)).all(|(a, b)| decode(a) < decode(b)));
        assert!(steps().zip(steps().skip(1)).all(|(a, b)| encode(a) < encode(b)));
    }
}
