//! Where textures are looked up.

use crate::geometry::Located;

/// What a texture is looked up at.
#[derive(Clone, Copy, Debug)]
pub struct TexturePoint<'a> {
    /// Texture coordinates.
    pub uv: [f32; 2],
    /// The point of the surface, for the textures that depend on more than coordinates: to the others it need not be
    /// given.
    pub surface: Option<&'a Located<'a>>,
}

impl From<[f32; 2]> for TexturePoint<'_> {
    #[inline(always)]
    fn from(uv: [f32; 2]) -> Self {
        Self { uv, surface: None }
    }
}

impl<'a> From<&'a Located<'a>> for TexturePoint<'a> {
    #[inline]
    fn from(surface: &'a Located<'a>) -> Self {
        Self { uv: surface.point().uv, surface: Some(surface) }
    }
}
