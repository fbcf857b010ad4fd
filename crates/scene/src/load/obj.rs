//! OBJ meshes.
//!
//! A parser of its own rather than one of the OBJ crates: guarding `tobj` 4.0.5 against what it gets
//! wrong (panics on some index and colour fields, aliasing of huge indices, a first line lost after
//! a byte-order mark, refused continuations, NaN coordinates) means reading every field of every line
//! beforehand, which is all there is to parsing the format; errors carry lines only this way.
//!
//! # Simplifications
//! Polygons are cut into fans from their first corner, which covers concave ones only when that
//! corner sees all others. Vertex colours and weights, smoothing groups, points, lines and free-form
//! geometry are ignored. A vertex must be defined before the faces that use it.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use std::path::{Path, PathBuf};

use etendue_math::glam::{Vec2, Vec3};

use crate::error::{ErrorKind, Location, SceneError, Warning};
use crate::geometry::TriangleMesh;

use super::file::read_asset;
use super::lines::{Line, Lines, fields, quote, real, statement};
use super::mesh_file::{MeshFile, TexCoords, mesh_error, stem};
use super::mtl::{MtlMaterial, parse_mtl, relative};
use super::obj_parts::{Corner, Parts};
use super::warnings::KindWarnings;

/// An OBJ file with its materials.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObjScene {
    /// One mesh for each pair of object or group name and material, in order of first use.
    pub meshes: Vec<ObjMesh>,
    /// The materials of the `mtllib` files, in order.
    pub materials: Vec<MtlMaterial>,
    /// What was skipped or looks suspicious.
    pub warnings: Vec<Warning>,
}

/// A part of an OBJ file with one material.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjMesh {
    /// The last `o` or `g` before its faces; empty without any.
    pub name: String,
    /// Index into [`ObjScene::materials`].
    pub material: Option<usize>,
    /// One vertex for each distinct triple of position, texture coordinate and normal. Where some
    /// corners have no normal it is zero; where some have no texture coordinate it is (0, 0).
    pub mesh: TriangleMesh,
}

/// An OBJ file, its parts apart, with the MTL files it names.
///
/// # Errors
/// A file that cannot be read, and everything [`parse_obj`] refuses.
pub fn load_obj(path: &Path, tex_coords: TexCoords) -> Result<ObjScene, SceneError> {
    parse_obj(&read_asset(path)?, path, tex_coords, read_asset)
}

/// An OBJ file as one mesh, its groups and materials ignored; warns where it has no faces.
///
/// # Errors
/// A file that cannot be read, and everything [`parse_obj`] refuses.
pub fn load_obj_merged(path: &Path, tex_coords: TexCoords) -> Result<MeshFile, SceneError> {
    parse_obj_merged(&read_asset(path)?, path, tex_coords)
}

/// OBJ text, its parts apart. `path` stands in messages; MTL files are named relative to its folder
/// and fetched by `read`.
///
/// An MTL file that cannot be read and a material that is not defined are warnings, like statements
/// of unknown kinds.
///
/// # Errors
/// A missing, malformed or non-finite coordinate; an index that is malformed, 0 or beyond what is
/// defined so far; an MTL file with malformed content;
/// [`ErrorKind::Resource`](crate::ErrorKind::Resource) for more than 100 MTL files.
///
/// # Examples
/// ```
/// use std::path::Path;
/// use etendue_scene::load::{TexCoords, parse_obj, read_asset};
/// let text = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 -1\n";
/// let scene = parse_obj(text, Path::new("quad.obj"), TexCoords::Flipped, read_asset)?;
/// assert_eq!(scene.meshes[0].mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
/// # Ok::<(), etendue_scene::SceneError>(())
/// ```
pub fn parse_obj(
    bytes: &[u8],
    path: &Path,
    tex_coords: TexCoords,
    mut read: impl FnMut(&Path) -> Result<Vec<u8>, SceneError>,
) -> Result<ObjScene, SceneError> {
    let mut parser = Parser::new(path, tex_coords);
    let mut materials = Vec::new();
    for line in Lines::new(bytes) {
        let (keyword, rest) = statement(&line.text);
        match keyword {
            b"o" | b"g" => parser.parts.name(&String::from_utf8_lossy(rest)),
            b"usemtl" => parser.parts.material(&String::from_utf8_lossy(rest)),
            b"mtllib" => materials.extend(parser.library(&line, rest, &mut read)?),
            _ => parser.statement(&line)?,
        }
    }
    parser.scene(materials)
}

