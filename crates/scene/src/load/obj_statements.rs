//! The statements of a part of an OBJ file.
//!
//! What a part holds does not depend on the others but for how much is defined before it: that much is counted first, so that
//! parts can be read on all cores.

use alloc::collections::BTreeSet;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use std::path::Path;

use etendue_math::glam::{Vec2, Vec3};

use crate::error::{Location, SceneError};

use super::lines::{Line, Lines, fields, quote, real, statement};
use super::mesh_file::TexCoords;
use super::obj_parts::Corner;
use super::warnings::MOST_KINDS;

/// How much a text holds, or what precedes a part of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Count {
    pub(super) lines: u32,
    pub(super) positions: usize,
    pub(super) uvs: usize,
    pub(super) normals: usize,
}

impl Count {
    /// What a part holds.
    pub(super) fn of(text: &[u8]) -> Self {
        let mut count = Self::default();
        let mut lines = Lines::after(0, text);
        for line in &mut lines {
            match statement(&line.text).0 {
                b"v" => count.positions += 1,
                b"vt" => count.uvs += 1,
                b"vn" => count.normals += 1,
                _ => {}
            }
        }
        Self { lines: lines.number(), ..count }
    }

    /// Both together.
    pub(super) fn and(self, after: Self) -> Self {
        Self {
            lines: self.lines.saturating_add(after.lines),
            positions: self.positions + after.positions,
            uvs: self.uvs + after.uvs,
            normals: self.normals + after.normals,
        }
    }
}

/// What stands between faces.
pub(super) enum Mark {
    /// `o` or `g`.
    Name(String),
    /// `usemtl`.
    Material(String),
    /// `mtllib`.
    Library(Vec<u8>),
    /// Content that is ignored.
    Ignored(String),
}

/// The statements of a part, up to the first that is wrong.
#[derive(Default)]
pub(super) struct Statements {
    pub(super) positions: Vec<Vec3>,
    pub(super) uvs: Vec<Vec2>,
    pub(super) normals: Vec<Vec3>,
    /// The corners of all faces.
    pub(super) corners: Vec<Corner>,
    /// How many corners each face has.
    pub(super) faces: Vec<usize>,
    /// Marks, each with the number of faces before it and its line.
    pub(super) marks: Vec<(usize, u32, Mark)>,
    pub(super) flaw: Option<SceneError>,
    /// Kinds of ignored content that have a mark.
    ignored: BTreeSet<String>,
}

impl Statements {
    /// Reads a part of the text of `path`, which holds `own`, with `before` in front of it. `path` stands in messages.
    pub(super) fn read(
        text: &[u8],
        path: &Path,
        tex_coords: TexCoords,
        before: Count,
        own: Count,
    ) -> Self {
        let mut statements = Self {
            positions: Vec::with_capacity(own.positions),
            uvs: Vec::with_capacity(own.uvs),
            normals: Vec::with_capacity(own.normals),
            ..Self::default()
        };
        for line in Lines::after(before.lines, text) {
            if let Err(message) = statements.line(&line, tex_coords, before) {
                statements.flaw =
                    Some(SceneError::scene(Location::line(path, line.number), message));
                break;
            }
        }
        statements
    }

    fn line(
        &mut self,
        line: &Line<'_>,
        tex_coords: TexCoords,
        before: Count,
    ) -> Result<(), String> {
        let (keyword, rest) = statement(&line.text);
        let text = || String::from_utf8_lossy(rest).into_owned();
        match keyword {
            b"v" => self.positions.push(coordinates::<3>(rest, 3)?.into()),
            b"vn" => self.normals.push(coordinates::<3>(rest, 3)?.into()),
            b"vt" => self.uvs.push(tex_coords.turn(coordinates::<2>(rest, 1)?.into())),
            b"f" => self.face(line.number, rest, before)?,
            b"o" | b"g" => self.mark(line.number, Mark::Name(text())),
            b"usemtl" => self.mark(line.number, Mark::Material(text())),
            b"mtllib" => self.mark(line.number, Mark::Library(rest.into())),
            b"" | b"s" | b"vp" | [b'#', ..] => {}
            _ => self.ignore(line.number, quote(keyword)),
        }
        Ok(())
    }

    fn mark(&mut self, line: u32, mark: Mark) {
        self.marks.push((self.faces.len(), line, mark));
    }

    fn ignore(&mut self, line: u32, kind: String) {
        if self.ignored.len() < MOST_KINDS && self.ignored.insert(kind.clone()) {
            self.mark(line, Mark::Ignored(kind));
        }
    }

    fn face(&mut self, line: u32, rest: &[u8], before: Count) -> Result<(), String> {
        let defined = Count {
            lines: line,
            positions: before.positions + self.positions.len(),
            uvs: before.uvs + self.uvs.len(),
            normals: before.normals + self.normals.len(),
        };
        let first = self.corners.len();
        for field in fields(rest) {
            self.corners.push(corner(field, defined)?);
        }
        let corners = self.corners.len() - first;
        if corners < 3 {
            self.ignore(line, "a face of fewer than three vertices".into());
        }
        self.faces.push(corners);
        Ok(())
    }
}

/// Reads `v`, `v/vt`, `v//vn` or `v/vt/vn`.
fn corner(field: &[u8], defined: Count) -> Result<Corner, String> {
    let mut parts = field.split(|&b| b == b'/');
    let mut next = |what, count, required| match parts.next() {
        Some(part) if required || !part.is_empty() => index(part, what, count),
        _ => Ok(Corner::NONE),
    };
    let corner = Corner {
        position: next("vertex", defined.positions, true)?,
        uv: next("texture coordinate", defined.uvs, false)?,
        normal: next("normal", defined.normals, false)?,
    };
    match parts.next() {
        None => Ok(corner),
        Some(_) => Err(format!("{} has more than three indices", quote(field))),
    }
}

/// `N` coordinates of which the first `required` must be there; the others default to 0.
fn coordinates<const N: usize>(rest: &[u8], required: usize) -> Result<[f32; N], String> {
    let mut fields = fields(rest);
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
    if let Some(index) = natural(field).filter(|&i| i != Corner::NONE && i as usize <= count) {
        return Ok(index);
    }
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

/// A number of up to nine digits, which most indices are.
fn natural(field: &[u8]) -> Option<u32> {
    if field.is_empty() || field.len() > 9 {
        return None;
    }
    field.iter().try_fold(0, |number, byte| {
        let digit = byte.wrapping_sub(b'0');
        (digit < 10).then(|| 10 * number + u32::from(digit))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_count_what_they_hold() {
        let text = b"v 1 2 3\nvt 0\n\n v 0 0 0\\\n1\nvn 0 0 1\nf 1 2 3\n# v";
        let expected = Count { lines: 8, positions: 2, uvs: 1, normals: 1 };
        assert_eq!(Count::of(text), expected);
        let none = Count::default();
        let read = Statements::read(text, Path::new("a"), TexCoords::AsWritten, none, none);
        let held = (read.positions.len(), read.uvs.len(), read.normals.len());
        assert_eq!(held, (expected.positions, expected.uvs, expected.normals));
    }

    #[test]
    fn short_indices_are_read_as_long_ones_are() {
        for text in
            ["1", "000000001", "999999999", "0000000001", "+1", "12a", "", "-1", "1234567890"]
        {
            let expected = text
                .parse::<i64>()
                .ok()
                .filter(|_| text.len() < 10 && !text.starts_with(['+', '-']));
            assert_eq!(natural(text.as_bytes()).map(i64::from), expected, "{text}");
        }
    }
}
