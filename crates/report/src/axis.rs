//! Axes of charts.

use etendue_math::Real;

/// How values are spread over an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Evenly, from 0.
    Linear,
    /// By their logarithm. What is 0 or less stands on the lower end.
    Log,
}

/// What an axis says and how it is divided.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Axis {
    /// Quantity and unit.
    pub label: String,
    /// How values are spread.
    pub scale: Scale,
}

impl Axis {
    /// A logarithmic axis.
    pub fn log(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Log }
    }

    /// An axis from 0.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Linear }
    }
}

/// An axis that holds given values: its ends and its ticks.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisRange {
    scale: Scale,
    ends: [f64; 2],
    step: f64,
}

impl AxisRange {
    /// The shortest axis with round ends that holds all finite `values`.
    pub fn of(scale: Scale, values: impl Iterator<Item = f64>) -> Self {
        match scale {
            Scale::Linear => {
                let peak = values.filter(|v| v.is_finite()).fold(0.0, f64::max);
                Self::linear(peak)
            }
            Scale::Log => {
                let positive = values.filter(|v| v.is_finite() && *v > 0.0);
                let (low, high) = positive
                    .fold((f64::INFINITY, 0.0), |(l, h): (f64, f64), v| (l.min(v), h.max(v)));
                if high == 0.0 {
                    return Self { scale, ends: [0.1, 10.0], step: 1.0 };
                }
                // A little room, so that no point lies on the frame.
                let first = (decade(low) - 0.05).floor();
                let last = (decade(high) + 0.05).ceil().max(first + 1.0);
                let step = ((last - first) / 8.0).ceil();
                Self { scale, ends: [first, last].map(power_of_ten), step }
            }
        }
    }

    /// From 0 to a round number, in at most five round steps.
    pub fn linear(peak: f64) -> Self {
        let scale = Scale::Linear;
        if !(peak > 0.0 && peak.is_finite()) {
            return Self { scale, ends: [0.0, 1.0], step: 0.5 };
        }
        // A hair of room, so that an albedo of 1 + 1e-9 does not need another step.
        let peak = peak * (1.0 - 1e-6);
        let power = power_of_ten(decade(peak / 5.0).floor());
        let step = [1.0, 2.0, 2.5, 5.0, 10.0]
            .map(|factor| factor * power)
            .into_iter()
            .find(|step| 5.0 * step >= peak)
            .unwrap_or(10.0 * power);
        Self { scale, ends: [0.0, step * (peak / step).ceil()], step }
    }

    /// Whether values are spread like this.
    pub fn is(&self, scale: Scale) -> bool {
        self.scale == scale
    }

    /// Where the axis ends.
    pub fn ends(&self) -> [f64; 2] {
        self.ends
    }

    /// Where a value lies: 0 at the lower end, 1 at the upper. What lies beyond an end counts as that end, NaN as the lower.
    pub fn place(&self, value: f64) -> f64 {
        let [low, high] = self.ends;
        let place = match self.scale {
            Scale::Linear => (value - low) / (high - low),
            Scale::Log => decade(value.max(low) / low) / decade(high / low),
        };
        if place > 0.0 { place.min(1.0) } else { 0.0 }
    }

    /// Where the axis is labelled.
    pub fn ticks(&self) -> Vec<f64> {
        let [low, high] = self.ends;
        match self.scale {
            Scale::Linear => {
                let count = (high / self.step).round() as u32;
                (0..=count).map(|i| f64::from(i) * self.step).collect()
            }
            Scale::Log => {
                let [first, last] = [low, high].map(|x| decade(x).round());
                let count = ((last - first) / self.step).floor() as u32;
                (0..=count).map(|i| power_of_ten(first + f64::from(i) * self.step)).collect()
            }
        }
    }

    /// A tick's label: with as many decimals as the step has, or the power of ten.
    pub fn label(&self, tick: f64) -> String {
        match self.scale {
            Scale::Linear => {
                let decimals = (0..6).find(|&d| {
                    let scaled = self.step * Real::powi(10.0_f64, d);
                    (scaled - scaled.round()).abs() < 1e-6 * scaled
                });
                match decimals {
                    Some(decimals) => format!("{tick:.*}", decimals as usize),
                    None => format!("{tick:.1e}"),
                }
            }
            Scale::Log => match decade(tick).round() as i32 {
                -2 => "0.01".to_owned(),
                -1 => "0.1".to_owned(),
                exponent @ 0..=3 => format!("{:.0}", power_of_ten(exponent.into())),
                exponent => format!("10{}", superscript(exponent)),
            },
        }
    }
}

/// The decimal logarithm; of a power of ten its exponent but for a rounding, which no use of it tells from the exponent.
fn decade(x: f64) -> f64 {
    Real::ln(x) / core::f64::consts::LN_10
}

fn power_of_ten(exponent: f64) -> f64 {
    Real::powf(10.0_f64, exponent)
}

/// An exponent in raised digits.
fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let sign = if exponent < 0 { "⁻" } else { "" };
    let digits = exponent.unsigned_abs().to_string();
    let raised = digits.bytes().map(|d| DIGITS[usize::from(d - b'0')]);
    sign.chars().chain(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_axes_are_round_and_hold_their_peak() {
        for (peak, end, step) in
            [(1.0, 1.0, 0.2), (1.04, 1.25, 0.25), (0.31, 0.4, 0.1), (7300.0, 8000.0, 2000.0)]
        {
            let axis = AxisRange::linear(peak);
            assert!((axis.ends[1] / end - 1.0).abs() < 1e-12, "{peak}: {axis:?}");
            assert!((axis.step / step - 1.0).abs() < 1e-12, "{peak}: {axis:?}");
        }
        assert_eq!(AxisRange::linear(f64::NAN).ends, [0.0, 1.0]);
        assert_eq!(AxisRange::linear(1.2).label(0.5), "0.50");
        assert_eq!(AxisRange::linear(7300.0).label(2000.0), "2000");
    }

    #[test]
    fn logarithmic_axes_hold_whole_decades_and_what_is_zero_stands_on_the_lower_end() {
        let axis = AxisRange::of(Scale::Log, [3e-7, 0.0, f64::NAN, 0.02].into_iter());
        assert_eq!(axis.ticks().len(), 7);
        assert!(
            (axis.ends[0] / 1e-7 - 1.0).abs() < 1e-12 && (axis.ends[1] / 0.1 - 1.0).abs() < 1e-12
        );
        assert_eq!([0.0, f64::NAN, -1.0].map(|v| axis.place(v)), [0.0; 3]);
        assert!((axis.place(1e-4) - 0.5).abs() < 1e-12);
        assert_eq!(axis.label(1e-7), "10⁻⁷");
        assert_eq!(axis.label(0.1), "0.1");
    }
}
