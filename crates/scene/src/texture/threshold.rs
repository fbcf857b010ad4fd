//! Textures that are there or not.

use super::TextureId;

/// White where the number of a texture reaches a limit, black elsewhere.
///
/// Its [mean](super::Textures::mean) is an estimate, that of the texture: how much of an image reaches the limit, once it is
/// filtered and multiplied, is not known beforehand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Threshold {
    /// What is compared.
    pub texture: TextureId,
    /// The least number that is white.
    pub limit: f32,
}
