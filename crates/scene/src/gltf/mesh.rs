//! Meshes.

use alloc::format;
use alloc::vec;
use alloc::vec::Vec;

use etendue_math::Spectrum;
use etendue_math::glam::{Vec2, Vec3};

use super::accessor::Accessor;
use super::buffers::Buffers;
use super::json::Json;
use super::skin::Skin;
use super::topology::Topology;
use crate::geometry::{AttributeOwner, MeshAttribute, MeshError, TriangleMesh};
use crate::{Color, SceneError};

/// The attribute of a mesh that holds the colours of its vertices.
pub(super) const COLOR: &str = "vertex_color";

/// The attribute that holds their opacities.
pub(super) const ALPHA: &str = "vertex_alpha";

/// A primitive as a mesh.
pub(super) struct Primitive {
    /// In the space of the node, with the [`COLOR`] and [`ALPHA`] that it has; without normals where it is faceted.
    pub(super) mesh: TriangleMesh,
    /// Whether it has texture coordinates.
    pub(super) has_uv: bool,
    /// Whether its vertices have colours.
    pub(super) has_colors: bool,
    /// Whether some of its vertices are not opaque.
    pub(super) has_alpha: bool,
}

/// The values of all vertices.
struct Vertices {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    colors: Vec<[f32; 4]>,
}

/// Reads a primitive with its `set`-th texture coordinates, where a skin takes it if there is one. `None` where it has no surface.
///
/// # Errors
/// What is not there or does not fit together, coordinates that are not finite, colours that are negative.
pub(super) fn read(
    buffers: &Buffers<'_>,
    primitive: &Json<'_>,
    set: usize,
    skin: Option<&Skin>,
) -> Result<Option<Primitive>, SceneError> {
    let topology = Topology::of(primitive)?;
    if topology == Topology::NoSurface {
        return Ok(None);
    }
    let attributes = primitive.need("attributes")?;
    let Some(positions) = Accessor::named(buffers, &attributes, "POSITION")? else {
        return Ok(None);
    };
    let mut vertices = vertices(buffers, &attributes, &positions, set)?;
    let count = vertices.positions.len();
    if let Some(skin) = skin {
        let influences = skin.influences(buffers, &attributes, count)?;
        skin.pose(&influences, &mut vertices.positions, &mut vertices.normals);
    }
    let indices = match Accessor::named(buffers, primitive, "indices")? {
        Some(accessor) => {
            let indices = accessor.indices()?;
            if let Some(at) = indices.iter().position(|&index| index as usize >= count) {
                return Err(accessor.error(format!(
                    "index {at} is {}, but {} has {count} vertices",
                    indices[at],
                    primitive.place()
                )));
            }
            indices
        }
        None => (0..count as u32).collect(),
    };
    let mut triangles = topology.triangles(&indices);
    vertices.drop_unused(&mut triangles);
    let Vertices { positions, normals, uvs, colors } = vertices;
    let has_uv = !uvs.is_empty();
    let has_colors = colors.iter().any(|color| color[..3] != [1.0; 3]);
    let has_alpha = colors.iter().any(|color| color[3] != 1.0);
    let mut mesh = TriangleMesh::new(positions, normals, uvs, triangles)
        .map_err(|error| attributes.error(error))?;
    for (name, is_there, value) in
        [(COLOR, has_colors, color_of as fn(&[f32; 4]) -> Color), (ALPHA, has_alpha, alpha_of)]
    {
        if is_there {
            let values = colors.iter().map(value).collect();
            let attribute =
                MeshAttribute { name: name.into(), owner: AttributeOwner::Vertex, values };
            mesh = mesh
                .with_attribute(attribute)
                .map_err(|error| attributes.error(format!("COLOR_0: {error}")))?;
        }
    }
    Ok(Some(Primitive { mesh, has_uv, has_colors, has_alpha }))
}

fn color_of(&[r, g, b, _]: &[f32; 4]) -> Color {
    Color::new(r, g, b)
}

fn alpha_of(color: &[f32; 4]) -> Color {
    Color::splat(color[3])
}

