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
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use etendue_math::glam::{Vec2, Vec3};
use rayon::prelude::*;

use crate::error::{ErrorKind, Location, SceneError, Warning};
use crate::geometry::MeshArrays;

use super::file::{open_asset, read_asset};
use super::lines::{fields, quote};
use super::mesh_file::{MeshFile, TexCoords, mesh_error, stem};
use super::mtl::{MtlMaterial, parse_mtl, relative};
use super::obj_parts::Parts;
use super::obj_pieces::{Pieces, Sizes, tasks};
use super::obj_statements::{Count, Mark, Statements};
use super::sandbox::Sandbox;
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
    pub mesh: MeshArrays,
}

/// An OBJ file, its parts apart, with the MTL files it names: those outside of the sandbox are left out with a warning.
///
/// # Errors
/// A file that cannot be read, and everything [`parse_obj`] refuses.
pub fn load_obj(
    path: &Path,
    tex_coords: TexCoords,
    sandbox: &Sandbox,
) -> Result<ObjScene, SceneError> {
    let (file, size) = open_asset(path)?;
    let mut library = |path: &Path| sandbox.check(path).and_then(|()| read_asset(path));
    Parser::new(path, tex_coords, Some(&mut library)).read(file, size, Sizes::USUAL)
}

/// An OBJ file as one mesh, its groups and materials ignored; warns where it has no faces.
///
/// # Errors
/// A file that cannot be read, and everything [`parse_obj`] refuses.
pub fn load_obj_merged(path: &Path, tex_coords: TexCoords) -> Result<MeshFile, SceneError> {
    let (file, size) = open_asset(path)?;
    let scene = Parser::new(path, tex_coords, None).read(file, size, Sizes::USUAL)?;
    Ok(merged(scene, path))
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
    Parser::new(path, tex_coords, Some(&mut read)).read(bytes, bytes.len() as u64, Sizes::USUAL)
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
    Ok(merged(
        Parser::new(path, tex_coords, None).read(bytes, bytes.len() as u64, Sizes::USUAL)?,
        path,
    ))
}

/// The only part of a file that was read as one mesh.
fn merged(scene: ObjScene, path: &Path) -> MeshFile {
    let mesh = scene.meshes.into_iter().next().map(|part| part.mesh).unwrap_or_default();
    MeshFile { name: stem(path), mesh, face_normals: false, warnings: scene.warnings }
}

/// The most MTL files of an OBJ file, lest a small file ask for endless reading.
const MOST_LIBRARIES: usize = 100;

/// Fetches another file.
type ReadFile<'a> = dyn FnMut(&Path) -> Result<Vec<u8>, SceneError> + 'a;

struct Parser<'a> {
    path: &'a Path,
    tex_coords: TexCoords,
    /// Reads MTL files; without it groups and materials are ignored.
    library: Option<&'a mut ReadFile<'a>>,
    positions: Vec<Vec3>,
    uvs: Vec<Vec2>,
    normals: Vec<Vec3>,
    parts: Parts,
    materials: Vec<MtlMaterial>,
    libraries: BTreeSet<PathBuf>,
    warnings: KindWarnings,
}

impl<'a> Parser<'a> {
    fn new(path: &'a Path, tex_coords: TexCoords, library: Option<&'a mut ReadFile<'a>>) -> Self {
        Self {
            path,
            tex_coords,
            library,
            positions: Vec::new(),
            uvs: Vec::new(),
            normals: Vec::new(),
            parts: Parts::default(),
            materials: Vec::new(),
            libraries: BTreeSet::new(),
            warnings: KindWarnings::default(),
        }
    }

    /// Reads a text: its pieces on all cores, while this thread joins what the piece before holds. No result depends on how the
    /// text is cut.
    fn read(
        mut self,
        text: impl Read + Send,
        length: u64,
        sizes: Sizes,
    ) -> Result<ObjScene, SceneError> {
        let mut pieces = Pieces::new(text, length, sizes.piece);
        let (path, tex_coords) = (self.path, self.tex_coords);
        let mut before = Count::default();
        let mut read = || -> io::Result<Vec<Statements>> {
            let is_first = before == Count::default();
            let piece = pieces.next()?;
            let text = piece.strip_prefix(b"\xef\xbb\xbf").filter(|_| is_first).unwrap_or(&piece);
            let texts = tasks(text, sizes.task);
            let counts: Vec<Count> = texts.par_iter().map(|text| Count::of(text)).collect();
            let starts: Vec<Count> = counts
                .iter()
                .map(|&count| {
                    let start = before;
                    before = before.and(count);
                    start
                })
                .collect();
            let parts = texts.into_par_iter().zip(starts).zip(counts);
            let read = |((text, start), own)| Statements::read(text, path, tex_coords, start, own);
            Ok(parts.map(read).collect())
        };
        let mut next = read();
        loop {
            let current = next.map_err(|error| SceneError::io(path, &error))?;
            if current.is_empty() {
                break;
            }
            next = Ok(Vec::new());
            rayon::in_place_scope(|scope| {
                scope.spawn(|_| next = read());
                current.into_iter().try_for_each(|statements| self.join(statements))
            })?;
        }
        self.scene()
    }

