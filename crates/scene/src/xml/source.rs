//! The text of one scene file, and places in it.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::{String, ToString};
use std::path::{Path, PathBuf};

use roxmltree::{Document, Node as Element, ParsingOptions};

use super::description::Kind;
use super::nearest::nearest;
use super::{SearchPath, places::Places, property};
use crate::load::read_asset;
use crate::{Location, SceneError};

/// The largest scene file that is read, in bytes; meshes and textures have files of their own.
pub(super) const LARGEST_FILE: usize = 1 << 28;

/// The element names a scene file may have beside those of plugins and of values.
const OTHER_ELEMENTS: [&str; 8] =
    ["default", "path", "ref", "alias", "include", "transform", "animation", "null"];

/// Reads a scene file whole.
///
/// # Errors
/// A file that is missing, is no regular file, is too large or is not UTF-8.
pub(super) fn read(path: &Path) -> Result<String, SceneError> {
    let bytes = read_asset(path)?;
    if bytes.len() > LARGEST_FILE {
        let message = format!("the file has {} bytes, more than {LARGEST_FILE}", bytes.len());
        return Err(SceneError::resource(Location::file(path), message));
    }
    if let [0xff, 0xfe, ..] | [0xfe, 0xff, ..] = bytes[..] {
        let message = "the file is UTF-16";
        return Err(SceneError::scene(Location::file(path), message).help("save it as UTF-8"));
    }
    String::from_utf8(bytes).map_err(|e| {
        let before = &e.as_bytes()[..e.utf8_error().valid_up_to()];
        let line = before.split(|&b| b == b'\n').count() as u32;
        SceneError::scene(Location::line(path, line), "the text is not UTF-8")
    })
}

/// The XML tree of a scene file. Document type declarations are refused, and with them entities, so
/// that nothing is fetched and nothing grows.
///
/// # Errors
/// Text that is not well-formed XML; more attributes than an element can have.
pub(super) fn document<'a>(text: &'a str, path: &Path) -> Result<Document<'a>, SceneError> {
    if let Some(byte) = overloaded(text) {
        let (line, column) = Places::of(text).of_byte(byte);
        let location = Location { file: path.to_owned(), line: Some(line), column: Some(column) };
        let message = format!("an element has more than {MOST_ATTRIBUTES} attributes");
        return Err(SceneError::scene(location, message));
    }
    let options = ParsingOptions { allow_dtd: false, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|e| {
        let position = e.pos();
        let location = Location {
            file: path.to_owned(),
            line: Some(position.row),
            column: Some(position.col),
        };
        let message = match e {
            roxmltree::Error::DtdDetected => {
                "document type declarations and entities are not allowed".to_string()
            }
            roxmltree::Error::NodesLimitReached => "the file has too many elements".to_string(),
            // The position at the end of its sentence is in the location already.
            other => {
                let text = other.to_string();
                let end = text.rfind(" at ").unwrap_or(text.len());
                format!("the file is not well-formed XML: {}", &text[..end])
            }
        };
        SceneError::scene(location, message)
    })
}

/// Attributes of an element, of which those known have seven at most. The parser compares each with each and copies the namespaces
/// of an element to those within.
const MOST_ATTRIBUTES: usize = 64;

/// The place of the first tag with more than [`MOST_ATTRIBUTES`] attributes, in text that may be no XML: quotes are counted in tags
/// and skipped with what is between them, as are comments and the like.
fn overloaded(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    let find = |what: &str, from: usize| text[from..].find(what).map(|at| from + at + what.len());
    let mut at = 0;
    while let Some(found) = memchr(b'<', bytes, at) {
        let rest = &text[found..];
        let skipped = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")];
        if let Some((begin, end)) = skipped.into_iter().find(|(begin, _)| rest.starts_with(begin)) {
            at = find(end, found + begin.len())?;
            continue;
        }
        let mut attributes = 0;
        at = found + 1;
        loop {
            let quote = at + bytes[at..].iter().position(|b| matches!(b, b'"' | b'\'' | b'>'))?;
            if bytes[quote] == b'>' {
                at = quote + 1;
                break;
            }
            attributes += 1;
            if attributes > MOST_ATTRIBUTES {
                return Some(found);
            }
            at = memchr(bytes[quote], bytes, quote + 1)? + 1;
        }
    }
    None
}

