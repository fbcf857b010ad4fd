//! Loaders for the files a scene refers to: OBJ and MTL, PLY, Mitsuba's `serialized`, volumes and images.
//!
//! | files | from a path | from bytes | result |
//! | --- | --- | --- | --- |
//! | OBJ, parts apart | [`load_obj`] | [`parse_obj`] | [`ObjScene`] |
//! | OBJ as one mesh | [`load_obj_merged`] | [`parse_obj_merged`] | [`MeshFile`] |
//! | MTL | [`load_mtl`] | [`parse_mtl`] | [`MtlMaterial`]s |
//! | PLY | [`load_ply`] | [`parse_ply`] | [`MeshFile`] |
//! | `serialized` | [`load_serialized`] | [`parse_serialized`] | [`MeshFile`] |
//! | volumes | [`load_volume`] | [`parse_volume`] | [`VolumeFile`] |
//! | PNG, JPEG, BMP, TGA, HDR, EXR, PFM | [`load_image`] | [`parse_image`] | [`Image`] |
//!
//! # What is promised for untrusted files
//! - No panic; malformed content is a [`SceneError`](crate::SceneError) with file and line or byte.
//! - Meshes have no index out of range and no coordinate that is NaN or infinite.
//! - Memory is proportional to the file: declared counts are checked against its size before
//!   anything is allocated, and what a compressed file may unfold to is bounded.
//! - Only regular files are opened; devices, pipes and directories are refused.
//! - Which files a scene may name at all is told by a [`Sandbox`].
//!
//! # Non-goals
//! Nothing here interprets: transforms, missing normals ([`smooth_normals`]), textures and BSDFs are
//! the business of whoever asked for the file.
//!
//! # Cores
//! Binary PLY and OBJ files are read on all cores (rayon's global pool); the result does not depend on their number.

mod allowance;
mod curves;
mod file;
mod image;
mod lines;
mod mesh_file;
mod mtl;
mod normals;
mod obj;
mod obj_parts;
mod obj_pieces;
mod obj_statements;
mod ply;
mod sandbox;
mod serialized;
pub mod srgb;
mod volume;
mod warnings;

pub(crate) use allowance::Allowance;
pub use curves::{CurveFile, load_curves, parse_curves};
pub use file::read_asset;
pub use image::{Encoding, Image, load_image, parse_image};
pub use mesh_file::{MeshFile, TexCoords};
pub use mtl::{MtlMap, MtlMaterial, load_mtl, parse_mtl};
pub use normals::smooth_normals;
pub use obj::{ObjMesh, ObjScene, load_obj, load_obj_merged, parse_obj, parse_obj_merged};
pub use ply::{load_ply, parse_ply};
pub use sandbox::Sandbox;
pub use serialized::{load_serialized, parse_serialized};
pub use volume::{VolumeFile, load_sdf, load_volume, parse_sdf, parse_volume};
