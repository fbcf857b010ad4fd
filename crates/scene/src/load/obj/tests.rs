use super::*;
use alloc::string::ToString;
use alloc::vec;

const PATH: &str = "a.obj";
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn merged(text: &str) -> Result<MeshFile, SceneError> {
    let whole = parse_obj_merged(text.as_bytes(), Path::new(PATH), TexCoords::AsWritten);
    if text.len() < 2000 {
        // However a text is cut, it means the same.
        for (piece, task) in [(1, 1), (7, 3), (50, 20)] {
            let parser = Parser::new(Path::new(PATH), TexCoords::AsWritten, None);
            let cut = parser.read(text.as_bytes(), text.len() as u64, Sizes { piece, task });
            assert_eq!(cut.map(|scene| super::merged(scene, Path::new(PATH))), whole, "{piece}");
        }
    }
    whole
}

fn mesh(text: &str) -> MeshArrays {
    merged(text).expect("a valid file").mesh
}

fn message(text: &str) -> String {
    merged(text).expect_err("an invalid file").to_string()
}

/// A scene whose MTL files all have the same content, or are all missing.
fn scene(text: &str, library: Option<&str>) -> ObjScene {
    let read = |path: &Path| match library {
        Some(text) => Ok(text.as_bytes().to_vec()),
        None => Err(SceneError::io(path, &io::ErrorKind::NotFound.into())),
    };
    parse_obj(text.as_bytes(), Path::new(PATH), TexCoords::AsWritten, read).expect("a valid file")
}

