//! The header of a PLY file.

use alloc::format;
use alloc::string::{String, ToString as _};
use alloc::vec::Vec;
use std::path::Path;

use crate::error::{Location, SceneError};

use super::super::lines::quote;

/// How the elements are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Ascii,
    Binary(Order),
}

/// Byte order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    Little,
    Big,
}

impl Order {
    /// The number that some bytes begin with; `None` where they end in it.
    #[inline(always)]
    pub(super) fn number(self, kind: Scalar, bytes: &[u8]) -> Option<f64> {
        Some(match kind {
            Scalar::I8 => i8::from_le_bytes(self.least_first(bytes)?).into(),
            Scalar::U8 => u8::from_le_bytes(self.least_first(bytes)?).into(),
            Scalar::I16 => i16::from_le_bytes(self.least_first(bytes)?).into(),
            Scalar::U16 => u16::from_le_bytes(self.least_first(bytes)?).into(),
            Scalar::I32 => i32::from_le_bytes(self.least_first(bytes)?).into(),
            Scalar::U32 => u32::from_le_bytes(self.least_first(bytes)?).into(),
            Scalar::F32 => f32::from_le_bytes(self.least_first(bytes)?).into(),
            Scalar::F64 => f64::from_le_bytes(self.least_first(bytes)?),
        })
    }

    /// The first bytes, least significant first.
    #[inline(always)]
    fn least_first<const N: usize>(self, bytes: &[u8]) -> Option<[u8; N]> {
        let mut bytes = *bytes.first_chunk::<N>()?;
        if self == Self::Big {
            bytes.reverse();
        }
        Some(bytes)
    }
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn parse(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes in a binary file.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    fn is_integer(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

/// What a property holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(Scalar),
    List { length: Scalar, item: Scalar },
}

#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
}

/// A kind of record: `vertex`, `face` or another.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
    /// The line that declares it.
    pub(super) line: u32,
}

#[derive(Debug)]
pub(super) struct Header {
    pub(super) format: Format,
    pub(super) elements: Vec<Element>,
}

/// The most kinds of records; real files have two or three.
const MOST_ELEMENTS: usize = 256;

/// The header, the bytes after it, and the number of the line they begin with.
pub(super) fn parse<'a>(
    bytes: &'a [u8],
    path: &Path,
) -> Result<(Header, &'a [u8], u32), SceneError> {
    let mut rest = bytes;
    let mut number = 0u32;
    let mut format = None;
    let mut elements: Vec<Element> = Vec::new();
    loop {
        number = number.saturating_add(1);
        let at = |message: String| SceneError::scene(Location::line(path, number), message);
        let Some(line) = take_line(&mut rest) else {
            return Err(at("the file ends within the header".into()));
        };
        if number == 1 {
            if line.trim_ascii() != b"ply" {
                return Err(at("not a PLY file: the first line is not 'ply'".into()));
            }
            continue;
        }
        let Ok(line) = core::str::from_utf8(line) else {
            if line.starts_with(b"comment") || line.starts_with(b"obj_info") {
                continue;
            }
            return Err(at("the header is not text".into()));
        };
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            None | Some("comment" | "obj_info") => {}
            Some("format") if format.is_some() => {
                return Err(at("the format is stated twice".into()));
            }
            Some("format") => format = Some(parse_format(words).map_err(at)?),
            Some("element") => {
                let element = parse_element(words, number).map_err(at)?;
                if elements.len() == MOST_ELEMENTS {
                    return Err(at(format!("more than {MOST_ELEMENTS} elements")));
                }
                if elements.iter().any(|e| e.name == element.name) {
                    return Err(at(format!("the element '{}' is declared twice", element.name)));
                }
                elements.push(element);
            }
            Some("property") => {
                let property = parse_property(words).map_err(at)?;
                let Some(element) = elements.last_mut() else {
                    return Err(at("a property comes before the first element".into()));
                };
                if element.properties.iter().any(|p| p.name == property.name) {
                    let message = format!("the property '{}' is declared twice", property.name);
                    return Err(at(message));
                }
                element.properties.push(property);
            }
            Some("end_header") => break,
            Some(other) => {
                return Err(at(format!("unknown header keyword {}", quote(other.as_bytes()))));
            }
        }
    }
    let Some(format) = format else {
        let message = "the header has no 'format' line";
        return Err(SceneError::scene(Location::line(path, number), message));
    };
    Ok((Header { format, elements }, rest, number.saturating_add(1)))
}

/// Takes a line that ends with LF, CRLF or CR off the front; `None` when no line ends.
fn take_line<'a>(rest: &mut &'a [u8]) -> Option<&'a [u8]> {
    let end = rest.iter().position(|&b| b == b'\n' || b == b'\r')?;
    let (line, tail) = rest.split_at(end);
    *rest = tail.strip_prefix(b"\r\n").unwrap_or(&tail[1..]);
    Some(line)
}

fn parse_format<'a>(mut words: impl Iterator<Item = &'a str>) -> Result<Format, String> {
    let format = match words.next() {
        Some("ascii") => Format::Ascii,
        Some("binary_little_endian") => Format::Binary(Order::Little),
        Some("binary_big_endian") => Format::Binary(Order::Big),
        other => return Err(format!("unknown format {}", quote(other.unwrap_or("").as_bytes()))),
    };
    match words.next() {
        Some("1.0") => Ok(format),
        other => Err(format!("unknown version {}", quote(other.unwrap_or("").as_bytes()))),
    }
}

fn parse_element<'a>(
    mut words: impl Iterator<Item = &'a str>,
    line: u32,
) -> Result<Element, String> {
    let (Some(name), Some(count)) = (words.next(), words.next()) else {
        return Err("an element needs a name and a count".into());
    };
    let count = count
        .parse()
        .map_err(|_| format!("{} is not a count of {name} records", quote(count.as_bytes())))?;
    Ok(Element { name: name.to_string(), count, properties: Vec::new(), line })
}

fn parse_property<'a>(mut words: impl Iterator<Item = &'a str>) -> Result<Property, String> {
    let mut word = || words.next().ok_or("a property needs a type and a name");
    let scalar =
        |name: &str| Scalar::parse(name).ok_or(format!("unknown type {}", quote(name.as_bytes())));
    let first = word()?;
    let kind = if first == "list" {
        let (length, item) = (scalar(word()?)?, scalar(word()?)?);
        if !length.is_integer() {
            return Err("the length of a list is not of an integer type".into());
        }
        Kind::List { length, item }
    } else {
        Kind::Scalar(scalar(first)?)
    };
    Ok(Property { name: word()?.to_string(), kind })
}
