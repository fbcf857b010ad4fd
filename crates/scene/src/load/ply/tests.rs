use super::header::{Order, Scalar};
use super::*;
use alloc::string::{String, ToString};
use alloc::vec;

/// A quad and a triangle with normals, texture coordinates, a colour and a foreign element.
const HEADER: &str = "comment made by hand\nobj_info none\n\
    element vertex 5\nproperty float x\nproperty double y\nproperty float z\n\
    property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n\
    property float s\nproperty float t\n\
    element edge 1\nproperty list ushort short ends\nproperty char kind\n\
    element face 2\nproperty uchar flags\nproperty list uchar int vertex_indices\n\
    property list uint float texcoord\nend_header\n";

/// The numbers of the records under `HEADER`, each with its type.
fn numbers() -> Vec<(Scalar, f64)> {
    use Scalar::*;
    let mut all = Vec::new();
    for i in 0..5u8 {
        let i = f64::from(i);
        all.extend([(F32, i), (F64, i * i), (F32, -0.5), (F32, 0.0), (F32, 0.0), (F32, 1.0)]);
        all.extend([(U8, 200.0), (F32, i / 4.0), (F32, 0.25)]);
    }
    all.extend([(U16, 2.0), (I16, -3.0), (I16, 4.0), (I8, -1.0)]);
    all.extend([(U8, 7.0), (U8, 4.0), (I32, 0.0), (I32, 1.0), (I32, 2.0), (I32, 3.0)]);
    all.extend([(U32, 2.0), (F32, 0.5), (F32, 0.5)]);
    all.extend([(U8, 7.0), (U8, 3.0), (I32, 4.0), (I32, 1.0), (I32, 0.0), (U32, 0.0)]);
    all
}

fn encode(format: &str) -> Vec<u8> {
    let mut file = format!("ply\nformat {format} 1.0\n{HEADER}").into_bytes();
    for (kind, value) in numbers() {
        let mut bytes = match kind {
            Scalar::I8 => (value as i8).to_le_bytes().to_vec(),
            Scalar::U8 => (value as u8).to_le_bytes().to_vec(),
            Scalar::I16 => (value as i16).to_le_bytes().to_vec(),
            Scalar::U16 => (value as u16).to_le_bytes().to_vec(),
            Scalar::I32 => (value as i32).to_le_bytes().to_vec(),
            Scalar::U32 => (value as u32).to_le_bytes().to_vec(),
            Scalar::F32 => (value as f32).to_le_bytes().to_vec(),
            Scalar::F64 => value.to_le_bytes().to_vec(),
        };
        match format {
            "ascii" => bytes = format!("{value}\n").into_bytes(),
            "binary_big_endian" => bytes.reverse(),
            _ => {}
        }
        file.extend(bytes);
    }
    file
}

const FORMATS: [&str; 3] = ["ascii", "binary_little_endian", "binary_big_endian"];

fn parse(bytes: &[u8]) -> Result<MeshFile, SceneError> {
    parse_ply(bytes, Path::new("a.ply"), TexCoords::AsWritten)
}

fn message(text: &str) -> String {
    parse(text.as_bytes()).expect_err("an invalid file").to_string()
}

/// A file of three ascii vertices and the given body of one face.
fn triangle(face: &str) -> String {
    format!(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
         property float z\nelement face 1\nproperty list int int vertex_index\nend_header\n\
         0 0 0\n1 0 0\n0 1 0\n{face}"
    )
}

#[test]
fn the_three_formats_hold_the_same_mesh() {
    for format in FORMATS {
        let file = parse(&encode(format)).expect(format);
        let mesh = file.mesh;
        assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3], [4, 1, 0]], "{format}");
        assert_eq!(mesh.positions()[3], Vec3::new(3.0, 9.0, -0.5), "{format}");
        assert_eq!(mesh.normals(), [Vec3::Z; 5], "{format}");
        assert_eq!(mesh.uvs()[2], Vec2::new(0.5, 0.25), "{format}");
        assert_eq!((file.name.as_str(), file.warnings), ("a", vec![]), "{format}");
    }
}

