//! PLY meshes: ascii, binary little endian and binary big endian.
//!
//! Vertices have `x y z`, and may have `nx ny nz` and texture coordinates (`u v`, `s t`,
//! `texture_u texture_v` or `texture_s texture_t`); faces have a list `vertex_indices` or
//! `vertex_index`. Properties may come in any order and type. Numbers and colours of vertices and faces
//! become attributes of the mesh; other properties and elements, face texture coordinates among them,
//! are read over.
//!
//! A parser of its own: errors name the line or the byte, counts are checked against the file before
//! anything is allocated, and no text is built in between. The usual records of binary files are read on
//! all cores (`records`).

mod attributes;
mod body;
mod columns;
mod header;
mod records;

use alloc::format;
use alloc::vec;
use alloc::vec::Vec;
use std::path::Path;

use etendue_math::glam::{Vec2, Vec3};

use crate::error::{Location, SceneError, Warning};
use crate::geometry::{AttributeOwner, MeshArrays};

use self::attributes::Attributes;
use self::body::{Ascii, Binary, Body};
use self::columns::{Columns, UNUSED};
use self::header::{Element, Format, Kind};
use super::file::read_asset;
use super::mesh_file::{MeshFile, TexCoords, mesh_error, stem};

/// A PLY file as a mesh.
///
/// # Errors
/// A file that cannot be read, and everything [`parse_ply`] refuses.
pub fn load_ply(path: &Path, tex_coords: TexCoords) -> Result<MeshFile, SceneError> {
    parse_ply(&read_asset(path)?, path, tex_coords)
}

/// The content of a PLY file as a mesh. `path` stands in messages. Polygons are cut into fans from
/// their first corner; faces of fewer than three corners are ignored with a warning.
///
/// # Errors
/// A malformed header; a missing coordinate; counts that the file is too short for; truncation; a
/// coordinate that is not finite; a vertex index or list length that is negative, fractional or out
/// of range. The message names the line (ascii) or the byte (binary).
///
/// # Examples
/// ```
/// use std::path::Path;
/// use etendue_scene::load::{TexCoords, parse_ply};
/// let text = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
///     property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
///     0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
/// let file = parse_ply(text, Path::new("triangle.ply"), TexCoords::AsWritten)?;
/// assert_eq!(file.mesh.triangles(), [[0, 1, 2]]);
/// # Ok::<(), etendue_scene::SceneError>(())
/// ```
pub fn parse_ply(bytes: &[u8], path: &Path, tex_coords: TexCoords) -> Result<MeshFile, SceneError> {
    let (header, rest, line) = header::parse(bytes, path)?;
    let start = bytes.len() - rest.len();
    let content = match header.format {
        Format::Ascii => read(&header.elements, Ascii::new(rest, line, path), path, tex_coords)?,
        Format::Binary(order) => {
            read(&header.elements, Binary::new(bytes, start, order, path), path, tex_coords)?
        }
    };
    content.into_mesh(path)
}

/// What a file holds, its faces cut into triangles.
#[derive(Default)]
struct Content {
    vertices: Vertices,
    triangles: Vec<[u32; 3]>,
    attributes: Vec<Attributes>,
    warnings: Vec<Warning>,
}

impl Content {
    fn into_mesh(self, path: &Path) -> Result<MeshFile, SceneError> {
        let Self { vertices, triangles, attributes, mut warnings } = self;
        let here = || Location::file(path);
        if triangles.is_empty() {
            warnings.push(Warning::new(here(), "there are no faces"));
        }
        let Vertices { positions, normals, uvs } = vertices;
        let mut mesh =
            MeshArrays::new(positions, normals, uvs, triangles).map_err(mesh_error(path))?;
        let moved: usize = attributes.iter().map(Attributes::moved).sum();
        if moved > 0 {
            let message = format!("{moved} attributes are negative or not finite and count as 0");
            warnings.push(Warning::new(here(), message));
        }
        for attribute in attributes.into_iter().flat_map(Attributes::finish) {
            mesh = mesh.with_attribute(attribute).map_err(mesh_error(path))?;
        }
        Ok(MeshFile { name: stem(path), mesh, face_normals: false, warnings })
    }
}

