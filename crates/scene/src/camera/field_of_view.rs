//! How much a perspective camera sees.

use etendue_math::Real;

use super::CameraError;

/// How much of the scene a perspective camera sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FieldOfView {
    /// The angle between the rays at opposite edges.
    Angle {
        /// In degrees, between 0 and 180, both excluded.
        degrees: f64,
        /// Which edges.
        axis: FovAxis,
    },
    /// A focal length as on 35 mm film, whose diagonal it sees.
    FocalLength {
        /// Positive.
        millimetres: f64,
    },
}

/// Along which axis of the picture a field of view is measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FovAxis {
    /// From left to right.
    #[default]
    X,
    /// From top to bottom.
    Y,
    /// Between opposite corners.
    Diagonal,
    /// The shorter one of the first two.
    Smaller,
    /// The longer one of the first two.
    Larger,
}

impl FieldOfView {
    /// Half the width of the picture at distance 1.
    ///
    /// ```text
    /// x: tan(φ/2)    y: a tan(φ/2)    diagonal: tan(φ/2) / √(1 + 1/a²)    a = width / height
    /// focal length f: diagonal with tan(φ/2) = √(36² + 24²) / 2f
    /// ```
    ///
    /// # Errors
    /// An angle outside (0°, 180°), a focal length that is not positive, a film without pixels.
    ///
    /// # Source
    /// Mitsuba 3's `parse_fov`.
    pub fn half_width(self, film_size: [u32; 2]) -> Result<f64, CameraError> {
        let [width, height] = film_size.map(f64::from);
        if width < 1.0 || height < 1.0 {
            return Err(CameraError::Film);
        }
        let aspect = width / height;
        let diagonal = |tan: f64| tan / Real::sqrt(1.0 + 1.0 / (aspect * aspect));
        match self {
            Self::FocalLength { millimetres } => {
                if !(millimetres > 0.0 && millimetres.is_finite()) {
                    return Err(CameraError::FocalLength(millimetres));
                }
                let film_diagonal = Real::sqrt(36.0_f64 * 36.0 + 24.0 * 24.0);
                Ok(diagonal(0.5 * film_diagonal / millimetres))
            }
            Self::Angle { degrees, axis } => {
                if !(degrees > 0.0 && degrees < 180.0) {
                    return Err(CameraError::FieldOfView(degrees));
                }
                let tan = Real::tan(0.5 * degrees.to_radians());
                Ok(match axis {
                    FovAxis::X => tan,
                    FovAxis::Y => tan * aspect,
                    FovAxis::Diagonal => diagonal(tan),
                    FovAxis::Smaller => tan * aspect.max(1.0),
                    FovAxis::Larger => tan * aspect.min(1.0),
                })
            }
        }
    }
}