#[test]
fn headers_may_have_any_line_end() {
    for end in ["\r\n", "\r"] {
        let plain = encode("binary_little_endian");
        let header = format!("ply\nformat binary_little_endian 1.0\n{HEADER}");
        let mut bytes = header.replace('\n', end).into_bytes();
        bytes.extend(&plain[header.len()..]);
        assert_eq!(parse(&bytes), parse(&plain), "{end:?}");
    }
}

#[test]
fn texture_coordinates_are_flipped_on_request() {
    let bytes = encode("ascii");
    let file = parse_ply(&bytes, Path::new("a.ply"), TexCoords::Flipped).expect("valid");
    assert_eq!(file.mesh.uvs()[2], Vec2::new(0.5, 0.75));
}

#[test]
fn flaws_of_text_name_their_line() {
    for (face, expected) in [
        ("3 0 1 3", "a.ply:13: face 0: '3' is not one of the vertices 0 to 2"),
        ("3 0 1 -1", "a.ply:13: face 0: '-1' is not one of the vertices 0 to 2"),
        ("3 0 1 1.5", "a.ply:13: face 0: '1.5' is not one of the vertices 0 to 2"),
        ("3 0 1 nan", "a.ply:13: face 0: 'nan' is not one of the vertices 0 to 2"),
        ("-3 0 1 2", "a.ply:13: face 0: '-3' is not the length of a list"),
        ("3\n0 one", "a.ply:14: face 0: 'one' is not a number"),
        ("1e18 0 1", "a.ply:13: the file ends in face 0 of 1"),
        ("3 0 1\n", "a.ply:14: the file ends in face 0 of 1"),
    ] {
        assert_eq!(message(&triangle(face)), expected);
    }
    let bad = triangle("3 0 1 2");
    assert_eq!(
        message(&bad.replace("1 0 0", "1 nan 0")),
        "a.ply:11: vertex 1: 'nan' is not a finite number"
    );
    assert_eq!(
        message(&bad.replace("1 0 0", "1e39 0 0")),
        "a.ply:11: vertex 1: '1e39' is not a finite number"
    );
}

