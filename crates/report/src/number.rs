//! Numbers as people read them.

use etendue_math::Real;

/// `value` with `digits` significant digits: plain between 0.001 and 100 000, else with a power of ten.
///
/// At least one digit; NaN, infinities and 0 by name.
///
/// # Examples
/// ```
/// use etendue_report::significant;
/// assert_eq!(significant(0.012345, 3), "0.0123");
/// assert_eq!(significant(12345.6, 2), "12000");
/// assert_eq!(significant(3.0e-9, 2), "3.0e-9");
/// assert_eq!(significant(0.0, 3), "0");
/// ```
pub fn significant(value: f64, digits: usize) -> String {
    let digits = digits.max(1);
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return match value {
            v if v.is_nan() => "NaN".to_owned(),
            v if v > 0.0 => "∞".to_owned(),
            _ => "−∞".to_owned(),
        };
    }
    // The exponent that remains after rounding to the digits asked for: 9.99 is 1.0e1 with two.
    let scientific = format!("{value:.*e}", digits - 1);
    let exponent: i32 = scientific.rsplit('e').next().and_then(|e| e.parse().ok()).unwrap_or(0);
    if !(-3..5).contains(&exponent) {
        return scientific;
    }
    let decimals = digits as i32 - 1 - exponent;
    if decimals >= 0 {
        format!("{value:.*}", decimals as usize)
    } else {
        let unit = Real::powi(10.0_f64, decimals.unsigned_abs());
        format!("{:.0}", (value / unit).round() * unit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_up_to_the_next_power_keeps_the_digits() {
        assert_eq!(significant(0.999_9, 2), "1.0");
        assert_eq!(significant(99_999.0, 2), "1.0e5");
        assert_eq!(significant(-2.345, 3), "-2.35");
        assert_eq!(significant(f64::NAN, 3), "NaN");
        assert_eq!(significant(f64::NEG_INFINITY, 3), "−∞");
    }
}
