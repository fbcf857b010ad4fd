//! Where in a pixel's neighbourhood a sample lies, and its weight.

use etendue_scene::film::{Film, ReconstructionFilter};

use super::filter_table::{FilterTable, Span};

/// Draws film positions in proportion to the reconstruction filter.
///
/// ```text
/// pixel = ∫ k(x−c) L(x) dx / ∫ k(x−c) dx
///       ≈ 1/n Σ sign k(xᵢ−c) · (∫|k| / ∫k) · L(xᵢ),   xᵢ ~ |k(x−c)|
/// ```
///
/// Each pixel owns its samples: no sample is splatted to a neighbour, so that pixels may be
/// computed in any order, on any thread or machine, with the same bits. Where the film ends and
/// `sample_border` is off, both integrals and the samples are restricted to the film, which is
/// what normalised splatting of samples inside the film converges to. Where a crop ends nothing
/// changes: its pixels are those of the whole picture.
///
/// # Precision
/// The filter is a staircase of 256 cells per axis; a box filter of radius ½ is exact.
///
/// # Source
/// Ernst, Stamminger, Greiner, "Filter Importance Sampling", IEEE Symposium on Interactive Ray
/// Tracing 2006. Departure: negative lobes by signed weights instead of a separate pass.
#[derive(Clone, Debug)]
pub struct FilterSampler {
    shape: Shape,
    /// The rectangle samples may lie in: [low, high] per axis, in film pixels.
    domain: [[f32; 2]; 2],
}

#[derive(Clone, Debug)]
enum Shape {
    /// Box of radius ½: the pixel's own square, every weight 1.
    Pixel,
    Table(FilterTable),
}

/// The filter of one pixel, ready to be sampled.
#[derive(Clone, Copy, Debug)]
pub struct PixelFilter<'a> {
    centre: [f32; 2],
    spans: Option<(&'a FilterTable, [Span; 2])>,
}

/// A position on the film and the weight of the radiance found there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmSample {
    /// Position in pixels of the full film.
    pub position: [f32; 2],
    /// Signed, dimensionless; its mean over a pixel's samples is 1.
    pub weight: f32,
}

impl FilterSampler {
    /// The sampler of a film's filter. A filter that cannot be normalised (its integral is not
    /// positive) is replaced by the pixel's own square.
    pub fn new(film: &Film) -> Self {
        let shape = match film.filter {
            ReconstructionFilter::Box { radius: 0.5 } => Shape::Pixel,
            ref filter => FilterTable::new(filter).map_or(Shape::Pixel, Shape::Table),
        };
        let domain = film.size.map(|end| {
            if film.sample_border { [f32::NEG_INFINITY, f32::INFINITY] } else { [0.0, end as f32] }
        });
        Self { shape, domain }
    }

    /// The filter centred on the pixel in column `x` and row `y` of the full film.
    pub fn pixel(&self, pixel: [u32; 2]) -> PixelFilter<'_> {
        let centre = pixel.map(|p| p as f32 + 0.5);
        let spans = match &self.shape {
            Shape::Pixel => None,
            Shape::Table(table) => {
                let r = table.radius();
                let span = |axis: usize| {
                    let [low, high] = self.domain[axis];
                    table.span((low - centre[axis]).max(-r), (high - centre[axis]).min(r))
                };
                Some((table, [span(0), span(1)]))
            }
        };
        PixelFilter { centre, spans }
    }
}

