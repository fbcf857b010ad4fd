//! Shapes, their acceleration structure, and what a ray finds.

mod mesh;

pub use mesh::{MeshError, TriangleMesh};
