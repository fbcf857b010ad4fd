//! Triangle meshes.

use alloc::vec::Vec;

use etendue_math::glam::{Vec2, Vec3};
use etendue_math::{Frame, Vector3};

use super::surface::LocalSurface;
use super::triangle::{Corners, Facet};
use super::{Aabb, AttributeOwner, MeshArrays, MeshAttribute, MeshError, ShapeSample, Transform};
use crate::Color;
use crate::parallel;

/// A triangle mesh whose indices and coordinates have been checked.
///
/// The front of a triangle is the side to which its vertex normals point; without normals, the
/// side from which its vertices run anticlockwise. Flipping exchanges front and back.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    arrays: MeshArrays,
    /// One per triangle, its normal on the front side.
    facets: Vec<Facet>,
    flipped: bool,
}

impl From<MeshArrays> for TriangleMesh {
    fn from(arrays: MeshArrays) -> Self {
        Self { arrays, ..Self::default() }.with_facets()
    }
}

impl TriangleMesh {
    /// A mesh from its parts, as [`MeshArrays::new`].
    ///
    /// # Errors
    /// As [`MeshArrays::new`].
    pub fn new(
        positions: Vec<Vec3>,
        normals: Vec<Vec3>,
        uvs: Vec<Vec2>,
        triangles: Vec<[u32; 3]>,
    ) -> Result<Self, MeshError> {
        MeshArrays::new(positions, normals, uvs, triangles).map(Self::from)
    }

    /// Vertex positions.
    pub fn positions(&self) -> &[Vec3] {
        &self.arrays.positions
    }

    /// Vertex normals, or nothing.
    pub fn normals(&self) -> &[Vec3] {
        &self.arrays.normals
    }

    /// Vertex texture coordinates, or nothing.
    pub fn uvs(&self) -> &[Vec2] {
        &self.arrays.uvs
    }

