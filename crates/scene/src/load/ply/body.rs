//! The numbers of a PLY file.

use alloc::format;
use alloc::string::String;
use std::path::Path;

use crate::error::{Location, SceneError};

use super::super::lines::quote;
use super::header::{Element, Kind, Order, Scalar};

/// The stream of numbers after the header. All of PLY's types are exact in `f64`.
pub(super) trait Body {
    /// The next number; `None` where the file ends or has something else, which
    /// [`flaw`](Body::flaw) then explains.
    fn value(&mut self, kind: Scalar) -> Option<f64>;

    /// How many records of this element the rest of the file can hold at most.
    fn most_records(&self, element: &Element) -> usize;

    /// Why there was no number.
    fn flaw(&self, element: &Element, index: usize) -> SceneError;

    /// That the last number read is not what it should be.
    fn wrong(&self, element: &Element, index: usize, what: &str) -> SceneError;

    /// What follows, and its order, where numbers have fixed sizes.
    fn binary(&self) -> Option<(&[u8], Order)>;

    /// Passes over bytes that were read from [`binary`](Body::binary).
    fn advance(&mut self, bytes: usize);
}

/// Numbers as text. Line ends count as any other space.
pub(super) struct Ascii<'a> {
    rest: &'a [u8],
    line: u32,
    last: &'a [u8],
    path: &'a Path,
}

impl<'a> Ascii<'a> {
    pub(super) fn new(rest: &'a [u8], line: u32, path: &'a Path) -> Self {
        Self { rest, line, last: b"", path }
    }

    fn error(&self, message: String) -> SceneError {
        SceneError::scene(Location::line(self.path, self.line), message)
    }
}

impl Body for Ascii<'_> {
    fn value(&mut self, _: Scalar) -> Option<f64> {
        let start = self.rest.iter().position(|b| !b.is_ascii_whitespace());
        let (space, word) = self.rest.split_at(start.unwrap_or(self.rest.len()));
        for _ in space.iter().filter(|&&b| b == b'\n') {
            self.line = self.line.saturating_add(1);
        }
        let end = word.iter().position(u8::is_ascii_whitespace).unwrap_or(word.len());
        (self.last, self.rest) = word.split_at(end);
        core::str::from_utf8(self.last).ok()?.parse().ok()
    }

    fn most_records(&self, element: &Element) -> usize {
        // A number takes a digit and, unless it is the last, a space.
        match element.properties.len() {
            0 => usize::MAX,
            numbers => self.rest.len().div_ceil(2) / numbers,
        }
    }

    fn flaw(&self, element: &Element, index: usize) -> SceneError {
        let Element { name, count, .. } = element;
        self.error(match self.last {
            [] => format!("the file ends in {name} {index} of {count}"),
            word => format!("{name} {index}: {} is not a number", quote(word)),
        })
    }

    fn wrong(&self, element: &Element, index: usize, what: &str) -> SceneError {
        self.error(format!("{} {index}: {} {what}", element.name, quote(self.last)))
    }

    fn binary(&self) -> Option<(&[u8], Order)> {
        None
    }

    fn advance(&mut self, bytes: usize) {
        self.rest = self.rest.get(bytes..).unwrap_or_default();
    }
}

/// Numbers in binary.
pub(super) struct Binary<'a> {
    file: &'a [u8],
    at: usize,
    order: Order,
    last: (usize, f64),
    path: &'a Path,
}

impl<'a> Binary<'a> {
    /// The numbers of a whole file from byte `at` on.
    pub(super) fn new(file: &'a [u8], at: usize, order: Order, path: &'a Path) -> Self {
        Self { file, at, order, last: (at, 0.0), path }
    }

    /// All that follows what was read.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.file.get(self.at..).unwrap_or_default()
    }

    fn error(&self, message: String) -> SceneError {
        SceneError::scene(Location::file(self.path), message)
    }
}

impl Body for Binary<'_> {
    fn value(&mut self, kind: Scalar) -> Option<f64> {
        let at = self.at;
        let value = self.order.number(kind, self.rest())?;
        self.at += kind.size();
        self.last = (at, value);
        Some(value)
    }

    fn most_records(&self, element: &Element) -> usize {
        let least = |kind| match kind {
            Kind::Scalar(scalar) => scalar.size(),
            Kind::List { length, .. } => length.size(),
        };
        match element.properties.iter().map(|p| least(p.kind)).sum() {
            0 => usize::MAX,
            record => (self.file.len() - self.at) / record,
        }
    }

    fn flaw(&self, element: &Element, index: usize) -> SceneError {
        let Element { name, count, .. } = element;
        self.error(format!(
            "the file ends at byte {} in {name} {index} of {count}",
            self.file.len()
        ))
    }

    fn wrong(&self, element: &Element, index: usize, what: &str) -> SceneError {
        let (at, value) = self.last;
        self.error(format!("{} {index}: {value} at byte {at} {what}", element.name))
    }

    fn binary(&self) -> Option<(&[u8], Order)> {
        Some((self.rest(), self.order))
    }

    fn advance(&mut self, bytes: usize) {
        self.at += bytes;
    }
}
