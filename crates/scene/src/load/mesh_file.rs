//! What a mesh file holds.

use alloc::string::String;
use alloc::vec::Vec;
use std::path::Path;

use etendue_math::glam::Vec2;

use crate::error::{Location, SceneError, Warning};
use crate::geometry::{MeshArrays, MeshError};

/// A mesh file read as one mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshFile {
    /// The mesh's own name, or that of the file without its extension.
    pub name: String,
    /// The mesh. Its normals are empty where the file has none.
    pub mesh: MeshArrays,
    /// The file asks for faceted shading; its normals, if it has any, are dropped.
    pub face_normals: bool,
    /// What was skipped or looks suspicious.
    pub warnings: Vec<Warning>,
}

/// Which way the vertical texture coordinate of a file runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TexCoords {
    /// `(u, v)` as written.
    AsWritten,
    /// `(u, 1 − v)`: the file's origin is the bottom of the image, as in most OBJ files, and
    /// should be the top.
    Flipped,
}

impl TexCoords {
    /// A texture coordinate of a file, turned as asked.
    pub(super) fn turn(self, uv: Vec2) -> Vec2 {
        match self {
            Self::AsWritten => uv,
            Self::Flipped => Vec2::new(uv.x, 1.0 - uv.y),
        }
    }
}

/// The file's name without its extension.
pub(super) fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// A flaw found by the mesh's own check, as an error of the file.
pub(super) fn mesh_error(path: &Path) -> impl Fn(MeshError) -> SceneError + '_ {
    move |error| SceneError::scene(Location::file(path), alloc::format!("{error}"))
}
