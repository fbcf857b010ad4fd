//! How far from the exact value an answer may lie; shared with the firmware that checks the same rows.

/// Largest condition-scaled error in ulps of `f32` of rows drawn at random.
pub(crate) const TYPICAL: f64 = 8.0;
/// The same of rows sought out because they are hard.
pub(crate) const HARD: f64 = 64.0;

/// The smallest positive `f32`, 2⁻¹⁴⁹.
pub(crate) const LEAST: f64 = f32::from_bits(1) as f64;

/// Spacing of `f32` at `x`, 2²³ of them to the power of two below.
pub(crate) fn ulp32(x: f64) -> f64 {
    if x.abs() < f64::from(f32::MIN_POSITIVE) {
        return LEAST;
    }
    // Sign and significand cleared.
    let power_below = f64::from_bits(x.to_bits() & f64::INFINITY.to_bits());
    power_below / 8_388_608.0
}
