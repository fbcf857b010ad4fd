//! Numbers in buffers.

use alloc::format;
use alloc::vec;
use alloc::vec::Vec;

use super::buffers::{Buffers, View};
use super::json::Json;
use crate::SceneError;

/// A list of numbers or vectors, checked to lie within its buffer.
pub(super) struct Accessor<'a> {
    json: Json<'a>,
    count: usize,
    component: Component,
    /// Components per element.
    width: usize,
    normalized: bool,
    /// None for zeros.
    elements: Option<Elements<'a>>,
    sparse: Option<Sparse<'a>>,
}

/// Elements at even distances.
struct Elements<'a> {
    /// From the first byte of the first to the last byte of the last.
    bytes: &'a [u8],
    stride: usize,
}

/// Elements that replace others.
struct Sparse<'a> {
    json: Json<'a>,
    count: usize,
    indices: Elements<'a>,
    index: Component,
    values: Elements<'a>,
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn of(json: &Json<'_>) -> Result<Self, SceneError> {
        let code = json.need("componentType")?;
        Ok(match code.as_index()? {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            other => {
                return Err(code.error(format!(
                    "{other} is no type of numbers; they are 5120 to 5123, 5125 and 5126"
                )));
            }
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// The number at the beginning of `bytes`, which hold it.
    ///
    /// ```text
    /// normalised: u / (2ᵇ − 1),  max(i / (2ᵇ⁻¹ − 1), −1)
    /// ```
    fn float(self, bytes: &[u8], normalized: bool) -> f32 {
        let (value, largest) = match self {
            Self::I8 => (f32::from(bytes[0] as i8), 127.0),
            Self::U8 => (f32::from(bytes[0]), 255.0),
            Self::I16 => (f32::from(i16::from_le_bytes([bytes[0], bytes[1]])), 32767.0),
            Self::U16 => (f32::from(u16::from_le_bytes([bytes[0], bytes[1]])), 65535.0),
            Self::U32 => (self.index(bytes) as f32, u32::MAX as f32),
            Self::F32 => return f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
        };
        if normalized { (value / largest).max(-1.0) } else { value }
    }

    /// The same of an index, which is unsigned.
    fn index(self, bytes: &[u8]) -> u32 {
        match self {
            Self::U8 => u32::from(bytes[0]),
            Self::U16 => u32::from(u16::from_le_bytes([bytes[0], bytes[1]])),
            _ => u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
        }
    }

    fn is_index(self) -> bool {
        matches!(self, Self::U8 | Self::U16 | Self::U32)
    }
}

impl<'a> Elements<'a> {
    /// `count` elements of `size` bytes each, `start` bytes into a view.
    fn within(
        view: &View<'a>,
        start: usize,
        count: usize,
        size: usize,
        json: &Json<'_>,
    ) -> Result<Self, SceneError> {
        let stride = view.stride.unwrap_or(size);
        let length = match count.checked_sub(1) {
            Some(steps) => steps.checked_mul(stride).and_then(|length| length.checked_add(size)),
            None => Some(0),
        };
        let end = length.and_then(|length| start.checked_add(length));
        let bytes = end.and_then(|end| view.bytes.get(start..end));
        let Some(bytes) = bytes else {
            return Err(json.error(format!(
                "reads past {}, which has {} bytes: {count} elements of {size} bytes, {stride} apart, from byte {start} on",
                view.json.place(),
                view.bytes.len()
            )));
        };
        Ok(Self { bytes, stride })
    }

    /// The bytes from an element on.
    fn at(&self, index: usize) -> &'a [u8] {
        &self.bytes[index * self.stride..]
    }
}

impl<'a> Accessor<'a> {
    /// The accessor that a property names, if it names one. What it says is checked before anything is read.
    ///
    /// # Errors
    /// One that does not exist, types that are not known, content that reaches beyond a buffer.
    pub(super) fn named(
        buffers: &'a Buffers<'_>,
        by: &Json<'_>,
        property: &str,
    ) -> Result<Option<Self>, SceneError> {
        let found = buffers.document().named(by, property, "accessors")?;
        let Some((_, json)) = found else { return Ok(None) };
        // What is wrong with an accessor is told where it is used, too.
        Self::of(buffers, json).map(Some).map_err(|mut error| {
            let user = by.get(property).ok().flatten();
            let user = user.as_ref().map_or("", Json::place);
            error.message = format!("{} (used by {user})", error.message);
            error
        })
    }

    fn of(buffers: &'a Buffers<'_>, json: Json<'a>) -> Result<Self, SceneError> {
        let component = Component::of(&json)?;
        let kind = json.need("type")?;
        let width = match kind.as_text()? {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            "MAT4" => 16,
            other => return Err(kind.error(format!("elements “{other}” are not supported here"))),
        };
        let count = json.need("count")?.as_index()?;
        let normalized = json.flag("normalized")?;
        let size = width * component.size();
        let elements = match buffers.view(&json, "bufferView")? {
            Some(view) => {
                let start = json.index("byteOffset")?.unwrap_or(0);
                Some(Elements::within(&view, start, count, size, &json)?)
            }
            None => None,
        };
        let sparse = match json.get("sparse")? {
            Some(sparse) => Some(Sparse::of(buffers, sparse, count, size)?),
            None => None,
        };
        buffers.spend(count as u64, &json)?;
        Ok(Self { json, count, component, width, normalized, elements, sparse })
    }

    /// How many elements there are.
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// An error about it.
    pub(super) fn error(&self, message: impl core::fmt::Display) -> SceneError {
        self.json.error(message)
    }

    /// Vectors of one of the given widths; components beyond the width of an element are `rest`.
    ///
    /// # Errors
    /// Elements of another width.
    pub(super) fn vectors<const N: usize>(
        &self,
        widths: &[usize],
        rest: f32,
    ) -> Result<Vec<[f32; N]>, SceneError> {
        let width = self.width.min(N);
        if !widths.contains(&self.width) {
            return Err(self.error(format!(
                "elements of {} numbers stand where some of {widths:?} belong",
                self.width
            )));
        }
        let read = |bytes: &[u8]| {
            let mut vector = [rest; N];
            for (i, component) in vector.iter_mut().take(width).enumerate() {
                let from = &bytes[i * self.component.size()..];
                *component = self.component.float(from, self.normalized);
            }
            vector
        };
        let mut zero = [rest; N];
        zero[..width].fill(0.0);
        self.read(zero, read)
    }

    /// Whole numbers.
    ///
    /// # Errors
    /// Elements that are vectors or have a sign or a fraction.
    pub(super) fn indices(&self) -> Result<Vec<u32>, SceneError> {
        if self.width != 1 || !self.component.is_index() {
            return Err(self.error("indices must be SCALAR of type 5121, 5123 or 5125"));
        }
        self.read(0, |bytes| self.component.index(bytes))
    }

    fn read<T: Copy>(&self, zero: T, read: impl Fn(&[u8]) -> T) -> Result<Vec<T>, SceneError> {
        let mut values: Vec<T> = match &self.elements {
            Some(elements) => (0..self.count).map(|index| read(elements.at(index))).collect(),
            None => vec![zero; self.count],
        };
        let Some(sparse) = &self.sparse else { return Ok(values) };
        for i in 0..sparse.count {
            let index = sparse.index.index(sparse.indices.at(i)) as usize;
            let Some(value) = values.get_mut(index) else {
                return Err(sparse.json.error(format!(
                    "index {i} replaces element {index}, but there are only {}",
                    self.count
                )));
            };
            *value = read(sparse.values.at(i));
        }
        Ok(values)
    }
}

impl<'a> Sparse<'a> {
    fn of(
        buffers: &'a Buffers<'_>,
        json: Json<'a>,
        most: usize,
        size: usize,
    ) -> Result<Self, SceneError> {
        let number = json.need("count")?;
        let count = number.as_index()?;
        if count > most {
            return Err(number.error(format!("{count} elements replace {most}")));
        }
        let part = |name: &str, size: usize| {
            let part = json.need(name)?;
            let Some(view) = buffers.view(&part, "bufferView")? else {
                return Err(part.error("has no “bufferView”"));
            };
            let start = part.index("byteOffset")?.unwrap_or(0);
            Elements::within(&view, start, count, size, &part)
        };
        let index = Component::of(&json.need("indices")?)?;
        if !index.is_index() {
            return Err(json.error("indices must be of type 5121, 5123 or 5125"));
        }
        let (indices, values) = (part("indices", index.size())?, part("values", size)?);
        Ok(Self { json, count, indices, index, values })
    }
}