impl PixelFilter<'_> {
    /// Maps two uniforms in `[0, 1)` to a film position distributed as |k|.
    #[inline]
    pub fn sample(&self, u: [f32; 2]) -> FilmSample {
        let [x, y] = self.centre;
        match self.spans {
            None => FilmSample { position: [x - 0.5 + u[0], y - 0.5 + u[1]], weight: 1.0 },
            Some((table, [span_x, span_y])) => {
                let (a, b) = (table.sample(span_x, u[0]), table.sample(span_y, u[1]));
                FilmSample {
                    position: [x + a.x, y + b.x],
                    weight: a.sign * b.sign * span_x.normalisation * span_y.normalisation,
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_scene::film::Crop;

    const FILTERS: [ReconstructionFilter; 6] = [
        ReconstructionFilter::Box { radius: 1.25 },
        ReconstructionFilter::Tent { radius: 1.0 },
        ReconstructionFilter::Gaussian { stddev: 0.5 },
        ReconstructionFilter::Mitchell { b: 1.0 / 3.0, c: 1.0 / 3.0 },
        ReconstructionFilter::CatmullRom,
        ReconstructionFilter::Lanczos { lobes: 3 },
    ];

    fn film(filter: ReconstructionFilter) -> Film {
        Film { filter, ..Film::new([8, 10]) }
    }

    /// Σ w x^power / n over a fine grid of uniforms, x relative to the pixel's centre.
    fn moment(pixel: PixelFilter<'_>, power: u32) -> f64 {
        const N: u32 = 40_000;
        let term = |i: u32| {
            let sample = pixel.sample([(i as f32 + 0.5) / N as f32, 0.5]);
            // The middle of the second axis is where every filter is positive; its normalisation
            // is divided out by that of the same axis sampled alone.
            let x = f64::from(sample.position[0] - pixel.centre[0]);
            f64::from(sample.weight) * etendue_math::Real::powi(x, power)
        };
        (0..N).map(term).sum::<f64>() / f64::from(N)
    }

    /// ∫ k x^power / ∫ k over the part of the support above `low`, by midpoints.
    fn exact_moment(filter: ReconstructionFilter, low: f32, power: u32) -> f64 {
        const N: u32 = 20_000;
        let (low, high) = (low.max(-filter.radius()), filter.radius());
        let (mut sum, mut norm) = (0.0, 0.0);
        for i in 0..N {
            let x = low + (high - low) * (i as f32 + 0.5) / N as f32;
            let k = f64::from(filter.eval(x));
            sum += k * etendue_math::Real::powi(f64::from(x), power);
            norm += k;
        }
        sum / norm
    }

    #[test]
    fn moments_are_those_of_the_filter_inside_and_at_the_border_of_the_film() {
        for filter in FILTERS {
            let sampler = FilterSampler::new(&film(filter));
            for (column, low) in [(4, f32::NEG_INFINITY), (0, -0.5), (1, -1.5)] {
                let pixel = sampler.pixel([column, 5]);
                let total = moment(pixel, 0);
                for power in [1, 2] {
                    let (got, want) = (moment(pixel, power), exact_moment(filter, low, power));
                    // A staircase of 256 steps: 1/128 of the radius (at most 3) at the worst
                    // places, averaging out to a tenth of that.
                    let got = got / total;
                    assert!((got - want).abs() < 4e-3, "{filter:?} {column} {power}: {got} {want}");
                }
            }
        }
    }

    #[test]
    fn weights_average_to_one() {
        for filter in FILTERS {
            let sampler = FilterSampler::new(&film(filter));
            for pixel in [[4, 5], [0, 0], [7, 9]] {
                const N: u32 = 256;
                let pixel = sampler.pixel(pixel);
                let at = |i: u32| (i as f32 + 0.5) / N as f32;
                let sum: f64 = (0..N * N)
                    .map(|i| f64::from(pixel.sample([at(i % N), at(i / N)]).weight))
                    .sum();
                // A change of sign falls within one of 256 steps per axis, and there are up to six.
                assert!((sum / f64::from(N * N) - 1.0).abs() < 0.03, "{filter:?} {sum}");
            }
        }
    }

    #[test]
    fn no_sample_leaves_the_film_unless_the_border_is_sampled() {
        for sample_border in [false, true] {
            let film = Film { sample_border, ..film(ReconstructionFilter::default()) };
            let sampler = FilterSampler::new(&film);
            let pixel = sampler.pixel([0, 0]);
            let outside = (0..1000).any(|i| {
                let [x, y] = pixel.sample([i as f32 / 1000.0, 0.5]).position;
                !(0.0..=8.0).contains(&x) || !(0.0..=10.0).contains(&y)
            });
            assert_eq!(outside, sample_border);
        }
    }

    #[test]
    fn a_crop_does_not_change_where_its_pixels_look() {
        let whole = film(ReconstructionFilter::default());
        let cropped = Film { crop: Crop { offset: [3, 5], size: [1, 1] }, ..whole };
        let [whole, cropped] = [whole, cropped].map(|film| FilterSampler::new(&film));
        for u in [[0.0, 0.0], [0.01, 0.99], [0.5, 0.25]] {
            assert_eq!(cropped.pixel([3, 5]).sample(u), whole.pixel([3, 5]).sample(u));
        }
    }

    #[test]
    fn the_box_of_one_pixel_maps_the_square_onto_the_pixel() {
        let film = film(ReconstructionFilter::Box { radius: 0.5 });
        let sample = FilterSampler::new(&film).pixel([4, 7]).sample([0.25, 0.75]);
        assert_eq!(sample, FilmSample { position: [4.25, 7.75], weight: 1.0 });
    }
}
