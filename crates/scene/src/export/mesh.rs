//! Meshes as binary PLY files.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use crate::geometry::{AttributeOwner, MeshAttribute, TriangleMesh};

/// A mesh with the bits that it holds: positions, normals and texture coordinates as far as it has them, and its attributes.
pub(super) fn ply(mesh: &TriangleMesh) -> Vec<u8> {
    let attributes = |owner| mesh.attributes().iter().filter(move |a| a.owner == owner);
    let (has_normals, has_uvs) = (!mesh.normals().is_empty(), !mesh.uvs().is_empty());
    let mut header = String::from("ply\nformat binary_little_endian 1.0\n");
    header += &format!("element vertex {}\n", mesh.positions().len());
    let groups =
        [(true, &["x", "y", "z"][..]), (has_normals, &["nx", "ny", "nz"]), (has_uvs, &["u", "v"])];
    for name in groups.iter().filter(|(is_there, _)| *is_there).flat_map(|(_, names)| *names) {
        header += &format!("property float {name}\n");
    }
    attributes(AttributeOwner::Vertex).for_each(|attribute| declare(attribute, &mut header));
    header += &format!("element face {}\n", mesh.triangles().len());
    header += "property list uchar int vertex_indices\n";
    attributes(AttributeOwner::Face).for_each(|attribute| declare(attribute, &mut header));
    header += "end_header\n";

    let mut bytes = header.into_bytes();
    for (index, position) in mesh.positions().iter().enumerate() {
        let normal = mesh.normals().get(index).map_or(&[][..], |n| n.as_ref());
        let uv = mesh.uvs().get(index).map_or(&[][..], |uv| uv.as_ref());
        let position: &[f32; 3] = position.as_ref();
        put(position.iter().chain(normal).chain(uv), &mut bytes);
        put_attributes(attributes(AttributeOwner::Vertex), index, &mut bytes);
    }
    for (index, triangle) in mesh.triangles().iter().enumerate() {
        bytes.push(3);
        triangle.iter().for_each(|corner| bytes.extend(corner.to_le_bytes()));
        put_attributes(attributes(AttributeOwner::Face), index, &mut bytes);
    }
    bytes
}

/// `P_0`, `P_1`, `P_2` of an attribute `vertex_P` or `face_P`.
fn declare(attribute: &MeshAttribute, header: &mut String) {
    let name = &attribute.name;
    let prefix = match attribute.owner {
        AttributeOwner::Vertex => "vertex_",
        AttributeOwner::Face => "face_",
    };
    let name = name.strip_prefix(prefix).unwrap_or(name);
    for part in 0..3 {
        *header += &format!("property float {name}_{part}\n");
    }
}

fn put<'a>(numbers: impl Iterator<Item = &'a f32>, bytes: &mut Vec<u8>) {
    numbers.for_each(|x| bytes.extend(x.to_le_bytes()));
}

fn put_attributes<'a>(
    attributes: impl Iterator<Item = &'a MeshAttribute>,
    index: usize,
    bytes: &mut Vec<u8>,
) {
    for attribute in attributes {
        put(attribute.values[index].to_array().iter(), bytes);
    }
}