#[test]
fn polygons_become_fans() {
    let m = mesh(&format!("{SQUARE}v 0 2 0\nf 1 2 3 5 4"));
    assert_eq!(m.triangles(), [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
    assert_eq!(m.positions()[3], Vec3::new(0., 2., 0.));
}

#[test]
fn negative_indices_count_from_the_last_vertex_so_far() {
    let m = mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -4 -3 -1");
    assert_eq!(m.triangles(), [[0, 1, 2], [0, 1, 3]]);
    assert_eq!(m.positions()[3], Vec3::splat(5.0));
}

#[test]
fn one_vertex_per_distinct_triple() {
    let m = mesh(&format!(
        "{SQUARE}vt 0 0\nvt 1 1\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nf 1/1/1 3/1/1 4/1/1\nf 1/2/1 2/1/1 3/1\nf 1/2/1 2 3/1"
    ));
    assert_eq!(m.triangles(), [[0, 1, 2], [0, 2, 3], [4, 1, 5], [4, 6, 5]]);
    assert_eq!(m.uvs()[4], Vec2::ONE);
    assert_eq!(m.normals()[5], Vec3::ZERO);
    assert_eq!((m.uvs()[6], m.normals()[6]), (Vec2::ZERO, Vec3::ZERO));
}

#[test]
fn unused_normals_and_texture_coordinates_leave_no_arrays() {
    let m = mesh(&format!("{SQUARE}vn 0 0 1\nvt 0 0\nf 1 2 3"));
    assert!(m.normals().is_empty() && m.uvs().is_empty());
    assert_eq!(m.positions().len(), 3);
}

#[test]
fn texture_coordinates_are_flipped_on_request() {
    let text = format!("{SQUARE}vt 0.25 0.25\nvt 0.5\nf 1/1 2/2 3/1");
    let m = parse_obj_merged(text.as_bytes(), Path::new(PATH), TexCoords::Flipped).expect("valid");
    assert_eq!(m.mesh.uvs()[..2], [Vec2::new(0.25, 0.75), Vec2::new(0.5, 1.0)]);
}

#[test]
fn marks_continuations_carriage_returns_colours_and_weights_are_understood() {
    let plain = mesh(&format!("{SQUARE}f 1 2 3 4"));
    for text in [
        "\u{feff}v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4",
        "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2 3 4\r\n",
        "v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rf 1 2 3 4\r",
        "v 0 0 0 1\nv 1 0 0 1.0\nv 1 1 0 .1 .2 .3\nv 0 1 0 .1 .2 .3 # red\nf 1 2 3 4# no comment",
        "v\t0e0 0 -0\nv +1 0 0\nv 10e-1 1.0E0 0\nv 0 1. 0\ns off\nf 1 2 \\\n 3 \\\r\n4",
        "v 0 0 0\n  v 1 0 0\nv 1 \\\n 1 0\nv 0 1 0\nf 1/ 2/ 3// 4",
    ] {
        let found = merged(text.trim_end_matches("# no comment")).map(|f| f.mesh);
        assert_eq!(found.as_ref(), Ok(&plain), "{text:?}");
    }
}

#[test]
fn very_long_lines_are_read() {
    let corners = " 1 2 3 4".repeat(25_000);
    assert_eq!(mesh(&format!("{SQUARE}f{corners}")).triangles().len(), 99_998);
}

#[test]
fn one_position_with_many_texture_coordinates_takes_linear_time() {
    let uvs: Vec<_> = (0..50_000).map(|i| format!("vt {i}")).collect();
    let corners: Vec<_> = (1..=50_000).map(|i| format!("1/{i}")).collect();
    let text = format!("v 0 0 0\n{}\nf {}", uvs.join("\n"), corners.join(" "));
    assert_eq!(mesh(&text).positions().len(), 50_000);
}

#[test]
fn indices_that_name_nothing_are_errors_with_a_line() {
    for (face, expected) in [
        (
            "f 1//6148914691236517206 2 3",
            "there is no normal 6148914691236517206: none is defined before it",
        ),
        ("f 1 2 4294967297", "there is no vertex 4294967297: 1 to 4 are defined before it"),
        ("f 1 2 5", "there is no vertex 5: 1 to 4 are defined before it"),
        ("f 0 1 2", "there is no vertex 0: 1 to 4 are defined before it"),
        ("f -5 1 2", "there is no vertex -5: 1 to 4 are defined before it"),
        (
            "f -9223372036854775808 1 2",
            "there is no vertex -9223372036854775808: 1 to 4 are defined before it",
        ),
        ("f 1/1 2 3", "there is no texture coordinate 1: none is defined before it"),
        ("f 99999999999999999999 1 2", "'99999999999999999999' is not a vertex index"),
        ("f 1.0 2 3", "'1.0' is not a vertex index"),
        ("f /1 2 3", "'' is not a vertex index"),
        ("f 1/x 2 3", "'x' is not a texture coordinate index"),
        ("f 1/1/1/1 2 3", "there is no texture coordinate 1: none is defined before it"),
        ("f 1////1 2 3", "'1////1' has more than three indices"),
    ] {
        assert_eq!(message(&format!("{SQUARE}{face}")), format!("a.obj:5: {expected}"));
    }
}

#[test]
fn malformed_coordinates_are_errors_with_a_line() {
    for (line, expected) in [
        ("v nan 0 0", "'nan' is not a finite number"),
        ("v 0 inf 0", "'inf' is not a finite number"),
        ("v 1e39 0 0", "'1e39' is not a finite number"),
        ("v 1 2", "2 numbers of 3 or more"),
        ("vn 0 0 NaN", "'NaN' is not a finite number"),
        ("vt", "0 numbers of 1 or more"),
        ("vt 1,5 2", "'1,5' is not a number"),
    ] {
        assert_eq!(message(&format!("# head\n{line}\n")), format!("a.obj:2: {expected}"));
    }
}

#[test]
fn parts_are_kept_apart_by_name_and_material() {
    let text = format!(
        "mtllib m.mtl\n{SQUARE}f 1 2 3\no box\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 3 4\nusemtl red\nf 2 3 4\n"
    );
    let s = scene(&text, Some("newmtl blue\nKd 0 0 1\nnewmtl red\nKd 1 0 0\n"));
    let parts: Vec<_> =
        s.meshes.iter().map(|m| (m.name.as_str(), m.material, m.mesh.triangles().len())).collect();
    assert_eq!(parts, [("", None, 1), ("box", Some(1), 2), ("box", Some(0), 1)]);
    assert_eq!(s.meshes[1].mesh.positions().len(), 4);
    assert_eq!(s.materials.len(), 2);
    assert_eq!(s.warnings, []);
}

#[test]
fn parts_do_not_depend_on_how_the_text_is_cut() {
    let lines: Vec<String> = (0..100)
        .map(|i| match i % 10 {
            0 => format!("o {}\nusemtl {}", i % 20, i % 30),
            5 => format!("mtllib {i}.mtl\nl {i}"),
            _ => format!("v {i} 0 0\nv 0 {i} 0\nv 0 0 {i}\nf -1 -2 -3\nf 1 2 3"),
        })
        .collect();
    let text = lines.join("\n");
    let read = |sizes| {
        let mut library = |_: &Path| Ok(b"newmtl 0\nfoo\nnewmtl 20".to_vec());
        let parser = Parser::new(Path::new(PATH), TexCoords::Flipped, Some(&mut library));
        parser.read(text.as_bytes(), text.len() as u64, sizes).expect("a valid file")
    };
    let whole = read(Sizes::USUAL);
    assert!(whole.meshes.len() == 6 && whole.warnings.len() > 5, "{:?}", whole.warnings);
    for (piece, task) in [(1, 1), (100, 30), (1000, 100)] {
        assert_eq!(read(Sizes { piece, task }), whole, "{piece}");
    }
}

#[test]
fn a_corner_beyond_the_chain_of_its_position_is_found_again() {
    let uvs: Vec<_> = (0..100).map(|i| format!("vt {i}")).collect();
    let corners: Vec<_> = (1..=100).map(|i| format!("1/{i}")).collect();
    let (uvs, corners) = (uvs.join("\n"), corners.join(" "));
    let once = mesh(&format!("v 0 0 0\n{uvs}\nf {corners}"));
    let twice = mesh(&format!("v 0 0 0\n{uvs}\nf {corners}\nf {corners}"));
    assert_eq!((once.positions().len(), once.uvs()), (100, twice.uvs()));
    assert_eq!(twice.triangles()[98..], *once.triangles());
}

#[test]
fn missing_libraries_and_materials_are_warnings() {
    let s = scene(&format!("mtllib a b.mtl\n{SQUARE}usemtl x\nf 1 2 3"), None);
    let messages: Vec<_> = s.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(messages.len(), 3);
    assert!(messages[0].starts_with("a.obj:1: material library left out: a: cannot read"));
    assert_eq!(messages[2], "a.obj: undefined material 'x' is ignored");
    assert_eq!(s.meshes[0].material, None);
}

#[test]
fn a_library_is_read_once_and_there_are_not_endlessly_many() {
    let mut reads = 0;
    let text = "mtllib a.mtl\n".repeat(1000);
    let s = parse_obj(text.as_bytes(), Path::new(PATH), TexCoords::AsWritten, |_| {
        reads += 1;
        Ok(b"newmtl a".to_vec())
    });
    assert_eq!((s.map(|s| s.materials.len()), reads), (Ok(1), 1));
    let names: Vec<_> = (0..200).map(|i| format!("mtllib {i}")).collect();
    let text = names.join("\n");
    let many =
        parse_obj(text.as_bytes(), Path::new(PATH), TexCoords::AsWritten, |_| Ok(Vec::new()));
    assert_eq!(many.map_err(|e| e.kind), Err(ErrorKind::Resource));
}

#[test]
fn a_malformed_library_is_an_error_of_its_own_file() {
    let read = |_: &Path| Ok(b"newmtl a\nKd x".to_vec());
    let error = parse_obj(b"mtllib m.mtl", Path::new("d/a.obj"), TexCoords::AsWritten, read);
    assert_eq!(error.map_err(|e| e.location), Err(Location::line("d/m.mtl", 2)));
}

#[test]
fn unknown_statements_and_small_faces_warn_once_per_kind() {
    let file = merged(&format!("{SQUARE}l 1 2\nl 2 3\ncurv 1\nf 1 2\nf 1")).expect("a valid file");
    let messages: Vec<_> = file.warnings.iter().map(|w| w.message.as_str()).collect();
    assert_eq!(
        messages,
        [
            "'l' is ignored",
            "'curv' is ignored",
            "a face of fewer than three vertices is ignored",
            "there are no faces"
        ]
    );
    assert_eq!((file.name.as_str(), file.mesh), ("a", MeshArrays::default()));
}

#[test]
fn truncated_files_never_panic() {
    let text = "\u{feff}mtllib x y\r\nv 0 0 0\nv 1 \\\n0 0\nv 0 1 0\nvt 0 1\nvn 0 0 1\nusemtl a\nf 1/1/1 2/1/1 -1//-1\n";
    for end in 0..text.len() {
        let _ =
            parse_obj(&text.as_bytes()[..end], Path::new(PATH), TexCoords::Flipped, |_| Ok(vec![]));
    }
}

#[test]
fn files_on_disk_bring_their_library() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.obj");
    std::fs::write(&path, format!("mtllib my lib.mtl\n{SQUARE}usemtl m\nf 1 2 3"))
        .expect("written");
    std::fs::write(folder.path().join("my lib.mtl"), "newmtl m\nmap_Kd t.png").expect("written");
    let s = load_obj(&path, TexCoords::Flipped, &Sandbox::default()).expect("a valid file");
    assert_eq!((s.meshes[0].material, s.warnings.len()), (Some(0), 0));
    let map = s.materials[0].diffuse_map.as_ref().map(|map| map.path.clone());
    assert_eq!(map, Some(folder.path().join("t.png")));
    assert_eq!(load_obj_merged(&path, TexCoords::Flipped).map(|m| m.name), Ok("a".into()));
}
