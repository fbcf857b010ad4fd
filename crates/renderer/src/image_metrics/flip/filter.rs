//! Filters of ꟻLIP, all of them sums of products of a function of x and one of y.

use core::f64::consts::PI;

use etendue_math::Real;

/// One number per pixel.
pub(super) struct Plane {
    size: [usize; 2],
    values: Vec<f64>,
}

impl Plane {
    /// Values row by row.
    pub(super) fn new(size: [usize; 2], values: Vec<f64>) -> Self {
        Self { size, values }
    }

    /// Filtered along rows and columns; borders are continued by their pixels.
    fn filtered(&self, along_x: &[f64], along_y: &[f64]) -> Vec<f64> {
        let [width, height] = self.size;
        let rows = line_filter(&self.values, self.size, along_x, |[x, y], offset| {
            y * width + clamped(x, offset, width)
        });
        line_filter(&rows, self.size, along_y, |[x, y], offset| {
            clamped(y, offset, height) * width + x
        })
    }
}

fn line_filter(
    values: &[f64],
    [width, height]: [usize; 2],
    kernel: &[f64],
    place: impl Fn([usize; 2], isize) -> usize,
) -> Vec<f64> {
    let radius = (kernel.len() / 2) as isize;
    let mut filtered = Vec::with_capacity(values.len());
    for y in 0..height {
        for x in 0..width {
            let terms =
                (-radius..).zip(kernel).map(|(o, weight)| weight * values[place([x, y], o)]);
            filtered.push(terms.sum());
        }
    }
    filtered
}

fn clamped(i: usize, offset: isize, length: usize) -> usize {
    i.saturating_add_signed(offset).min(length - 1)
}

/// A Gaussian in space that is one in frequency, `exp(−b f²)`: weight and b of the published fits.
type Sensitivity = [f64; 2];

const ACHROMATIC: [Sensitivity; 1] = [[1.0, 0.0047]];
const RED_GREEN: [Sensitivity; 1] = [[1.0, 0.0053]];
const BLUE_YELLOW: [Sensitivity; 2] = [[34.1, 0.04], [13.5, 0.025]];
/// The widest of them.
const WIDEST: f64 = 0.04;
/// Width in degrees, from peak to trough, of what the eye finds edges with.
const FEATURE_WIDTH: f64 = 0.082;

/// Gaussians of one channel, each with its share, which add up to 1.
type Channel = Vec<(f64, Vec<f64>)>;

/// All filters for one number of pixels per degree.
pub(super) struct Kernels {
    channels: [Channel; 3],
    smooth: Vec<f64>,
    edge: Vec<f64>,
    point: Vec<f64>,
}

impl Kernels {
    pub(super) fn new(pixels_per_degree: f64) -> Self {
        let radius = (3.0 * (WIDEST / (2.0 * PI * PI)).sqrt() * pixels_per_degree).ceil() as i32;
        let channel = |sensitivities: &[Sensitivity]| -> Channel {
            let terms: Vec<(f64, Vec<f64>)> = sensitivities
                .iter()
                .map(|&[a, b]| {
                    let falloff = PI * PI / (b * pixels_per_degree * pixels_per_degree);
                    let kernel = gaussian(radius, falloff);
                    let sum: f64 = kernel.iter().sum();
                    (a * (PI / b).sqrt() * sum * sum, normalised(kernel))
                })
                .collect();
            let total: f64 = terms.iter().map(|(share, _)| share).sum();
            terms.into_iter().map(|(share, kernel)| (share / total, kernel)).collect()
        };
        let deviation = 0.5 * FEATURE_WIDTH * pixels_per_degree;
        let feature_radius = (3.0 * deviation).ceil() as i32;
        let gaussian = gaussian(feature_radius, 0.5 / (deviation * deviation));
        let derivative = |factor: &dyn Fn(f64) -> f64| {
            let values = (-feature_radius..).zip(&gaussian);
            halves_normalised(values.map(|(x, g)| factor(x.into()) * g).collect())
        };
        Self {
            channels: [channel(&ACHROMATIC), channel(&RED_GREEN), channel(&BLUE_YELLOW)],
            edge: derivative(&|x| -x),
            point: derivative(&|x| x * x / (deviation * deviation) - 1.0),
            smooth: normalised(gaussian),
        }
    }

    /// What the eye sees of luminance.
    pub(super) fn achromatic(&self, plane: &Plane) -> Vec<f64> {
        seen(plane, &self.channels[0])
    }

    /// What it sees of red against green.
    pub(super) fn red_green(&self, plane: &Plane) -> Vec<f64> {
        seen(plane, &self.channels[1])
    }

    /// What it sees of blue against yellow.
    pub(super) fn blue_yellow(&self, plane: &Plane) -> Vec<f64> {
        seen(plane, &self.channels[2])
    }

    /// First derivative of a Gaussian.
    pub(super) fn edge(&self) -> &[f64] {
        &self.edge
    }

    /// Second derivative.
    pub(super) fn point(&self) -> &[f64] {
        &self.point
    }

    /// The derivative along x and along y, smoothed across.
    pub(super) fn along_both_axes(&self, plane: &Plane, derivative: &[f64]) -> [Vec<f64>; 2] {
        [plane.filtered(derivative, &self.smooth), plane.filtered(&self.smooth, derivative)]
    }
}

fn seen(plane: &Plane, channel: &Channel) -> Vec<f64> {
    let mut sum = vec![0.0; plane.values.len()];
    for (share, kernel) in channel {
        for (sum, value) in sum.iter_mut().zip(plane.filtered(kernel, kernel)) {
            *sum += share * value;
        }
    }
    sum
}

/// `exp(−falloff x²)` for whole x up to the radius.
fn gaussian(radius: i32, falloff: f64) -> Vec<f64> {
    (-radius..=radius).map(|x| Real::exp(-falloff * f64::from(x * x))).collect()
}

fn normalised(mut kernel: Vec<f64>) -> Vec<f64> {
    let sum: f64 = kernel.iter().sum();
    for weight in &mut kernel {
        *weight /= sum;
    }
    kernel
}

/// Positive weights add up to 1, negative ones to −1.
fn halves_normalised(mut kernel: Vec<f64>) -> Vec<f64> {
    let positive: f64 = kernel.iter().filter(|w| **w > 0.0).sum();
    let negative: f64 = -kernel.iter().filter(|w| **w < 0.0).sum::<f64>();
    for weight in &mut kernel {
        *weight /= if *weight > 0.0 { positive } else { negative };
    }
    kernel
}