#[test]
fn flaws_of_binary_files_name_their_byte() {
    let mut bytes = encode("binary_little_endian");
    let start = format!("ply\nformat binary_little_endian 1.0\n{HEADER}").len();
    bytes[start..start + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    let expected = format!("a.ply: vertex 0: NaN at byte {start} is not a finite number");
    assert_eq!(parse(&bytes).map_err(|e| e.to_string()), Err(expected));
    let whole = encode("binary_little_endian");
    let short = &whole[..whole.len() - 2];
    let expected = format!("a.ply: the file ends at byte {} in face 1 of 2", short.len());
    assert_eq!(parse(short).map_err(|e| e.to_string()), Err(expected));
}

#[test]
fn counts_beyond_the_file_are_refused_before_memory_is_taken() {
    let bad = triangle("3 0 1 2");
    for count in ["1000000", "18446744073709551615"] {
        let expected = format!("{count} vertex records do not fit in the file");
        let text = bad.replace("vertex 3", &format!("vertex {count}"));
        assert_eq!(message(&text), format!("a.ply:3: {expected}"));
        let text = text.replace("ascii", "binary_big_endian");
        assert_eq!(message(&text), format!("a.ply:3: {expected}"));
    }
    let endless = bad.replace("element face", "element nothing 18446744073709551615\nelement face");
    assert!(parse(endless.as_bytes()).is_ok());
}

#[test]
fn malformed_headers_name_their_line() {
    let elements: Vec<_> = (0..300).map(|i| format!("element e{i} 0\n")).collect();
    let endless = format!("ply\n{}", elements.concat());
    for (text, expected) in [
        ("", "a.ply:1: the file ends within the header"),
        ("plx\n", "a.ply:1: not a PLY file: the first line is not 'ply'"),
        ("ply\nformat ascii 2.0\n", "a.ply:2: unknown version '2.0'"),
        ("ply\nformat text 1.0\n", "a.ply:2: unknown format 'text'"),
        ("ply\nend_header\n", "a.ply:2: the header has no 'format' line"),
        ("ply\nelement vertex -1\n", "a.ply:2: '-1' is not a count of vertex records"),
        ("ply\nelement vertex\n", "a.ply:2: an element needs a name and a count"),
        ("ply\nelement a 1\nelement a 1\n", "a.ply:3: the element 'a' is declared twice"),
        ("ply\nproperty float x\n", "a.ply:2: a property comes before the first element"),
        ("ply\nelement a 1\nproperty half x\n", "a.ply:3: unknown type 'half'"),
        ("ply\nelement a 1\nproperty int\n", "a.ply:3: a property needs a type and a name"),
        (
            "ply\nelement a 1\nproperty list float int x\n",
            "a.ply:3: the length of a list is not of an integer type",
        ),
        (&endless, "a.ply:258: more than 256 elements"),
        ("ply\nfoo\n", "a.ply:2: unknown header keyword 'foo'"),
    ] {
        assert_eq!(message(text), expected);
    }
    let bad = triangle("3 0 1 2");
    assert_eq!(
        message(&bad.replace("float z", "float w")),
        "a.ply:3: the element 'vertex' needs the properties x, y and z"
    );
    assert_eq!(
        message(&bad.replace("vertex_index", "corners")),
        "a.ply:7: the element 'face' needs a list 'vertex_indices'"
    );
}

#[test]
fn small_and_missing_faces_are_warnings() {
    let file = parse(triangle("2 0 1").as_bytes()).expect("a valid file");
    let messages: Vec<_> = file.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(
        messages,
        ["a.ply: 1 faces of fewer than three vertices are ignored", "a.ply: there are no faces"]
    );
}

#[test]
fn truncated_files_never_panic() {
    for format in FORMATS {
        let bytes = encode(format);
        // The last byte of text is a line end, without which nothing is missing.
        let needed = bytes.len() - usize::from(format == "ascii");
        for end in 0..needed {
            let _ = parse(&bytes[..end]);
            assert!(format == "ascii" || parse(&bytes[..end]).is_err(), "{format}: {end}");
        }
    }
}

#[test]
fn files_on_disk_are_read() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("quad.ply");
    std::fs::write(&path, encode("binary_big_endian")).expect("written");
    let file = load_ply(&path, TexCoords::AsWritten).expect("a valid file");
    assert_eq!((file.name.as_str(), file.mesh.triangles().len()), ("quad", 3));
}

#[test]
fn properties_of_vertices_and_faces_become_attributes() {
    let text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
        property float z\nproperty float red\nproperty float green\nproperty float blue\n\
        element face 2\nproperty list uchar int vertex_indices\nproperty float w_0\nend_header\n\
        0 0 0 1 0 0\n1 0 0 0 1 0\n1 1 0 0 0 1\n0 1 0 -1 nan 0.5\n\
        4 0 1 2 3 0.25\n3 0 1 2 0.75\n";
    let file = parse(text.as_bytes()).expect("a valid file");
    let [colors, weights] = file.mesh.attributes() else { panic!("{:?}", file.mesh.attributes()) };
    assert_eq!((colors.name.as_str(), weights.name.as_str()), ("vertex_color", "face_w"));
    let rgb = |i: usize| colors.values[i].to_array();
    assert_eq!([rgb(0), rgb(3)], [[1.0, 0.0, 0.0], [0.0, 0.0, 0.5]]);
    // The quad is two triangles.
    assert_eq!(weights.values.iter().map(|c| c.r).collect::<Vec<_>>(), [0.25, 0.25, 0.75]);
    assert_eq!(file.warnings.len(), 1);
    let warning = file.warnings[0].to_string();
    assert!(warning.contains("2 attributes are negative or not finite"), "{warning}");
}

/// Numbers of a binary file, read one after the other.
struct OneByOne<'a>(Binary<'a>);

