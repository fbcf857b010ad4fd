//! Meshes and textures that are wrong, or only look wrong: one message with its place, the exit code
//! that the documentation promises, and nothing left behind.

mod common;

use std::io::Cursor;

use common::case::{Case, ball, check, material};
use common::scene;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

#[test]
fn meshes_that_are_wrong_are_refused_with_their_line() {
    let faces = |face: &str| format!("{TRIANGLE}f {face}\n");
    let ply = |positions: &str, face: &str| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
             property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
             {positions}\n{face}\n"
        )
    };
    let positions = "0 0 0\n1 0 0\n0 1 0";
    let mut truncated =
        ply("", "").replace("ascii", "binary_little_endian").trim_end().as_bytes().to_vec();
    truncated.push(b'\n');
    truncated.extend([0; 20]);
    check([
        Case::obj("index beyond the last vertex", 3, &["mesh.obj:4", "4"], &faces("1 2 4")),
        Case::obj("index 0", 3, &["mesh.obj:4", "0"], &faces("0 1 2")),
        Case::obj("index before the first vertex", 3, &["mesh.obj:4", "-4"], &faces("-1 -2 -4")),
        // 3 · 2⁶¹ + 1: times 3 this is 3 in 64 bits.
        Case::obj(
            "index that overflows when multiplied",
            3,
            &["mesh.obj:4", "6148914691236517206"],
            &faces("1//6148914691236517206 2//1 3//1"),
        ),
        Case::obj(
            "index of 2⁶⁴ + 1",
            3,
            &["mesh.obj:4", "18446744073709551617"],
            &faces("1 2 18446744073709551617"),
        ),
        Case::obj("index that is no number", 3, &["mesh.obj:4", "'x'"], &faces("1 2 x")),
        Case::obj("NaN vertex", 3, &["mesh.obj:2", "nan"], "v 0 0 0\nv nan 0 0\n"),
        Case::obj("infinite vertex", 3, &["mesh.obj:1", "1e99"], "v 0 1e99 0\n"),
        Case::obj("short vertex", 3, &["mesh.obj:1"], "v 0 0\n"),
        Case::obj("no triangles", 0, &["mesh.obj"], TRIANGLE),
        Case::ply("not a PLY file", 3, &["mesh.ply:1"], "v 0 0 0\n"),
        Case::ply("index out of range", 3, &["mesh.ply:13", "'3'"], ply(positions, "3 0 1 3")),
        Case::ply(
            "NaN vertex",
            3,
            &["mesh.ply:11", "nan"],
            ply("0 0 0\n0 nan 0\n0 1 0", "3 0 1 2"),
        ),
        Case::ply("missing face", 3, &["mesh.ply:", "ends"], ply(positions, "")),
        Case::ply(
            "binary data cut off",
            3,
            &["mesh.ply:3", "3 vertex records do not fit"],
            truncated,
        ),
        Case::ply("unknown format", 3, &["mesh.ply:2"], "ply\nformat text 1.0\nend_header\n"),
        Case::scene(
            "missing mesh",
            4,
            &["mesh.obj", "scene.xml:3:1"],
            "<shape type=\"obj\"><string name=\"filename\" value=\"mesh.obj\"/></shape>",
        ),
    ]);
}

#[test]
fn meshes_that_only_look_wrong_are_rendered_without_a_warning() {
    let mtl = |text: &str| {
        let obj = format!("mtllib mesh.mtl\nusemtl a\n{TRIANGLE}f 1 2 3\n");
        Case::obj("material", 0, &[], &obj).file("mesh.mtl", text)
    };
    check([
        mtl("newmtl a\nKd 0.5\n"),
        mtl("\u{feff}newmtl a\nKd 0.5 0.5 0.5\n"),
        Case::obj("byte-order mark", 0, &[], &format!("\u{feff}{TRIANGLE}f 1 2 3\n")),
        Case::obj("continued line", 0, &[], &format!("{TRIANGLE}f 1 \\\n2 3\n")),
        Case::obj(
            "carriage returns",
            0,
            &[],
            &format!("{TRIANGLE}f 1 2 3\n").replace('\n', "\r\n"),
        ),
        Case::obj("negative indices", 0, &[], &format!("{TRIANGLE}f -3 -2 -1\n")),
        Case::new("byte-order mark", 0, &[])
            .file("scene.xml", format!("\u{feff}{}", scene(&ball("")))),
    ]);
}

/// One sound picture in a format.
fn png() -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image::RgbImage::from_fn(64, 64, |x, y| image::Rgb([x as u8, y as u8, 7]))
        .write_to(&mut bytes, image::ImageFormat::Png)
        .expect("encoded");
    bytes.into_inner()
}