fn read(
    elements: &[Element],
    mut body: impl Body,
    path: &Path,
    tex_coords: TexCoords,
) -> Result<Content, SceneError> {
    let mut content = Content::default();
    let declared = elements.iter().find(|e| e.name == "vertex").map_or(0, |e| e.count);
    for element in elements {
        if element.count > body.most_records(element) {
            let message =
                format!("{} {} records do not fit in the file", element.count, element.name);
            return Err(SceneError::scene(Location::line(path, element.line), message));
        }
        match element.name.as_str() {
            "vertex" => {
                let mut own = Attributes::of(element, AttributeOwner::Vertex);
                content.vertices = read_vertices(&mut body, element, path, tex_coords, &mut own)?;
                content.attributes.push(own);
            }
            "face" if element.count > 0 => {
                let mut own = Attributes::of(element, AttributeOwner::Face);
                let faces = Faces { triangles: &mut content.triangles, attributes: &mut own };
                let small = read_faces(&mut body, element, declared, path, faces)?;
                content.attributes.push(own);
                if small > 0 {
                    let message = format!("{small} faces of fewer than three vertices are ignored");
                    content.warnings.push(Warning::new(Location::file(path), message));
                }
            }
            _ => skip(&mut body, element)?,
        }
    }
    Ok(content)
}

#[derive(Default)]
struct Vertices {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
}

fn read_vertices(
    body: &mut impl Body,
    element: &Element,
    path: &Path,
    tex_coords: TexCoords,
    attributes: &mut Attributes,
) -> Result<Vertices, SceneError> {
    let columns = Columns::of(element);
    if element.count > 0 && !columns.has_positions {
        let message = "the element 'vertex' needs the properties x, y and z";
        return Err(SceneError::scene(Location::line(path, element.line), message));
    }
    let parallel = body
        .binary()
        .and_then(|binary| records::vertices(binary, element, &columns, tex_coords, attributes));
    if let Some((vertices, bytes)) = parallel {
        body.advance(bytes);
        return Ok(vertices);
    }
    let Columns { has_normals, has_uvs, .. } = columns;
    let capacity = |wanted| if wanted { element.count } else { 0 };
    let mut vertices = Vertices {
        positions: Vec::with_capacity(element.count),
        normals: Vec::with_capacity(capacity(has_normals)),
        uvs: Vec::with_capacity(capacity(has_uvs)),
    };
    let mut record = vec![0.0; columns.slots.len()];
    for index in 0..element.count {
        let mut slots = [0f32; UNUSED + 1];
        let properties = element.properties.iter().zip(&columns.slots);
        for ((property, &slot), number) in properties.zip(&mut record) {
            match property.kind {
                Kind::Scalar(scalar) => {
                    let value = body.value(scalar).ok_or_else(|| body.flaw(element, index))?;
                    *number = value;
                    slots[slot] = value as f32;
                    if columns.uses(slot) && !slots[slot].is_finite() {
                        return Err(body.wrong(element, index, "is not a finite number"));
                    }
                }
                Kind::List { .. } => skip_list(body, element, index, property.kind)?,
            }
        }
        let [x, y, z, nx, ny, nz, u, v, _] = slots;
        vertices.positions.push(Vec3::new(x, y, z));
        if has_normals {
            vertices.normals.push(Vec3::new(nx, ny, nz));
        }
        if has_uvs {
            vertices.uvs.push(tex_coords.turn(Vec2::new(u, v)));
        }
        attributes.push(&record, 1);
    }
    Ok(vertices)
}

/// Whether a list of a face is that of its vertices.
fn is_indices(name: &str) -> bool {
    name == "vertex_indices" || name == "vertex_index"
}

