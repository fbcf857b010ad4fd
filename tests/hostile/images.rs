//! Images as textures and environments.

use std::io::Cursor;

use exr::prelude::{SpecificChannels, WritableImage as _};

use super::png::{chunk, file, zeros};
use crate::common::case::{Case, ball};

/// A ball with a picture on it; the file's name is on line 5.
fn textured(name: &str) -> String {
    ball(&format!(
        "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" value=\"{name}\"/></texture></bsdf>"
    ))
}

fn with_content(
    name: &'static str,
    what: &'static str,
    exit: i32,
    says: &'static [&'static str],
    content: impl Into<Vec<u8>>,
) -> Case {
    Case::scene(what, exit, says, &textured(name)).file(name, content)
}

fn encoded(picture: &image::DynamicImage, format: image::ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).expect("memory");
    bytes.into_inner()
}

fn exr() -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let channels =
        SpecificChannels::rgb(|p: exr::math::Vec2<usize>| (p.0 as f32, p.1 as f32, 1.0_f32));
    let image = exr::image::Image::from_channels((64_usize, 64_usize), channels);
    image.write().to_buffered(&mut bytes).expect("memory");
    bytes.into_inner()
}

/// The file with bytes written over what follows the first `after`.
fn patched(mut bytes: Vec<u8>, after: &[u8], skip: usize, with: &[u8]) -> Vec<u8> {
    let at = bytes.windows(after.len()).position(|window| window == after).expect("in the file");
    let start = at + after.len() + skip;
    bytes[start..start + with.len()].copy_from_slice(with);
    bytes
}

fn half(mut bytes: Vec<u8>) -> Vec<u8> {
    bytes.truncate(bytes.len() / 2);
    bytes
}

fn flipped(mut bytes: Vec<u8>, at: usize) -> Vec<u8> {
    bytes[at] ^= 0xff;
    bytes
}