/// The next byte of a value.
fn memchr(byte: u8, bytes: &[u8], from: usize) -> Option<usize> {
    bytes[from..].iter().position(|&b| b == byte).map(|at| from + at)
}

/// One scene file while it is read.
pub(super) struct Source<'a> {
    path: PathBuf,
    places: Places<'a>,
    pub(super) version: [u32; 3],
    pub(super) search: SearchPath,
}

impl<'a> Source<'a> {
    /// A file that searches `search` beside its own folder: that of the file which includes it.
    pub(super) fn new(
        text: &'a str,
        path: &Path,
        root: Element<'_, '_>,
        search: &SearchPath,
    ) -> Result<Self, SceneError> {
        let mut search = search.clone();
        search.prepend_folder_of(path);
        let mut source =
            Self { path: path.to_owned(), places: Places::of(text), version: [0; 3], search };
        source.version = Self::parse_version(source.location(root), root)?;
        Ok(source)
    }

    /// The place of a byte.
    pub(super) fn at(&self, byte: usize) -> Location {
        let (line, column) = self.places.of_byte(byte);
        Location { file: self.path.clone(), line: Some(line), column: Some(column) }
    }

    /// The error of a file that an element names, with its place.
    pub(super) fn named(&self, element: Element<'_, '_>, mut error: SceneError) -> SceneError {
        if error.location.line.is_none() {
            error.message = format!("{} (named at {})", error.message, self.location(element));
        }
        error
    }

    /// The place of an element.
    pub(super) fn location(&self, element: Element<'_, '_>) -> Location {
        self.at(element.range().start)
    }

    /// An error at an element.
    pub(super) fn error(&self, element: Element<'_, '_>, message: impl Into<String>) -> SceneError {
        SceneError::scene(self.location(element), message)
    }

    /// The error for an element without a necessary attribute.
    pub(super) fn missing_attribute(&self, element: Element<'_, '_>, name: &str) -> SceneError {
        let tag = element.tag_name().name();
        self.error(element, format!("<{tag}> needs the attribute “{name}”"))
    }

    /// The error for an element that scene files do not have.
    pub(super) fn unknown_element(&self, element: Element<'_, '_>) -> SceneError {
        let tag = element.tag_name().name();
        let known = Kind::ALL.iter().map(|(name, _)| *name);
        let known = known.chain(OTHER_ELEMENTS).chain(property::ELEMENTS);
        let error = self.error(element, format!("unknown element <{tag}>"));
        match nearest(tag, known) {
            Some(name) => error.help(format!("did you mean <{name}>?")),
            None => error,
        }
    }

    /// Refuses attributes that are not among those named.
    pub(super) fn check_attributes(
        &self,
        element: Element<'_, '_>,
        allowed: &[&str],
    ) -> Result<(), SceneError> {
        for attribute in element.attributes() {
            if !allowed.contains(&attribute.name()) {
                let tag = element.tag_name().name();
                let message = format!("<{tag}> has no attribute “{}”", attribute.name());
                return Err(SceneError::scene(self.at(attribute.range().start), message)
                    .help(format!("it has {}", allowed.join(", "))));
            }
        }
        Ok(())
    }

    /// Refuses elements inside an element that holds none.
    pub(super) fn check_empty(&self, element: Element<'_, '_>) -> Result<(), SceneError> {
        match element.children().find(Element::is_element) {
            None => Ok(()),
            Some(child) => {
                let (inner, outer) = (child.tag_name().name(), element.tag_name().name());
                Err(self.error(child, format!("<{inner}> cannot stand inside <{outer}>")))
            }
        }
    }
}
