//! Values of arguments: sizes, durations, errors and the like.

use std::time::Duration;

use etendue_scene::film::Crop;

fn numbers<const N: usize>(text: &str, separator: char) -> Option<[u32; N]> {
    let parsed: Vec<u32> =
        text.split(separator).map(|t| t.trim().parse().ok()).collect::<Option<_>>()?;
    parsed.try_into().ok()
}

pub(crate) fn size(text: &str) -> Result<[u32; 2], String> {
    match numbers(text, 'x') {
        Some(size) if !size.contains(&0) => Ok(size),
        _ => Err("expected WIDTHxHEIGHT, as in 640x480, both at least 1".to_owned()),
    }
}

pub(crate) fn crop(text: &str) -> Result<Crop, String> {
    let [x, y, w, h] =
        numbers(text, ',').ok_or("expected four numbers: left, top, width, height")?;
    Ok(Crop { offset: [x, y], size: [w, h] })
}

pub(crate) fn max_depth(text: &str) -> Result<i64, String> {
    match text.parse() {
        Ok(depth) if (-1..=i64::from(u32::MAX)).contains(&depth) => Ok(depth),
        _ => Err("expected a number of edges, or -1 for no limit".to_owned()),
    }
}

pub(crate) fn exposure(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(stops) if stops.abs() <= 64.0 => Ok(stops),
        _ => Err("expected a number of stops between -64 and 64".to_owned()),
    }
}

/// Units of time and their seconds; `ms` before `s`, which it ends with.
const UNITS: [(&str, f64); 4] = [("ms", 1e-3), ("min", 60.0), ("h", 3600.0), ("s", 1.0)];

/// A time with its unit, up to a year.
pub(crate) fn duration(text: &str) -> Result<Duration, String> {
    let with_unit = UNITS.iter().find_map(|(unit, seconds)| {
        let number: f64 = text.strip_suffix(unit)?.trim_end().parse().ok()?;
        Some(number * seconds)
    });
    match with_unit {
        Some(seconds) if seconds > 0.0 && seconds <= 365.0 * 86400.0 => {
            Ok(Duration::from_secs_f64(seconds))
        }
        _ => Err("expected a time above 0 with its unit, as in 500ms, 30s, 2min, 1h".to_owned()),
    }
}

/// A relative error, as a fraction or in percent.
pub(crate) fn relative_error(text: &str) -> Result<f64, String> {
    let (number, unit) = match text.strip_suffix('%') {
        Some(percent) => (percent.trim_end(), 0.01),
        None => (text, 1.0),
    };
    match number.parse::<f64>() {
        Ok(error) if error * unit > 0.0 && error * unit <= 1.0 => Ok(error * unit),
        _ => Err("expected an error above 0, up to 1 or 100%, as in 1% or 0.01".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_units() {
        for (text, milliseconds) in
            [("500ms", 500), ("30s", 30_000), ("2min", 120_000), ("1h", 3_600_000), ("1.5 s", 1500)]
        {
            assert_eq!(duration(text), Ok(Duration::from_millis(milliseconds)), "{text}");
        }
        for text in ["", "30", "s", "0s", "-1s", "nans", "infs", "1e99h", "1m", "2 hours"] {
            assert!(duration(text).is_err(), "{text}");
        }
    }

    #[test]
    fn errors_are_fractions_or_percentages() {
        assert_eq!(relative_error("0.01"), Ok(0.01));
        assert_eq!(relative_error("1%"), Ok(0.01));
        assert_eq!(relative_error("2.5 %"), Ok(0.025));
        for text in ["", "%", "0", "0%", "-1%", "NaN", "inf", "1.5", "150%", "one", "1%%"] {
            assert!(relative_error(text).is_err(), "{text}");
        }
    }
}
