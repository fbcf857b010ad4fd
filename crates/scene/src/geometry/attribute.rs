//! What a mesh knows of its surface beyond positions, normals and texture coordinates.

use alloc::string::String;
use alloc::vec::Vec;

use crate::Color;

/// What the values of an attribute belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AttributeOwner {
    /// Vertices; linear over a triangle in between.
    Vertex,
    /// Triangles; the same all over each.
    Face,
}

/// A named colour of each vertex or triangle of a mesh; numbers are grey.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshAttribute {
    /// Its name, by convention `vertex_…` or `face_…`.
    pub name: String,
    /// What the values belong to.
    pub owner: AttributeOwner,
    /// One per vertex or triangle, finite and not negative.
    pub values: Vec<Color>,
}
