//! Noise and bias of two independent pictures of one kind.

use etendue_math::Spectrum;
use etendue_renderer::Image;
use etendue_renderer::image_metrics::SizeMismatch;
use etendue_renderer::image_metrics::flip::{self, HdrReference};
use etendue_scene::Color;
use serde::{Deserialize, Serialize};

/// Pixels are dealt to this many groups, which are independent of each other.
pub const GROUPS: usize = 16;

/// What pictures are compared with: two references of the same expectation.
///
/// With independent noise in the two, products of differences from the one and from the other have no share of it.
pub struct Reference {
    halves: [Image; 2],
    /// Of the mean of both.
    flip: HdrReference,
}

/// What two pictures a, b of one variant with independent seeds say.
///
/// ```text
/// ⟨x, y⟩ = mean over channels of x y / (r² + 0.01)          r the mean of the references r₁, r₂
/// noise  = ½ ⟨a − b, a − b⟩                                variance of a picture
/// bias   = ½ (⟨a − r₁, b − r₂⟩ + ⟨a − r₂, b − r₁⟩)         squared bias; negative by chance where there is none
/// ```
///
/// For what leaves something out of a variant f that the references are drawn from as well, with pictures a₀, b₀ of f from the
/// seeds of a and b, most of the noise cancels: `bias = ⟨a − a₀, b − b₀⟩`.
///
/// All are unbiased estimates, and with one exact reference their sum is the mean relMSE of the two pictures
/// ([`Comparison::relative_mse`](etendue_renderer::image_metrics::Comparison::relative_mse)).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PairErrors {
    /// Variance.
    pub noise: f64,
    /// Squared bias, as a sum of the shares of groups of pixels.
    pub bias: [f64; GROUPS],
    /// Mean HDR-FLIP of the first picture against the mean of the references.
    pub flip: f64,
}

impl Reference {
    /// One picture, taken as it is: its noise counts as bias of everything that is compared with it.
    pub fn given(image: Image) -> Self {
        Self { flip: HdrReference::new(&image), halves: [image.clone(), image] }
    }

    /// Two pictures with independent noise.
    ///
    /// # Errors
    /// Pictures of different sizes, or without pixels.
    pub fn halves(halves: [Image; 2]) -> Result<Self, SizeMismatch> {
        let sizes = [halves[0].size(), halves[1].size()];
        check(sizes[0], sizes[1])?;
        let [a, b] = &halves;
        let pixels = a.pixels().iter().zip(b.pixels()).map(|(&a, &b)| (a + b).scale(0.5));
        let mean = Image::from_pixels(a.size(), pixels.collect()).unwrap_or_else(|| a.clone());
        Ok(Self { flip: HdrReference::new(&mean), halves })
    }

    /// Width and height.
    pub fn size(&self) -> [u32; 2] {
        self.halves[0].size()
    }

    /// The two pictures.
    pub fn pictures(&self) -> &[Image; 2] {
        &self.halves
    }

    /// relMSE of the mean of the two pictures by their difference, `¼ ⟨r₁ − r₂, r₁ − r₂⟩`; 0 for one that was given.
    pub fn own_error(&self) -> f64 {
        let [a, b] = &self.halves;
        0.25 * self.sum(|[r1, r2]| (r1 - r2) * (r1 - r2), [a, b]).iter().sum::<f64>()
    }

    /// What two pictures say.
    ///
    /// # Errors
    /// A picture of another size.
    pub fn compare(&self, a: &Image, b: &Image) -> Result<PairErrors, SizeMismatch> {
        check(a.size(), self.size())?;
        check(b.size(), self.size())?;
        let [r1, r2] = &self.halves;
        let cross = |[a, b, r1, r2]: [f64; 4]| 0.5 * ((a - r1) * (b - r2) + (a - r2) * (b - r1));
        self.errors([a, b], self.sum(cross, [a, b, r1, r2]))
    }

    /// What two pictures say of which the ones of `full` with the same seeds are known: the bias against those.
    ///
    /// # Errors
    /// A picture of another size.
    pub fn compare_with(
        &self,
        [a, b]: [&Image; 2],
        full: &[Image; 2],
    ) -> Result<PairErrors, SizeMismatch> {
        let [a0, b0] = full;
        for image in [a, b, a0, b0] {
            check(image.size(), self.size())?;
        }
        let cross = |[a, b, a0, b0]: [f64; 4]| (a - a0) * (b - b0);
        self.errors([a, b], self.sum(cross, [a, b, a0, b0]))
    }

    fn errors(&self, [a, b]: [&Image; 2], bias: [f64; GROUPS]) -> Result<PairErrors, SizeMismatch> {
        let noise = self.sum(|[a, b]| 0.5 * (a - b) * (a - b), [a, b]).iter().sum();
        Ok(PairErrors { noise, bias, flip: flip::mean(&self.flip.differences(a)?) })
    }

