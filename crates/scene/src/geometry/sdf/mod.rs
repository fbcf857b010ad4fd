//! Surfaces of distance fields that are sampled on a grid.

mod cubic;
mod normal;
mod samples;
#[cfg(test)]
mod tests;
mod voxel;

use alloc::vec::Vec;

use etendue_math::glam::{DAffine3, DVec3, Vec3};
use etendue_math::{Real, Vector3};

use super::sphere::round_point;
use super::surface::LocalSurface;
use super::{Aabb, Ray, ShapeError, Transform};
pub use samples::{SdfError, SdfSamples};
use voxel::Voxel;

/// Which normals a distance field is shaded with. That of the geometry is the gradient in the voxel in any case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SdfNormals {
    /// Gradients blended over voxels, without edges between these.
    #[default]
    Smooth,
    /// The gradient in the voxel.
    Analytic,
}

/// Where a distance field, interpolated trilinearly between its samples, is 0. The front is where it is positive.
///
/// The field fills the unit cube of the shape's own space. Rays meet its surface from either side. It has no texture
/// coordinates, and no points are drawn on it.
///
/// # Numerics
/// Each voxel with both signs at its corners is an object of the hierarchy, with a box that is no larger than the
/// surface in it. Along a ray the field is a cubic there, of which all roots are found in `f64`
/// (`cubic::roots`). At the faces of voxels it is computed from the samples of the face alone, at a place that both
/// voxels compute in the same way, so that no ray passes between two voxels.
///
/// A hit has the bound of its error: half a unit in the last place of `f32`, and the noise of `f64` in the ray's way
/// into the grid (times the condition of the transform) and in the field over its gradient.
///
/// # Source
/// Hansson-Söderlund, Evans, Akenine-Möller, "Ray Tracing of Signed Distance Function Grids", JCGT 11(3), 2022;
/// definitions as in Mitsuba 3, `src/shapes/sdfgrid.cpp`.
#[derive(Clone, Debug, PartialEq)]
pub struct SdfGrid {
    samples: SdfSamples,
    /// The samples at the lower corners of the voxels that the surface passes through; not empty.
    voxels: Vec<u32>,
    normals: SdfNormals,
    /// From the unit cube.
    to_world: Transform,
    /// +1 where the front is where the field is positive, −1 where it is negative.
    side: f64,
}

/// A ray in units of the grid.
struct GridRay {
    origin: DVec3,
    direction: DVec3,
}

impl SdfGrid {
    /// The surface in a distance field over the unit cube, placed by a transform.
    ///
    /// # Errors
    /// [`ShapeError::NoSurface`] where all values have one sign.
    pub fn new(
        samples: SdfSamples,
        normals: SdfNormals,
        to_world: &Transform,
    ) -> Result<Self, ShapeError> {
        let [x, y, z] = samples.size().map(|n| n - 1);
        let all = (0..z).flat_map(|z| (0..y).flat_map(move |y| (0..x).map(move |x| [x, y, z])));
        let voxels: Vec<u32> = all
            .filter(|&place| Voxel::of(&samples, place).surface_box().is_some())
            .map(|place| samples.index(place))
            .collect();
        if voxels.is_empty() {
            return Err(ShapeError::NoSurface);
        }
        Ok(Self { samples, voxels, normals, to_world: *to_world, side: 1.0 })
    }

    /// The field moved by a transform.
    pub(super) fn transformed(self, transform: &Transform) -> Result<Self, ShapeError> {
        Ok(Self { to_world: transform.compose(&self.to_world)?, ..self })
    }

    /// The same surface with front and back exchanged.
    #[must_use]
    pub fn flipped(self) -> Self {
        Self { side: -self.side, ..self }
    }

    /// The field.
    pub fn samples(&self) -> &SdfSamples {
        &self.samples
    }

    /// Which normals it is shaded with.
    pub fn normals(&self) -> SdfNormals {
        self.normals
    }

    /// Where the unit cube is, and whether front and back are exchanged.
    pub fn placement(&self) -> (&DAffine3, bool) {
        (self.to_world.affine(), self.side < 0.0)
    }

    /// Voxels with a part of the surface.
    pub fn voxel_count(&self) -> u32 {
        self.voxels.len() as u32
    }

    pub(crate) fn bounds(&self) -> Aabb {
        (0..self.voxel_count()).fold(Aabb::EMPTY, |all, i| all.union(self.voxel_bounds(i)))
    }

    /// A box that holds the surface in a voxel.
    pub(crate) fn voxel_bounds(&self, number: u32) -> Aabb {
        let Some((place, voxel)) = self.voxel(number) else { return Aabb::EMPTY };
        let Some([min, max]) = voxel.surface_box() else { return Aabb::EMPTY };
        let cells = self.cells();
        let [min, max] = [min, max].map(|p| (place + p) / cells);
        let affine = self.to_world.affine();
        let center = affine.transform_point3((min + max) * 0.5);
        let half = (max - min) * 0.5;
        let m = &affine.matrix3;
        let reach = m.x_axis.abs() * half.x + m.y_axis.abs() * half.y + m.z_axis.abs() * half.z;
        // Where in f64 the surface is in the box, and a step outwards for the rounding to f32.
        let noise = (m.x_axis.abs() + m.y_axis.abs() + m.z_axis.abs() + affine.translation.abs())
            * (16.0 * f64::EPSILON);
        let (low, high) = (center - reach - noise, center + reach + noise);
        let (low, high) = (low.as_vec3(), high.as_vec3());
        Aabb {
            min: Vec3::new(low.x.next_down(), low.y.next_down(), low.z.next_down()),
            max: Vec3::new(high.x.next_up(), high.y.next_up(), high.z.next_up()),
        }
    }