impl Body for OneByOne<'_> {
    fn value(&mut self, kind: Scalar) -> Option<f64> {
        self.0.value(kind)
    }

    fn most_records(&self, element: &Element) -> usize {
        self.0.most_records(element)
    }

    fn flaw(&self, element: &Element, index: usize) -> SceneError {
        self.0.flaw(element, index)
    }

    fn wrong(&self, element: &Element, index: usize, what: &str) -> SceneError {
        self.0.wrong(element, index, what)
    }

    fn binary(&self) -> Option<(&[u8], Order)> {
        None
    }

    fn advance(&mut self, _: usize) {}
}

/// A file of polygons of two to five corners whose indices have the types given by name, with numbers around the lists.
fn polygons(order: Order, length: (&str, usize), item: (&str, usize), count: u32) -> Vec<u8> {
    let name = if order == Order::Big { "big" } else { "little" };
    let mut file = format!(
        "ply\nformat binary_{name}_endian 1.0\nelement vertex {count}\nproperty double x\nproperty float y\n\
         property short z\nproperty float v\nproperty float u\nproperty uchar blue\nproperty uchar red\n\
         property uchar green\nproperty float heat_0\nelement face {count}\nproperty short before\n\
         property list {} {} vertex_index\nproperty uchar after\nend_header\n",
        length.0, item.0
    )
    .into_bytes();
    let mut push = |bytes: &[u8]| match order {
        Order::Little => file.extend(bytes),
        Order::Big => file.extend(bytes.iter().rev()),
    };
    for i in 0..count {
        push(&f64::from(i).to_le_bytes());
        push(&(i as f32).sqrt().to_le_bytes());
        push(&(i as i16).to_le_bytes());
        push(&0.25f32.to_le_bytes());
        push(&(1.0 / (1 + i) as f32).to_le_bytes());
        (0..3).for_each(|channel| push(&[(i + channel) as u8]));
        push(&(i as f32 - 2.0).to_le_bytes());
    }
    for i in 0..count {
        push(&[1, 2]);
        let corners = 2 + i % 4;
        push(&corners.to_le_bytes()[..length.1]);
        for corner in 0..corners {
            push(&((i * 7 + corner) % count.min(200)).to_le_bytes()[..item.1]);
        }
        push(&[9]);
    }
    file
}

#[test]
fn records_read_on_all_cores_are_those_read_one_by_one() {
    let path = Path::new("a.ply");
    let slowly = |bytes: &[u8]| {
        let (header, rest, _) = header::parse(bytes, path)?;
        let Format::Binary(order) = header.format else { panic!("a text") };
        let numbers = Binary::new(bytes, bytes.len() - rest.len(), order, path);
        read(&header.elements, OneByOne(numbers), path, TexCoords::Flipped)?.into_mesh(path)
    };
    let quickly = |bytes: &[u8]| parse_ply(bytes, path, TexCoords::Flipped);
    for order in [Order::Little, Order::Big] {
        for (length, item) in [
            (("uchar", 1), ("int", 4)),
            (("uchar", 1), ("uint", 4)),
            (("int", 4), ("uchar", 1)),
            (("ushort", 2), ("short", 2)),
        ] {
            let bytes = polygons(order, length, item, 40);
            let expected = slowly(&bytes).expect("a valid file");
            assert_eq!(expected.mesh.triangles().len(), 60);
            assert_eq!(quickly(&bytes), Ok(expected));
            // Flaws are found by the same words.
            for at in 0..bytes.len() {
                let mut altered = bytes.clone();
                altered[at] ^= 0x80;
                assert_eq!(quickly(&altered), slowly(&altered), "{at}");
                assert_eq!(quickly(&bytes[..at]), slowly(&bytes[..at]), "{at}");
            }
        }
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let bytes = polygons(Order::Little, ("uchar", 1), ("int", 4), 30_000);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| parse(&bytes).expect("a valid file"))
    };
    assert_eq!(with(1), with(4));
}
