//! A ray against the eight triangles of a block.

use super::LANES;
use super::block::TriangleBlock;
use super::simd::Simd;
use super::traverse::{Found, lanes};
use crate::geometry::Ray;

/// A ray as the triangle test wants it, in vectors: the axis along which it is longest and the shear
/// that turns it into that axis.
///
/// No closures over vectors here: they would be compiled apart, without the kernel's instructions.
#[derive(Clone, Copy, Debug)]
pub(super) struct TriangleRay<F> {
    /// The two other axes and the longest one.
    axes: [Axis; 3],
    /// Origin along these axes.
    origin: [F; 3],
    /// Direction along the other axes over that along the longest.
    shear: [F; 2],
    /// Reciprocal of the direction along the longest.
    inverse: f32,
}

/// An axis as an index that needs no check.
#[derive(Clone, Copy, Debug)]
enum Axis {
    X,
    Y,
    Z,
}

impl<F: Copy> TriangleRay<F> {
    /// `inverse`: reciprocals of the ray's direction.
    #[inline(always)]
    pub(super) fn new<S: Simd<F = F>>(simd: S, ray: &Ray, inverse: [f32; 3]) -> Self {
        let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
        let size = ray.direction.abs();
        let axes = if size.x >= size.y && size.x >= size.z {
            [Axis::Y, Axis::Z, Axis::X]
        } else if size.y >= size.z {
            [Axis::Z, Axis::X, Axis::Y]
        } else {
            [Axis::X, Axis::Y, Axis::Z]
        };
        let [x, y, z] = axes.map(|axis| axis as usize);
        Self {
            axes,
            origin: [simd.splat(o[x]), simd.splat(o[y]), simd.splat(o[z])],
            shear: [simd.splat(d[x] / d[z]), simd.splat(d[y] / d[z])],
            inverse: inverse[z],
        }
    }

    #[inline(always)]
    fn shear<S: Simd<F = F>>(&self, simd: S, corner: &[[f32; LANES]; 3]) -> Sheared<F> {
        let x = simd.sub(simd.load(&corner[self.axes[0] as usize]), self.origin[0]);
        let y = simd.sub(simd.load(&corner[self.axes[1] as usize]), self.origin[1]);
        let z = simd.sub(simd.load(&corner[self.axes[2] as usize]), self.origin[2]);
        Sheared {
            x: simd.sub(x, simd.mul(self.shear[0], z)),
            y: simd.sub(y, simd.mul(self.shear[1], z)),
            z,
        }
    }
}

/// A ray against the triangles of a block, as far as both closest and any hit need it.
struct Tested<F> {
    /// Lanes that are hit at `0 < t < t_max` for sure, and lanes that have to be looked at again.
    hit: u32,
    on_edge: u32,
    t: F,
    /// Edge functions and their sum.
    v: F,
    w: F,
    determinant: F,
    corners: [Sheared<F>; 3],
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
fn test<S: Simd>(
    simd: S,
    block: &TriangleBlock,
    ray: &TriangleRay<S::F>,
    t_max: f32,
) -> Option<Tested<S::F>> {
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
    let inside = simd.bits(simd.or(simd.le(zero, least), simd.le(largest, zero)));
    let within = simd.or(simd.lt(zero, least), simd.lt(largest, zero));
    let determinant = simd.add(u, simd.add(v, w));
    let depth = simd.add(simd.mul(u, a.z), simd.add(simd.mul(v, b.z), simd.mul(w, c.z)));
    let t = simd.mul(simd.div(depth, determinant), simd.splat(ray.inverse));
    let in_range = simd.and(simd.lt(zero, t), simd.lt(t, simd.splat(t_max)));
    let hit = simd.bits(simd.and(within, in_range));
    let on_edge = inside & !simd.bits(within);
    if hit | on_edge == 0 {
        return None;
    }
    Some(Tested { hit, on_edge, t, v, w, determinant, corners: [a, b, c] })
}

/// Replaces `found` by the closest hit in a block, if it is closer.
#[inline(always)]
pub(super) fn closest<S: Simd>(
    simd: S,
    block: &TriangleBlock,
    ray: &TriangleRay<S::F>,
    found: &mut Found,
) {
    let Some(tested) = test(simd, block, ray, found.t) else { return };
    if tested.hit != 0 {
        let t = simd.store(tested.t);
        let (v, w) = (simd.store(tested.v), simd.store(tested.w));
        let determinant = simd.store(tested.determinant);
        for lane in lanes(tested.hit) {
            if t[lane] < found.t {
                let uv = [v[lane] / determinant[lane], w[lane] / determinant[lane]];
                *found = block.found(lane, t[lane], uv);
            }
        }
    }
    if tested.on_edge != 0 {
        let corners = tested.corners.map(|corner| corner.store(simd));
        for lane in lanes(tested.on_edge) {
            if let Some((t, uv)) = redo(&corners, lane, ray.inverse)
                && t < found.t
            {
                *found = block.found(lane, t, uv);
            }
        }
    }
}

/// Whether a triangle of a block is hit before `t_max`.
#[inline(always)]
pub(super) fn any<S: Simd>(
    simd: S,
    block: &TriangleBlock,
    ray: &TriangleRay<S::F>,
    t_max: f32,
) -> bool {
    let Some(tested) = test(simd, block, ray, t_max) else { return false };
    if tested.hit != 0 {
        return true;
    }
    if tested.on_edge == 0 {
        return false;
    }
    let corners = tested.corners.map(|corner| corner.store(simd));
    lanes(tested.on_edge)
        .any(|lane| redo(&corners, lane, ray.inverse).is_some_and(|(t, _)| t < t_max))
}

/// Decides a lane in which an edge function is 0 again in `f64`: t and the weights of a hit.
#[cold]
fn redo(
    sheared: &[[[f32; LANES]; 3]; 3],
    lane: usize,
    inverse_depth: f32,
) -> Option<(f32, [f32; 2])> {
    let [a, b, c] = sheared.map(|corner| corner.map(|axis| f64::from(axis[lane])));
    let u = c[0] * b[1] - c[1] * b[0];
    let v = a[0] * c[1] - a[1] * c[0];
    let w = b[0] * a[1] - b[1] * a[0];
    let determinant = u + v + w;
    let one_sign = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
    let t = (u * a[2] + v * b[2] + w * c[2]) / determinant * f64::from(inverse_depth);
    let t = t as f32;
    // A triangle seen edge-on has determinant 0 and t NaN.
    (one_sign && determinant != 0.0 && t > 0.0)
        .then(|| (t, [(v / determinant) as f32, (w / determinant) as f32]))
}
