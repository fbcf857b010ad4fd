//! What curves are made of.

use alloc::vec::Vec;

use etendue_math::glam::{DVec3, Vec3};

/// A control point of a curve and its radius there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// Where it is.
    pub position: Vec3,
    /// Not negative.
    pub radius: f32,
}

impl CurvePoint {
    #[inline]
    pub(super) fn exact(&self) -> (DVec3, f64) {
        (self.position.as_dvec3(), f64::from(self.radius))
    }

    fn is_valid(&self) -> bool {
        self.position.is_finite() && self.radius.is_finite() && self.radius >= 0.0
    }
}

/// How control points make a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveBasis {
    /// Straight from point to point.
    Linear,
    /// A uniform cubic B-spline, which begins and ends near the second point and the last but one.
    BSpline,
}

impl CurveBasis {
    /// The control points of one segment, the fewest that a curve can have: 2 or 4.
    pub fn degree_plus_one(self) -> u32 {
        match self {
            Self::Linear => 2,
            Self::BSpline => 4,
        }
    }
}

/// Why control points do not make curves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CurveError {
    /// There is no curve.
    #[error("there is no curve")]
    Empty,
    /// A curve has too few points for a segment.
    #[error("curve {curve} has {points} control points, fewer than {needed}")]
    Short {
        /// Counted from 0.
        curve: u32,
        /// How many it has.
        points: u32,
        /// How many a segment has.
        needed: u32,
    },
    /// The lengths of the curves do not add up to the number of points.
    #[error("the curves have {expected} control points together, and there are {found}")]
    Length {
        /// By the lengths.
        expected: u64,
        /// How many there are.
        found: usize,
    },
    /// A coordinate is NaN or infinite, or a radius is, or is negative.
    #[error("control point {point} is not finite, or its radius is negative")]
    Point {
        /// Counted from 0 through all curves.
        point: u32,
    },
    /// There are more segments than can be numbered.
    #[error("there are too many segments")]
    TooMany,
}

/// The first control points of all segments, of curves that follow one another.
pub(super) fn segments(
    basis: CurveBasis,
    points: &[CurvePoint],
    lengths: &[u32],
) -> Result<Vec<u32>, CurveError> {
    let needed = basis.degree_plus_one();
    let expected = lengths.iter().map(|&length| u64::from(length)).sum::<u64>();
    if expected != points.len() as u64 {
        return Err(CurveError::Length { expected, found: points.len() });
    }
    if u32::try_from(points.len()).is_err() {
        return Err(CurveError::TooMany);
    }
    if let Some(point) = points.iter().position(|point| !point.is_valid()) {
        return Err(CurveError::Point { point: point as u32 });
    }
    let mut segments = Vec::new();
    let mut start = 0;
    for (curve, &points) in (0..).zip(lengths) {
        if points < needed {
            return Err(CurveError::Short { curve, points, needed });
        }
        segments.extend(start..=start + points - needed);
        start += points;
    }
    if segments.is_empty() {
        return Err(CurveError::Empty);
    }
    Ok(segments)
}
