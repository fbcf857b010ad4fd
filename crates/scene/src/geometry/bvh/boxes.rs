//! A ray against the eight boxes of a node.

use super::LANES;
use super::node::Node;
use super::simd::Simd;
use crate::geometry::Ray;

/// A ray as the box test wants it.
#[derive(Clone, Copy, Debug)]
pub(in crate::geometry) struct BoxRay {
    origin: [f32; 3],
    inverse: [f32; 3],
    /// For each axis, which of the six rows of [`Node::bounds`] the ray meets first.
    near: [usize; 3],
}

/// How much the interval in a box is widened at either end, `2 γ(9)` with γ in units of 2⁻²⁴.
///
/// A box must be entered by every ray that the test of a triangle in it accepts. Each slab distance
/// has three roundings (difference, reciprocal, product), and the triangle test moves the corners,
/// as seen from the origin, by up to five (difference along two axes, shear, product, difference):
/// eight in all, relative to the same distance. One more for the widening itself.
///
/// # Source
/// Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013, which counts the first three.
const WIDEN: f32 = 18.0 * 0.5 * f32::EPSILON;

impl BoxRay {
    #[inline(always)]
    pub(super) fn new(ray: &Ray) -> Self {
        let inverse = ray.direction.to_array().map(|d| 1.0 / d);
        // The sign of the reciprocal, so that −0 selects the rows that fit its −∞.
        let near =
            core::array::from_fn(|axis| 2 * axis + usize::from(inverse[axis].is_sign_negative()));
        Self { origin: ray.origin.to_array(), inverse, near }
    }
}

/// Which boxes the ray meets before `t_max`, as a mask, and a lower bound on where it enters them.
///
/// ```text
/// t₀ = max(0, max over axes of (near − o)/d · (1 − w)),  t₁ = min(t_max, min of (far − o)/d · (1 + w))
/// met where t₀ ≤ t₁
/// ```
///
/// A ray in the plane of a side gives 0·∞ = NaN on that axis: `max` and `min` return their second
/// operand then, the bound so far, and the axis does not constrain. Empty boxes give +∞ ≤ −∞.
#[inline(always)]
pub(super) fn entered<S: Simd>(
    simd: S,
    node: &Node,
    ray: &BoxRay,
    t_max: f32,
) -> (u32, [f32; LANES]) {
    let (shrink, stretch) = (simd.splat(1.0 - WIDEN), simd.splat(1.0 + WIDEN));
    let mut enter = simd.splat(0.0);
    let mut leave = simd.splat(f32::INFINITY);
    for axis in 0..3 {
        let origin = simd.splat(ray.origin[axis]);
        let inverse = simd.splat(ray.inverse[axis]);
        let row = ray.near[axis];
        let near = simd.mul(simd.sub(simd.load(&node.bounds[row]), origin), inverse);
        let far = simd.mul(simd.sub(simd.load(&node.bounds[row ^ 1]), origin), inverse);
        enter = simd.max(near, enter);
        leave = simd.min(far, leave);
    }
    let enter = simd.mul(enter, shrink);
    let leave = simd.min(simd.mul(leave, stretch), simd.splat(t_max));
    (simd.le(enter, leave), simd.store(enter))
}
