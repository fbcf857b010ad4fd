//! Look-ups in an image.

use etendue_math::Real;

use super::pyramid::Pyramid;
use super::{BitmapImage, TexturePoint, UvTransform};
use crate::Color;

/// How a colour between texel centres is made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// Linear in both directions between the four nearest texels.
    #[default]
    Bilinear,
    /// The texel that contains the point.
    Nearest,
    /// As bilinear, in an image whose texels are as large as what a sample stands for.
    Trilinear,
}

/// What lies outside the unit square.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The image again.
    #[default]
    Repeat,
    /// The image mirrored, then the image again.
    Mirror,
    /// The nearest texel of the border.
    Clamp,
}

impl Wrap {
    /// The texel, of `size` in a row, that stands for the `index`-th.
    #[inline]
    pub(crate) fn apply(self, index: i32, size: u32) -> u32 {
        // Most are within, and a division costs more than the rest of a look-up.
        if (index as u32) < size {
            return index as u32;
        }
        let size = size as i32;
        let wrapped = match self {
            Self::Repeat => index.rem_euclid(size),
            Self::Clamp => index.clamp(0, size - 1),
            Self::Mirror => {
                let within = index.rem_euclid(size);
                let flipped = index.div_euclid(size).rem_euclid(2) == 1;
                if flipped { size - 1 - within } else { within }
            }
        };
        wrapped as u32
    }
}

/// An image as a texture.
///
/// The first texel of the first row, at the top left of the picture, covers the corner at
/// `uv = (0, 0)`; u grows with the columns and v with the rows.
///
/// # Source
/// The conventions of Mitsuba 3's `bitmap`.
#[derive(Clone, Debug)]
pub struct Bitmap {
    image: BitmapImage,
    filter: Filter,
    /// Beyond columns and beyond rows.
    wrap: [Wrap; 2],
    uv: UvTransform,
    /// Of a filter that needs one.
    pyramid: Option<Pyramid>,
}

impl Bitmap {
    /// A texture from an image and how it is to be looked up.
    pub fn new(image: BitmapImage, filter: Filter, wrap: Wrap, uv: UvTransform) -> Self {
        let pyramid = (filter == Filter::Trilinear).then(|| Pyramid::new(&image));
        Self { image, filter, wrap: [wrap; 2], uv, pyramid }
    }

    /// The same with other borders, of its own left and right, and above and below.
    #[must_use]
    pub fn with_wraps(self, wrap: [Wrap; 2]) -> Self {
        Self { wrap, ..self }
    }

    /// The image.
    pub fn image(&self) -> &BitmapImage {
        &self.image
    }

    /// How colours between texel centres are made.
    pub fn filter(&self) -> Filter {
        self.filter
    }

    /// What lies outside the unit square: left and right, and above and below.
    pub fn wraps(&self) -> [Wrap; 2] {
        self.wrap
    }

    /// What coordinates are transformed by first.
    pub fn uv(&self) -> &UvTransform {
        &self.uv
    }

    /// The colour at texture coordinates `uv`.
    ///
    /// ```text
    /// nearest:   texel(⌊u W⌋, ⌊v H⌋)
    /// bilinear:  x = u W − ½, y = v H − ½, linear between texels ⌊x⌋, ⌊x⌋ + 1 and ⌊y⌋, ⌊y⌋ + 1
    /// ```
    ///
    /// Coordinates that are not finite, or beyond 2³¹ texels, give some texel of the image.
    #[inline]
    pub fn color(&self, uv: [f32; 2]) -> Color {
        let [u, v] = self.uv.apply(uv);
        let (x, y) = (u * self.image.width() as f32, v * self.image.height() as f32);
        match self.filter {
            Filter::Nearest => {
                let (column, row) = (Real::floor(x) as i32, Real::floor(y) as i32);
                self.image.wrapped(column, row, self.wrap)
            }
            Filter::Bilinear | Filter::Trilinear => {
                self.image.bilinear([x - 0.5, y - 0.5], self.wrap)
            }
        }
    }

