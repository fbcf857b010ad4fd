//! Textures made of others, as one image.

use alloc::vec::Vec;

use crate::Color;
use crate::texture::{
    Bitmap, BitmapImage, Filter, Product, Texture, TextureId, Textures, Threshold,
};

/// A texture as one image.
#[derive(Clone, Debug)]
pub(super) struct Baked {
    pub(super) bitmap: Bitmap,
    /// Whether it is looked up to the same colours.
    pub(super) is_exact: bool,
}

/// The texture as one image, if there is one: an image times constants, or where such a one reaches a limit. Where it is
/// filtered before it is compared with the limit, the edges become those of texels.
pub(super) fn baked(textures: &Textures, id: TextureId) -> Option<Baked> {
    match textures.get(id)? {
        Texture::Bitmap(bitmap) => Some(Baked { bitmap: bitmap.clone(), is_exact: true }),
        Texture::Product(Product { factors: [a, b] }) => {
            let constant = |id| match textures.get(id) {
                Some(Texture::Constant(color)) => Some(*color),
                _ => None,
            };
            let (factor, image) = match (constant(*a), constant(*b)) {
                (Some(factor), _) => (factor, *b),
                (None, Some(factor)) => (factor, *a),
                (None, None) => return None,
            };
            let Baked { bitmap, is_exact } = baked(textures, image)?;
            let bitmap = mapped(&bitmap, bitmap.filter(), |color| color * factor)?;
            Some(Baked { bitmap, is_exact })
        }
        Texture::Threshold(Threshold { texture, limit }) => {
            let Baked { bitmap, is_exact } = baked(textures, *texture)?;
            let is_grey = bitmap.image().is_grey();
            let number = |color: Color| if is_grey { color.r } else { color.luminance() };
            let is_exact = is_exact && bitmap.filter() == Filter::Nearest;
            let bitmap = mapped(&bitmap, Filter::Nearest, |color| {
                let white = number(color) >= *limit;
                [f32::from(u8::from(white)); 3].into()
            })?;
            Some(Baked { bitmap, is_exact })
        }
        _ => None,
    }
}

/// The same with every texel changed and another filter; `None` where a texel is out of range.
fn mapped(bitmap: &Bitmap, filter: Filter, change: impl Fn(Color) -> Color) -> Option<Bitmap> {
    let image = bitmap.image();
    let (width, height) = (image.width(), image.height());
    let texels = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
    let texels: Vec<f32> =
        texels.flat_map(|(column, row)| change(image.texel(column, row)).to_array()).collect();
    let image = BitmapImage::from_f32(width, height, 3, &texels).ok()?;
    let [wrap, _] = bitmap.wraps();
    Some(Bitmap::new(image, filter, wrap, *bitmap.uv()).with_wraps(bitmap.wraps()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::{UvTransform, Wrap};

    #[test]
    fn images_times_constants_are_images() {
        let mut textures = Textures::default();
        let image = BitmapImage::from_f32(2, 1, 1, &[0.25, 0.75]).expect("an image");
        let bitmap =
            |filter| Bitmap::new(image.clone(), filter, Wrap::Clamp, UvTransform::IDENTITY);
        let smooth = textures.add(Texture::Bitmap(bitmap(Filter::Bilinear)));
        let sharp = textures.add(Texture::Bitmap(bitmap(Filter::Nearest)));
        let factor = textures.constant(Color::new(1.0, 0.5, 0.0));
        let tinted = textures.add(Texture::Product(Product { factors: [factor, smooth] }));
        let tinted = baked(&textures, tinted).expect("an image");
        assert!(tinted.is_exact);
        assert_eq!(tinted.bitmap.image().texel(1, 0).to_array(), [0.75, 0.375, 0.0]);
        let limit = |texture| Texture::Threshold(Threshold { texture, limit: 0.5 });
        for (texture, exact) in [(sharp, true), (smooth, false)] {
            let holes = textures.add(limit(texture));
            let Baked { bitmap, is_exact } = baked(&textures, holes).expect("an image");
            assert_eq!([0, 1].map(|column| bitmap.image().texel(column, 0).r), [0.0, 1.0]);
            assert_eq!((bitmap.filter(), is_exact), (Filter::Nearest, exact));
        }
        let squared = textures.add(Texture::Product(Product { factors: [smooth, sharp] }));
        assert!(baked(&textures, squared).is_none());
    }
}
