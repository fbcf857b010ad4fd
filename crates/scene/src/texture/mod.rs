//! Colours that vary over a surface.
//!
//! Textures live in one arena, [`Textures`], and are named by [`TextureId`]; a number or colour of
//! a material is a texture as well, a constant one. Every stored value is finite and not negative,
//! which is what lets the code that uses it be total.

mod attribute;
mod bitmap;
mod checkerboard;
mod image;
mod point;
mod product;
mod pyramid;
mod threshold;
mod uv_transform;
mod volume;

use alloc::boxed::Box;
use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use etendue_math::Spectrum;

pub use attribute::AttributeTexture;
pub use bitmap::{Bitmap, Filter, Wrap};
pub use checkerboard::Checkerboard;
pub(crate) use image::split;
pub use image::{BitmapError, BitmapImage};
pub use point::TexturePoint;
pub use product::Product;
pub use threshold::Threshold;
pub use uv_transform::UvTransform;
pub use volume::VolumeTexture;

use crate::Color;
use crate::color::{Channels, Curve};

/// Names a texture of a [`Textures`] arena.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TextureId(pub u32);

/// A colour as a function of texture coordinates.
#[derive(Clone, Debug)]
pub enum Texture {
    /// The same everywhere.
    Constant(Color),
    /// An image.
    Bitmap(Bitmap),
    /// Two textures in the squares of a checkerboard.
    Checkerboard(Checkerboard),
    /// What a mesh brings along.
    Attribute(AttributeTexture),
    /// What fills space.
    Volume(VolumeTexture),
    /// Two textures multiplied.
    Product(Product),
    /// Where a texture reaches a limit.
    Threshold(Threshold),
}

impl Texture {
    /// The textures that it is made of.
    fn parts(&self) -> impl Iterator<Item = TextureId> + use<> {
        let parts = match *self {
            Self::Checkerboard(Checkerboard { color0, color1, .. }) => [Some(color0), Some(color1)],
            Self::Product(Product { factors: [a, b] }) => [Some(a), Some(b)],
            Self::Threshold(Threshold { texture, .. }) => [Some(texture), None],
            _ => [None; 2],
        };
        parts.into_iter().flatten()
    }

    /// Whether it is looked up at the surface itself and not at texture coordinates alone.
    pub(crate) fn needs_surface(&self) -> bool {
        match self {
            Self::Attribute(_) | Self::Volume(_) => true,
            Self::Bitmap(bitmap) => bitmap.is_filtered(),
            Self::Constant(_) | Self::Checkerboard(_) | Self::Product(_) | Self::Threshold(_) => {
                false
            }
        }
    }
}

/// All textures of a scene.
///
/// # Examples
/// ```
/// use etendue_scene::{Color, texture::Textures};
///
/// let mut textures = Textures::default();
/// let grey = textures.constant(Color::new(0.5, 0.5, 0.5));
/// assert_eq!(textures.value(grey, [0.3, 0.7]), 0.5);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Textures {
    entries: Vec<Entry>,
}

/// A texture and what is asked about it as a whole.
#[derive(Clone, Debug)]
struct Entry {
    texture: Texture,
    mean: Color,
    max: Color,
    /// What its colour is an integral over, if it was given so.
    curve: Option<Box<Curve>>,
}

