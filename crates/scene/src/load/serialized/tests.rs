use super::*;
use crate::ErrorKind;
use alloc::string::ToString as _;
use flate2::{Compression, write::ZlibEncoder};
use std::io::Write as _;

/// The content of a mesh: a triangle at height `z`.
fn content(version: u16, flags: u32, z: f64) -> Vec<u8> {
    let mut out = flags.to_le_bytes().to_vec();
    if version == 4 {
        out.extend(b"tri\0");
    }
    out.extend(3u64.to_le_bytes());
    out.extend(1u64.to_le_bytes());
    let mut numbers = Vec::from([0.0, 0.0, z, 1.0, 0.0, z, 0.0, 1.0, z]);
    if flags & HAS_NORMALS != 0 {
        numbers.extend([0.0, 0.0, 1.0].repeat(3));
    }
    if flags & HAS_UVS != 0 {
        numbers.extend([0.25, 0.75].repeat(3));
    }
    if flags & HAS_COLORS != 0 {
        numbers.extend([0.5; 9]);
    }
    for x in numbers {
        match flags & DOUBLE_PRECISION {
            0 => out.extend((x as f32).to_le_bytes()),
            _ => out.extend(x.to_le_bytes()),
        }
    }
    out.extend([0u32, 1, 2].iter().flat_map(|i| i.to_le_bytes()));
    out
}

fn encode(version: u16, contents: &[Vec<u8>]) -> Vec<u8> {
    let mut file = Vec::new();
    let mut offsets = Vec::new();
    for content in contents {
        offsets.push(file.len() as u64);
        file.extend(MAGIC);
        file.extend(version.to_le_bytes());
        let mut zlib = ZlibEncoder::new(file, Compression::default());
        zlib.write_all(content).expect("memory");
        file = zlib.finish().expect("memory");
    }
    let width = if version == 4 { 8 } else { 4 };
    file.extend(offsets.iter().flat_map(|o| o.to_le_bytes().into_iter().take(width)));
    file.extend((contents.len() as u32).to_le_bytes());
    file
}

fn parse(bytes: &[u8], index: usize) -> Result<MeshFile, SceneError> {
    parse_serialized(bytes, Path::new("a.serialized"), index)
}

#[test]
fn both_versions_and_precisions_and_all_attributes_are_read() {
    let all = HAS_NORMALS | HAS_UVS | HAS_COLORS;
    for version in [3, 4] {
        for flags in [0, HAS_NORMALS, HAS_UVS | 0x1000, all, all | DOUBLE_PRECISION] {
            let z = [2.0, 5.0];
            let bytes = encode(version, &z.map(|z| content(version, flags, z)));
            for (index, z) in z.into_iter().enumerate() {
                let file = parse(&bytes, index).expect("a valid file");
                let mesh = file.mesh;
                assert_eq!(file.name, if version == 4 { "tri" } else { "a" });
                assert_eq!(mesh.positions()[1], Vec3::new(1.0, 0.0, z as f32));
                assert_eq!(mesh.triangles(), [[0, 1, 2]]);
                let count = |flag| if flags & flag != 0 { 3 } else { 0 };
                assert_eq!(mesh.normals(), &[Vec3::Z; 3][..count(HAS_NORMALS)]);
                assert_eq!(mesh.uvs(), &[Vec2::new(0.25, 0.75); 3][..count(HAS_UVS)]);
            }
        }
    }
}

#[test]
fn the_face_normal_flag_drops_stored_normals() {
    let flags = HAS_NORMALS | FACE_NORMALS;
    let file = parse(&encode(4, &[content(4, flags, 0.0)]), 0).expect("a valid file");
    assert!(file.face_normals && file.mesh.normals().is_empty());
}

#[test]
fn wrong_files_and_indices_are_named() {
    let good = encode(4, &[content(4, 0, 0.0)]);
    let message = |bytes: &[u8], index| parse(bytes, index).map_err(|e| e.to_string());
    let error = |text: &str| Err(format!("a.serialized: {text}"));
    assert_eq!(message(b"", 0), error("the file ends before the mesh at byte 0"));
    assert_eq!(message(b"PK\x03\x04", 0), error("no serialized mesh begins at byte 0"));
    assert_eq!(message(b"\x1c\x04\x05\0", 0), error("unknown version 5, expected 3 or 4"));
    assert_eq!(message(&good, 1), error("there is no mesh 1: the file has 1"));
    let mut many = good.clone();
    let end = many.len();
    many[end - 4..].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_eq!(
        message(&many, 1),
        error("the dictionary of 4294967295 meshes does not fit in the file")
    );
}

#[test]
fn declared_counts_are_bounded_by_the_stream_and_the_file() {
    let mut lie = content(3, 0, 0.0);
    lie[4..12].copy_from_slice(&u64::MAX.to_le_bytes());
    let error = parse(&encode(3, &[lie.clone()]), 0).expect_err("too large");
    assert_eq!(error.kind, ErrorKind::Resource);
    lie[4..12].copy_from_slice(&1000u64.to_le_bytes());
    let error = parse(&encode(3, &[lie]), 0).expect_err("too short");
    assert_eq!(error.kind, ErrorKind::Scene);
    assert!(error.message.starts_with("the positions of mesh 0: "), "{error}");
}

#[test]
fn bad_indices_coordinates_and_names_are_errors() {
    let mut bad = content(3, 0, 0.0);
    let end = bad.len();
    bad[end - 4..].copy_from_slice(&3u32.to_le_bytes());
    assert!(parse(&encode(3, &[bad]), 0).is_err());
    assert!(parse(&encode(3, &[content(3, 0, f64::NAN)]), 0).is_err());
    let mut endless = 0u32.to_le_bytes().to_vec();
    endless.resize(LONGEST_NAME + 5, b'a');
    assert!(parse(&encode(4, &[endless]), 0).is_err());
}

#[test]
fn truncated_and_altered_files_never_panic() {
    let all = HAS_NORMALS | HAS_UVS | DOUBLE_PRECISION;
    let bytes = encode(4, &[content(4, all, 1.0), content(4, 0, 2.0)]);
    for at in 0..bytes.len() {
        let mut altered = bytes.clone();
        altered[at] ^= 0xff;
        for index in 0..3 {
            let _ = parse(&bytes[..at], index);
            let _ = parse(&altered, index);
        }
    }
}
