//! Mitsuba's `serialized` meshes, format versions 3 and 4.
//!
//! ```text
//! file        mesh … mesh, offset of each mesh, u32 number of meshes
//! offset      u32 in version 3, u64 in version 4
//! mesh        u16 0x041C, u16 version, then a zlib stream of
//!             u32 flags, name and NUL (version 4 only), u64 vertices, u64 triangles,
//!             positions, normals if flag 0x1, (u, v) if 0x2, colours if 0x8, u32 corners
//! numbers     f64 if flag 0x2000, else f32; flag 0x10 asks for face normals
//! ```
//!
//! All numbers are little endian. Colours are read over.
//!
//! # Source
//! Mitsuba 3, `src/shapes/serialized.cpp`.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use std::io::{self, BufReader, Read};
use std::path::Path;

use etendue_math::glam::{Vec2, Vec3};
use flate2::read::ZlibDecoder;

use crate::error::{Location, SceneError, Warning};
use crate::geometry::MeshArrays;

use super::file::read_asset;
use super::mesh_file::{MeshFile, mesh_error, stem};

const MAGIC: [u8; 2] = 0x041Cu16.to_le_bytes();
const HAS_NORMALS: u32 = 0x1;
const HAS_UVS: u32 = 0x2;
const HAS_COLORS: u32 = 0x8;
const FACE_NORMALS: u32 = 0x10;
const DOUBLE_PRECISION: u32 = 0x2000;

/// A file of N bytes may unfold to `FREE + RATIO · N`. Real meshes stay below ten times their size;
/// a few bytes of zlib can stand for a thousand times as many.
const FREE: u64 = 1 << 24;
const RATIO: u64 = 128;

/// The longest name of a mesh, in bytes.
const LONGEST_NAME: usize = 1 << 16;

/// The mesh `shape_index`, counted from 0, of a `serialized` file.
///
/// # Errors
/// A file that cannot be read, and everything [`parse_serialized`] refuses.
pub fn load_serialized(path: &Path, shape_index: usize) -> Result<MeshFile, SceneError> {
    parse_serialized(&read_asset(path)?, path, shape_index)
}

/// The mesh `shape_index`, counted from 0, of the bytes of a `serialized` file. `path` stands in
/// messages.
///
/// # Errors
/// Another format or version; an index the file does not have; a damaged dictionary or stream;
/// truncation; an index out of range; a coordinate that is not finite;
/// [`ErrorKind::Resource`](crate::ErrorKind::Resource) for counts out of proportion to the file.
pub fn parse_serialized(
    bytes: &[u8],
    path: &Path,
    shape_index: usize,
) -> Result<MeshFile, SceneError> {
    let fail = |message: String| SceneError::scene(Location::file(path), message);
    let (version, stream) = find(bytes, shape_index).map_err(fail)?;
    let limit = FREE + RATIO * bytes.len() as u64;
    let mut stream = Stream { inner: BufReader::new(ZlibDecoder::new(stream)), wide: false };
    read(&mut stream, version, limit, path).map_err(|flaw| match flaw {
        Flaw::Broken(part, error) => fail(format!("the {part} of mesh {shape_index}: {error}")),
        Flaw::TooLarge(size) => SceneError::resource(
            Location::file(path),
            format!("mesh {shape_index} declares {size} bytes, more than the {limit} allowed"),
        ),
        Flaw::Mesh(error) => error,
    })
}

/// The format version and the zlib stream of a mesh.
fn find(bytes: &[u8], shape_index: usize) -> Result<(u16, &[u8]), String> {
    let (version, first) = mesh_header(bytes, 0)?;
    if shape_index == 0 {
        return Ok((version, first));
    }
    let dictionary = || -> Option<(u64, u64)> {
        let (rest, count) = bytes.split_last_chunk::<4>()?;
        let count = u64::from(u32::from_le_bytes(*count));
        let from_last = usize::try_from(count.checked_sub(shape_index as u64)?).ok()?;
        let width = if version == 4 { 8 } else { 4 };
        let at = rest.len().checked_sub(from_last.checked_mul(width)?)?;
        let mut offset = [0; 8];
        offset[..width].copy_from_slice(rest.get(at..at + width)?);
        Some((count, u64::from_le_bytes(offset)))
    };
    let count = bytes.last_chunk::<4>().map_or(0, |count| u32::from_le_bytes(*count));
    match dictionary() {
        _ if shape_index >= count as usize => {
            Err(format!("there is no mesh {shape_index}: the file has {count}"))
        }
        Some((_, offset)) => mesh_header(bytes, offset),
        None => Err(format!("the dictionary of {count} meshes does not fit in the file")),
    }
}

/// Checks the header at an offset; returns the version and what follows.
fn mesh_header(bytes: &[u8], offset: u64) -> Result<(u16, &[u8]), String> {
    let rest = usize::try_from(offset).ok().and_then(|at| bytes.get(at..));
    match rest.and_then(<[u8]>::split_first_chunk::<4>) {
        Some(([a, b, c, d], stream)) if [*a, *b] == MAGIC => match u16::from_le_bytes([*c, *d]) {
            version @ (3 | 4) => Ok((version, stream)),
            other => Err(format!("unknown version {other}, expected 3 or 4")),
        },
        Some(_) => Err(format!("no serialized mesh begins at byte {offset}")),
        None => Err(format!("the file ends before the mesh at byte {offset}")),
    }
}

