//! What triangle meshes are made of.

use alloc::vec::Vec;

use etendue_math::glam::{Vec2, Vec3};

use super::{AttributeOwner, MeshAttribute, Transform, is_unit};
use crate::Color;
use crate::parallel;

/// The arrays of a triangle mesh, its indices and coordinates checked: a mesh as files have it, before what rays need of
/// it is computed ([`TriangleMesh`](super::TriangleMesh)).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshArrays {
    pub(super) positions: Vec<Vec3>,
    pub(super) normals: Vec<Vec3>,
    pub(super) uvs: Vec<Vec2>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) attributes: Vec<MeshAttribute>,
}

/// Why a mesh is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} refers to vertex {vertex}, but there are only {vertices}")]
    IndexOutOfRange {
        /// The triangle, counted from 0.
        triangle: usize,
        /// The index it names, counted from 0.
        vertex: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("the {attribute} of vertex {vertex} is not finite")]
    NotFinite {
        /// `position`, `normal` or `uv`.
        attribute: &'static str,
        /// The vertex, counted from 0.
        vertex: usize,
    },
    /// Normals or texture coordinates are there for some vertices only.
    #[error("there are {found} {attribute}s for {vertices} vertices")]
    LengthMismatch {
        /// `normal` or `uv`.
        attribute: &'static str,
        /// How many there are.
        found: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// An attribute has more or fewer values than the mesh has vertices or triangles.
    #[error("an attribute has {found} values for {expected} vertices or triangles")]
    AttributeLength {
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// A value of an attribute is NaN, infinite or negative.
    #[error("value {index} of an attribute is negative or not finite")]
    AttributeValue {
        /// Which, counted from 0.
        index: usize,
    },
}

/// Checks that there are no values or one for each vertex, and that they are finite.
fn check<T: Sync>(
    attribute: &'static str,
    values: &[T],
    is_finite: impl Fn(&T) -> bool + Sync + Send,
    vertices: usize,
) -> Result<(), MeshError> {
    let found = values.len();
    if found != 0 && found != vertices {
        return Err(MeshError::LengthMismatch { attribute, found, vertices });
    }
    match parallel::position(values, |value| !is_finite(value)) {
        Some(vertex) => Err(MeshError::NotFinite { attribute, vertex }),
        None => Ok(()),
    }
}

impl MeshArrays {
    /// A mesh from its parts. `normals` and `uvs` are empty or as long as `positions`; normals need
    /// not have unit length, and a zero normal stands for the geometric one.
    ///
    /// # Errors
    /// An index out of range, a coordinate that is not finite, arrays of unequal length.
    pub fn new(
        positions: Vec<Vec3>,
        normals: Vec<Vec3>,
        uvs: Vec<Vec2>,
        triangles: Vec<[u32; 3]>,
    ) -> Result<Self, MeshError> {
        let vertices = positions.len();
        check("position", &positions, |p| p.is_finite(), vertices)?;
        check("normal", &normals, |n| n.is_finite(), vertices)?;
        check("uv", &uvs, |t| t.is_finite(), vertices)?;
        let beyond = |v: &u32| *v as usize >= vertices;
        let bad = parallel::position(&triangles, |corners| corners.iter().any(beyond));
        if let Some(triangle) = bad {
            let vertex = triangles[triangle].into_iter().find(beyond).unwrap_or_default();
            return Err(MeshError::IndexOutOfRange { triangle, vertex, vertices });
        }
        Ok(Self { positions, normals, uvs, triangles, attributes: Vec::new() })
    }

    /// Vertex positions.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Vertex normals, or nothing.
    pub fn normals(&self) -> &[Vec3] {
        &self.normals
    }

    /// Vertex texture coordinates, or nothing.
    pub fn uvs(&self) -> &[Vec2] {
        &self.uvs
    }

    /// Three vertex indices per triangle.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The same mesh with other vertex normals, or with none.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_normals(mut self, normals: Vec<Vec3>) -> Result<Self, MeshError> {
        check("normal", &normals, |n| n.is_finite(), self.positions.len())?;
        self.normals = normals;
        Ok(self)
    }

    /// The same mesh with one more attribute.
    ///
    /// # Errors
    /// Another number of values than of vertices or triangles, a value that is NaN, infinite or negative.
    pub fn with_attribute(mut self, attribute: MeshAttribute) -> Result<Self, MeshError> {
        let expected = match attribute.owner {
            AttributeOwner::Vertex => self.positions.len(),
            AttributeOwner::Face => self.triangles.len(),
        };
        let found = attribute.values.len();
        if found != expected {
            return Err(MeshError::AttributeLength { found, expected });
        }
        let valid = |color: &Color| color.to_array().iter().all(|c| *c >= 0.0 && c.is_finite());
        if let Some(index) = attribute.values.iter().position(|color| !valid(color)) {
            return Err(MeshError::AttributeValue { index });
        }
        self.attributes.push(attribute);
        Ok(self)
    }

    /// The same mesh with some of its attributes.
    pub fn keep_attributes(mut self, keep: impl FnMut(&MeshAttribute) -> bool) -> Self {
        self.attributes.retain(keep);
        self
    }

    /// What the mesh knows of its surface beyond positions, normals and texture coordinates.
    pub fn attributes(&self) -> &[MeshAttribute] {
        &self.attributes
    }

    /// Memory of the arrays.
    #[cfg(feature = "std")]
    pub(crate) fn bytes(&self) -> usize {
        let vertices = size_of_val(&*self.positions) + size_of_val(&*self.normals);
        let attributes = self.attributes.iter().map(|a| size_of_val(&*a.values));
        vertices
            + size_of_val(&*self.uvs)
            + size_of_val(&*self.triangles)
            + attributes.sum::<usize>()
    }

    /// The mesh with positions moved by a transform and normals by its transposed inverse.
    ///
    /// The order of the vertices stays, so mirroring turns a mesh without normals inside out, as
    /// it does in Mitsuba. Normals become unit vectors; those that are, up to their rounding, stay what they are where nothing
    /// is moved, so that a mesh that was written down is read as it was.
    ///
    /// # Errors
    /// A vertex that leaves the range of `f32`.
    pub fn transformed(mut self, transform: &Transform) -> Result<Self, MeshError> {
        let stays = *transform == Transform::IDENTITY;
        parallel::update(&mut self.positions, |p| transform.point(p));
        parallel::update(&mut self.normals, |n| {
            if stays && is_unit(n) { n } else { transform.normal(n) }
        });
        match parallel::position(&self.positions, |p| !p.is_finite()) {
            Some(vertex) => Err(MeshError::NotFinite { attribute: "position", vertex }),
            None => Ok(self),
        }
    }
}