    /// Voxels along each axis.
    fn cells(&self) -> DVec3 {
        let [x, y, z] = self.samples.size().map(|n| f64::from(n - 1));
        DVec3::new(x, y, z)
    }

    /// The lower corner of a voxel in units of the grid, and its values.
    fn voxel(&self, number: u32) -> Option<(DVec3, Voxel)> {
        let place = self.samples.place(*self.voxels.get(number as usize)?);
        let [x, y, z] = place.map(f64::from);
        Some((DVec3::new(x, y, z), Voxel::of(&self.samples, place)))
    }

    fn grid_ray(&self, ray: &Ray) -> GridRay {
        let (to_local, cells) = (self.to_world.inverse_affine(), self.cells());
        GridRay {
            origin: to_local.transform_point3(ray.origin.as_dvec3()) * cells,
            direction: to_local.transform_vector3(ray.direction.as_dvec3()) * cells,
        }
    }

    /// Where a ray meets the surface in a voxel, in ascending order.
    fn crossings(&self, number: u32, ray: &Ray) -> Option<impl Iterator<Item = f64>> {
        let (corner, voxel) = self.voxel(number)?;
        let GridRay { origin, direction } = self.grid_ray(ray);
        let mut span = [0.0, f64::INFINITY];
        // By axis: entered through the side that is met first, left through the other one.
        let mut sides = [[(f64::NAN, 0.0); 2]; 3];
        for axis in 0..3 {
            let (o, d) = (origin[axis], direction[axis]);
            let [near, far] = if d < 0.0 { [1.0, 0.0] } else { [0.0, 1.0] };
            if d == 0.0 {
                // In the plane of a side it is in both voxels.
                if o < corner[axis] || o > corner[axis] + 1.0 {
                    return None;
                }
                continue;
            }
            let meets = |side: f64| ((corner[axis] + side - o) / d, side);
            sides[axis] = [meets(near), meets(far)];
            span = [span[0].max(sides[axis][0].0), span[1].min(sides[axis][1].0)];
        }
        let [enter, leave] = span;
        if !(enter <= leave && leave < f64::INFINITY) {
            return None;
        }
        // On a side to the bit, so that both voxels there have the same value.
        let point = |t: f64| {
            let mut p = origin + direction * t - corner;
            for axis in 0..3 {
                let on = sides[axis].iter().find(|(met, _)| *met == t);
                p[axis] = on.map_or(p[axis].clamp_to(0.0, 1.0), |&(_, side)| side);
            }
            p
        };
        let (start, end) = (point(enter), voxel.at(point(leave)));
        let cubic = voxel.cubic(start, direction * (leave - enter));
        Some(cubic::roots(cubic, end).map(move |s| enter + s * (leave - enter)))
    }

    pub(crate) fn intersect(&self, number: u32, ray: &Ray) -> Option<f32> {
        let crossings = self.crossings(number, ray)?;
        crossings.map(|t| t as f32).find(|&t| t > 0.0 && t < ray.t_max)
    }

    pub(crate) fn surface(&self, number: u32, ray: &Ray, t: f32) -> LocalSurface {
        let rounded = f64::from(t);
        // The root in f64 that was rounded to `t`.
        let distance = |t: f64| Real::abs(t - rounded);
        let t = self
            .crossings(number, ray)
            .and_then(|all| all.min_by(|a, b| distance(*a).total_cmp(&distance(*b))))
            .unwrap_or(rounded);
        let (corner, voxel) =
            self.voxel(number).unwrap_or((DVec3::ZERO, Voxel::of(&self.samples, [0; 3])));
        let grid = self.grid_ray(ray);
        let (p, cells) = (grid.origin + grid.direction * t, self.cells());
        let local = (p - corner).clamp(DVec3::ZERO, DVec3::ONE);
        let to_world =
            |gradient: DVec3| self.to_world.inverse_affine().matrix3.transpose() * gradient;
        let gradient = to_world(voxel.gradient(local) * cells);
        let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        // Where the field is flat, whence the ray came.
        let unit = |n: DVec3| Vector3::try_normalize(n);
        let normal = unit(gradient).or(unit(-direction)).unwrap_or(DVec3::Z);
        let shading = match self.normals {
            SdfNormals::Smooth => unit(to_world(normal::smooth(&self.samples, p))),
            SdfNormals::Analytic => None,
        };
        let [normal, shading_normal] =
            [normal, shading.unwrap_or(normal)].map(|n| (n * self.side).as_vec3());
        let affine = self.to_world.affine();
        let length = |v: DVec3| Vector3::length(v);
        let size =
            |m: &etendue_math::glam::DMat3| length(m.x_axis) + length(m.y_axis) + length(m.z_axis);
        let condition = size(&affine.matrix3) * size(&self.to_world.inverse_affine().matrix3);
        let way = length(origin) + length(direction) * Real::abs(t) + length(affine.translation);
        let (position, error) = round_point(origin + direction * t, DVec3::ZERO, way * condition);
        // A dozen roundings of products in the cubic and its root; no farther than the voxel is large.
        let flat = 32.0 * f64::EPSILON * voxel.magnitude() / length(gradient);
        let voxel_size = size(&affine.matrix3) / cells.min_element();
        LocalSurface {
            position,
            error: error + Vec3::splat(flat.min(voxel_size) as f32),
            normal,
            shading_normal,
            uv: [0.0; 2],
            tangent: None,
            primitive: number,
        }
    }
}
