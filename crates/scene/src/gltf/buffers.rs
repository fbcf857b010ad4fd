//! The bytes that the document is about.

use alloc::borrow::Cow;
use alloc::format;
use alloc::vec::Vec;
use core::cell::{Cell, RefCell};
use std::path::{Path, PathBuf};

use super::document::Document;
use super::json::Json;
use super::uri::{Resource, fetch};
use crate::SceneError;
use crate::load::Allowance;

/// Files of N bytes may unfold to `FREE + RATIO · N` elements: parts of a mesh may share vertices, but a kilobyte cannot ask for
/// gigabytes.
const FREE: u64 = 1 << 22;
const RATIO: u64 = 64;

/// The buffers of a document.
#[derive(Debug)]
pub(super) struct Buffers<'a> {
    document: &'a Document,
    /// None for one that has no content.
    contents: Vec<Option<Cow<'a, [u8]>>>,
    /// Elements that may still be read.
    allowance: Cell<u64>,
    /// How much the files that were read may unfold to.
    read: RefCell<Allowance>,
}

/// A part of a buffer.
#[derive(Clone, Debug)]
pub(super) struct View<'a> {
    /// Where it is described.
    pub(super) json: Json<'a>,
    /// All of it.
    pub(super) bytes: &'a [u8],
    /// From element to element, where it says so.
    pub(super) stride: Option<usize>,
}

impl<'a> Buffers<'a> {
    /// Fetches all buffers; `files` gets the paths of those that are files.
    ///
    /// # Errors
    /// A buffer that cannot be fetched or is shorter than it says.
    pub(super) fn load(
        document: &'a Document,
        files: &mut Vec<PathBuf>,
    ) -> Result<Self, SceneError> {
        let mut contents = Vec::new();
        let mut total = 0;
        let mut read = Allowance::default();
        for (index, json) in document.list("buffers")?.iter().enumerate() {
            let mut content: Option<Cow<'a, [u8]>> = match json.get("uri")? {
                Some(uri) => Some(Cow::Owned(match fetch(&uri, document)? {
                    Resource::Data(bytes) => bytes,
                    Resource::File(path, bytes) => {
                        read.spend(&path, bytes.len()).map_err(|error| uri.told_of(error))?;
                        files.push(path);
                        bytes
                    }
                })),
                None if index == 0 => document.binary().map(Cow::Borrowed),
                None => None,
            };
            let length = json.need("byteLength")?.as_index()?;
            if let Some(content) = &mut content {
                let found = content.len();
                if found < length {
                    let error = json.error(format!("holds {found} bytes instead of {length}"));
                    return Err(error.help("the file of the buffer is cut off or another one"));
                }
                match content {
                    Cow::Owned(bytes) => bytes.truncate(length),
                    Cow::Borrowed(bytes) => *bytes = &bytes[..length],
                }
                total += length as u64;
            }
            contents.push(content);
        }
        let allowance = Cell::new(FREE + RATIO * total);
        Ok(Self { document, contents, allowance, read: RefCell::new(read) })
    }

    /// The document.
    pub(super) fn document(&self) -> &'a Document {
        self.document
    }

    /// Accounts for elements that are about to be read or copied.
    ///
    /// # Errors
    /// More than there is reason for in buffers of this size.
    pub(super) fn spend(&self, elements: u64, json: &Json<'_>) -> Result<(), SceneError> {
        match self.allowance.get().checked_sub(elements) {
            Some(left) => {
                self.allowance.set(left);
                Ok(())
            }
            None => Err(json.too_much(format!(
                "{elements} more elements are out of all proportion to the buffers of the file"
            ))),
        }
    }

    /// Accounts for bytes that were made of a file for the sake of an object.
    ///
    /// # Errors
    /// More in all than there is reason for in files of this size.
    pub(super) fn unfold(
        &self,
        path: &Path,
        bytes: usize,
        json: &Json<'_>,
    ) -> Result<(), SceneError> {
        self.read.borrow_mut().spend(path, bytes).map_err(|error| json.told_of(error))
    }

    /// The view that a property names, if it names one.
    ///
    /// # Errors
    /// A view or buffer that does not exist, a view that reaches beyond its buffer.
    pub(super) fn view(
        &self,
        by: &Json<'_>,
        property: &str,
    ) -> Result<Option<View<'_>>, SceneError> {
        let Some((_, json)) = self.document.named(by, property, "bufferViews")? else {
            return Ok(None);
        };
        let Some((index, buffer)) = self.document.named(&json, "buffer", "buffers")? else {
            return Err(json.error("has no “buffer”"));
        };
        let content = self.contents.get(index).and_then(Option::as_deref);
        let Some(content) = content else {
            return Err(buffer.error("has no content: no “uri”, and the file contains none"));
        };
        let start = json.index("byteOffset")?.unwrap_or(0);
        let length = json.need("byteLength")?.as_index()?;
        let bytes = start.checked_add(length).and_then(|end| content.get(start..end));
        let Some(bytes) = bytes else {
            return Err(json.error(format!(
                "{length} bytes from byte {start} on reach beyond {}, which has {}",
                buffer.place(),
                content.len()
            )));
        };
        let stride = json.index("byteStride")?;
        if stride == Some(0) {
            return Err(json.error("a “byteStride” of 0 leads nowhere"));
        }
        Ok(Some(View { json, bytes, stride }))
    }
}
