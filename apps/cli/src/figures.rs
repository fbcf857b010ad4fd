//! Figures as people read them.

use etendue_math::Real;
use etendue_renderer::progressive::ImageError;

/// `error 0.92 % ± 0.08`: to one or two digits of the distance to the upper end of the interval.
pub(crate) fn error_in_percent(error: &ImageError) -> String {
    if error.estimate == 0.0 {
        return "error 0 %".to_owned();
    }
    if !error.estimate.is_finite() {
        return "error unknown: the picture's mean is not positive".to_owned();
    }
    let (percent, margin) = (100.0 * error.estimate, 100.0 * (error.upper - error.estimate));
    let magnitude = Real::floor(Real::ln(margin) * core::f64::consts::LOG10_E);
    let decimals = (-magnitude).clamp(0.0, 9.0) as usize;
    format!("error {percent:.decimals$} % ± {margin:.decimals$}")
}

/// A time in a unit that suits it.
pub(crate) fn seconds(seconds: f64) -> String {
    match seconds {
        s if s < 0.95 => format!("{:.0} ms", 1e3 * s),
        s if s < 9.95 => format!("{s:.1} s"),
        s if s < 119.5 => format!("{s:.0} s"),
        s if s < 7170.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(estimate: f64, upper: f64) -> String {
        let error = ImageError { estimate, lower: 0.0, upper, degrees_of_freedom: 100.0 };
        error_in_percent(&error)
    }

    #[test]
    fn errors_have_as_many_digits_as_are_known() {
        assert_eq!(error(0.009, 0.010), "error 0.9 % ± 0.1");
        assert_eq!(error(0.009_16, 0.009_96), "error 0.92 % ± 0.08");
        assert_eq!(error(0.5, 0.62), "error 50 % ± 12");
        assert_eq!(error(0.0, 0.0), "error 0 %");
        assert_eq!(
            error(f64::INFINITY, f64::INFINITY),
            "error unknown: the picture's mean is not positive"
        );
    }

    #[test]
    fn times_have_the_unit_that_suits_them() {
        let times = [0.0123, 0.5, 1.24, 48.0, 600.0, 5400.0, 9000.0].map(seconds);
        assert_eq!(times, ["12 ms", "500 ms", "1.2 s", "48 s", "10 min", "90 min", "2.5 h"]);
    }
}
