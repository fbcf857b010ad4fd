//! Meshes as binary PLY files.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use crate::geometry::{AttributeOwner, MeshAttribute, TriangleMesh};

/// A mesh with the bits that it holds: positions, normals and texture coordinates as far as it has them, and its attributes.
pub(super) fn ply(mesh: &TriangleMesh) -> Vec<u8> {
    let [of_vertices, of_faces] = [AttributeOwner::Vertex, AttributeOwner::Face].map(|owner| {
        let own = mesh.attributes().iter().filter(|attribute| attribute.owner == owner);
        own.map(Columns::of).collect::<Vec<_>>()
    });
    let (has_normals, has_uvs) = (!mesh.normals().is_empty(), !mesh.uvs().is_empty());
    let groups: [(bool, &[&str]); 3] =
        [(true, &["x", "y", "z"]), (has_normals, &["nx", "ny", "nz"]), (has_uvs, &["u", "v"])];
    let mut header = String::from("ply\nformat binary_little_endian 1.0\n");
    header += &format!("element vertex {}\n", mesh.positions().len());
    for name in groups.iter().filter(|(is_there, _)| *is_there).flat_map(|(_, names)| *names) {
        header += &format!("property float {name}\n");
    }
    for columns in &of_vertices {
        columns.declare(&mut header);
    }
    header += &format!("element face {}\n", mesh.triangles().len());
    header += "property list uchar int vertex_indices\n";
    for columns in &of_faces {
        columns.declare(&mut header);
    }
    header += "end_header\n";

    let mut bytes = header.into_bytes();
    for (index, position) in mesh.positions().iter().enumerate() {
        put(&position.to_array(), &mut bytes);
        if has_normals {
            put(&mesh.normals()[index].to_array(), &mut bytes);
        }
        if has_uvs {
            put(&mesh.uvs()[index].to_array(), &mut bytes);
        }
        for columns in &of_vertices {
            columns.put(index, &mut bytes);
        }
    }
    for (index, triangle) in mesh.triangles().iter().enumerate() {
        bytes.push(3);
        bytes.extend(triangle.iter().flat_map(|corner| corner.to_le_bytes()));
        for columns in &of_faces {
            columns.put(index, &mut bytes);
        }
    }
    bytes
}

fn put(numbers: &[f32], bytes: &mut Vec<u8>) {
    bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
}

/// An attribute `vertex_P` or `face_P` as the properties `P_0`, `P_1`, `P_2`.
struct Columns<'a> {
    attribute: &'a MeshAttribute,
    /// One for numbers: Mitsuba takes no three for one.
    count: usize,
}

impl<'a> Columns<'a> {
    fn of(attribute: &'a MeshAttribute) -> Self {
        let is_grey = attribute.values.iter().all(|c| c.r == c.g && c.g == c.b);
        Self { attribute, count: if is_grey { 1 } else { 3 } }
    }

    fn declare(&self, header: &mut String) {
        let name = &self.attribute.name;
        let prefix = match self.attribute.owner {
            AttributeOwner::Vertex => "vertex_",
            AttributeOwner::Face => "face_",
        };
        let name = name.strip_prefix(prefix).unwrap_or(name);
        for part in 0..self.count {
            *header += &format!("property float {name}_{part}\n");
        }
    }

    fn put(&self, index: usize, bytes: &mut Vec<u8>) {
        put(&self.attribute.values[index].to_array()[..self.count], bytes);
    }
}
