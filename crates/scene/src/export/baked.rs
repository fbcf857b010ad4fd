//! Textures made of others, as one image.

use alloc::vec::Vec;

use crate::Color;
use crate::texture::{
    Bitmap, BitmapImage, Filter, Product, Texture, TextureId, Textures, Threshold,
};

/// The texture as one image that is looked up in the same way, if there is one: an image times constants, or where such a
/// one, looked up without filter, reaches a limit.
pub(super) fn baked(textures: &Textures, id: TextureId) -> Option<Bitmap> {
    match textures.get(id)? {
        Texture::Bitmap(bitmap) => Some(bitmap.clone()),
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
            mapped(&baked(textures, image)?, |color| color * factor)
        }
        Texture::Threshold(Threshold { texture, limit }) => {
            let image = baked(textures, *texture)?;
            // Between texels a filter and a limit do not commute.
            if image.filter() != Filter::Nearest {
                return None;
            }
            let number = |color: Color| {
                if image.image().is_grey() { color.r } else { color.luminance() }
            };
            mapped(&image, |color| {
                let white = number(color) >= *limit;
                [f32::from(u8::from(white)); 3].into()
            })
        }
        _ => None,
    }
}

/// The same with every texel changed; `None` where one is out of range.
fn mapped(bitmap: &Bitmap, change: impl Fn(Color) -> Color) -> Option<Bitmap> {
    let image = bitmap.image();
    let (width, height) = (image.width(), image.height());
    let texels = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
    let texels: Vec<f32> =
        texels.flat_map(|(column, row)| change(image.texel(column, row)).to_array()).collect();
    let image = BitmapImage::from_f32(width, height, 3, &texels).ok()?;
    let [wrap, _] = bitmap.wraps();
    Some(Bitmap::new(image, bitmap.filter(), wrap, *bitmap.uv()).with_wraps(bitmap.wraps()))
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
        let texel = baked(&textures, tinted).expect("an image").image().texel(1, 0);
        assert_eq!(texel.to_array(), [0.75, 0.375, 0.0]);
        let limit = |texture| Texture::Threshold(Threshold { texture, limit: 0.5 });
        let holes = textures.add(limit(sharp));
        let holes = baked(&textures, holes).expect("an image");
        assert_eq!([0, 1].map(|column| holes.image().texel(column, 0).r), [0.0, 1.0]);
        let blurred = textures.add(limit(smooth));
        assert!(baked(&textures, blurred).is_none());
        let squared = textures.add(Texture::Product(Product { factors: [smooth, sharp] }));
        assert!(baked(&textures, squared).is_none());
    }
}