    /// Mean of a weighted function of pictures, by group. What is not finite in a reference is left out.
    fn sum<const N: usize>(
        &self,
        value: impl Fn([f64; N]) -> f64,
        images: [&Image; N],
    ) -> [f64; GROUPS] {
        let mut sums = [0.0; GROUPS];
        let mut count = 0_u64;
        let [r1, r2] = self.halves.each_ref().map(Image::pixels);
        for i in 0..r1.len() {
            let pixels = images.map(|image| image.pixels()[i].to_array());
            let references = [r1[i], r2[i]].map(Color::to_array);
            for channel in 0..3 {
                let [x, y] = references.map(|r| f64::from(r[channel]));
                let r = f64::midpoint(x, y);
                let value = value(pixels.map(|p| f64::from(p[channel]))) / (r * r + 0.01);
                if value.is_finite() {
                    sums[i % GROUPS] += value;
                    count += 1;
                }
            }
        }
        sums.map(|sum| sum / count.max(1) as f64)
    }
}

fn check(image: [u32; 2], reference: [u32; 2]) -> Result<(), SizeMismatch> {
    if image == reference && image[0] > 0 && image[1] > 0 {
        Ok(())
    } else {
        Err(SizeMismatch { image, reference })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_renderer::image_metrics::compare;
    use etendue_sampling::{Decision, Dimension, Independent, Sampler};

    const SIZE: [u32; 2] = [32, 16];

    /// Pixels of the given mean with uniform noise of the given width.
    fn noisy(seed: u64, mean: f32, width: f32) -> Image {
        let pixels = (0..SIZE[0] * SIZE[1]).map(|i| {
            let number =
                |d| Independent::at(seed, [i, 0], 0).sample_1d::<f32>(Dimension::camera(d)) - 0.5;
            let [r, g, b] =
                [Decision::Film, Decision::Lens, Decision::Time].map(|d| mean + width * number(d));
            Color::new(r, g, b)
        });
        Image::from_pixels(SIZE, pixels.collect()).expect("as many pixels")
    }

    #[test]
    fn with_one_reference_noise_and_bias_add_up_to_the_relative_mean_squared_error() {
        let [a, b, r] = [1, 2, 3].map(|seed| noisy(seed, 0.5, 0.3));
        let errors = Reference::given(r.clone()).compare(&a, &b).expect("equal sizes");
        let whole = [&a, &b].map(|x| compare(x, &r).expect("equal sizes").relative_mse);
        let sum = errors.noise + errors.bias.iter().sum::<f64>();
        // An identity; 1536 sums of doubles.
        assert!((sum - f64::midpoint(whole[0], whole[1])).abs() < 1e-12 * sum, "{sum} {whole:?}");
    }

    #[test]
    fn noise_of_pictures_and_of_references_is_not_taken_for_bias() {
        let (width, mean, offset) = (0.2, 0.5, 0.1);
        let references = [10, 11].map(|seed| noisy(seed, mean, width));
        let reference = Reference::halves(references).expect("equal sizes");
        let weight = 1.0 / (0.25 + 0.01);
        for bias in [0.0, offset] {
            let [a, b] = [1, 2].map(|seed| noisy(seed, mean + bias, width));
            let errors = reference.compare(&a, &b).expect("equal sizes");
            let variance = f64::from(width * width) / 12.0 * weight;
            // 1536 values: ½(a − b)² scatters by about its mean, products of differences by twice the variance; weights
            // by the noisy reference differ from those of the true mean by 2 %. 5 standard errors.
            let error = 5.0 * 2.0 * variance / 1536_f64.sqrt() + 0.02 * variance;
            assert!((errors.noise - variance).abs() < error, "{errors:?} {variance}");
            let want = f64::from(bias * bias) * weight;
            let scatter = error + 5.0 * 2.0 * (want * variance / 1536.0).sqrt() + 0.02 * want;
            assert!((errors.bias.iter().sum::<f64>() - want).abs() < scatter, "{errors:?} {want}");
        }
        let variance = f64::from(width * width) / 12.0 * weight;
        // The mean of two has half the variance; the scatter as above.
        assert!((reference.own_error() / (0.5 * variance) - 1.0).abs() < 0.3);
    }

    #[test]
    fn other_sizes_are_refused() {
        let reference = Reference::given(noisy(1, 0.5, 0.1));
        let other = Image::black([16, 32]);
        assert!(reference.compare(&other, &other).is_err());
        assert!(Reference::halves([other, noisy(1, 0.5, 0.1)]).is_err());
    }
}