    /// Three vertex indices per triangle.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.arrays.triangles
    }

    /// The same mesh with other vertex normals, or with none.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_normals(self, normals: Vec<Vec3>) -> Result<Self, MeshError> {
        let arrays = self.arrays.with_normals(normals)?;
        Ok(Self { arrays, ..self }.with_facets())
    }

    /// The same mesh with one more attribute.
    ///
    /// # Errors
    /// Another number of values than of vertices or triangles, a value that is NaN, infinite or negative.
    pub fn with_attribute(self, attribute: MeshAttribute) -> Result<Self, MeshError> {
        let arrays = self.arrays.with_attribute(attribute)?;
        Ok(Self { arrays, ..self })
    }

    /// The same mesh with some of its attributes.
    pub fn keep_attributes(self, keep: impl FnMut(&MeshAttribute) -> bool) -> Self {
        Self { arrays: self.arrays.keep_attributes(keep), ..self }
    }

    /// Whether front and back are exchanged.
    pub fn is_flipped(&self) -> bool {
        self.flipped
    }

    /// What the mesh knows of its surface beyond positions, normals and texture coordinates.
    pub fn attributes(&self) -> &[MeshAttribute] {
        &self.arrays.attributes
    }

    /// The attribute of a name at the point of a triangle with the barycentric weights `b₁, b₂`.
    pub(crate) fn attribute(&self, name: &str, triangle: u32, [b1, b2]: [f32; 2]) -> Option<Color> {
        let attribute = self.arrays.attributes.iter().find(|attribute| attribute.name == name)?;
        match attribute.owner {
            AttributeOwner::Vertex => {
                let [a, b, c] = self.corner_values(&attribute.values, triangle)?;
                // Just outside a triangle, by rounding, a weight may be negative.
                let color = a * (1.0 - b1 - b2) + b * b1 + c * b2;
                Some(color.to_array().map(|x| x.max(0.0)).into())
            }
            AttributeOwner::Face => attribute.values.get(triangle as usize).copied(),
        }
    }

    /// The same mesh with front and back exchanged.
    pub fn flipped(mut self) -> Self {
        for facet in &mut self.facets {
            facet.normal = -facet.normal;
        }
        Self { flipped: !self.flipped, ..self }
    }

    /// The mesh moved by a transform, as [`MeshArrays::transformed`].
    ///
    /// # Errors
    /// A vertex that leaves the range of `f32`.
    pub fn transformed(self, transform: &Transform) -> Result<Self, MeshError> {
        let arrays = self.arrays.transformed(transform)?;
        Ok(Self { arrays, ..self }.with_facets())
    }

    /// The mesh with the facets of its arrays.
    fn with_facets(self) -> Self {
        let Self { arrays, mut facets, flipped } = self;
        let front = |&[i, j, k]: &[u32; 3]| {
            let indices = [i as usize, j as usize, k as usize];
            let mut facet = Facet::of(indices.map(|v| arrays.positions[v]));
            let outward: Vec3 = match arrays.normals.as_slice() {
                [] => facet.normal,
                // One decision per triangle: the front must not change within it.
                normals => indices.iter().map(|&v| normals[v]).sum(),
            };
            let reversed = facet.normal.dot(outward) < 0.0;
            if reversed != flipped {
                facet.normal = -facet.normal;
            }
            facet
        };
        if facets.len() == arrays.triangles.len() {
            parallel::put(&mut facets, &arrays.triangles, front);
        } else {
            facets = parallel::map(&arrays.triangles, front);
        }
        Self { arrays, facets, flipped }
    }

    /// One facet per triangle.
    #[inline(always)]
    pub(crate) fn facets(&self) -> &[Facet] {
        &self.facets
    }

    /// The facet of a triangle, `triangle < self.arrays.triangles().len()`.
    #[inline(always)]
    pub(crate) fn facet(&self, triangle: u32) -> &Facet {
        &self.facets[triangle as usize]
    }

    /// The corners of a triangle, `triangle < self.arrays.triangles().len()`.
    #[inline(always)]
    pub(crate) fn corners(&self, triangle: u32) -> Corners {
        self.facet(triangle).corners
    }

    pub(crate) fn bounds(&self) -> Aabb {
        Aabb::from_points(
            self.arrays.triangles.iter().flatten().map(|&v| self.arrays.positions[v as usize]),
        )
    }

    /// The point of a triangle with the barycentric weights `b₁, b₂` of its later corners.
    ///
    /// ```text
    /// ∂p/∂u = (Δv₂ e₁ − Δv₁ e₂)/D,  D = Δu₁ Δv₂ − Δv₁ Δu₂
    /// ```
    ///
    /// Without texture coordinates, `(u, v) = (b₁, b₂)` and the tangent is any that is
    /// orthogonal to the normal.
    ///
    /// # Source
    /// Mitsuba 3, `Mesh::compute_surface_interaction`. There, vertex normals on the other side of
    /// the geometric one leave the two at odds; here the geometric normal follows.
    #[inline(always)]
    pub(crate) fn surface(&self, triangle: u32, barycentric: [f32; 2]) -> LocalSurface {
        let facet = self.facet(triangle);
        let (position, error) = facet.point(barycentric);
        LocalSurface {
            position,
            error,
            normal: facet.normal,
            shading_normal: self.shading_normal(triangle, barycentric).unwrap_or(facet.normal),
            uv: self.uv(triangle, barycentric),
            tangent: self.tangent(triangle, &facet.corners),
            primitive: triangle,
        }
    }

    #[inline(always)]
    fn shading_normal(&self, triangle: u32, [b1, b2]: [f32; 2]) -> Option<Vec3> {
        let [n0, n1, n2] = self.corner_values(&self.arrays.normals, triangle)?;
        let normal = Vector3::try_normalize(n0 * (1.0 - b1 - b2) + n1 * b1 + n2 * b2)?;
        Some(if self.flipped { -normal } else { normal })
    }

    #[inline(always)]
    fn uv(&self, triangle: u32, [b1, b2]: [f32; 2]) -> [f32; 2] {
        match self.corner_values(&self.arrays.uvs, triangle) {
            Some([t0, t1, t2]) => (t0 * (1.0 - b1 - b2) + t1 * b1 + t2 * b2).to_array(),
            None => [b1, b2],
        }
    }

    #[inline(always)]
    fn tangent(&self, triangle: u32, [v0, v1, v2]: &Corners) -> Option<Vec3> {
        let [t0, t1, t2] = self.corner_values(&self.arrays.uvs, triangle)?;
        let (d1, d2) = (t1 - t0, t2 - t0);
        let (e1, e2) = (*v1 - *v0, *v2 - *v0);
        let scale = 1.0 / (d1.x * d2.y - d1.y * d2.x);
        Some((e1 * d2.y - e2 * d1.y) * scale).filter(|du| du.is_finite())
    }

    /// `∂p/∂u` and `∂p/∂v` of a triangle; without texture coordinates, two tangents of unit length.
    pub(crate) fn partials(&self, triangle: u32) -> [Vec3; 2] {
        let facet = self.facet(triangle);
        let [v0, v1, v2] = facet.corners;
        let (e1, e2) = (v1 - v0, v2 - v0);
        let of_coordinates = |[t0, t1, t2]: [Vec2; 3]| {
            let (d1, d2) = (t1 - t0, t2 - t0);
            let scale = 1.0 / (d1.x * d2.y - d1.y * d2.x);
            let partials = [(e1 * d2.y - e2 * d1.y) * scale, (e2 * d1.x - e1 * d2.x) * scale];
            partials.iter().all(|d| d.is_finite()).then_some(partials)
        };
        self.corner_values(&self.arrays.uvs, triangle).and_then(of_coordinates).unwrap_or_else(
            || {
                let Frame { s, t, .. } = Frame::<f32>::from_normal(facet.normal);
                [s, t]
            },
        )
    }

    /// What the mesh knows of the three corners; `None` where it knows nothing of the kind.
    #[inline(always)]
    fn corner_values<T: Copy>(&self, values: &[T], triangle: u32) -> Option<[T; 3]> {
        if values.is_empty() {
            return None;
        }
        let [i, j, k] = self.arrays.triangles[triangle as usize];
        Some([values[i as usize], values[j as usize], values[k as usize]])
    }

    /// The same point as a sample of the triangle's area.
    #[inline(always)]
    pub(crate) fn at(&self, triangle: u32, barycentric: [f32; 2]) -> ShapeSample {
        let facet = self.facet(triangle);
        let (position, error) = facet.point(barycentric);
        ShapeSample {
            position,
            error,
            normal: facet.normal,
            uv: self.uv(triangle, barycentric),
            pdf_area: if facet.area > 0.0 { 1.0 / facet.area } else { 0.0 },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Hit, ShapeId};
    use alloc::vec;
    use etendue_math::Spectrum;

    #[test]
    fn bad_indices_and_coordinates_are_refused() {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
        let ok = TriangleMesh::new(positions.clone(), vec![], vec![], vec![[0, 1, 2]]);
        assert_eq!(ok.map(|m| m.triangles().len()), Ok(1));
        assert_eq!(
            TriangleMesh::new(positions.clone(), vec![], vec![], vec![[0, 1, 3]]),
            Err(MeshError::IndexOutOfRange { triangle: 0, vertex: 3, vertices: 3 })
        );
        assert_eq!(
            TriangleMesh::new(vec![Vec3::NAN], vec![], vec![], vec![]),
            Err(MeshError::NotFinite { attribute: "position", vertex: 0 })
        );
        assert_eq!(
            TriangleMesh::new(positions, vec![Vec3::Z], vec![], vec![]),
            Err(MeshError::LengthMismatch { attribute: "normal", found: 1, vertices: 3 })
        );
    }

    /// One triangle in the plane z = 0, anticlockwise as seen from +z.
    fn one(normals: Vec<Vec3>, uvs: Vec<Vec2>) -> TriangleMesh {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
        TriangleMesh::new(positions, normals, uvs, vec![[0, 1, 2]]).expect("a valid mesh")
    }

    #[test]
    fn vertex_normals_decide_which_side_is_the_front() {
        let b = [0.25, 0.25];
        assert_eq!(one(vec![], vec![]).surface(0, b).normal, Vec3::Z);
        let against = one(vec![-Vec3::Z; 3], vec![]);
        assert_eq!(against.surface(0, b).normal, -Vec3::Z);
        assert_eq!(against.flipped().surface(0, b).shading_normal, Vec3::Z);
        // A zero normal stands for the geometric one.
        assert_eq!(one(vec![Vec3::ZERO; 3], vec![]).surface(0, b).shading_normal, Vec3::Z);
    }

    #[test]
    fn mirroring_keeps_vertex_normals_outside_and_reverses_bare_triangles() {
        let mirror = Transform::scale(etendue_math::glam::DVec3::new(-1.0, 1.0, 1.0));
        let mirror = mirror.expect("a map");
        let front = |mesh: TriangleMesh| {
            mesh.transformed(&mirror).map(|mesh| mesh.surface(0, [0.2, 0.2]).normal)
        };
        assert_eq!(front(one(vec![Vec3::Z; 3], vec![])), Ok(Vec3::Z));
        assert_eq!(front(one(vec![], vec![])), Ok(-Vec3::Z));
    }

    #[test]
    fn the_tangent_follows_the_texture_coordinates() {
        let uvs = vec![Vec2::ZERO, Vec2::new(0.0, 0.5), Vec2::new(-2.0, 0.0)];
        let p = one(vec![], uvs).surface(0, [0.5, 0.25]);
        assert_eq!(p.uv, [-0.5, 0.25]);
        assert_eq!(p.tangent, Some(Vec3::Y * -0.5));
        // All three vertices at one place of the texture: any tangent will do.
        let p = one(vec![], vec![Vec2::ONE; 3]).surface(0, [0.5, 0.25]);
        assert_eq!(p.tangent, None);
        let hit = Hit {
            t: 1.0,
            uv: [0.5, 0.25],
            shape: ShapeId(0),
            primitive: 0,
            instance: u32::MAX,
            time: 0.0,
        };
        let p = p.of(&hit);
        assert!(p.shading.s.is_finite() && p.shading.s.dot(p.normal) == 0.0);
    }

    #[test]
    fn attributes_are_linear_between_vertices_and_constant_on_faces() {
        let grey = |x: f32| Color::splat(x);
        let attribute = |owner, values: &[f32]| MeshAttribute {
            name: "it".into(),
            owner,
            values: values.iter().map(|&x| grey(x)).collect(),
        };
        let with = |owner, values: &[f32]| {
            one(vec![Vec3::Z; 3], vec![]).with_attribute(attribute(owner, values))
        };
        let vertices = with(AttributeOwner::Vertex, &[1.0, 2.0, 4.0]).expect("three values");
        assert_eq!(vertices.attribute("it", 0, [0.25, 0.5]), Some(grey(2.75)));
        assert_eq!(vertices.attribute("else", 0, [0.25, 0.5]), None);
        // They stay when the mesh is moved, turned inside out or gets other normals.
        let moved = vertices.flipped().transformed(&Transform::IDENTITY);
        let bare = moved.and_then(|mesh| mesh.with_normals(vec![])).expect("a valid mesh");
        assert_eq!(bare.attribute("it", 0, [0.0, 1.0]), Some(grey(4.0)));
        let face = with(AttributeOwner::Face, &[0.5]).expect("one value");
        assert_eq!(face.attribute("it", 0, [0.25, 0.5]), Some(grey(0.5)));
        let refused = |owner, values: &[f32]| with(owner, values).err();
        assert_eq!(
            refused(AttributeOwner::Face, &[1.0, 2.0]),
            Some(MeshError::AttributeLength { found: 2, expected: 1 })
        );
        assert_eq!(
            refused(AttributeOwner::Vertex, &[1.0, -1.0, 0.0]),
            Some(MeshError::AttributeValue { index: 1 })
        );
    }
}
