//! Meshes from files, and the cube.

use alloc::format;
use alloc::string::String;
use std::path::{Path, PathBuf};

use super::super::Context;
use super::super::reader::PluginReader;
use super::Item;
use super::surface::{placed, refused, surface};
use crate::SceneError;
use crate::geometry::{MeshArrays, MeshError, Shape, TriangleMesh};
use crate::load::{
    MeshFile, TexCoords, load_obj_merged, load_ply, load_serialized, smooth_normals,
};

/// `filename`, `face_normals` (false), `flip_tex_coords` (true), `flip_normals` (false), `to_world`.
pub(super) fn obj<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Item, SceneError> {
    let path = path(reader)?;
    let file = load_obj_merged(&path, tex_coords(reader, true)?);
    mesh(reader, context, &path, file)
}

/// The parameters of `obj`, `flip_tex_coords` being false by default.
pub(super) fn ply<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Item, SceneError> {
    let path = path(reader)?;
    let file = load_ply(&path, tex_coords(reader, false)?);
    mesh(reader, context, &path, file)
}

/// `filename`, `shape_index` (0), `face_normals` (false), `flip_normals` (false), `to_world`.
pub(super) fn serialized<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Item, SceneError> {
    let path = path(reader)?;
    let index = reader.integer("shape_index")?.unwrap_or(0);
    let index = usize::try_from(index)
        .map_err(|_| reader.error("shape_index", format!("there is no shape {index}")))?;
    mesh(reader, context, &path, load_serialized(&path, index))
}

/// The cube between −1 and 1: `flip_normals` (false), `to_world`.
pub(super) fn cube<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Item, SceneError> {
    let (to_world, motion) = placed(reader, context)?;
    let mesh = TriangleMesh::cube(&to_world).map_err(|e| refused(reader, e))?;
    surface(reader, context, Shape::Mesh(mesh), motion, "cube".into())
}

/// The file of `filename`.
pub(super) fn path(reader: &mut PluginReader<'_>) -> Result<PathBuf, SceneError> {
    match reader.string("filename")? {
        Some(name) => {
            reader.node().search.resolve(name).map_err(|error| asset_error(error, reader))
        }
        None => Err(reader.error("filename", format!("{} has no “filename”", reader.title()))),
    }
}

fn tex_coords(reader: &mut PluginReader<'_>, default: bool) -> Result<TexCoords, SceneError> {
    Ok(if reader.boolean("flip_tex_coords", default)? {
        TexCoords::Flipped
    } else {
        TexCoords::AsWritten
    })
}

/// An error of a shape's file, with the place of the shape.
pub(super) fn asset_error(mut error: SceneError, reader: &PluginReader<'_>) -> SceneError {
    error.message = format!("{} (shape at {})", error.message, reader.node().location);
    error
}

fn mesh<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    path: &Path,
    file: Result<MeshFile, SceneError>,
) -> Result<Item, SceneError> {
    let file = file.map_err(|error| asset_error(error, reader))?;
    context.read(path, file.mesh.bytes()).map_err(|error| asset_error(error, reader))?;
    context.warnings.extend(file.warnings);
    let (to_world, motion) = placed(reader, context)?;
    let is_flat = reader.boolean("face_normals", file.face_normals)?;
    let mesh = file.mesh.transformed(&to_world).and_then(|mesh| shaded(mesh, is_flat));
    let mesh = mesh.map_err(|e| refused(reader, e))?;
    let name: String = if file.name.is_empty() { reader.title() } else { file.name };
    surface(reader, context, Shape::Mesh(mesh), motion, name)
}

/// The mesh without vertex normals where it is to look flat, and else with them.
pub(in super::super) fn shaded(mesh: MeshArrays, is_flat: bool) -> Result<TriangleMesh, MeshError> {
    let mesh = if is_flat {
        mesh.with_normals(alloc::vec::Vec::new())?
    } else if mesh.normals().is_empty() {
        let normals = smooth_normals(&mesh);
        mesh.with_normals(normals)?
    } else {
        mesh
    };
    Ok(mesh.into())
}