    /// Whether what is looked at has an extent for it.
    pub fn is_filtered(&self) -> bool {
        self.pyramid.is_some()
    }

    /// The same without regard to that.
    pub(super) fn lose_filter(&mut self) {
        if self.pyramid.take().is_some() {
            self.filter = Filter::Bilinear;
        }
    }

    /// The colour of what is looked at, which has an extent for a [`Filter::Trilinear`].
    #[inline]
    pub(super) fn color_at(&self, at: TexturePoint<'_>) -> Color {
        match (&self.pyramid, at.surface) {
            (Some(pyramid), Some(surface)) => self.filtered(pyramid, at.uv, surface.extent()),
            _ => self.color(at.uv),
        }
    }

    #[inline(never)]
    fn filtered(&self, pyramid: &Pyramid, [u, v]: [f32; 2], [du, dv]: [f32; 2]) -> Color {
        let size = [self.image.width() as f32, self.image.height() as f32];
        let place = self.uv.apply([u, v]);
        let texels = [[u + du, v], [u, v + dv]].map(|end| {
            let end = self.uv.apply(end);
            let [x, y] = [0, 1].map(|axis| (end[axis] - place[axis]) * size[axis]);
            Real::sqrt(x * x + y * y)
        });
        pyramid.color(&self.image, place, texels[0].max(texels[1]), self.wrap)
    }

