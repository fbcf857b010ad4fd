//! Distance fields and curves.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::element::Element;
use super::exporter::Exporter;
use super::values::{string, to_world};
use super::volumes;
use crate::geometry::{CurveBasis, Curves, SdfGrid, SdfNormals};

/// A distance field, and whether it is turned inside out.
pub(super) fn sdf(exporter: &mut Exporter<'_>, name: &str, grid: &SdfGrid) -> (Element, bool) {
    let samples = grid.samples();
    let mut bytes = volumes::header(samples.size(), 1);
    bytes.extend(samples.values().iter().flat_map(|value| value.to_le_bytes()));
    let filename = exporter.file(name, "vol", bytes);
    let normals = match grid.normals() {
        SdfNormals::Smooth => "smooth",
        SdfNormals::Analytic => "analytic",
    };
    let (place, is_flipped) = grid.placement();
    let element = Element::plugin("shape", "sdfgrid")
        .with(filename)
        .with(string("normals", normals))
        .with_all(to_world(place));
    (element, is_flipped)
}

/// Curves, and whether they are turned inside out.
pub(super) fn curves(exporter: &mut Exporter<'_>, name: &str, curves: &Curves) -> (Element, bool) {
    let plugin = match curves.basis() {
        CurveBasis::Linear => "linearcurve",
        CurveBasis::BSpline => "bsplinecurve",
    };
    let filename = exporter.file(name, "txt", text(curves));
    (Element::plugin("shape", plugin).with(filename), curves.is_flipped())
}

/// A line for each control point, an empty one between curves.
fn text(curves: &Curves) -> Vec<u8> {
    let order = curves.basis().degree_plus_one();
    let mut text = String::new();
    // The control points that are written already.
    let mut written = 0;
    for &first in curves.segments() {
        if first >= written && written > 0 {
            text.push('\n');
        }
        for point in &curves.points()[first.max(written) as usize..(first + order) as usize] {
            let [x, y, z] = point.position.to_array();
            // The shortest digits that read back as they are.
            text += &format!("{x:?} {y:?} {z:?} {:?}\n", point.radius);
        }
        written = first + order;
    }
    text.into_bytes()
}
