//! Textures multiplied.

use super::TextureId;

/// The product of two textures, channel by channel: an image tinted by a factor, or by colours that a mesh brings along.
///
/// What exceeds the range of `f32` is its largest number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Product {
    /// What is multiplied.
    pub factors: [TextureId; 2],
}