fn vertices(
    buffers: &Buffers<'_>,
    attributes: &Json<'_>,
    positions: &Accessor<'_>,
    set: usize,
) -> Result<Vertices, SceneError> {
    let count = positions.len();
    let named = |name: &str| -> Result<Option<Accessor<'_>>, SceneError> {
        let accessor = Accessor::named(buffers, attributes, name)?;
        match accessor {
            Some(accessor) if accessor.len() != count => Err(accessor.error(format!(
                "has {} elements for {count} positions (used by {}.{name})",
                accessor.len(),
                attributes.place()
            ))),
            accessor => Ok(accessor),
        }
    };
    let positions: Vec<Vec3> =
        positions.vectors::<3>(&[3], 0.0)?.into_iter().map(Vec3::from).collect();
    let mut vertices =
        Vertices { positions, normals: Vec::new(), uvs: Vec::new(), colors: Vec::new() };
    if let Some(normals) = named("NORMAL")? {
        vertices.normals = normals.vectors::<3>(&[3], 0.0)?.into_iter().map(Vec3::from).collect();
    }
    if let Some(uvs) = named(&format!("TEXCOORD_{set}"))? {
        vertices.uvs = uvs.vectors::<2>(&[2], 0.0)?.into_iter().map(Vec2::from).collect();
    }
    if let Some(colors) = named("COLOR_0")? {
        vertices.colors = colors.vectors::<4>(&[3, 4], 1.0)?;
    }
    Ok(vertices)
}

impl Vertices {
    /// Forgets vertices that no triangle has: primitives may share them with others.
    fn drop_unused(&mut self, triangles: &mut [[u32; 3]]) {
        let mut is_used = vec![false; self.positions.len()];
        for &vertex in triangles.iter().flatten() {
            is_used[vertex as usize] = true;
        }
        if is_used.iter().all(|used| *used) {
            return;
        }
        let mut next = 0;
        let number = |used: &bool| {
            let number = next;
            next += u32::from(*used);
            number
        };
        let numbers: Vec<u32> = is_used.iter().map(number).collect();
        for vertex in triangles.iter_mut().flatten() {
            *vertex = numbers[*vertex as usize];
        }
        keep(&mut self.positions, &is_used);
        keep(&mut self.normals, &is_used);
        keep(&mut self.uvs, &is_used);
        keep(&mut self.colors, &is_used);
    }
}

/// Keeps the values that are used, of a list that is as long or empty.
fn keep<T>(values: &mut Vec<T>, is_used: &[bool]) {
    let mut used = is_used.iter();
    values.retain(|_| used.next().is_some_and(|used| *used));
    values.shrink_to_fit();
}

/// The triangles whose texture is not mirrored, and those whose texture is; a mesh of neither is left out.
///
/// ```text
/// mirrored:  (∂p/∂u × ∂p/∂v) · n > 0   for v counted from the top
/// ```
///
/// Only there the second axis of glTF's tangent space, `w n × t` with w = −1, is not that of ours, `n × t`.
pub(super) fn by_handedness(mesh: TriangleMesh) -> Result<[Option<TriangleMesh>; 2], MeshError> {
    let is_mirrored = |index: usize| {
        let triangle = mesh.triangles()[index].map(|vertex| vertex as usize);
        let [p0, p1, p2] = triangle.map(|vertex| mesh.positions()[vertex]);
        let [t0, t1, t2] = triangle.map(|vertex| mesh.uvs()[vertex]);
        let side = (p1 - p0).cross(p2 - p0).dot(mesh.facet(index as u32).normal);
        side * (t1 - t0).perp_dot(t2 - t0) > 0.0
    };
    let count = mesh.triangles().len();
    let mirrored: Vec<bool> = (0..count).map(is_mirrored).collect();
    let number = mirrored.iter().filter(|is_mirrored| **is_mirrored).count();
    if number == 0 {
        return Ok([Some(mesh), None]);
    }
    if number == count {
        return Ok([None, Some(mesh)]);
    }
    let part = |of: bool| {
        let own = mesh.triangles().iter().zip(&mirrored).filter(|(_, mirrored)| **mirrored == of);
        let triangles = own.map(|(triangle, _)| *triangle).collect();
        let [positions, normals] = [mesh.positions(), mesh.normals()].map(<[Vec3]>::to_vec);
        let part = TriangleMesh::new(positions, normals, mesh.uvs().to_vec(), triangles)?;
        let attributes = mesh.attributes().iter().cloned();
        attributes.into_iter().try_fold(part, TriangleMesh::with_attribute).map(Some)
    };
    Ok([part(false)?, part(true)?])
}
