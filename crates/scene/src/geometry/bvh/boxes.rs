//! A ray against the eight boxes of a node.

use super::LANES;
use super::node::Node;
use super::simd::Simd;
use crate::geometry::Ray;

/// A ray as the box test wants it, in vectors.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoxRay<F> {
    origin: [F; 3],
    /// Reciprocals of the direction, shrunk for where boxes begin, stretched for where they end. Once
    /// here instead of after the distances: every node waits for those.
    to_near: [F; 3],
    to_far: [F; 3],
    /// For each axis, which of its two rows in [`Node::bounds`] the ray meets first.
    near: [Row; 3],
}

/// A row of [`Node::bounds`] as an index that needs no check.
#[derive(Clone, Copy, Debug)]
enum Row {
    Least,
    Largest,
}

impl Row {
    /// The one that a ray meets first along an axis, by the reciprocal of its direction: its sign, so
    /// that −0 selects the rows that fit its −∞.
    #[inline(always)]
    fn first(inverse: f32) -> Self {
        if inverse.is_sign_negative() { Self::Largest } else { Self::Least }
    }
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

impl<F: Copy> BoxRay<F> {
    /// `inverse`: reciprocals of the ray's direction.
    #[inline(always)]
    pub(super) fn new<S: Simd<F = F>>(simd: S, ray: &Ray, inverse: [f32; 3]) -> Self {
        let [x, y, z] = inverse;
        let (shrink, stretch) = (1.0 - WIDEN, 1.0 + WIDEN);
        Self {
            origin: [simd.splat(ray.origin.x), simd.splat(ray.origin.y), simd.splat(ray.origin.z)],
            to_near: [simd.splat(x * shrink), simd.splat(y * shrink), simd.splat(z * shrink)],
            to_far: [simd.splat(x * stretch), simd.splat(y * stretch), simd.splat(z * stretch)],
            near: [Row::first(x), Row::first(y), Row::first(z)],
        }
    }
}

/// Which boxes the ray meets before `t_max`, as a mask, and a lower bound on where it enters them.
///
/// ```text
/// t₀ = max(0, max over axes of (near − o) · (1 − w)/d),  t₁ = min(t_max, min of (far − o) · (1 + w)/d)
/// met where t₀ ≤ t₁
/// ```
///
/// A ray in the plane of a side gives 0·∞ = NaN on that axis: `max` and `min` return their second
/// operand then, the bound so far, and the axis does not constrain. Empty boxes give +∞ ≤ −∞.
#[inline(always)]
pub(super) fn entered<S: Simd>(
    simd: S,
    node: &Node,
    ray: &BoxRay<S::F>,
    t_max: f32,
) -> (u32, [f32; LANES]) {
    let mut enter = simd.splat(0.0);
    let mut leave = simd.splat(t_max);
    for axis in 0..3 {
        let row = ray.near[axis] as usize;
        let near = simd.sub(simd.load(&node.bounds[axis][row]), ray.origin[axis]);
        let far = simd.sub(simd.load(&node.bounds[axis][1 - row]), ray.origin[axis]);
        enter = simd.max(simd.mul(near, ray.to_near[axis]), enter);
        leave = simd.min(simd.mul(far, ray.to_far[axis]), leave);
    }
    (simd.bits(simd.le(enter, leave)), simd.store(enter))
}