/// OBJ text as one mesh, its groups and materials ignored; warns where it has no faces. `path`
/// stands in messages.
///
/// # Errors
/// As [`parse_obj`], MTL files aside.
pub fn parse_obj_merged(
    bytes: &[u8],
    path: &Path,
    tex_coords: TexCoords,
) -> Result<MeshFile, SceneError> {
    let mut parser = Parser::new(path, tex_coords);
    for line in Lines::new(bytes) {
        match statement(&line.text).0 {
            b"o" | b"g" | b"usemtl" | b"mtllib" => {}
            _ => parser.statement(&line)?,
        }
    }
    let scene = parser.scene(Vec::new())?;
    let mesh = scene.meshes.into_iter().next().map(|part| part.mesh).unwrap_or_default();
    Ok(MeshFile { name: stem(path), mesh, face_normals: false, warnings: scene.warnings })
}

/// The most MTL files of an OBJ file, lest a small file ask for endless reading.
const MOST_LIBRARIES: usize = 100;

struct Parser<'a> {
    path: &'a Path,
    tex_coords: TexCoords,
    positions: Vec<Vec3>,
    uvs: Vec<Vec2>,
    normals: Vec<Vec3>,
    parts: Parts,
    libraries: BTreeSet<PathBuf>,
    warnings: KindWarnings,
}

impl<'a> Parser<'a> {
    fn new(path: &'a Path, tex_coords: TexCoords) -> Self {
        Self {
            path,
            tex_coords,
            positions: Vec::new(),
            uvs: Vec::new(),
            normals: Vec::new(),
            parts: Parts::default(),
            libraries: BTreeSet::new(),
            warnings: KindWarnings::default(),
        }
    }

    /// Reads a statement about vertices or faces.
    fn statement(&mut self, line: &Line<'_>) -> Result<(), SceneError> {
        let mut fields = fields(&line.text);
        let Some(keyword) = fields.next() else { return Ok(()) };
        let at = |message| SceneError::scene(Location::line(self.path, line.number), message);
        match keyword {
            b"v" => {
                let position = coordinates::<3>(&mut fields, 3).map_err(at)?;
                self.positions.push(position.into());
            }
            b"vn" => self.normals.push(coordinates::<3>(&mut fields, 3).map_err(at)?.into()),
            b"vt" => {
                let uv = coordinates::<2>(&mut fields, 1).map_err(at)?;
                self.uvs.push(self.tex_coords.turn(uv.into()));
            }
            b"f" => self.face(line, fields)?,
            b"s" | b"vp" => {}
            _ => self.warnings.add(|| Location::line(self.path, line.number), &quote(keyword)),
        }
        Ok(())
    }

