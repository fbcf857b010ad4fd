//! The picture: its size, the part that is rendered, and the filter that turns samples into pixels.

use etendue_math::Real;

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crop {
    /// Column and row of the first pixel.
    pub offset: [u32; 2],
    /// Number of columns and rows.
    pub size: [u32; 2],
}

/// What the camera exposes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Film {
    /// Number of columns and rows of the whole picture, each at least 1.
    pub size: [u32; 2],
    /// The part of it that is rendered.
    pub crop: Crop,
    /// The weight of a sample by its distance from a pixel's centre.
    pub filter: ReconstructionFilter,
    /// Whether samples are also taken outside the film, as far as the filter reaches. Crops fit
    /// together either way.
    pub sample_border: bool,
}

impl Film {
    /// A film of the given size, rendered whole, with Mitsuba's default filter; a size of 0 is made 1.
    pub fn new(size: [u32; 2]) -> Self {
        let size = size.map(|n| n.max(1));
        Self {
            size,
            crop: Crop { offset: [0, 0], size },
            filter: ReconstructionFilter::default(),
            sample_border: false,
        }
    }

    /// Whether the crop is not empty and lies within the film.
    pub fn contains_crop(&self) -> bool {
        (0..2).all(|axis| {
            let Crop { offset, size } = self.crop;
            let end = offset[axis].checked_add(size[axis]);
            size[axis] > 0 && end.is_some_and(|end| end <= self.size[axis])
        })
    }
}

/// The filter with which samples are weighted, a product of one function of x and one of y.
///
/// # Source
/// Mitsuba 3's `rfilter` plugins; Mitchell and Netravali 1988, equation 8.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ReconstructionFilter {
    /// 1 within the radius.
    Box {
        /// In pixels, ½ for one pixel.
        radius: f32,
    },
    /// Falls linearly to 0 at the radius.
    Tent {
        /// In pixels.
        radius: f32,
    },
    /// A Gaussian shifted to reach 0 at four standard deviations.
    Gaussian {
        /// In pixels.
        stddev: f32,
    },
    /// Mitchell and Netravali's cubic; ⅓ and ⅓ are their recommendation.
    Mitchell {
        /// Their B.
        b: f32,
        /// Their C.
        c: f32,
    },
    /// Mitchell and Netravali's cubic with B = 0, C = ½.
    CatmullRom,
    /// A sinc windowed by the central lobe of a wider one.
    Lanczos {
        /// Lobes on each side, at least 1.
        lobes: u32,
    },
}

impl Default for ReconstructionFilter {
    /// Mitsuba's default: a Gaussian of half a pixel.
    fn default() -> Self {
        Self::Gaussian { stddev: 0.5 }
    }
}

impl ReconstructionFilter {
    /// The distance in pixels from which the filter is 0.
    pub fn radius(&self) -> f32 {
        match *self {
            Self::Box { radius } | Self::Tent { radius } => radius,
            Self::Gaussian { stddev } => 4.0 * stddev,
            Self::Mitchell { .. } | Self::CatmullRom => 2.0,
            Self::Lanczos { lobes } => lobes as f32,
        }
    }

    /// The weight at `x` pixels from the centre: 1 at or near 0, not normalised, negative in the
    /// side lobes of the cubics and of Lanczos's; 0 beyond the radius and for NaN.
    ///
    /// ```text
    /// box       1
    /// tent      1 − |x|/r
    /// gaussian  exp(−x²/2σ²) − exp(−8)
    /// Lanczos   sinc(x) sinc(x/n),  sinc(x) = sin(πx)/(πx)
    /// ```
    ///
    /// # Source
    /// As above. Mitsuba evaluates the Gaussian by a polynomial that differs by up to 4·10⁻⁴; this
    /// is the function it stands for.
    pub fn eval(&self, x: f32) -> f32 {
        let x = x.abs();
        let radius = self.radius();
        // False for NaN too.
        let inside = x <= radius;
        if !inside {
            return 0.0;
        }
        match *self {
            Self::Box { .. } => 1.0,
            Self::Tent { .. } => 1.0 - x / radius,
            Self::Gaussian { stddev } => {
                let gaussian = |x: f32| Real::exp(-0.5 * Real::sqr(x / stddev));
                gaussian(x) - gaussian(radius)
            }
            Self::Mitchell { b, c } => mitchell_netravali(x, b, c),
            Self::CatmullRom => mitchell_netravali(x, 0.0, 0.5),
            Self::Lanczos { .. } => sinc(x) * sinc(x / radius),
        }
    }
}