/// Where faces are put.
struct Faces<'a> {
    triangles: &'a mut Vec<[u32; 3]>,
    attributes: &'a mut Attributes,
}

/// Reads the faces; returns how many have fewer than three corners.
fn read_faces(
    body: &mut impl Body,
    element: &Element,
    vertices: usize,
    path: &Path,
    mut faces: Faces<'_>,
) -> Result<usize, SceneError> {
    let listed = |p: &header::Property| is_indices(&p.name) && matches!(p.kind, Kind::List { .. });
    if !element.properties.iter().any(listed) {
        let message = "the element 'face' needs a list 'vertex_indices'";
        return Err(SceneError::scene(Location::line(path, element.line), message));
    }
    let parallel =
        body.binary().and_then(|binary| records::faces(binary, element, vertices, &mut faces));
    if let Some((small, bytes)) = parallel {
        body.advance(bytes);
        return Ok(small);
    }
    let Faces { triangles, attributes } = faces;
    let mut small = 0;
    triangles.reserve(element.count);
    let mut record = vec![0.0; element.properties.len()];
    for index in 0..element.count {
        let before = triangles.len();
        for (property, number) in element.properties.iter().zip(&mut record) {
            let (length, item) = match property.kind {
                Kind::List { length, item } => (length, item),
                Kind::Scalar(scalar) => {
                    *number = body.value(scalar).ok_or_else(|| body.flaw(element, index))?;
                    continue;
                }
            };
            if !is_indices(&property.name) {
                skip_list(body, element, index, property.kind)?;
                continue;
            }
            let corners = read_length(body, element, index, length)?;
            let mut fan = [0u32; 2];
            for corner in 0..corners {
                let value = body.value(item).ok_or_else(|| body.flaw(element, index))?;
                let vertex = value as u32;
                if f64::from(vertex) != value || vertex as usize >= vertices {
                    let what = format!("is not one of the vertices 0 to {}", vertices.max(1) - 1);
                    return Err(body.wrong(element, index, &what));
                }
                match corner {
                    0 | 1 => fan[corner as usize] = vertex,
                    _ => {
                        triangles.push([fan[0], fan[1], vertex]);
                        fan[1] = vertex;
                    }
                }
            }
            small += usize::from(corners < 3);
        }
        attributes.push(&record, triangles.len() - before);
    }
    Ok(small)
}

fn skip(body: &mut impl Body, element: &Element) -> Result<(), SceneError> {
    if element.properties.is_empty() {
        return Ok(()); // such records occupy nothing, however many are declared
    }
    for index in 0..element.count {
        for property in &element.properties {
            skip_property(body, element, index, property.kind)?;
        }
    }
    Ok(())
}

fn skip_property(
    body: &mut impl Body,
    element: &Element,
    index: usize,
    kind: Kind,
) -> Result<(), SceneError> {
    match kind {
        Kind::Scalar(scalar) => {
            body.value(scalar).map(|_| ()).ok_or_else(|| body.flaw(element, index))
        }
        Kind::List { .. } => skip_list(body, element, index, kind),
    }
}

fn skip_list(
    body: &mut impl Body,
    element: &Element,
    index: usize,
    kind: Kind,
) -> Result<(), SceneError> {
    let Kind::List { length, item } = kind else { return Ok(()) };
    for _ in 0..read_length(body, element, index, length)? {
        body.value(item).ok_or_else(|| body.flaw(element, index))?;
    }
    Ok(())
}

fn read_length(
    body: &mut impl Body,
    element: &Element,
    index: usize,
    length: header::Scalar,
) -> Result<u64, SceneError> {
    let value = body.value(length).ok_or_else(|| body.flaw(element, index))?;
    if value < 0.0 || value.fract() != 0.0 {
        return Err(body.wrong(element, index, "is not the length of a list"));
    }
    Ok(value as u64)
}

#[cfg(test)]
mod tests;
