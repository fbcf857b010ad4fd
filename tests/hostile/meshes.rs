//! Meshes and curves: OBJ with its materials, PLY, Mitsuba's serialized meshes, control points.

use std::io::Write as _;

use flate2::Compression;
use flate2::write::ZlibEncoder;

use crate::common::case::{Case, Content, LIGHT, ball};
use crate::common::scene;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

fn faces(face: &str) -> String {
    format!("{TRIANGLE}f {face}\n")
}

pub(super) fn cases() -> Vec<Case> {
    [obj(), mtl(), ply(), serialized(), curves()].into_iter().flatten().collect()
}

fn obj() -> Vec<Case> {
    let polygon = format!("{TRIANGLE}f{}\n", " 1 2 3".repeat(100_000));
    let kinds: String = (0..100_000).map(|i| format!("keyword{i} 1\n")).collect();
    vec![
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
        Case::obj("index of −2⁶³", 3, &["mesh.obj:4", "-9223372036854775808"], &faces("1 2 -9223372036854775808")),
        Case::obj("index of 2³² + 1", 3, &["mesh.obj:4", "4294967297"], &faces("1 2 4294967297")),
        Case::obj("index that is no number", 3, &["mesh.obj:4", "'x'"], &faces("1 2 x")),
        Case::obj("four indices in one", 3, &["mesh.obj:4", "more than three indices"], &faces("1////1 2 3")),
        Case::obj("normal that is not there", 3, &["mesh.obj:4", "none is defined"], &faces("1//1 2//1 3//1")),
        Case::obj("face before its vertices", 3, &["mesh.obj:1"], &format!("f 1 2 3\n{TRIANGLE}")),
        Case::obj("NaN vertex", 3, &["mesh.obj:2", "nan"], "v 0 0 0\nv nan 0 0\n"),
        Case::obj("infinite vertex", 3, &["mesh.obj:1", "1e99"], "v 0 1e99 0\n"),
        Case::obj("NaN normal", 3, &["mesh.obj:1", "nan"], "vn 0 nan 0\n"),
        Case::obj("NaN texture coordinate", 3, &["mesh.obj:1", "nan"], "vt nan\n"),
        Case::obj("short vertex", 3, &["mesh.obj:1"], "v 0 0\n"),
        Case::obj("vertices at 10³⁰", 3, &["mesh.obj", "reaches beyond ±2⁴⁰"], "v 1e30 0 0\nv 0 1e30 0\nv 0 0 1e30\nf 1 2 3\n"),
        Case::obj("vertices at 3·10³⁸", 3, &["mesh.obj"], "v 3e38 0 0\nv -3e38 3e38 0\nv 0 0 -3e38\nf 1 2 3\n"),
        Case::obj("vertices at 10⁻⁴⁵", 3, &["mesh.obj"], "v 1e-45 0 0\nv 0 1e-45 0\nv 0 0 0\nf 1 2 3\n"),
        Case::obj("no triangles", 0, &["mesh.obj"], TRIANGLE),
        Case::obj("empty", 0, &["mesh.obj", "no faces"], ""),
        Case::obj("face of one vertex, repeated", 0, &[], &faces("1 1 1")),
        Case::obj("face of two vertices", 0, &["fewer than three vertices"], &faces("1 2")),
        Case::obj("polygon of 3·10⁵ corners", 0, &[], &polygon),
        Case::obj("10⁵ unknown statements", 0, &["mesh.obj:5", "'keyword0' is ignored"], &format!("{}{kinds}", faces("1 2 3"))),
        Case::obj("line of a megabyte", 3, &["mesh.obj:1", "…' is not a number"], &format!("v {}\n", "x".repeat(1 << 20))),
        Case::obj("line that goes on and on", 0, &["no faces"], &"v 0 0 0 \\\n".repeat(100_000)),
        Case::obj("NUL", 0, &["ignored"], &format!("{}\0\0\0\n", faces("1 2 3"))),
        Case::obj("keyword with escape codes", 0, &["ignored"], &format!("{}\u{1b}[2J 1\n", faces("1 2 3"))),
        Case::obj("name with escape codes", 0, &["\\u{1b}[2J"], "mtllib \u{1b}[2J\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        Case::new("names that are no UTF-8", 0, &["undefined material"])
            .file("mesh.obj", [b"o \xff\xfe\nusemtl \xff\n".as_slice(), faces("1 2 3").as_bytes()].concat())
            .command(&["render", "mesh.obj", "-o", "out.pfm", "--quiet", "--spp=1", "--size=4x4"]),
        Case::obj("negative indices", 0, &[], &faces("-3 -2 -1")),
        Case::obj("byte-order mark", 0, &[], &format!("\u{feff}{}", faces("1 2 3"))),
        Case::obj("continued line", 0, &[], &faces("1 \\\n2 3")),
        Case::obj("carriage returns", 0, &[], &faces("1 2 3").replace('\n', "\r\n")),
        Case::scene("missing mesh", 4, &["mesh.obj", "scene.xml:3:1"], "<shape type=\"obj\"><string name=\"filename\" value=\"mesh.obj\"/></shape>"),
        Case::scene("light without area", 3, &["scene.xml:3:1", "area"], "<shape type=\"obj\"><string name=\"filename\" value=\"line.obj\"/><emitter type=\"area\"/></shape>")
            .file("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
        Case::scene("light of a mesh without faces", 3, &["scene.xml:3:1", "area"], "<shape type=\"obj\"><string name=\"filename\" value=\"a.obj\"/><emitter type=\"area\"/></shape>")
            .file("a.obj", TRIANGLE),
        Case::scene("mesh that its transform moves out of range", 3, &["scene.xml:3:1"], "<shape type=\"obj\"><string name=\"filename\" value=\"a.obj\"/><transform name=\"to_world\"><scale value=\"1e20\"/></transform></shape>")
            .file("a.obj", "v 1e30 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n"),
    ]
}

fn mtl() -> Vec<Case> {
    let with = |what, exit, says, text: &str| {
        let obj = format!("mtllib mesh.mtl\nusemtl a\n{}", faces("1 2 3"));
        Case::obj(what, exit, says, &obj).file("mesh.mtl", text)
    };
    vec![
        with("colour of one number", 0, &[], "newmtl a\nKd 0.5\n"),
        with("byte-order mark of materials", 0, &[], "\u{feff}newmtl a\nKd 0.5 0.5 0.5\n"),
        with(
            "property before any material",
            3,
            &["mesh.mtl:1", "before the first 'newmtl'"],
            "Kd 1 1 1\n",
        ),
        with("colour of NaN", 3, &["mesh.mtl:2", "nan"], "newmtl a\nKd nan 0 0\n"),
        with("colour of −1", 0, &[], "newmtl a\nKd -1 -1 -1\n"),
        with("colour of 10³⁰", 0, &[], "newmtl a\nKd 1e30 1e30 1e30\n"),
        with(
            "emission of 10³⁸",
            3,
            &["mesh.obj", "light 0 emits more than 2¹⁰⁰ W"],
            "newmtl a\nKe 1e38 1e38 1e38\n",
        ),
        with(
            "index of refraction 0",
            0,
            &["mesh.obj", "eta is 0", "1.5 instead"],
            "newmtl a\nillum 4\nNi 0\n",
        ),
        with("roughness of −1", 0, &[], "newmtl a\nPr -1\nPm 7\n"),
        with("exponent of 10³⁰", 0, &[], "newmtl a\nKs 1\nNs 1e30\n"),
        with("exponent of −10³⁰", 0, &[], "newmtl a\nKs 1\nNs -1e30\n"),
        with(
            "texture scaled by 10³⁸",
            0,
            &["a.png"],
            "newmtl a\nmap_Kd -s 1e38 1e38 1e38 -o 1e38 a.png\n",
        ),
        with("map without a name", 3, &["mesh.mtl:2", "needs a file name"], "newmtl a\nmap_Kd\n"),
        with("materials that are a mesh", 3, &["mesh.mtl:1"], TRIANGLE),
        Case::obj(
            "mesh as its own materials",
            3,
            &["mesh.obj:1"],
            &format!("mtllib mesh.obj\n{}", faces("1 2 3")),
        ),
        Case::obj(
            "materials of a device",
            0,
            &["/dev/zero", "left out"],
            &format!("mtllib /dev/zero\n{}", faces("1 2 3")),
        ),
        Case::obj(
            "101 material libraries",
            5,
            &["mesh.obj:101", "more than 100"],
            &(0..101).map(|i| format!("mtllib {i}.mtl\n")).collect::<String>(),
        ),
    ]
}

/// A header of `vertices` of single precision and `triangles` of bytes and integers.
fn header(format: &str, vertices: &str, triangles: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\n\
         property float z\nelement face {triangles}\nproperty list uchar int vertex_indices\nend_header\n"
    )
}

fn ply() -> Vec<Case> {
    let ascii =
        |positions: &str, face: &str| format!("{}{positions}\n{face}\n", header("ascii", "3", "1"));
    let positions = "0 0 0\n1 0 0\n0 1 0";
    // One triangle in either order of bytes, with a coordinate and the last index of choice.
    let binary = |is_big: bool, x: f32, last: i32| {
        let format = if is_big { "binary_big_endian" } else { "binary_little_endian" };
        let mut bytes = header(format, "3", "1").into_bytes();
        let word = |bytes: [u8; 4]| {
            let mut word = bytes;
            if is_big {
                word.reverse();
            }
            word
        };
        for number in [x, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
            bytes.extend(word(number.to_le_bytes()));
        }
        bytes.push(3);
        for index in [0, 1, last] {
            bytes.extend(word(index.to_le_bytes()));
        }
        bytes
    };
    let little = |vertices: &str, triangles: &str, body: &[u8]| {
        [header("binary_little_endian", vertices, triangles).as_bytes(), body].concat()
    };
    let list = |length: &str, count: &[u8]| {
        let header = format!(
            "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list {length} int vertex_indices\nend_header\n"
        );
        [header.as_bytes(), count].concat()
    };
    vec![
        Case::ply("not a PLY file", 3, &["mesh.ply:1"], "v 0 0 0\n"),
        Case::ply("empty PLY", 3, &["mesh.ply"], ""),
        Case::ply("PLY of its first word", 3, &["mesh.ply"], "ply"),
        Case::ply(
            "header without an end",
            3,
            &["mesh.ply"],
            "ply\nformat ascii 1.0\nelement vertex 3\n",
        ),
        Case::ply(
            "header of a megabyte",
            3,
            &["mesh.ply"],
            format!("ply\nformat ascii 1.0\n{}", "comment x\n".repeat(100_000)),
        ),
        Case::ply(
            "line of a header of a megabyte",
            3,
            &["mesh.ply", "ends within the header"],
            format!("ply\nformat ascii 1.0\nelement {} 1\n", "x".repeat(1 << 20)),
        ),
        Case::ply("unknown format", 3, &["mesh.ply:2"], "ply\nformat text 1.0\nend_header\n"),
        Case::ply(
            "two formats",
            3,
            &["mesh.ply:3", "stated twice"],
            "ply\nformat ascii 1.0\nformat binary_little_endian 1.0\nend_header\n",
        ),
        Case::ply(
            "property of no element",
            3,
            &["mesh.ply:3"],
            "ply\nformat ascii 1.0\nproperty float x\nend_header\n",
        ),
        Case::ply(
            "property of an unknown type",
            3,
            &["mesh.ply:4", "quad"],
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n1\n",
        ),
        Case::ply(
            "property given twice",
            3,
            &["mesh.ply:5", "declared twice"],
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 1 1 1\n",
        ),
        Case::ply(
            "vertices without z",
            3,
            &["mesh.ply", "z"],
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n1 1\n",
        ),
        Case::ply(
            "positions that are lists",
            3,
            &["mesh.ply"],
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar float x\nproperty float y\nproperty float z\nend_header\n1 1 1 1\n",
        ),
        Case::ply(
            "indices that are fractions",
            3,
            &["mesh.ply"],
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar float vertex_indices\nend_header\n1 1 1\n3 0 0.5 0\n",
        ),
        Case::ply("index out of range", 3, &["mesh.ply:13", "'3'"], ascii(positions, "3 0 1 3")),
        Case::ply("index −1", 3, &["mesh.ply:13", "'-1'"], ascii(positions, "3 0 1 -1")),
        Case::ply(
            "NaN vertex of text",
            3,
            &["mesh.ply:11", "nan"],
            ascii("0 0 0\n0 nan 0\n0 1 0", "3 0 1 2"),
        ),
        Case::ply("missing face", 3, &["mesh.ply:", "ends"], ascii(positions, "")),
        Case::ply("list longer than its line", 3, &["mesh.ply"], ascii(positions, "200 0 1 2")),
        Case::ply("list of −1 numbers", 3, &["mesh.ply:13"], ascii(positions, "-1 0 1 2")),
        Case::ply("2³¹ vertices of text", 3, &["mesh.ply"], header("ascii", "2147483648", "0")),
        Case::ply("2⁶⁴ vertices", 3, &["mesh.ply:3"], header("ascii", "18446744073709551616", "0")),
        Case::ply("−1 vertices", 3, &["mesh.ply:3"], header("ascii", "-1", "0")),
        Case::ply("no vertices and no faces", 0, &["mesh.ply"], header("ascii", "0", "0")),
        Case::ply(
            "faces of no vertices",
            3,
            &["mesh.ply"],
            format!("{}3 0 0 0\n", header("ascii", "0", "1")),
        ),
        Case::ply(
            "2³¹ binary vertices",
            3,
            &["mesh.ply:3", "do not fit"],
            little("2147483648", "0", &[0; 100]),
        ),
        Case::ply(
            "2⁶³ binary vertices",
            3,
            &["mesh.ply:3", "do not fit"],
            little("9223372036854775807", "0", &[0; 100]),
        ),
        Case::ply(
            "2³¹ binary faces",
            3,
            &["mesh.ply:7", "do not fit"],
            little("0", "2147483648", &[0; 100]),
        ),
        Case::ply(
            "binary data cut off",
            3,
            &["mesh.ply:3", "3 vertex records do not fit"],
            little("3", "1", &[0; 20]),
        ),
        Case::ply("binary list of 2³² − 1 numbers", 3, &["mesh.ply"], list("uint", &[0xff; 8])),
        Case::ply("binary list of −1 numbers", 3, &["mesh.ply"], list("int", &[0xff; 8])),
        Case::ply(
            "2⁶³ elements of nothing",
            0,
            &["mesh.ply"],
            format!(
                "ply\nformat binary_little_endian 1.0\nelement nothing 9223372036854775807\n{}",
                header("ascii", "0", "0").split_once("1.0\n").expect("a header").1
            ),
        ),
        Case::ply(
            "10⁵ kinds of elements",
            3,
            &["mesh.ply"],
            format!(
                "ply\nformat ascii 1.0\n{}",
                (0..100_000).map(|i| format!("element e{i} 0\n")).collect::<String>()
            ),
        ),
        Case::ply("NaN vertex, little endian", 3, &["mesh.ply"], binary(false, f32::NAN, 2)),
        Case::ply("NaN vertex, big endian", 3, &["mesh.ply"], binary(true, f32::NAN, 2)),
        Case::ply("index out of range, little endian", 3, &["mesh.ply"], binary(false, 0.0, 3)),
        Case::ply("index −1, big endian", 3, &["mesh.ply"], binary(true, 0.0, -1)),
        Case::ply("index −2³¹, little endian", 3, &["mesh.ply"], binary(false, 0.0, i32::MIN)),
        Case::ply("sound PLY, little endian", 0, &[], binary(false, 0.0, 2)),
        Case::ply("sound PLY, big endian", 0, &[], binary(true, 0.0, 2)),
    ]
}

fn serialized() -> Vec<Case> {
    /// A file of one mesh whose stream holds the content, with its dictionary.
    fn file(content: &[u8]) -> Vec<u8> {
        let mut zlib = ZlibEncoder::new(b"\x1c\x04\x04\0".to_vec(), Compression::best());
        zlib.write_all(content).expect("memory");
        let mut bytes = zlib.finish().expect("memory");
        bytes.extend([0; 8]);
        bytes.extend(1_u32.to_le_bytes());
        bytes
    }
    let content = |name: &[u8], counts: [u64; 2], numbers: &[f32], indices: &[u32]| {
        let mut bytes = 0x1000_u32.to_le_bytes().to_vec();
        bytes.extend(name);
        bytes.extend(counts.iter().flat_map(|n| n.to_le_bytes()));
        bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend(indices.iter().flat_map(|i| i.to_le_bytes()));
        bytes
    };
    let body = |index: &str| {
        format!(
            "{LIGHT}<shape type=\"serialized\"><string name=\"filename\" value=\"a.bin\"/>{index}</shape>"
        )
    };
    let case = |what, exit, says, bytes: Vec<u8>| {
        Case::scene(what, exit, says, &body("")).file("a.bin", bytes)
    };
    let triangle = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let sound = file(&content(b"\0", [3, 1], &triangle, &[0, 1, 2]));
    let at = |what, says, index: &str| {
        let index = format!("<integer name=\"shape_index\" value=\"{index}\"/>");
        Case::scene(what, 3, says, &body(&index)).file("a.bin", sound.clone())
    };
    vec![
        case("sound serialized mesh", 0, &[], sound.clone()),
        case("empty serialized file", 3, &["a.bin"], Vec::new()),
        case(
            "serialized file of another kind",
            3,
            &["a.bin", "no serialized mesh begins"],
            b"v 0 0 0\n".to_vec(),
        ),
        case(
            "serialized mesh of version 9",
            3,
            &["a.bin", "version 9"],
            b"\x1c\x04\x09\0....".to_vec(),
        ),
        case(
            "serialized stream that is none",
            3,
            &["a.bin", "header of mesh 0"],
            b"\x1c\x04\x04\0not a stream".to_vec(),
        ),
        case("serialized mesh cut off", 3, &["a.bin"], sound[..20].to_vec()),
        case(
            "2⁶³ serialized vertices",
            5,
            &["a.bin", "declares"],
            file(&content(b"\0", [1 << 63, 1], &[], &[])),
        ),
        case(
            "2⁶⁴ − 1 serialized triangles",
            5,
            &["a.bin", "declares"],
            file(&content(b"\0", [3, u64::MAX], &[], &[])),
        ),
        case(
            "serialized vertices that are not there",
            3,
            &["a.bin", "positions of mesh 0"],
            file(&content(b"\0", [1000, 1], &[], &[])),
        ),
        case(
            "10⁸ zeros for 10⁷ serialized vertices",
            5,
            &["a.bin", "declares 120000012 bytes"],
            file(&[content(b"\0", [10_000_000, 1], &[], &[]), vec![0; 100_000_000]].concat()),
        ),
        case(
            "serialized name without an end",
            3,
            &["a.bin", "name of mesh 0"],
            file(&content(&vec![b'x'; 1 << 20], [3, 1], &[], &[])),
        ),
        case(
            "serialized index out of range",
            3,
            &["a.bin"],
            file(&content(b"\0", [3, 1], &triangle, &[0, 1, 3])),
        ),
        case(
            "serialized NaN",
            3,
            &["a.bin"],
            file(&content(b"\0", [3, 1], &[f32::NAN; 9], &[0, 1, 2])),
        ),
        at("serialized mesh −1", &["shape_index"], "-1"),
        at("serialized mesh 7 of 1", &["there is no mesh 7: the file has 1"], "7"),
        at("serialized mesh 2⁶³ − 1", &["a.bin"], "9223372036854775807"),
        Case::scene(
            "dictionary of 2³² − 1 meshes",
            3,
            &["a.bin", "dictionary of 4294967295 meshes"],
            &body("<integer name=\"shape_index\" value=\"1\"/>"),
        )
        .file("a.bin", [&sound[..sound.len() - 4], &[0xff; 4]].concat()),
    ]
}

fn curves() -> Vec<Case> {
    let case = |what, exit, says, text: &str| {
        let body = format!(
            "{LIGHT}<shape type=\"bsplinecurve\"><string name=\"filename\" value=\"a.txt\"/></shape>"
        );
        Case::scene(what, exit, says, &body).file("a.txt", text)
    };
    let points = "0 0 0 0.1\n1 0 0 0.1\n2 0 0 0.1\n3 1 0 0.1\n";
    vec![
        case("sound curve", 0, &[], points),
        case("no curve", 3, &["a.txt"], ""),
        case("curve of one point", 3, &["a.txt:1", "1 control point"], "0 0 0 0.1\n"),
        case("point of three numbers", 3, &["a.txt:1"], "0 0 0\n"),
        case("point of NaN", 3, &["a.txt:2", "nan"], "0 0 0 0.1\nnan 0 0 0.1\n"),
        case("curve of negative radius", 3, &["a.txt:1", "-1"], &points.replacen("0.1", "-1", 1)),
        case("curve of radius 0", 0, &[], &points.replace("0.1", "0")),
        case("curve of radius 10³⁰", 3, &["reaches beyond ±2⁴⁰"], &points.replace("0.1", "1e30")),
        case("curve of 10⁵ equal points", 0, &[], &"1 1 1 0.1\n".repeat(100_000)),
        case("curve of words", 3, &["a.txt:1", "'one'"], "one two three four\n"),
        case("line of control points of a megabyte", 3, &["a.txt:1", "…' is not a number"], &"x".repeat(1 << 20)),
        Case::scene("light that is a curve", 3, &["a light needs an area"], "<shape type=\"bsplinecurve\"><string name=\"filename\" value=\"a.txt\"/><emitter type=\"area\"/></shape>")
            .file("a.txt", points),
        Case::new("scene named as a folder", 4, &["scene.xml", "not a regular file"])
            .with_content("scene.xml", Content::Folder),
        Case::new("byte-order mark of a scene", 0, &[]).file("scene.xml", format!("\u{feff}{}", scene(&ball("")))),
    ]
}