enum Flaw {
    Broken(&'static str, io::Error),
    TooLarge(u64),
    Mesh(SceneError),
}

fn read(
    stream: &mut Stream<impl Read>,
    version: u16,
    limit: u64,
    path: &Path,
) -> Result<MeshFile, Flaw> {
    let broken = |part| move |error| Flaw::Broken(part, error);
    let flags = u32::from_le_bytes(stream.bytes().map_err(broken("header"))?);
    let stored = if version == 4 { stream.name().map_err(broken("name"))? } else { String::new() };
    let name = if stored.is_empty() { stem(path) } else { stored };
    let vertices = u64::from_le_bytes(stream.bytes().map_err(broken("header"))?);
    let triangles = u64::from_le_bytes(stream.bytes().map_err(broken("header"))?);

    stream.wide = flags & DOUBLE_PRECISION != 0;
    let has = |flag| flags & flag != 0;
    let per_vertex = 3
        + if has(HAS_NORMALS) { 3 } else { 0 }
        + if has(HAS_UVS) { 2 } else { 0 }
        + if has(HAS_COLORS) { 3 } else { 0 };
    let number = if stream.wide { 8 } else { 4 };
    let size =
        vertices.saturating_mul(per_vertex * number).saturating_add(triangles.saturating_mul(12));
    if size > limit || vertices > u64::from(u32::MAX) {
        return Err(Flaw::TooLarge(size));
    }
    let positions = stream.floats(vertices).map_err(broken("positions"))?;
    let mut normals = Vec::new();
    if has(HAS_NORMALS) {
        normals = stream.floats(vertices).map_err(broken("normals"))?;
    }
    if has(FACE_NORMALS) {
        normals = Vec::new();
    }
    let mut uvs = Vec::new();
    if has(HAS_UVS) {
        uvs = stream.floats(vertices).map_err(broken("texture coordinates"))?;
    }
    if has(HAS_COLORS) {
        let _: Vec<[f32; 3]> = stream.floats(vertices).map_err(broken("colours"))?;
    }
    let corners = stream.records(triangles, |bytes: [u8; 12]| {
        core::array::from_fn(|i| u32::from_le_bytes(core::array::from_fn(|k| bytes[4 * i + k])))
    });
    let corners = corners.map_err(broken("triangles"))?;

    let positions = positions.into_iter().map(Vec3::from_array).collect();
    let normals = normals.into_iter().map(Vec3::from_array).collect();
    let uvs = uvs.into_iter().map(Vec2::from_array).collect();
    let mesh = MeshArrays::new(positions, normals, uvs, corners);
    let mesh = mesh.map_err(|error| Flaw::Mesh(mesh_error(path)(error)))?;
    let mut warnings = Vec::new();
    if mesh.triangles().is_empty() {
        warnings.push(Warning::new(Location::file(path), "there are no faces"));
    }
    Ok(MeshFile { name, mesh, face_normals: has(FACE_NORMALS), warnings })
}

/// Numbers from a decompressed stream.
struct Stream<R> {
    inner: R,
    /// Whether floats are of double precision.
    wide: bool,
}

impl<R: Read> Stream<R> {
    fn bytes<const N: usize>(&mut self) -> io::Result<[u8; N]> {
        let mut bytes = [0; N];
        self.inner.read_exact(&mut bytes)?;
        Ok(bytes)
    }

    /// A string that ends with NUL.
    fn name(&mut self) -> io::Result<String> {
        let mut name = Vec::new();
        loop {
            match self.bytes()? {
                [0] => return Ok(String::from_utf8_lossy(&name).into_owned()),
                [_] if name.len() == LONGEST_NAME => {
                    return Err(io::Error::new(io::ErrorKind::InvalidData, "it is too long"));
                }
                [byte] => name.push(byte),
            }
        }
    }

    /// `count` records of `N` bytes. Memory grows with what the stream yields.
    fn records<const N: usize, T>(
        &mut self,
        count: u64,
        convert: impl Fn([u8; N]) -> T,
    ) -> io::Result<Vec<T>> {
        let mut records = Vec::new();
        for _ in 0..count {
            records.push(convert(self.bytes()?));
        }
        Ok(records)
    }

    /// `count` vectors of `D` floats of the stream's precision.
    fn floats<const D: usize>(&mut self, count: u64) -> io::Result<Vec<[f32; D]>> {
        let mut vectors = Vec::new();
        for _ in 0..count {
            let mut vector = [0.0; D];
            for value in &mut vector {
                *value = if self.wide {
                    f64::from_le_bytes(self.bytes()?) as f32
                } else {
                    f32::from_le_bytes(self.bytes()?)
                };
            }
            vectors.push(vector);
        }
        Ok(vectors)
    }
}

#[cfg(test)]
mod tests;