impl Textures {
    /// Adds a texture. It may refer to textures added before it; a reference to itself or to a
    /// later one is black, so that look-ups always end.
    ///
    /// A channel of a constant that is NaN, infinite or negative is stored as 0.
    pub fn add(&mut self, texture: Texture) -> TextureId {
        let id = TextureId(self.entries.len() as u32);
        let (texture, mean, max) = match texture {
            Texture::Constant(color) => {
                let color = color.map(|c| if c > 0.0 && c.is_finite() { c } else { 0.0 });
                (Texture::Constant(color), color, color)
            }
            Texture::Bitmap(bitmap) => {
                let (mean, max) = (bitmap.image().mean(), bitmap.image().max());
                (Texture::Bitmap(bitmap), mean, max)
            }
            Texture::Checkerboard(board) => {
                let [a, b] = [board.color0, board.color1];
                let mean = (self.mean(a) + self.mean(b)) * 0.5;
                let max = self.max(a).zip(self.max(b), f32::max);
                (Texture::Checkerboard(board), mean, max)
            }
            Texture::Attribute(attribute) => {
                let bound = Color::splat(attribute.scale);
                (Texture::Attribute(attribute), bound, bound)
            }
            Texture::Volume(texture) => {
                let (mean, max) = (texture.volume.mean(), texture.volume.max());
                (Texture::Volume(texture), mean, max)
            }
            Texture::Product(product) => {
                let times = |a: Color, b: Color| a.zip(b, |a, b| (a * b).min(f32::MAX));
                let [a, b] = product.factors;
                let mean = times(self.mean(a), self.mean(b));
                (Texture::Product(product), mean, times(self.max(a), self.max(b)))
            }
            Texture::Threshold(threshold) => {
                let Threshold { texture, limit } = threshold;
                // Luminances may round to less than the largest channel; a bound may not.
                let reaches = self.max(texture).max_channel() >= limit;
                let max = Color::splat(f32::from(reaches));
                let mean = self.mean(texture).map(|mean| mean.min(max.r));
                (Texture::Threshold(threshold), mean, max)
            }
        };
        self.entries.push(Entry { texture, mean, max, curve: None });
        id
    }

    /// Puts its mean in the place of every texture that `varies`.
    pub(crate) fn average(&mut self, varies: impl Fn(&Texture) -> bool) {
        for Entry { texture, mean, max, .. } in &mut self.entries {
            if varies(texture) {
                *texture = Texture::Constant(*mean);
                *max = *mean;
            }
        }
    }

    /// Looks at every image as if samples had no extent.
    pub(crate) fn lose_filters(&mut self) {
        for Entry { texture, .. } in &mut self.entries {
            if let Texture::Bitmap(bitmap) = texture {
                bitmap.lose_filter();
            }
        }
    }

    /// Adds a texture that is `color` everywhere.
    pub fn constant(&mut self, color: Color) -> TextureId {
        self.add(Texture::Constant(color))
    }

    /// Adds a texture that is a curve over the wavelengths everywhere; `color` is what it is in RGB.
    pub fn constant_curve(&mut self, color: Color, curve: Curve) -> TextureId {
        let id = self.constant(color);
        self.entries[id.0 as usize].curve = Some(Box::new(curve));
        id
    }

    /// The curve that a texture was given as, if it was.
    pub fn curve(&self, id: TextureId) -> Option<&Curve> {
        self.entries.get(id.0 as usize).and_then(|entry| entry.curve.as_deref())
    }