pub(super) fn cases() -> Vec<Case> {
    let picture = image::RgbImage::from_fn(64, 64, |x, y| image::Rgb([x as u8, y as u8, 7]));
    let picture = image::DynamicImage::from(picture);
    let encoded = |format| encoded(&picture, format);
    let png = || encoded(image::ImageFormat::Png);
    let named: &[&str] = &["a.png", "scene.xml:5:"];
    let of_png =
        |what, exit, says, content: Vec<u8>| with_content("a.png", what, exit, says, content);
    let mut cases = vec![
        Case::scene("missing texture", 4, named, &textured("a.png")),
        of_png("PNG cut off", 3, named, half(png())),
        of_png("PNG of text", 3, named, b"not a picture".into()),
        of_png("empty PNG", 3, named, Vec::new()),
        of_png("PNG with a wrong length", 3, named, flipped(png(), 8)),
        of_png("PNG with a wrong checksum", 3, named, flipped(png(), 29)),
        of_png("PNG without an end", 3, &["a.png", "unexpected end"], {
            let mut bytes = png();
            bytes.truncate(bytes.len() - 12);
            bytes
        }),
        of_png("PNG without rows", 3, named, file([4, 4], [8, 0, 0], &[])),
        of_png(
            "PNG with half its rows",
            3,
            named,
            file([4, 4], [8, 0, 0], &[chunk(b"IDAT", &zeros(10))]),
        ),
        of_png("PNG 0 wide", 3, named, file([0, 4], [8, 0, 0], &[chunk(b"IDAT", &zeros(4))])),
        of_png(
            "PNG 2³² − 1 wide",
            5,
            &["a.png", "limit exceeded"],
            file([u32::MAX, 1], [8, 0, 0], &[chunk(b"IDAT", &zeros(4))]),
        ),
        of_png(
            "PNG 2³¹ − 1 wide",
            5,
            &["a.png", "limit exceeded"],
            file([i32::MAX as u32, 1], [8, 0, 0], &[chunk(b"IDAT", &zeros(4))]),
        ),
        of_png(
            "PNG of 65535² pixels",
            5,
            &["65535 × 65535 pixels are more than"],
            file([65535, 65535], [8, 2, 0], &[chunk(b"IDAT", &zeros(4))]),
        ),
        of_png(
            "PNG of 2²⁸ pixels in 30 kB",
            5,
            &["allowed for a file of this size"],
            file([16384, 16384], [1, 0, 0], &[chunk(b"IDAT", &zeros(16384 * 2049))]),
        ),
        of_png(
            "PNG of 2²⁵ pixels in 5 kB",
            0,
            &[],
            file([8192, 4096], [1, 0, 0], &[chunk(b"IDAT", &zeros(4096 * 1025))]),
        ),
        of_png(
            "PNG of 2¹⁶ pixels and rows of 10⁸ bytes",
            0,
            &[],
            file([256, 256], [8, 0, 0], &[chunk(b"IDAT", &zeros(100_000_000))]),
        ),
        of_png(
            "PNG with a colour profile of 10⁸ bytes",
            0,
            &[],
            file(
                [4, 4],
                [8, 0, 0],
                &[
                    chunk(b"iCCP", &[b"p\0\0".as_slice(), &zeros(100_000_000)].concat()),
                    chunk(b"IDAT", &zeros(20)),
                ],
            ),
        ),
        of_png(
            "PNG with a text of 10⁸ bytes",
            0,
            &[],
            file(
                [4, 4],
                [8, 0, 0],
                &[
                    chunk(b"zTXt", &[b"p\0\0".as_slice(), &zeros(100_000_000)].concat()),
                    chunk(b"IDAT", &zeros(20)),
                ],
            ),
        ),
        of_png(
            "PNG of a palette that is not there",
            3,
            named,
            file([4, 4], [8, 3, 0], &[chunk(b"IDAT", &zeros(20))]),
        ),
        of_png(
            "PNG of an unknown colour type",
            3,
            named,
            file([4, 4], [8, 5, 0], &[chunk(b"IDAT", &zeros(20))]),
        ),
        of_png("PNG of 3 bits", 3, named, file([4, 4], [3, 0, 0], &[chunk(b"IDAT", &zeros(20))])),
        of_png(
            "PNG with an unknown filter",
            3,
            named,
            file(
                [4, 4],
                [8, 0, 0],
                &[chunk(b"IDAT", &[0x78, 1, 1, 5, 0, 0xfa, 0xff, 9, 9, 9, 9, 9])],
            ),
        ),
        of_png(
            "interlaced PNG cut off",
            3,
            named,
            file([64, 64], [8, 0, 1], &[chunk(b"IDAT", &zeros(100))]),
        ),
        of_png(
            "PNG with two headers",
            3,
            named,
            file(
                [4, 4],
                [8, 0, 0],
                &[
                    chunk(b"IHDR", &[0, 0, 0, 4, 0, 0, 0, 4, 8, 0, 0, 0, 0]),
                    chunk(b"IDAT", &zeros(20)),
                ],
            ),
        ),
        with_content("a.png", "JPEG named PNG", 0, &[], encoded(image::ImageFormat::Jpeg)),
        with_content("a.png", "GIF", 3, named, b"GIF89a\x01\0\x01\0\0\0\0;".as_slice()),
        with_content(
            "a.png",
            "SVG with an entity",
            3,
            &["not an image of a known format"],
            "<!DOCTYPE svg [<!ENTITY x SYSTEM \"file:///etc/passwd\">]><svg>&x;</svg>",
        ),
        with_content(
            "a.jpg",
            "JPEG cut off",
            3,
            &["a.jpg", "scene.xml:5:"],
            half(encoded(image::ImageFormat::Jpeg)),
        ),
        with_content(
            "a.jpg",
            "JPEG of its first bytes",
            3,
            &["a.jpg"],
            b"\xff\xd8\xff\xe0\0\x10JFIF\0".as_slice(),
        ),
        with_content(
            "a.jpg",
            "JPEG of 65535² pixels",
            5,
            &["65535 × 65535 pixels are more than"],
            patched(encoded(image::ImageFormat::Jpeg), b"\xff\xc0", 3, &[0xff; 4]),
        ),
        with_content(
            "a.jpg",
            "JPEG of 16000² pixels in a kilobyte",
            5,
            &["allowed for a file of this size"],
            patched(encoded(image::ImageFormat::Jpeg), b"\xff\xc0", 3, &[0x3e, 0x80, 0x3e, 0x80]),
        ),
        with_content(
            "a.jpg",
            "JPEG 0 high",
            3,
            &["a.jpg"],
            patched(encoded(image::ImageFormat::Jpeg), b"\xff\xc0", 3, &[0, 0]),
        ),
        with_content("a.bmp", "BMP cut off", 3, &["a.bmp"], half(encoded(image::ImageFormat::Bmp))),
        with_content(
            "a.bmp",
            "BMP 2³¹ − 1 wide",
            3,
            &["a.bmp", "too large"],
            patched(encoded(image::ImageFormat::Bmp), b"BM", 16, &i32::MAX.to_le_bytes()),
        ),
        with_content(
            "a.bmp",
            "BMP of negative width",
            3,
            &["a.bmp"],
            patched(encoded(image::ImageFormat::Bmp), b"BM", 16, &(-4_i32).to_le_bytes()),
        ),
        with_content(
            "a.bmp",
            "BMP of least height",
            3,
            &["a.bmp"],
            patched(encoded(image::ImageFormat::Bmp), b"BM", 20, &i32::MIN.to_le_bytes()),
        ),
        with_content(
            "a.bmp",
            "BMP whose pixels lie behind its end",
            3,
            &["a.bmp"],
            patched(encoded(image::ImageFormat::Bmp), b"BM", 8, &u32::MAX.to_le_bytes()),
        ),
        with_content("a.tga", "TGA cut off", 3, &["a.tga"], half(encoded(image::ImageFormat::Tga))),
        with_content(
            "a.tga",
            "TGA of 65535² pixels",
            5,
            &["a.tga", "65535 × 65535"],
            [0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 24, 0],
        ),
        with_content("a.tga", "TGA of zeros", 3, &["a.tga"], [0; 64]),
        with_content("a.hdr", "HDR cut off", 3, &["a.hdr"], half(encoded_hdr())),
        with_content(
            "a.hdr",
            "HDR 10⁹ wide",
            5,
            &["a.hdr"],
            "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1000000000\n",
        ),
        with_content(
            "a.hdr",
            "HDR of negative size",
            3,
            &["a.hdr"],
            "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y -4 +X -4\n",
        ),
        with_content(
            "a.hdr",
            "HDR with an endless header",
            3,
            &["a.hdr"],
            format!("#?RADIANCE\n{}", "A=1\n".repeat(1 << 18)),
        ),
        with_content(
            "a.pfm",
            "PFM 2³¹ wide",
            5,
            &["a.pfm", "2147483648 × 1"],
            "PF 2147483648 1 -1\n",
        ),
        with_content("a.pfm", "PFM cut off", 3, &["a.pfm", "expected 48"], "PF 2 2 -1\n1234"),
        with_content(
            "a.pfm",
            "PFM of NaN",
            3,
            &["a.pfm", "column 0, row 0 is not finite"],
            [b"Pf 1 1 -1\n".as_slice(), &f32::NAN.to_le_bytes()].concat(),
        ),
        with_content(
            "a.pfm",
            "PFM of infinities",
            3,
            &["a.pfm", "column 1, row 0 is not finite"],
            [b"Pf 2 1 -1\n\0\0\0\0".as_slice(), &f32::INFINITY.to_le_bytes()].concat(),
        ),
        with_content(
            "a.pfm",
            "PFM of negative colours",
            0,
            &[],
            [b"Pf 1 1 -1\n".as_slice(), &(-1.0_f32).to_le_bytes()].concat(),
        ),
    ];
    let of_exr =
        |what, exit, says, content: Vec<u8>| with_content("a.exr", what, exit, says, content);
    let window = |corners: [i32; 4]| {
        let corners = corners.map(i32::to_le_bytes);
        patched(exr(), b"dataWindow\0box2i\0", 4, corners.as_flattened())
    };
    let in_exr: &[&str] = &["a.exr", "scene.xml:5:"];
    cases.extend([
        of_exr("EXR cut off", 3, in_exr, half(exr())),
        of_exr("EXR of text", 3, in_exr, b"not a picture".into()),
        of_exr("EXR of another version", 3, in_exr, flipped(exr(), 4)),
        of_exr("EXR of its first bytes", 3, in_exr, exr()[..8].to_vec()),
        of_exr("EXR 2³¹ wide", 3, in_exr, window([0, 0, i32::MAX, 1])),
        of_exr(
            "EXR of 10⁵ × 10⁵ pixels",
            5,
            &["a.exr", "pixels are more than"],
            window([0, 0, 99_999, 99_999]),
        ),
        of_exr(
            "EXR of 2²⁷ pixels in a kilobyte",
            5,
            &["a.exr", "allowed for a file of this size"],
            window([0, 0, (1 << 14) - 1, (1 << 13) - 1]),
        ),
        of_exr("EXR that ends before it begins", 3, in_exr, window([10, 10, 0, 0])),
        of_exr("EXR of a window beyond all numbers", 3, in_exr, window([i32::MIN, 0, i32::MAX, 1])),
        of_exr(
            "EXR with an attribute of 2³¹ bytes",
            3,
            in_exr,
            patched(exr(), b"dataWindow\0box2i\0", 0, &i32::MAX.to_le_bytes()),
        ),
        of_exr(
            "EXR with an attribute of −1 bytes",
            3,
            in_exr,
            patched(exr(), b"channels\0chlist\0", 0, &(-1_i32).to_le_bytes()),
        ),
        of_exr(
            "EXR of an unknown compression",
            3,
            in_exr,
            patched(exr(), b"compression\0compression\0", 4, &[200]),
        ),
        of_exr(
            "EXR of an unknown order of lines",
            3,
            in_exr,
            patched(exr(), b"lineOrder\0lineOrder\0", 4, &[200]),
        ),
        of_png("sound PNG", 0, &[], png()),
        of_exr("sound EXR", 0, &[], exr()),
        Case::scene(
            "environment of one black pixel",
            0,
            &["no light can be seen"],
            "<emitter type=\"envmap\"><string name=\"filename\" value=\"a.pfm\"/></emitter>",
        )
        .file("a.pfm", b"Pf 1 1 -1\n\0\0\0\0".as_slice()),
        Case::scene(
            "environment of one pixel",
            0,
            &["there are no shapes"],
            "<emitter type=\"envmap\"><string name=\"filename\" value=\"a.pfm\"/></emitter>",
        )
        .file("a.pfm", [b"Pf 1 1 -1\n".as_slice(), &1.0_f32.to_le_bytes()].concat()),
        Case::scene(
            "environment of 3·10³⁸",
            3,
            &["light 0 emits more than 2¹⁰⁰ W"],
            "<emitter type=\"envmap\"><string name=\"filename\" value=\"a.pfm\"/></emitter>",
        )
        .file("a.pfm", [b"PF 2 1 -1\n".as_slice(), &3e38_f32.to_le_bytes().repeat(6)].concat()),
        Case::new("missing texture of a bare mesh", 0, &["a.png", "cannot read"])
            .file("mesh.obj", "mtllib mesh.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
            .file("mesh.mtl", "newmtl a\nmap_Kd a.png\n")
            .command(&["render", "mesh.obj", "-o", "out.pfm", "--quiet", "--spp=1", "--size=4x4"]),
        Case::new("reference that is no picture", 3, &["a.pfm"])
            .file("a.pfm", "PF 2 2 -1\n")
            .file("b.pfm", "PF 2 2 -1\n")
            .command(&["compare", "a.pfm", "b.pfm"]),
    ]);
    cases
}

fn encoded_hdr() -> Vec<u8> {
    let picture = image::DynamicImage::from(image::Rgb32FImage::new(64, 64));
    encoded(&picture, image::ImageFormat::Hdr)
}
