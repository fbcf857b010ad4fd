//! Loaders for the files a scene refers to.

mod file;
mod image;
mod lines;
mod mesh_file;
mod mtl;
mod normals;
mod obj;
mod obj_parts;
mod ply;
mod serialized;
pub mod srgb;
mod warnings;

pub use file::read_asset;
pub use image::{Encoding, Image, load_image, parse_image};
pub use mesh_file::{MeshFile, TexCoords};
pub use mtl::{MtlMaterial, load_mtl, parse_mtl};
pub use normals::smooth_normals;
pub use obj::{ObjMesh, ObjScene, load_obj, load_obj_merged, parse_obj, parse_obj_merged};
pub use ply::{load_ply, parse_ply};
pub use serialized::{load_serialized, parse_serialized};