    /// Adds what a part of the text holds.
    fn join(&mut self, statements: Statements) -> Result<(), SceneError> {
        let Statements { positions, uvs, normals, corners, faces, marks, flaw, .. } = statements;
        self.positions.extend(positions);
        self.uvs.extend(uvs);
        self.normals.extend(normals);
        self.parts.positions(self.positions.len());
        let mut marks = marks.into_iter().peekable();
        let mut corners = corners.as_slice();
        for (number, size) in faces.into_iter().enumerate() {
            while let Some((_, line, mark)) = marks.next_if(|(before, ..)| *before <= number) {
                self.mark(line, mark)?;
            }
            let (face, others) = corners.split_at(size);
            corners = others;
            if self.parts.face(face).is_none() {
                let here = Location::file(self.path);
                return Err(SceneError::resource(here, "more than 2³² vertices"));
            }
        }
        marks.try_for_each(|(_, line, mark)| self.mark(line, mark))?;
        flaw.map_or(Ok(()), Err)
    }

    fn mark(&mut self, line: u32, mark: Mark) -> Result<(), SceneError> {
        match mark {
            Mark::Ignored(kind) => self.warnings.add(|| Location::line(self.path, line), &kind),
            _ if self.library.is_none() => {}
            Mark::Name(name) => self.parts.name(name),
            Mark::Material(name) => self.parts.material(name),
            Mark::Library(names) => self.libraries(line, &names)?,
        }
        Ok(())
    }

    /// Reads the MTL files of a `mtllib` statement: one whose name may hold spaces, or several.
    fn libraries(&mut self, line: u32, names: &[u8]) -> Result<(), SceneError> {
        let mut unread = Vec::new();
        match self.library(line, names) {
            Err(error) if error.kind == ErrorKind::Io => {
                if fields(names).nth(1).is_none() {
                    unread.push(error);
                } else {
                    for name in fields(names) {
                        match self.library(line, name) {
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
            self.warnings.push(Warning::new(Location::line(self.path, line), message));
        }
        Ok(())
    }

    fn library(&mut self, line: u32, name: &[u8]) -> Result<(), SceneError> {
        let path = relative(self.path, name);
        let Some(read) = &mut self.library else { return Ok(()) };
        if !self.libraries.insert(path.clone()) {
            return Ok(());
        }
        if self.libraries.len() > MOST_LIBRARIES {
            let message = format!("more than {MOST_LIBRARIES} material libraries");
            return Err(SceneError::resource(Location::line(self.path, line), message));
        }
        let (found, warnings) = parse_mtl(&read(&path)?, &path)?;
        self.materials.extend(found);
        self.warnings.extend(warnings);
        Ok(())
    }

    fn scene(mut self) -> Result<ObjScene, SceneError> {
        let mut by_name = BTreeMap::new();
        for (index, material) in self.materials.iter().enumerate() {
            by_name.entry(material.name.as_str()).or_insert(index);
        }
        let mut parts = Vec::new();
        for part in self.parts.into_vec() {
            let vertices = part.vertices(&self.positions, &self.uvs, &self.normals);
            parts.push((part.name, part.material, part.triangles, vertices));
        }
        drop((self.positions, self.uvs, self.normals));
        let mut meshes = Vec::new();
        for (name, material, triangles, (positions, uvs, normals)) in parts {
            let material = material.as_ref().and_then(|name| {
                let found = by_name.get(name.as_str()).copied();
                if found.is_none() {
                    let kind = format!("undefined material {}", quote(name.as_bytes()));
                    self.warnings.add(|| Location::file(self.path), &kind);
                }
                found
            });
            let mesh = MeshArrays::new(positions, normals, uvs, triangles)
                .map_err(mesh_error(self.path))?;
            meshes.push(ObjMesh { name, material, mesh });
        }
        if meshes.is_empty() {
            self.warnings.push(Warning::new(Location::file(self.path), "there are no faces"));
        }
        Ok(ObjScene { meshes, materials: self.materials, warnings: self.warnings.into_vec() })
    }
}

#[cfg(test)]
mod tests;
