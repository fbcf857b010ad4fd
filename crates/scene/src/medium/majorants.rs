//! Bounds of a density, region by region.

use alloc::vec::Vec;

use etendue_math::glam::Vec3;

use super::Volume;
use crate::geometry::Aabb;

/// Regions along each axis: enough to tell dense from thin, few enough to cross quickly.
const REGIONS: usize = 16;

/// A coarse grid of bounds over a box.
///
/// # Source
/// Szirmay-Kalos, Tóth, Magdics, "Free Path Sampling in High Resolution Inhomogeneous Participating
/// Media", CGF 30(1), 2011; crossed as in Amanatides, Woo, "A Fast Voxel Traversal Algorithm for Ray
/// Tracing", Eurographics 1987.
#[derive(Clone, Debug)]
pub(super) struct Majorants {
    bounds: Aabb,
    /// Edge lengths of a region.
    edge: Vec3,
    /// Of all regions, x fastest.
    values: Vec<f32>,
}

/// A part of a ray through a region, and the bound there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Where it begins, as a parameter of the ray.
    pub begin: f32,
    /// Where it ends.
    pub end: f32,
    /// A bound of the extinction σt in every channel.
    pub majorant: f32,
}

impl Majorants {
    /// The bounds of a volume within its box, times `scale`.
    pub(super) fn new(volume: &Volume, scale: f32) -> Self {
        // Interpolation rounds a few times, and so does the place of a region.
        const ROUNDING: f32 = 1.0 + 16.0 * f32::EPSILON;
        let bounds = volume.bounds();
        let edge = bounds.extent() / REGIONS as f32;
        let mut values = Vec::with_capacity(REGIONS * REGIONS * REGIONS);
        for z in 0..REGIONS {
            for y in 0..REGIONS {
                for x in 0..REGIONS {
                    let corner = |by: usize| {
                        let index = Vec3::new((x + by) as f32, (y + by) as f32, (z + by) as f32);
                        bounds.min + edge * index
                    };
                    let region = Aabb { min: corner(0), max: corner(1) };
                    values.push(volume.largest_within(&region) * scale * ROUNDING);
                }
            }
        }
        Self { bounds, edge, values }
    }

    /// The largest of all.
    pub(super) fn largest(&self) -> f32 {
        self.values.iter().copied().fold(0.0, f32::max)
    }

    /// The stretches of the ray `origin + t·direction` with `0 < t < t_max`, in order and without
    /// gaps; none outside of the box.
    #[inline]
    pub(super) fn along(&self, origin: Vec3, direction: Vec3, t_max: f32) -> Crossing<'_> {
        let mut crossing =
            Crossing { majorants: self, t: 0.0, t_end: t_max, cell: [0; 3], axes: [Axis::NONE; 3] };
        for axis in 0..3 {
            let (o, d) = (origin[axis], direction[axis]);
            let (min, max) = (self.bounds.min[axis], self.bounds.max[axis]);
            if d == 0.0 {
                if !(min..=max).contains(&o) {
                    crossing.t_end = 0.0;
                }
                continue;
            }
            let [near, far] = if d > 0.0 { [min, max] } else { [max, min] };
            crossing.t = crossing.t.max((near - o) / d);
            crossing.t_end = crossing.t_end.min((far - o) / d);
        }
        for axis in 0..3 {
            let (o, d) = (origin[axis], direction[axis]);
            let (min, edge) = (self.bounds.min[axis], self.edge[axis]);
            let place = (o + d * crossing.t - min) / edge;
            // A cast moves NaN, of a flat box, and what is outside to an end.
            let cell = (place as usize).min(REGIONS - 1);
            crossing.cell[axis] = cell;
            if d != 0.0 {
                let wall = if d > 0.0 { cell + 1 } else { cell };
                crossing.axes[axis] = Axis {
                    forwards: d > 0.0,
                    next: (min + edge * wall as f32 - o) / d,
                    step: (edge / d).abs(),
                };
            }
        }
        crossing
    }
}

/// A ray on its way through the regions.
#[derive(Clone, Debug)]
pub(super) struct Crossing<'a> {
    majorants: &'a Majorants,
    t: f32,
    t_end: f32,
    cell: [usize; 3],
    axes: [Axis; 3],
}

#[derive(Clone, Copy, Debug)]
struct Axis {
    forwards: bool,
    /// Where the ray meets the next wall between regions.
    next: f32,
    step: f32,
}

impl Axis {
    /// An axis along which a ray does not move.
    const NONE: Self = Self { forwards: true, next: f32::INFINITY, step: f32::INFINITY };
}

impl Iterator for Crossing<'_> {
    type Item = Stretch;

    #[inline]
    fn next(&mut self) -> Option<Stretch> {
        // False for NaN.
        let goes_on = self.t < self.t_end;
        if !goes_on {
            return None;
        }
        let [x, y, z] = self.cell;
        let majorant = self.majorants.values[(z * REGIONS + y) * REGIONS + x];
        let axis = (0..3).fold(0, |nearest, axis| {
            if self.axes[axis].next < self.axes[nearest].next { axis } else { nearest }
        });
        let Axis { forwards, next, step } = self.axes[axis];
        let begin = self.t;
        let last = if forwards { self.cell[axis] == REGIONS - 1 } else { self.cell[axis] == 0 };
        // The last region holds what rounding leaves of the box.
        let end = if last { self.t_end } else { next.clamp(begin, self.t_end) };
        self.t = end;
        if !last {
            self.cell[axis] = if forwards { self.cell[axis] + 1 } else { self.cell[axis] - 1 };
            self.axes[axis].next = next + step;
        }
        Some(Stretch { begin, end, majorant })
    }
}
