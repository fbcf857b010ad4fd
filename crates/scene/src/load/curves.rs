//! Text files of curves, as Mitsuba's `linearcurve` and `bsplinecurve` read them.
//!
//! A line is a control point: three coordinates and a radius. Empty lines end a curve.
//!
//! # Source
//! Mitsuba 3, `src/shapes/linearcurve.cpp` and `bsplinecurve.cpp`.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use std::path::Path;

use etendue_math::glam::Vec3;

use super::file::read_asset;
use super::lines::{Lines, quote, real};
use crate::error::{Location, SceneError, Warning, Warnings};
use crate::geometry::{CurveBasis, CurvePoint};

/// The control points of a file, of curves that follow one another.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveFile {
    /// Of all curves. Radii are finite and not negative.
    pub points: Vec<CurvePoint>,
    /// How many of them each curve has.
    pub lengths: Vec<u32>,
    /// What looks suspicious.
    pub warnings: Vec<Warning>,
}

/// The curves of a file.
///
/// # Errors
/// A file that cannot be read, and everything [`parse_curves`] refuses.
pub fn load_curves(path: &Path, basis: CurveBasis) -> Result<CurveFile, SceneError> {
    parse_curves(&read_asset(path)?, path, basis)
}

/// The curves of the bytes of a file. `path` stands in messages.
///
/// # Errors
/// A line of fewer than four numbers, numbers that are not finite, radii below 0, curves of fewer points than a segment
/// of the basis has, no curve at all.
pub fn parse_curves(bytes: &[u8], path: &Path, basis: CurveBasis) -> Result<CurveFile, SceneError> {
    let error = |line: u32, message: String| SceneError::scene(Location::line(path, line), message);
    let (mut points, mut lengths) = (Vec::new(), Vec::new());
    let mut warnings = Warnings::new();
    // The number of points of the curve being read, and the line that it began in.
    let (mut length, mut first) = (0_u32, 0);
    let mut end = |length: &mut u32, first: u32| {
        let needed = basis.degree_plus_one();
        match core::mem::take(length) {
            0 => Ok(()),
            length if length < needed => {
                let message = format!(
                    "a curve with {length} control point{}, expected {needed} or more",
                    if length == 1 { "" } else { "s" }
                );
                Err(error(first, message).help("an empty line ends a curve"))
            }
            length => {
                lengths.push(length);
                Ok(())
            }
        }
    };
    for line in Lines::new(bytes) {
        let mut fields =
            line.text.split(u8::is_ascii_whitespace).filter(|field| !field.is_empty()).peekable();
        if fields.peek().is_none() {
            end(&mut length, first)?;
            continue;
        }
        let mut numbers = [0.0; 4];
        for (i, number) in numbers.iter_mut().enumerate() {
            let Some(field) = fields.next() else {
                let message =
                    format!("a control point of {i} numbers, expected x, y, z and a radius");
                return Err(error(line.number, message));
            };
            *number = real(field).map_err(|message| error(line.number, message))?;
        }
        let [x, y, z, radius] = numbers;
        if radius < 0.0 {
            return Err(error(line.number, format!("the radius {radius} is negative")));
        }
        if let Some(field) = fields.next()
            && warnings.is_empty()
        {
            let message = format!(
                "{} and what follows the four numbers of a control point is not used",
                quote(field)
            );
            warnings.push(Warning::new(Location::line(path, line.number), message));
        }
        if length == 0 {
            first = line.number;
        }
        // A saturated count is not that of the points, which `Curves::new` refuses.
        length = length.saturating_add(1);
        points.push(CurvePoint { position: Vec3::new(x, y, z), radius });
    }
    end(&mut length, first)?;
    if lengths.is_empty() {
        let message = "the file has no control points";
        return Err(SceneError::scene(Location::file(path), message)
            .help("a line is a control point: x, y, z and a radius"));
    }
    Ok(CurveFile { points, lengths, warnings })
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    fn read(text: &str, basis: CurveBasis) -> Result<CurveFile, SceneError> {
        parse_curves(text.as_bytes(), Path::new("a.txt"), basis)
    }

    #[test]
    fn empty_lines_end_curves() {
        let text = "\n \t\n0 0 0 1\r\n 1 2 3 0.5\n\n\n-1 0 0 0\n0 1e1 0 2\n0 0 1 3";
        let file = read(text, CurveBasis::Linear).expect("two curves");
        assert_eq!(file.lengths, [2, 3]);
        let last = CurvePoint { position: Vec3::Z, radius: 3.0 };
        assert_eq!((file.points.len(), file.points[4]), (5, last));
        assert!(file.warnings.is_empty());
    }

    #[test]
    fn what_follows_four_numbers_is_warned_of_once() {
        let file = read("0 0 0 1 7\n0 0 1 1 8\n", CurveBasis::Linear).expect("a curve");
        assert_eq!(file.warnings.len(), 1);
        assert_eq!(file.warnings[0].location, Location::line("a.txt", 1));
        assert!(file.warnings[0].message.starts_with("'7'"));
    }

    #[test]
    fn what_makes_no_curve_is_refused_with_its_line() {
        let refused = |text: &str, basis, start: &str, fragment: &str| {
            let error = read(text, basis).expect_err(fragment).to_string();
            assert!(error.starts_with(start) && error.contains(fragment), "{error}");
        };
        let linear = CurveBasis::Linear;
        refused("", linear, "a.txt: ", "no control points");
        refused(" \n\n", linear, "a.txt: ", "no control points");
        refused("0 0 0 1\n0 0 1", linear, "a.txt:2: ", "of 3 numbers");
        refused("0 0 0 1\n0 0 x 1", linear, "a.txt:2: ", "'x' is not a number");
        refused("0 nan 0 1\n0 0 0 1", linear, "a.txt:1: ", "'nan' is not a finite number");
        refused("0 0 0 inf\n0 0 0 1", linear, "a.txt:1: ", "'inf' is not a finite number");
        refused("0 0 0 1\n0 0 0 -1", linear, "a.txt:2: ", "radius -1 is negative");
        refused("0 0 0 1\n0 0 1 1\n\n0 0 0 1\n", linear, "a.txt:4: ", "with 1 control point,");
        let three = "0 0 0 1\n0 0 1 1\n0 0 2 1\n";
        refused(three, CurveBasis::BSpline, "a.txt:1: ", "with 3 control points, expected 4");
        refused("# hair\n0 0 0 1\n0 0 1 1", linear, "a.txt:1: ", "'#' is not a number");
        refused("\u{0}\u{1}", linear, "a.txt:1: ", "is not a number");
    }
}