    fn face<'t>(
        &mut self,
        line: &Line<'_>,
        fields: impl Iterator<Item = &'t [u8]>,
    ) -> Result<(), SceneError> {
        let here = || Location::line(self.path, line.number);
        let mut fan = [0; 2];
        let mut corners = 0usize;
        for field in fields {
            let corner = self.corner(field).map_err(|m| SceneError::scene(here(), m))?;
            let vertex = self.parts.vertex(corner, &self.positions, &self.uvs, &self.normals);
            let vertex =
                vertex.ok_or_else(|| SceneError::resource(here(), "more than 2³² vertices"))?;
            match corners {
                0 | 1 => fan[corners] = vertex,
                _ => {
                    self.parts.triangle([fan[0], fan[1], vertex]);
                    fan[1] = vertex;
                }
            }
            corners += 1;
        }
        if corners < 3 {
            self.warnings.add(here, "a face of fewer than three vertices");
        }
        Ok(())
    }

    /// Reads `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&self, field: &[u8]) -> Result<Corner, String> {
        let mut parts = field.split(|&b| b == b'/');
        let mut next = |what, count, required| match parts.next() {
            Some(part) if required || !part.is_empty() => index(part, what, count),
            _ => Ok(Corner::NONE),
        };
        let corner = Corner {
            position: next("vertex", self.positions.len(), true)?,
            uv: next("texture coordinate", self.uvs.len(), false)?,
            normal: next("normal", self.normals.len(), false)?,
        };
        match parts.next() {
            None => Ok(corner),
            Some(_) => Err(format!("{} has more than three indices", quote(field))),
        }
    }

    /// Reads the MTL files of a `mtllib` statement: one whose name may hold spaces, or several.
    fn library(
        &mut self,
        line: &Line<'_>,
        names: &[u8],
        read: &mut impl FnMut(&Path) -> Result<Vec<u8>, SceneError>,
    ) -> Result<Vec<MtlMaterial>, SceneError> {
        let mut materials = Vec::new();
        let mut add = |name: &[u8]| -> Result<(), SceneError> {
            let path = relative(self.path, name);
            if !self.libraries.insert(path.clone()) {
                return Ok(());
            }
            if self.libraries.len() > MOST_LIBRARIES {
                let message = format!("more than {MOST_LIBRARIES} material libraries");
                let here = Location::line(self.path, line.number);
                return Err(SceneError::resource(here, message));
            }
            let (found, warnings) = parse_mtl(&read(&path)?, &path)?;
            materials.extend(found);
            self.warnings.extend(warnings);
            Ok(())
        };
        let mut unread = Vec::new();
        match add(names) {
            Err(error) if error.kind == ErrorKind::Io => {
                if fields(names).nth(1).is_none() {
                    unread.push(error);
                } else {
                    for name in fields(names) {
                        match add(name) {
                            Err(error) if error.kind == ErrorKind::Io => unread.push(error),
                            other => other?,
                        }
                    }
                }
            }
            other => other?,
        }
        for error in unread {
            let message = format!("material library left out: {error}");
            self.warnings.push(Warning::new(Location::line(self.path, line.number), message));
        }
        Ok(materials)
    }

    fn scene(mut self, materials: Vec<MtlMaterial>) -> Result<ObjScene, SceneError> {
        let mut by_name = BTreeMap::new();
        for (index, material) in materials.iter().enumerate() {
            by_name.entry(material.name.as_str()).or_insert(index);
        }
        let mut meshes = Vec::new();
        for part in self.parts.into_vec() {
            let material = part.material.as_ref().and_then(|name| {
                let found = by_name.get(name.as_str()).copied();
                if found.is_none() {
                    let kind = format!("undefined material {}", quote(name.as_bytes()));
                    self.warnings.add(|| Location::file(self.path), &kind);
                }
                found
            });
            let mesh = TriangleMesh::new(part.positions, part.normals, part.uvs, part.triangles)
                .map_err(mesh_error(self.path))?;
            meshes.push(ObjMesh { name: part.name, material, mesh });
        }
        if meshes.is_empty() {
            self.warnings.push(Warning::new(Location::file(self.path), "there are no faces"));
        }
        Ok(ObjScene { meshes, materials, warnings: self.warnings.into_vec() })
    }
}

/// `N` coordinates of which the first `required` must be there; the others default to 0.
fn coordinates<'t, const N: usize>(
    fields: &mut impl Iterator<Item = &'t [u8]>,
    required: usize,
) -> Result<[f32; N], String> {
    let mut values = [0.0; N];
    for (i, value) in values.iter_mut().enumerate() {
        *value = match fields.next() {
            Some(field) => real(field)?,
            None if i < required => return Err(format!("{i} numbers of {required} or more")),
            None => 0.0,
        };
    }
    Ok(values)
}

/// An index counted from 1, of `count` things; negative ones count from the last back.
fn index(field: &[u8], what: &str, count: usize) -> Result<u32, String> {
    let text = core::str::from_utf8(field).unwrap_or_default();
    let written: i64 =
        text.parse().map_err(|_| format!("{} is not a {what} index", quote(field)))?;
    let from_first =
        if written < 0 { written.saturating_add_unsigned(count as u64 + 1) } else { written };
    u32::try_from(from_first).ok().filter(|&i| i != Corner::NONE && i as usize <= count).ok_or_else(
        || {
            let defined = match count {
                0 => "none is defined before it".into(),
                n => format!("1 to {n} are defined before it"),
            };
            format!("there is no {what} {written}: {defined}")
        },
    )
}

#[cfg(test)]
mod tests;
