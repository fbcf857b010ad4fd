//! Volume files, as densities and as distance fields.

use crate::common::case::{Case, LIGHT, ball};

/// A file of `size` cells, `numbers` being what follows the header of sizes, encoding and channels.
fn volume(size: [i32; 3], channels: i32, numbers: &[f32]) -> Vec<u8> {
    let mut bytes = b"VOL\x03".to_vec();
    let integers = [1, size[0], size[1], size[2], channels];
    bytes.extend(integers.iter().flat_map(|number| number.to_le_bytes()));
    let corners = [0.0_f32, 0.0, 0.0, 1.0, 1.0, 1.0];
    bytes.extend(corners.iter().chain(numbers).flat_map(|number| number.to_le_bytes()));
    bytes
}

pub(super) fn cases() -> Vec<Case> {
    let cloud = ball(
        r#"<medium type="heterogeneous" name="interior">
            <volume name="sigma_t" type="gridvolume"><string name="filename" value="a.vol"/></volume>
        </medium><bsdf type="null"/>"#,
    );
    let cloud = format!("<integrator type=\"volpath\"/>{cloud}");
    let field = format!(
        "{LIGHT}<shape type=\"sdfgrid\"><string name=\"filename\" value=\"a.vol\"/></shape>"
    );
    let density = |what, exit, says, bytes: Vec<u8>| {
        Case::scene(what, exit, says, &cloud).file("a.vol", bytes)
    };
    let distances = |what, exit, says, bytes: Vec<u8>| {
        Case::scene(what, exit, says, &field).file("a.vol", bytes)
    };
    let with = |value: f32| [[0.5; 7].as_slice(), &[value]].concat();
    let cube = |size: i32, channels: i32, value: f32| volume([size; 3], channels, &with(value));
    let by_its_box = cloud.replace(
        "value=\"a.vol\"/>",
        "value=\"a.vol\"/><boolean name=\"use_grid_bbox\" value=\"true\"/>",
    );
    // A box whose six numbers are made of one byte.
    let boxed = |what, byte: u8| {
        let mut bytes = cube(2, 1, 0.5);
        bytes[24..48].fill(byte);
        Case::scene(what, 3, &["the box of a.vol"], &by_its_box).file("a.vol", bytes)
    };
    let mut coded = cube(2, 1, 0.5);
    coded[4] = 2;
    vec![
        Case::scene("no file", 4, &["a.vol"], &cloud),
        density("empty file", 3, &["a.vol", "VOL"], Vec::new()),
        density("another format", 3, &["a.vol", "VOL"], b"v 0 0 0\n".to_vec()),
        density("another version", 3, &["a.vol", "version"], b"VOL\x02 and so on".repeat(8)),
        density("another encoding", 3, &["a.vol", "encoding 2"], coded),
        density("cut off", 3, &["a.vol", "do not fit"], cube(3, 1, 0.5)),
        density("cut off in its header", 3, &["a.vol", "header"], b"VOL\x03\x01\0\0\0".to_vec()),
        density("more cells than memory", 3, &["a.vol", "do not fit"], cube(i32::MAX, 1, 0.5)),
        density(
            "2¹² cells along each axis and 2²⁸ channels",
            3,
            &["a.vol", "do not fit"],
            volume([1 << 12; 3], 1 << 28, &[]),
        ),
        density("negative size", 3, &["a.vol"], cube(-2, 1, 0.5)),
        density("no cells", 3, &["a.vol", "0 × 2 × 2"], volume([0, 2, 2], 1, &[])),
        density("two channels", 3, &["a.vol", "channels"], cube(2, 2, 0.5)),
        density("no channels", 3, &["a.vol", "channels"], cube(2, 0, 0.5)),
        density("NaN", 3, &["a.vol", "cell (1, 1, 1)"], cube(2, 1, f32::NAN)),
        density("infinite", 3, &["a.vol", "cell (1, 1, 1)"], cube(2, 1, f32::INFINITY)),
        density("negative density", 3, &["a.vol", "cell (1, 1, 1)"], cube(2, 1, -1.0)),
        density("thicker than can be sampled", 3, &["sigma_t", "thick"], cube(2, 1, 1e30)),
        density("all zero", 0, &[], volume([2; 3], 1, &[0.0; 8])),
        density("a good one", 0, &[], cube(2, 1, 0.5)),
        boxed("box without size", 0),
        boxed("box of NaN", 0xff),
        distances(
            "distances of three channels",
            3,
            &["a.vol", "1 channel"],
            volume([2; 3], 3, &[0.5; 24]),
        ),
        distances(
            "distances along a line",
            3,
            &["a.vol", "2 × 1 × 1"],
            volume([2, 1, 1], 1, &[0.5; 2]),
        ),
        distances(
            "2³¹ distances",
            3,
            &["a.vol", "do not fit"],
            volume([1 << 11, 1 << 10, 1 << 10], 1, &[]),
        ),
        distances("distance of NaN", 3, &["sample (1, 1, 1)"], cube(2, 1, f32::NAN)),
        distances("distance of 10³⁸", 0, &[], cube(2, 1, -1e38)),
        distances("distances of zero", 0, &[], volume([2; 3], 1, &[0.0; 8])),
        Case::scene(
            "light that is a distance field",
            3,
            &["a light needs an area"],
            &field.replace("</shape>", "<emitter type=\"area\"/></shape>"),
        )
        .file("a.vol", cube(2, 1, -0.5)),
    ]
}
