//! What fuzz targets of loaders share.

use etendue_scene::geometry::MeshArrays;

/// Asserts what a mesh promises: finite coordinates, indices of vertices that there are, arrays of one length.
pub fn check_mesh(mesh: &MeshArrays) {
    let vertices = mesh.positions().len();
    assert!(mesh.positions().iter().chain(mesh.normals()).all(|v| v.is_finite()));
    assert!(mesh.uvs().iter().all(|uv| uv.is_finite()));
    assert!(mesh.triangles().as_flattened().iter().all(|&v| (v as usize) < vertices));
    assert!([0, vertices].contains(&mesh.normals().len()));
    assert!([0, vertices].contains(&mesh.uvs().len()));
}
