//! One voxel of a distance field.

use etendue_math::glam::DVec3;

use super::samples::SdfSamples;

/// The values at the corners of a unit cube; bits 0, 1 and 2 of an index are the corner's x, y and z.
#[derive(Clone, Copy, Debug)]
pub(super) struct Voxel([f64; 8]);

impl Voxel {
    /// The voxel above a sample, which is not the last one along any axis.
    #[inline]
    pub(super) fn of(samples: &SdfSamples, [x, y, z]: [u32; 3]) -> Self {
        Self(core::array::from_fn(|i| {
            let i = i as u32;
            samples.value([x + (i & 1), y + (i >> 1 & 1), z + (i >> 2)])
        }))
    }

    /// The largest of the values' magnitudes.
    pub(super) fn magnitude(&self) -> f64 {
        self.0.iter().fold(0.0, |largest, value| value.abs().max(largest))
    }

    /// The trilinear interpolation.
    ///
    /// On a face of the cube only the corners of that face count, to the bit: the voxel on its other side gives the same.
    #[inline]
    pub(super) fn at(&self, p: DVec3) -> f64 {
        let [a, b, c, d, e, f, g, h] = self.0;
        let along_x = [[a, b], [c, d], [e, f], [g, h]].map(|pair| mix(pair, p.x));
        let [low, high] = [[along_x[0], along_x[1]], [along_x[2], along_x[3]]];
        mix([mix(low, p.y), mix(high, p.y)], p.z)
    }

    /// The differences along the edges, bilinearly interpolated.
    #[inline]
    pub(super) fn gradient(&self, p: DVec3) -> DVec3 {
        let [a, b, c, d, e, f, g, h] = self.0;
        let plane =
            |[a, b, c, d]: [f64; 4], u: f64, v: f64| mix([mix([a, b], u), mix([c, d], u)], v);
        DVec3::new(
            plane([b - a, d - c, f - e, h - g], p.y, p.z),
            plane([c - a, d - b, g - e, h - f], p.x, p.z),
            plane([e - a, f - b, g - c, h - d], p.x, p.y),
        )
    }

    /// The coefficients, that of the highest power last, of the cubic in `s` that the interpolation is on `p + s d`.
    #[inline]
    pub(super) fn cubic(&self, p: DVec3, d: DVec3) -> [f64; 4] {
        let [a, b, c, d_, e, f, g, h] = self.0;
        // The mixed differences: those of two axes at the corner, and how they change along the third.
        let [xy, xz, yz] = [a - b - c + d_, a - b - e + f, a - c - e + g];
        let xyz = (h - g - f + e) - xy;
        let mixed = DVec3::new(yz + xyz * p.x, xz + xyz * p.y, xy + xyz * p.z);
        [
            self.at(p),
            self.gradient(p).dot(d),
            mixed.dot(DVec3::new(d.y * d.z, d.x * d.z, d.x * d.y)),
            xyz * d.x * d.y * d.z,
        ]
    }

    /// The box of the surface in the voxel; `None` where there is none.
    ///
    /// A cut through the voxel across an axis holds a point of the surface if and only if the four values at its
    /// corners are not of one sign, and this changes only where one of them is 0: at a corner of the voxel, or where the
    /// surface cuts one of its edges. So these span the box.
    ///
    /// # Source
    /// Hansson-Söderlund, Akenine-Möller, "Tight Bounding Boxes for Voxels and Bricks in a Signed Distance Field Ray
    /// Tracer", 2023.
    pub(super) fn surface_box(&self) -> Option<[DVec3; 2]> {
        let corner = |i: usize| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64);
        let mut span = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let mut grow = |p: DVec3| span = [span[0].min(p), span[1].max(p)];
        for (i, &value) in self.0.iter().enumerate() {
            if value == 0.0 {
                grow(corner(i));
            }
            for axis in (0..3).filter(|axis| i >> axis & 1 == 0) {
                let other = self.0[i | 1 << axis];
                if (value < 0.0 && other > 0.0) || (value > 0.0 && other < 0.0) {
                    let mut p = corner(i);
                    p[axis] = value / (value - other);
                    grow(p);
                }
            }
        }
        (span[0].x <= span[1].x).then_some(span)
    }
}

/// Exact at both ends.
#[inline(always)]
fn mix([a, b]: [f64; 2], w: f64) -> f64 {
    a * (1.0 - w) + b * w
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::Real;

    const VOXEL: Voxel = Voxel([0.5, -1.0, 0.25, 2.0, -0.75, 1.5, -2.0, 0.125]);

    #[test]
    fn the_cubic_is_the_interpolation_along_a_line() {
        let (p, d) = (DVec3::new(0.2, 0.7, 0.4), DVec3::new(0.5, -0.6, 0.3));
        let [c0, c1, c2, c3] = VOXEL.cubic(p, d);
        for s in [0.0, 0.3, 0.9] {
            let value = c0 + s * (c1 + s * (c2 + s * c3));
            assert!(Real::abs(value - VOXEL.at(p + d * s)) < 1e-15);
        }
    }

    #[test]
    fn the_gradient_is_that_of_the_interpolation() {
        let p = DVec3::new(0.2, 0.7, 0.4);
        let gradient = VOXEL.gradient(p);
        for axis in 0..3 {
            let mut step = DVec3::ZERO;
            step[axis] = 0.125;
            // Linear along an axis: the difference quotient is exact up to rounding.
            let quotient = (VOXEL.at(p + step) - VOXEL.at(p - step)) / 0.25;
            assert!(Real::abs(quotient - gradient[axis]) < 1e-14);
        }
    }

    #[test]
    fn a_face_knows_only_its_own_corners() {
        let mut other = VOXEL;
        for corner in [0, 2, 4, 6] {
            other.0[corner] = 1e30;
        }
        let p = DVec3::new(1.0, 0.3, 0.6);
        assert_eq!(VOXEL.at(p).to_bits(), other.at(p).to_bits());
    }

    #[test]
    fn the_box_of_the_surface_holds_it_and_is_tight() {
        // The plane x = 0.25, and none.
        let plane = Voxel(core::array::from_fn(|i| if i & 1 == 0 { -1.0 } else { 3.0 }));
        let [min, max] = plane.surface_box().expect("a plane");
        assert_eq!((min, max), (DVec3::new(0.25, 0.0, 0.0), DVec3::new(0.25, 1.0, 1.0)));
        assert!(Voxel([1.0; 8]).surface_box().is_none());
        let [min, max] = VOXEL.surface_box().expect("it has both signs");
        let step = 1.0 / 32.0;
        for i in 0..33_u32.pow(3) {
            let p =
                DVec3::new(f64::from(i % 33), f64::from(i / 33 % 33), f64::from(i / 1089)) * step;
            let near = VOXEL.at(p);
            for axis in 0..3 {
                let mut q = p;
                q[axis] += step;
                if q[axis] <= 1.0 && (near < 0.0) != (VOXEL.at(q) < 0.0) {
                    // The surface is between the two.
                    assert!(q.cmpge(min).all() && p.cmple(max).all(), "{p} {q}");
                }
            }
        }
    }
}