fn exr() -> Vec<u8> {
    use exr::prelude::{SpecificChannels, WritableImage};
    let mut bytes = Cursor::new(Vec::new());
    let channels =
        SpecificChannels::rgb(|p: exr::math::Vec2<usize>| (p.0 as f32, p.1 as f32, 1.0_f32));
    let image = exr::image::Image::from_channels((64_usize, 64_usize), channels);
    image.write().to_buffered(&mut bytes).expect("encoded");
    bytes.into_inner()
}

/// A ball with a picture on it; the file's name is on line 5.
fn textured(what: &'static str, exit: i32, says: &'static [&'static str], name: &str) -> Case {
    let bsdf = format!(
        "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\">\
         <string name=\"filename\" value=\"{name}\"/></texture></bsdf>"
    );
    material(what, exit, says, &bsdf)
}

#[test]
fn textures_that_cannot_be_decoded_are_named_with_the_place_that_uses_them() {
    let half = |mut bytes: Vec<u8>| {
        bytes.truncate(bytes.len() / 2);
        bytes
    };
    let flipped = |mut bytes: Vec<u8>, at: usize| {
        bytes[at] ^= 0xff;
        bytes
    };
    let cases = [
        textured("missing texture", 4, &["a.png", "scene.xml:5:"], "a.png"),
        textured("PNG cut off", 3, &["a.png", "scene.xml:5:"], "a.png").file("a.png", half(png())),
        textured("PNG of text", 3, &["a.png", "scene.xml:5:"], "a.png")
            .file("a.png", "not a picture"),
        textured("empty PNG", 3, &["a.png", "scene.xml:5:"], "a.png").file("a.png", ""),
        // The length of the first chunk.
        textured("PNG with a wrong header", 3, &["a.png", "scene.xml:5:"], "a.png")
            .file("a.png", flipped(png(), 8)),
        textured("EXR cut off", 3, &["a.exr", "scene.xml:5:"], "a.exr").file("a.exr", half(exr())),
        textured("EXR of text", 3, &["a.exr", "scene.xml:5:"], "a.exr")
            .file("a.exr", "not a picture"),
        // The version number.
        textured("EXR with a wrong header", 3, &["a.exr", "scene.xml:5:"], "a.exr")
            .file("a.exr", flipped(exr(), 4)),
    ];
    check(cases);
    // The pictures from which the wrong ones are made are right.
    check([
        textured("sound PNG", 0, &[], "a.png").file("a.png", png()),
        textured("sound EXR", 0, &[], "a.exr").file("a.exr", exr()),
    ]);
}

#[test]
fn volumes_that_are_wrong_are_refused_with_their_file() {
    let cloud = ball(
        r#"<medium type="heterogeneous" name="interior">
            <volume name="sigma_t" type="gridvolume"><string name="filename" value="a.vol"/></volume>
        </medium><bsdf type="null"/>"#,
    );
    let cloud = format!("<integrator type=\"volpath\"/>{cloud}");
    // A header of `size` cells along each axis, and eight values.
    let volume = |size: i32, channels: i32, value: f32| {
        let mut bytes = b"VOL\x03".to_vec();
        let integers = [1, size, size, size, channels];
        bytes.extend(integers.iter().flat_map(|number| number.to_le_bytes()));
        let corners = [0.0_f32, 0.0, 0.0, 1.0, 1.0, 1.0];
        let numbers = corners.into_iter().chain([0.5; 7]).chain([value]);
        bytes.extend(numbers.flat_map(f32::to_le_bytes));
        bytes
    };
    let case = |what, says, bytes: Vec<u8>| Case::scene(what, 3, says, &cloud).file("a.vol", bytes);
    check([
        Case::scene("no file", 4, &["a.vol"], &cloud),
        case("empty file", &["a.vol", "VOL"], Vec::new()),
        case("another format", &["a.vol", "VOL"], b"v 0 0 0\n".to_vec()),
        case("another version", &["a.vol", "version"], b"VOL\x02 and so on".repeat(8)),
        case("cut off", &["a.vol"], volume(3, 1, 0.5)),
        case("more cells than memory", &["a.vol"], volume(i32::MAX, 1, 0.5)),
        case("negative size", &["a.vol"], volume(-2, 1, 0.5)),
        case("two channels", &["a.vol", "channels"], volume(2, 2, 0.5)),
        case("NaN", &["a.vol"], volume(2, 1, f32::NAN)),
        case("negative density", &["a.vol"], volume(2, 1, -1.0)),
        case("thicker than can be sampled", &["sigma_t", "thick"], volume(2, 1, 1e30)),
        Case::scene("a good one", 0, &[], &cloud).file("a.vol", volume(2, 1, 0.5)),
    ]);
}