    /// How the luminance of [`color`](Self::color) changes with u and v; 0 for nearest texels.
    ///
    /// # Source
    /// Mitsuba 3's `eval_1_grad`.
    pub fn gradient(&self, uv: [f32; 2]) -> [f32; 2] {
        if self.filter == Filter::Nearest {
            return [0.0; 2];
        }
        let [u, v] = self.uv.apply(uv);
        let size = [self.image.width() as f32, self.image.height() as f32];
        let at = [u * size[0] - 0.5, v * size[1] - 0.5];
        let [x, y] = self.image.bilinear_gradient(at, self.wrap);
        self.uv.pull_back([x.luminance() * size[0], y.luminance() * size[1]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::Spectrum;
    use etendue_math::glam::{DMat4, DVec3};

    const UV: [[f32; 2]; 7] = [
        [0.25, 1.0 / 6.0],
        [0.1, 0.1],
        [0.6, 0.4],
        [0.95, 0.9],
        [-0.3, 1.2],
        [1.45, -0.65],
        [2.9, 5.77],
    ];

    /// Two columns and three rows.
    fn bitmap(filter: Filter, wrap: Wrap, uv: UvTransform) -> Option<Bitmap> {
        let texels = [0.1, 0.5, 0.9, 0.3, 0.7, 0.2];
        let image = BitmapImage::from_f32(2, 3, 1, &texels).ok()?;
        Some(Bitmap::new(image, filter, wrap, uv))
    }

    #[test]
    fn filters_and_wrap_modes_have_mitsubas_values() {
        // Values by Mitsuba 3.9.1 (`raw`, scalar_rgb) for the same image and coordinates.
        let cases: [(Filter, Wrap, &[f32]); 6] = [
            (Filter::Bilinear, Wrap::Repeat, &[0.1, 0.286, 0.45, 0.388, 0.45, 0.48, 0.3747002]),
            (Filter::Bilinear, Wrap::Mirror, &[0.1, 0.1, 0.45, 0.2, 0.669, 0.477, 0.4619999]),
            (Filter::Bilinear, Wrap::Clamp, &[0.1, 0.1, 0.45, 0.2, 0.7, 0.5, 0.2]),
            (Filter::Nearest, Wrap::Repeat, &[0.1, 0.1, 0.3, 0.2, 0.5, 0.9, 0.2]),
            (Filter::Nearest, Wrap::Mirror, &[0.1, 0.1, 0.3, 0.2, 0.7, 0.3, 0.5]),
            (Filter::Nearest, Wrap::Clamp, &[0.1, 0.1, 0.3, 0.2, 0.7, 0.5, 0.2]),
        ];
        for (filter, wrap, expected) in cases {
            let bitmap = bitmap(filter, wrap, UvTransform::IDENTITY);
            for (uv, &value) in UV.iter().zip(expected) {
                let found = bitmap.as_ref().map_or(f32::NAN, |b| b.color(*uv).r);
                // Coordinates up to 17 texels away carry 17 ε of position, times the contrast.
                assert!(
                    (found - value).abs() < 4e-6,
                    "{filter:?} {wrap:?} {uv:?}: {found} {value}"
                );
            }
        }
    }

    #[test]
    fn borders_may_differ_between_the_axes() {
        let bitmap = bitmap(Filter::Nearest, Wrap::Repeat, UvTransform::IDENTITY);
        let bitmap = bitmap.expect("six texels").with_wraps([Wrap::Clamp, Wrap::Mirror]);
        // One texel right of the last column, in the row below the last one and its image.
        assert_eq!(bitmap.color([1.25, 1.1]).r, 0.2);
        assert_eq!(bitmap.color([-0.25, 1.4]).r, 0.9);
    }

    #[test]
    fn coordinates_are_transformed_first() {
        let matrix = DMat4::from_translation(DVec3::new(0.1, 0.2, 0.0))
            * DMat4::from_scale(DVec3::new(2.0, 3.0, 1.0));
        let uv = UvTransform::from_matrix4(matrix).unwrap_or_default();
        let bitmap = bitmap(Filter::Bilinear, Wrap::Repeat, uv);
        let found = bitmap.map_or(f32::NAN, |b| b.color([0.1, 0.1]).r);
        // Value by Mitsuba 3.9.1; a few ε.
        assert!((found - 0.84).abs() < 1e-6, "{found}");
    }

    #[test]
    fn any_coordinates_give_a_colour_between_the_texels() {
        let hostile = [f32::NAN, f32::INFINITY, -f32::INFINITY, f32::MAX, -1e30, 3e9, -0.0, 1e-45];
        for filter in [Filter::Bilinear, Filter::Nearest] {
            for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
                let bitmap = bitmap(filter, wrap, UvTransform::IDENTITY);
                for u in hostile {
                    for v in hostile {
                        let c = bitmap.as_ref().map_or(Color::black(), |b| b.color([u, v]));
                        // One rounding of the convex combination.
                        assert!((0.1..=0.900_001).contains(&c.r), "{u} {v}: {c:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_gradient_is_the_difference_of_the_values_beside() {
        let data: [f32; 12] = core::array::from_fn(|i| (i * i % 7) as f32 / 7.0);
        let image = BitmapImage::from_f32(4, 3, 1, &data).expect("twelve texels");
        let turn = DMat4::from_scale(DVec3::new(2.0, 0.5, 1.0))
            * DMat4::from_rotation_z(0.3)
            * DMat4::from_translation(DVec3::new(0.1, 0.2, 0.0));
        let uv = UvTransform::from_matrix4(turn).expect("finite");
        let bitmap = Bitmap::new(image, Filter::Bilinear, Wrap::Repeat, uv);
        for at in [[0.31_f32, 0.42], [0.9, 0.05], [-0.37, 1.2]] {
            let gradient = bitmap.gradient(at);
            let h = 1.0 / 1024.0;
            for (axis, slope) in gradient.into_iter().enumerate() {
                let value = |sign: f32| {
                    let mut moved = at;
                    moved[axis] += sign * h;
                    bitmap.color(moved).r
                };
                let difference = (value(1.0) - value(-1.0)) / (2.0 * h);
                // Values have an error of 1e-7, over 2h; they are bilinear, so that curvature adds next to nothing.
                assert!((difference - slope).abs() < 5e-3, "{at:?} {difference} {slope}");
            }
        }
        let image = BitmapImage::from_f32(4, 3, 1, &data).expect("twelve texels");
        let nearest = Bitmap::new(image, Filter::Nearest, Wrap::Repeat, uv);
        assert_eq!(nearest.gradient([0.3, 0.4]), [0.0; 2]);
    }
}
