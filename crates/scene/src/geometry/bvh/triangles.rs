//! A ray against the eight triangles of a block.

use super::LANES;
use super::block::TriangleBlock;
use super::simd::Simd;
use crate::geometry::Ray;

/// A ray as the triangle test wants it, in vectors: the axis along which it is longest and the shear
/// that turns it into that axis.
///
/// No closures over vectors here: they would be compiled apart, without the kernel's instructions.
#[derive(Clone, Copy, Debug)]
pub(super) struct TriangleRay<F> {
    /// The two other axes and the longest one.
    axes: [usize; 3],
    /// Origin along these axes.
    origin: [F; 3],
    /// Direction along the other axes over that along the longest.
    shear: [F; 2],
    /// Reciprocal of the direction along the longest.
    inverse: f32,
}

impl<F: Copy> TriangleRay<F> {
    #[inline(always)]
    pub(super) fn new<S: Simd<F = F>>(simd: S, ray: &Ray) -> Self {
        let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
        let size = ray.direction.abs();
        let z = if size.x >= size.y && size.x >= size.z {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        Self {
            axes: [x, y, z],
            origin: [simd.splat(o[x]), simd.splat(o[y]), simd.splat(o[z])],
            shear: [simd.splat(d[x] / d[z]), simd.splat(d[y] / d[z])],
            inverse: 1.0 / d[z],
        }
    }

    #[inline(always)]
    fn shear<S: Simd<F = F>>(&self, simd: S, corner: &[[f32; LANES]; 3]) -> Sheared<F> {
        let x = simd.sub(simd.load(&corner[self.axes[0]]), self.origin[0]);
        let y = simd.sub(simd.load(&corner[self.axes[1]]), self.origin[1]);
        let z = simd.sub(simd.load(&corner[self.axes[2]]), self.origin[2]);
        Sheared {
            x: simd.sub(x, simd.mul(self.shear[0], z)),
            y: simd.sub(y, simd.mul(self.shear[1], z)),
            z,
        }
    }
}

/// The triangles of a block that a ray hits.
pub(super) struct BlockHits {
    /// One bit per lane.
    pub(super) mask: u32,
    pub(super) t: [f32; LANES],
    /// Barycentric weights of the second and third corner.
    pub(super) b1: [f32; LANES],
    pub(super) b2: [f32; LANES],
}

/// A corner in the sheared space of the ray, in which the ray is the z axis.
struct Sheared<F> {
    x: F,
    y: F,
    z: F,
}

impl<F: Copy> Sheared<F> {
    #[inline(always)]
    fn store<S: Simd<F = F>>(&self, simd: S) -> [[f32; LANES]; 3] {
        [simd.store(self.x), simd.store(self.y), simd.store(self.z)]
    }
}

/// The triangles that the ray hits at `0 < t < t_max`.
///
/// Corners are moved to the ray's origin and sheared so that the ray is the z axis; then
///
/// ```text
/// U = Cx By − Cy Bx,  V = Ax Cy − Ay Cx,  W = Bx Ay − By Ax        hit: U, V, W of one sign
/// t = (U Az + V Bz + W Cz)/(U + V + W)/dz
/// ```
///
/// Two triangles with a common edge compute the same products for it, so that its sign is the same
/// or opposite and no ray passes between them; therefore no fused multiply-add. Where a function is
/// exactly 0 it is computed again in `f64`, in which products of `f32` are exact.
///
/// t is the mean of the corners' depths, with positive weights: there is no cancellation, and a
/// sliver cannot give a t outside its own range of depths, as the plane equation can.
///
/// # Source
/// Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
#[inline(always)]
pub(super) fn hits<S: Simd>(
    simd: S,
    block: &TriangleBlock,
    ray: &TriangleRay<S::F>,
    t_max: f32,
) -> Option<BlockHits> {
    let a = ray.shear(simd, &block.corners[0]);
    let b = ray.shear(simd, &block.corners[1]);
    let c = ray.shear(simd, &block.corners[2]);
    let u = simd.sub(simd.mul(c.x, b.y), simd.mul(c.y, b.x));
    let v = simd.sub(simd.mul(a.x, c.y), simd.mul(a.y, c.x));
    let w = simd.sub(simd.mul(b.x, a.y), simd.mul(b.y, a.x));

    // Comparisons with NaN are false: lanes without a triangle fall out here.
    let zero = simd.splat(0.0);
    let least = simd.min(u, simd.min(v, w));
    let largest = simd.max(u, simd.max(v, w));
    let inside = simd.le(zero, least) | simd.le(largest, zero);
    if inside == 0 {
        return None;
    }
    let on_edge = inside & (simd.eq(u, zero) | simd.eq(v, zero) | simd.eq(w, zero));
    let determinant = simd.add(u, simd.add(v, w));
    let depth = simd.add(simd.mul(u, a.z), simd.add(simd.mul(v, b.z), simd.mul(w, c.z)));
    let t = simd.mul(simd.div(depth, determinant), simd.splat(ray.inverse));
    let in_range = simd.lt(zero, t) & simd.lt(t, simd.splat(t_max));
    let mut found = BlockHits {
        mask: inside & in_range & !on_edge,
        t: simd.store(t),
        b1: simd.store(simd.div(v, determinant)),
        b2: simd.store(simd.div(w, determinant)),
    };
    if on_edge != 0 {
        redo_on_edges(
            &mut found,
            on_edge,
            &[a.store(simd), b.store(simd), c.store(simd)],
            ray.inverse,
            t_max,
        );
    }
    (found.mask != 0).then_some(found)
}

/// Decides the lanes in which an edge function is 0 again in `f64`.
#[cold]
fn redo_on_edges(
    found: &mut BlockHits,
    lanes: u32,
    sheared: &[[[f32; LANES]; 3]; 3],
    inverse_depth: f32,
    t_max: f32,
) {
    for lane in (0..LANES).filter(|lane| lanes >> lane & 1 == 1) {
        let [a, b, c] = sheared.map(|corner| corner.map(|axis| f64::from(axis[lane])));
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        let determinant = u + v + w;
        let one_sign = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
        let t = (u * a[2] + v * b[2] + w * c[2]) / determinant * f64::from(inverse_depth);
        let t = t as f32;
        // A triangle seen edge-on has determinant 0 and t NaN.
        if one_sign && determinant != 0.0 && t > 0.0 && t < t_max {
            found.mask |= 1 << lane;
            found.t[lane] = t;
            found.b1[lane] = (v / determinant) as f32;
            found.b2[lane] = (w / determinant) as f32;
        }
    }
}
