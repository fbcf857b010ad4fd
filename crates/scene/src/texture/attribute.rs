//! Colours that a mesh brings along.

use alloc::string::String;

use etendue_math::Spectrum;

use super::TexturePoint;
use crate::Color;

/// An attribute of the mesh that is looked at.
///
/// # Source
/// Mitsuba 3's `mesh_attribute`.
#[derive(Clone, Debug, PartialEq)]
pub struct AttributeTexture {
    /// The attribute's name.
    pub name: String,
    /// What its values are multiplied by, finite and not negative.
    pub scale: f32,
}

impl AttributeTexture {
    /// The attribute there times the scale; black where the shape has none of that name.
    pub fn color(&self, at: TexturePoint<'_>) -> Color {
        let value = at.surface.and_then(|surface| surface.attribute(&self.name));
        value.map_or(Color::black(), |color| color * self.scale)
    }
}
