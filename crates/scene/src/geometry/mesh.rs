//! Triangle meshes.

use alloc::vec::Vec;

use etendue_math::glam::{Vec2, Vec3};

/// A triangle mesh whose indices and coordinates have been checked.
///
/// The front of a triangle is the side from which its vertices run anticlockwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    triangles: Vec<[u32; 3]>,
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
}

impl TriangleMesh {
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
        for (attribute, found) in [("normal", normals.len()), ("uv", uvs.len())] {
            if found != 0 && found != vertices {
                return Err(MeshError::LengthMismatch { attribute, found, vertices });
            }
        }
        let finite = |attribute, bad: Option<usize>| match bad {
            Some(vertex) => Err(MeshError::NotFinite { attribute, vertex }),
            None => Ok(()),
        };
        finite("position", positions.iter().position(|p| !p.is_finite()))?;
        finite("normal", normals.iter().position(|n| !n.is_finite()))?;
        finite("uv", uvs.iter().position(|t| !t.is_finite()))?;
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices) {
                return Err(MeshError::IndexOutOfRange { triangle, vertex, vertices });
            }
        }
        Ok(Self { positions, normals, uvs, triangles })
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    #[test]
    fn bad_indices_and_coordinates_are_refused() {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
        let ok = TriangleMesh::new(positions.clone(), vec![], vec![], vec![[0, 1, 2]]);
        assert_eq!(ok.map(|m| m.triangles().len()), Ok(1));
        assert_eq!(
            TriangleMesh::new(positions.clone(), vec![], vec![], vec![[0, 1, 3]]),
            Err(MeshError::IndexOutOfRange { triangle: 0, vertex: 3, vertices: 3 })
        );
        assert_eq!(
            TriangleMesh::new(vec![Vec3::NAN], vec![], vec![], vec![]),
            Err(MeshError::NotFinite { attribute: "position", vertex: 0 })
        );
        assert_eq!(
            TriangleMesh::new(positions, vec![Vec3::Z], vec![], vec![]),
            Err(MeshError::LengthMismatch { attribute: "normal", found: 1, vertices: 3 })
        );
    }
}