    /// A share of light or property of matter at a point, in the channels of a path.
    #[inline(always)]
    pub fn matter<'a, C: Channels>(
        &self,
        id: TextureId,
        at: impl Into<TexturePoint<'a>>,
        channels: C,
    ) -> C::Color {
        self.carried(id, at, channels, C::matter)
    }

    /// Light of the colour at a point, in the channels of a path.
    #[inline(always)]
    pub fn light<'a, C: Channels>(
        &self,
        id: TextureId,
        at: impl Into<TexturePoint<'a>>,
        channels: C,
    ) -> C::Color {
        self.carried(id, at, channels, C::light)
    }

    #[inline(always)]
    fn carried<'a, C: Channels>(
        &self,
        id: TextureId,
        at: impl Into<TexturePoint<'a>>,
        channels: C,
        translate: impl FnOnce(C, Color) -> C::Color,
    ) -> C::Color {
        let rgb = self.color(id, at);
        // Known where this is compiled: channels that are the same for all paths are no wavelengths.
        match (C::FIXED, self.curve(id)) {
            (None, Some(curve)) => channels.curve(curve, rgb),
            _ => translate(channels, rgb),
        }
    }

    /// The colour at a point, which may be texture coordinates alone: finite, not negative; black for an unknown `id`.
    ///
    /// Coordinates that are NaN or infinite give some colour of the texture.
    #[inline(always)]
    pub fn color<'a>(&self, id: TextureId, at: impl Into<TexturePoint<'a>>) -> Color {
        match self.entries.get(id.0 as usize).map(|entry| &entry.texture) {
            Some(&Texture::Constant(color)) => color,
            Some(texture) => self.varying(texture, id, at.into()),
            None => Color::black(),
        }
    }

    /// The colour of a texture that is not constant. Out of line, so that constants do not pay for it.
    #[inline(never)]
    fn varying(&self, texture: &Texture, id: TextureId, at: TexturePoint<'_>) -> Color {
        match texture {
            Texture::Constant(color) => *color,
            Texture::Bitmap(bitmap) => bitmap.color_at(at),
            Texture::Checkerboard(board) => {
                let square = board.square(at.uv);
                if square < id { self.color(square, at) } else { Color::black() }
            }
            Texture::Attribute(attribute) => attribute.color(at),
            Texture::Volume(texture) => texture.color(at),
            Texture::Product(Product { factors: [a, b] }) => {
                if *a < id && *b < id {
                    self.color(*a, at).zip(self.color(*b, at), |a, b| (a * b).min(f32::MAX))
                } else {
                    Color::black()
                }
            }
            Texture::Threshold(Threshold { texture, limit }) => {
                let reaches = *texture < id && self.value(*texture, at) >= *limit;
                Color::splat(f32::from(reaches))
            }
        }
    }

    /// The number at a point: the luminance of the colour, exactly `x` for a grey `(x, x, x)`.
    ///
    /// Numbers of a [`Checkerboard`] have its colours the other way round, as in Mitsuba 3 (3.9.1).
    #[inline]
    pub fn value<'a>(&self, id: TextureId, at: impl Into<TexturePoint<'a>>) -> f32 {
        let at = at.into();
        match self.get(id) {
            Some(Texture::Checkerboard(board)) => {
                let square = board.other_square(at.uv);
                if square < id { self.value(square, at) } else { 0.0 }
            }
            Some(Texture::Volume(texture)) => texture.value(at),
            _ => {
                let color = self.color(id, at);
                // The weights of the luminance add up to 1 only after rounding.
                if color.r == color.g && color.g == color.b { color.r } else { color.luminance() }
            }
        }
    }

    /// How the number at coordinates `uv` changes with u and v; 0 for all but bitmaps.
    pub fn gradient(&self, id: TextureId, uv: [f32; 2]) -> [f32; 2] {
        match self.get(id) {
            Some(Texture::Bitmap(bitmap)) => bitmap.gradient(uv),
            _ => [0.0; 2],
        }
    }

    /// Textures and those that they are made of.
    pub fn with_parts(&self, ids: impl IntoIterator<Item = TextureId>) -> BTreeSet<TextureId> {
        let mut all = BTreeSet::new();
        let mut rest: Vec<TextureId> = ids.into_iter().collect();
        while let Some(id) = rest.pop() {
            if all.insert(id) {
                rest.extend(self.get(id).into_iter().flat_map(Texture::parts));
            }
        }
        all
    }

    /// All textures, constants included, in the order of [`TextureId`].
    pub fn iter(&self) -> impl Iterator<Item = &Texture> {
        self.entries.iter().map(|entry| &entry.texture)
    }

    /// The texture itself, or `None` for an unknown `id`.
    pub fn get(&self, id: TextureId) -> Option<&Texture> {
        self.entries.get(id.0 as usize).map(|entry| &entry.texture)
    }

    /// How many textures there are, constant ones included.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// The mean over the unit square of the untransformed texture: over the texels of a bitmap, over the cells of a volume. An attribute, of which only
    /// meshes know more, counts as 1 times its scale.
    pub fn mean(&self, id: TextureId) -> Color {
        self.entries.get(id.0 as usize).map_or(Color::black(), |entry| entry.mean)
    }

    /// An upper bound of each channel; of an attribute one for values up to 1.
    pub fn max(&self, id: TextureId) -> Color {
        self.entries.get(id.0 as usize).map_or(Color::black(), |entry| entry.max)
    }

    /// Columns and rows of a bitmap; 1 × 1 of every other texture.
    pub fn size(&self, id: TextureId) -> [u32; 2] {
        match self.get(id) {
            Some(Texture::Bitmap(bitmap)) => [bitmap.image().width(), bitmap.image().height()],
            _ => [1, 1],
        }
    }

    /// Whether the texture is black everywhere, being constant.
    pub(crate) fn is_black(&self, id: TextureId) -> bool {
        self.is_constant(id) && self.mean(id).is_black()
    }

    /// Whether the texture is white everywhere, being constant.
    #[cfg(feature = "std")]
    pub(crate) fn is_white(&self, id: TextureId) -> bool {
        self.is_constant(id) && self.mean(id) == Color::white()
    }

    /// Whether the texture is a [`Texture::Constant`].
    pub fn is_constant(&self, id: TextureId) -> bool {
        matches!(self.get(id), Some(Texture::Constant(_)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grey_constant_has_exactly_its_value_and_bad_channels_are_black() {
        let mut textures = Textures::default();
        let grey = textures.constant(Color::splat(0.1));
        assert_eq!(textures.value(grey, [0.0, 0.0]), 0.1);
        let bad = textures.constant(Color::new(f32::NAN, f32::INFINITY, -1.0));
        assert_eq!(textures.color(bad, [0.0, 0.0]), Color::black());
    }

    #[test]
    fn a_checkerboard_of_itself_is_black_instead_of_endless() {
        let mut textures = Textures::default();
        let own = TextureId(0);
        let board = Checkerboard { color0: own, color1: TextureId(7), uv: UvTransform::IDENTITY };
        let id = textures.add(Texture::Checkerboard(board));
        assert_eq!(textures.color(id, [0.1, 0.1]), Color::black());
        assert_eq!(textures.color(id, [0.6, 0.1]), Color::black());
        assert_eq!(textures.value(id, [0.1, 0.1]), 0.0);
    }

    #[test]
    fn numbers_of_a_checkerboard_are_the_other_way_round() {
        let mut textures = Textures::default();
        let [color0, color1] = [0.25, 0.75].map(|x| textures.constant(Color::splat(x)));
        let board = Checkerboard { color0, color1, uv: UvTransform::IDENTITY };
        let id = textures.add(Texture::Checkerboard(board));
        for (uv, color, value) in [([0.1, 0.1], 0.25, 0.75), ([0.6, 0.1], 0.75, 0.25)] {
            assert_eq!(textures.color(id, uv), Color::splat(color));
            assert_eq!(textures.value(id, uv), value);
        }
    }

    #[test]
    fn mean_and_maximum_of_a_checkerboard_come_from_its_squares() {
        let mut textures = Textures::default();
        let color0 = textures.constant(Color::new(0.5, 0.0, 1.0));
        let color1 = textures.constant(Color::new(0.25, 1.0, 0.0));
        let board = Checkerboard { color0, color1, uv: UvTransform::IDENTITY };
        let id = textures.add(Texture::Checkerboard(board));
        assert_eq!(textures.mean(id), Color::new(0.375, 0.5, 0.5));
        assert_eq!(textures.max(id), Color::new(0.5, 1.0, 1.0));
        assert!(!textures.is_constant(id) && textures.is_constant(color0));
    }

    #[test]
    fn products_are_channel_by_channel_and_thresholds_see_the_product() {
        let mut textures = Textures::default();
        let [a, b] = [Color::new(0.5, 2.0, 0.0), Color::new(0.5, 0.25, 8.0)];
        let factors = [a, b].map(|color| textures.constant(color));
        let product = textures.add(Texture::Product(Product { factors }));
        let expected = Color::new(0.25, 0.5, 0.0);
        assert_eq!(textures.color(product, [0.0; 2]), expected);
        assert_eq!((textures.mean(product), textures.max(product)), (expected, expected));
        let luminance = expected.luminance();
        for (limit, value) in [(luminance, 1.0), (luminance + 1e-3, 0.0)] {
            let threshold = Threshold { texture: product, limit };
            let id = textures.add(Texture::Threshold(threshold));
            assert_eq!(textures.value(id, [0.3; 2]), value, "{limit}");
            assert!(textures.max(id).r >= value);
            assert!(textures.with_parts([id]).contains(&factors[1]));
        }
        let huge = textures.constant(Color::splat(f32::MAX));
        let squared = textures.add(Texture::Product(Product { factors: [huge; 2] }));
        assert_eq!(textures.value(squared, [0.0; 2]), f32::MAX);
    }

    #[test]
    fn products_and_thresholds_of_themselves_are_black() {
        let mut textures = Textures::default();
        let own = textures.add(Texture::Product(Product { factors: [TextureId(0); 2] }));
        let limit = Threshold { texture: TextureId(1), limit: 0.0 };
        let threshold = textures.add(Texture::Threshold(limit));
        assert_eq!(textures.color(own, [0.0; 2]), Color::black());
        assert_eq!(textures.value(threshold, [0.0; 2]), 0.0);
    }
}