/// Mitchell and Netravali's cubic for x in `[0, 2]`.
fn mitchell_netravali(x: f32, b: f32, c: f32) -> f32 {
    let sixfold = if x < 1.0 {
        ((12.0 - 9.0 * b - 6.0 * c) * x + (-18.0 + 12.0 * b + 6.0 * c)) * x * x + (6.0 - 2.0 * b)
    } else {
        (((-b - 6.0 * c) * x + (6.0 * b + 30.0 * c)) * x + (-12.0 * b - 48.0 * c)) * x
            + (8.0 * b + 24.0 * c)
    };
    sixfold / 6.0
}

/// sin(πx)/(πx), 1 at 0.
fn sinc(x: f32) -> f32 {
    let angle = x * f32::PI;
    if angle < f32::EPSILON { 1.0 } else { Real::sin(angle) / angle }
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: [f32; 7] = [0.0, 0.25, 0.5, 1.0, 1.25, 1.75, 2.5];

    #[test]
    fn filters_have_mitsubas_values() {
        // Values by Mitsuba 3.9.1's `rfilter.eval`, the Gaussian's excepted.
        let third = 1.0 / 3.0;
        let cases: [(ReconstructionFilter, [f32; 7]); 5] = [
            (ReconstructionFilter::Box { radius: 0.5 }, [1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0]),
            (ReconstructionFilter::Tent { radius: 1.0 }, [1.0, 0.75, 0.5, 0.0, 0.0, 0.0, 0.0]),
            (
                ReconstructionFilter::Mitchell { b: third, c: third },
                [0.888889, 0.7821181, 0.5347223, 0.0555556, -0.0234374, -0.0147567, 0.0],
            ),
            (
                ReconstructionFilter::CatmullRom,
                [1.0, 0.8671875, 0.5625, 0.0, -0.0703125, -0.0234375, 0.0],
            ),
            (
                ReconstructionFilter::Lanczos { lobes: 3 },
                [1.0, 0.890067, 0.6079271, 0.0, -0.132871, -0.0677913, 0.0243171],
            ),
        ];
        for (filter, expected) in cases {
            for (x, value) in X.into_iter().zip(expected) {
                // Six digits are printed above and cubics cancel to a few ε of 1.
                let (plus, minus) = (filter.eval(x), filter.eval(-x));
                assert!((plus - value).abs() < 1e-6 && plus == minus, "{filter:?} {x}: {plus}");
            }
        }
    }

    #[test]
    fn the_gaussian_reaches_zero_at_its_radius() {
        let filter = ReconstructionFilter::Gaussian { stddev: 0.5 };
        assert_eq!(filter.radius(), 2.0);
        assert_eq!(filter.eval(2.0), 0.0);
        // exp(−½·1²/¼) − exp(−8) = 0.13499982, to an ε of each exponential.
        assert!((filter.eval(1.0) - 0.134_999_82).abs() < 1e-7);
        assert_eq!(filter.eval(f32::NAN), 0.0);
    }

    #[test]
    fn a_crop_must_lie_within_the_film() {
        let film = Film::new([4, 3]);
        let with = |offset, size| Film { crop: Crop { offset, size }, ..film }.contains_crop();
        assert!(film.contains_crop() && with([3, 2], [1, 1]));
        assert!(!with([3, 2], [2, 1]) && !with([0, 0], [4, 0]) && !with([u32::MAX, 0], [2, 1]));
        assert_eq!(Film::new([0, 0]).size, [1, 1]);
    }
}
