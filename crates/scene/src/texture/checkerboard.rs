//! The checkerboard.

use etendue_math::Real;

use super::{TextureId, UvTransform};

/// Two textures in alternate squares, four to the unit square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checkerboard {
    /// The squares at the origin and diagonally opposite.
    pub color0: TextureId,
    /// The other two.
    pub color1: TextureId,
    /// Applied to the coordinates first.
    pub uv: UvTransform,
}

impl Checkerboard {
    /// The texture that fills the square at `uv`.
    ///
    /// ```text
    /// color0 where (frac u > ½) = (frac v > ½), else color1
    /// ```
    ///
    /// # Source
    /// Mitsuba 3's `checkerboard`.
    #[inline]
    pub fn square(&self, uv: [f32; 2]) -> TextureId {
        let [u, v] = self.uv.apply(uv).map(|x| x - Real::floor(x) > 0.5);
        if u == v { self.color0 } else { self.color1 }
    }

    /// The texture that fills the squares beside it.
    #[inline]
    pub fn other_square(&self, uv: [f32; 2]) -> TextureId {
        Self { color0: self.color1, color1: self.color0, ..*self }.square(uv)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_alternate_and_repeat() {
        let (color0, color1) = (TextureId(0), TextureId(1));
        let board = Checkerboard { color0, color1, uv: UvTransform::IDENTITY };
        assert_eq!(board.square([0.25, 0.25]), color0);
        assert_eq!(board.square([0.75, 0.25]), color1);
        assert_eq!(board.square([0.75, 0.75]), color0);
        assert_eq!(board.square([-0.75, 3.75]), color1);
    }
}
