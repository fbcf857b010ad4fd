//! Numbers, colours and transforms as text that reads back to the same bits.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;

use etendue_math::glam::{DAffine3, Vec3};

use super::element::Element;
use crate::Color;
use crate::color::Curve;

/// The shortest decimal that is read as this number, of `f32` or `f64`.
pub(super) fn number(x: impl fmt::Debug) -> String {
    let text = format!("{x:?}");
    text.strip_suffix(".0").map_or(text.clone(), ToString::to_string)
}

/// Text that stands for itself: `$` begins the name of a parameter.
pub(super) fn text(text: &str) -> String {
    text.replace('$', "\\$")
}

pub(super) fn list<T: fmt::Debug>(numbers: impl IntoIterator<Item = T>) -> String {
    numbers.into_iter().map(number).collect::<Vec<_>>().join(" ")
}

pub(super) fn float(name: &str, x: impl fmt::Debug) -> Element {
    Element::value("float", name, number(x))
}

pub(super) fn integer(name: &str, x: impl fmt::Display) -> Element {
    Element::value("integer", name, format!("{x}"))
}

pub(super) fn boolean(name: &str, x: bool) -> Element {
    Element::value("boolean", name, x.to_string())
}

pub(super) fn string(name: &str, x: &str) -> Element {
    Element::value("string", name, text(x))
}

pub(super) fn rgb(name: &str, color: Color) -> Element {
    Element::value("rgb", name, list(color.to_array()))
}

pub(super) fn vector(tag: &'static str, name: &str, v: Vec3) -> Element {
    let mut element = Element::new(tag).attribute("name", name);
    for (axis, x) in ["x", "y", "z"].into_iter().zip(v.to_array()) {
        element = element.attribute(axis, number(x));
    }
    element
}

/// A quantity by wavelength.
pub(super) fn spectrum(name: &str, curve: &Curve) -> Element {
    let samples = curve.samples().iter();
    let samples: Vec<_> = samples.map(|&(nm, x)| format!("{}:{}", number(nm), number(x))).collect();
    Element::value("spectrum", name, samples.join(", "))
}

/// `to_world`; nothing for the map that changes nothing.
pub(super) fn to_world(affine: &DAffine3) -> Option<Element> {
    if *affine == DAffine3::IDENTITY {
        return None;
    }
    let (m, t) = (&affine.matrix3, affine.translation);
    let rows = [0, 1, 2].map(|row| [m.x_axis[row], m.y_axis[row], m.z_axis[row], t[row]]);
    Some(transform("to_world", rows))
}

/// A map by its first three rows.
pub(super) fn transform<T: fmt::Debug + Copy>(name: &str, rows: [[T; 4]; 3]) -> Element {
    let value = list(rows.into_iter().flatten()) + " 0 0 0 1";
    let matrix = Element::new("matrix").attribute("value", value);
    Element::new("transform").attribute("name", name).with(matrix)
}
