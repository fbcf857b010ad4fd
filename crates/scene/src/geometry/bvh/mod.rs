//! The bounding volume hierarchy: eight-wide nodes over blocks of eight triangles and single objects.
//!
//! | file | what |
//! | --- | --- |
//! | `node` | a node's boxes side by side, and references to children |
//! | `block` | eight triangles side by side |
//! | `presplit`, `clip` | large triangles with much empty space in their boxes, in several parts |
//! | `binary` | from items to a binary tree, top down |
//! | `split` | where to cut a range of items: binned surface area heuristic |
//! | `reinsert` | moving nodes of the binary tree to better places |
//! | `collapse` | which of its nodes become the children of a wide one |
//! | `build` | all of these in turn, to wide nodes and blocks |
//! | `boxes` | a ray against the eight boxes of a node |
//! | `triangles` | a ray against the eight triangles of a block |
//! | `traverse` | closest and any hit |
//! | `simd` | eight floats at a time on what the processor offers, prefetching, a stack that is not zeroed, large pages: the only `unsafe` code |
//!
//! Rays are checked before they come here: a NaN constrains nothing, so that such a ray would enter
//! empty boxes as well, which stand for the root, and go round for ever.
//!
//! # What has been tried and is not here
//! Speed relative to the same code without the change, on an AVX2 processor, on a box of 32 triangles
//! and on scans of 70 000 to 100 000:
//!
//! * leaves of at most 4 or 6 triangles in the blocks of eight (with nodes collapsed greedily):
//!   0.83–0.93 and 0.92–1.00 times, with more nodes and emptier blocks;
//! * pushing the children for any-hit at once, packed by a permutation: 0.91 times on scans, 1.0 in
//!   the box. Perhaps because the next node is then known only after movemask, table, permutation,
//!   store and load in turn, while a loop over bits lets the processor guess and run ahead;
//! * any-hit that keeps one child off the stack, or children by size of their box: 0.95–1.0 times;
//! * intervals in boxes widened once after all axes, with three vectors of the ray less to keep: 0.95 and
//!   0.96 times, because every node waits for one product more;
//! * a way out of the triangle test before its division where no edge functions fit: 0.98–1.0 times;
//! * the longest axis of a ray from a table instead of by comparisons: 0.88–0.98 times;
//! * a product with the reciprocal for the shear instead of a division: no difference.
//!
//! The same on an AVX-512 processor, in the box:
//!
//! * the closest hit kept lane by lane and picked at the end, with no branch on whether a block is hit:
//!   0.95 times. A quarter fewer branches are mispredicted, but every block waits for the one before;
//! * that, and all five blocks in turn without a look at their boxes: 0.86 times;
//! * the ray handed to objects by value, so that no copy of it is in memory: no difference;
//! * the whole program without LLVM's vectorisation of straight-line code, which takes vectors apart
//!   into two and one: 0.97 times.
//!
//! On an AVX-512 processor, on the meshes of `tests/embree`:
//!
//! * boxes by a fused product and sum, with three vectors of the ray more to keep: 0.94–1.0 times, 1.03–1.06 on a scan of 400 000;
//! * splitting triangles while ranges are cut (Stich's spatial splits, for an overlap above 10⁻⁵ of the scene): in an interior
//!   0.87–0.92 times, in a stadium 0.73–0.86 although the expected cost is 0.9 times as high, on slivers nothing, since no single
//!   cut pays for the triangles it doubles;
//! * reinsertion of a tenth of the nodes, four times, instead of three tenths, six times: 0.9–0.95 times in a stadium.

mod binary;
mod block;
mod boxes;
mod build;
mod clip;
mod collapse;
mod node;
mod presplit;
mod reinsert;
pub(super) mod simd;
mod split;
mod traverse;
mod triangles;

use alloc::vec::Vec;

use super::{Aabb, Ray};
use block::TriangleBlock;
use boxes::BoxRay;
use node::Node;
use simd::Simd;
use triangles::TriangleRay;

pub(super) use build::{TriangleRef, Triangles};
pub(super) use traverse::{Found, Objects};

/// Floats in a vector, children of a node, triangles of a block.
const LANES: usize = 8;

/// A hierarchy over triangles, which it holds, and objects, which it only numbers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Bvh {
    nodes: Vec<Node>,
    blocks: Vec<TriangleBlock>,
    bounds: Aabb,
    left_out: usize,
}

impl Bvh {
    /// How many triangles no ray can hit, and are not in it.
    pub(super) fn left_out(&self) -> usize {
        self.left_out
    }

    /// A box that holds everything.
    pub(super) fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Nodes.
    pub(super) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// Memory of nodes and blocks in bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice()) + size_of_val(self.blocks.as_slice())
    }
}

/// A ray with what the tests of boxes and triangles want to know of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct PreparedRay<F> {
    boxes: BoxRay<F>,
    triangles: TriangleRay<F>,
}

impl<F: Copy> PreparedRay<F> {
    /// For a ray that [is valid](Ray::is_valid).
    #[inline(always)]
    pub(super) fn new<S: Simd<F = F>>(simd: S, ray: &Ray) -> Self {
        let [x, y, z] = ray.direction.to_array();
        let inverse = [1.0 / x, 1.0 / y, 1.0 / z];
        Self {
            boxes: BoxRay::new(simd, ray, inverse),
            triangles: TriangleRay::new(simd, ray, inverse),
        }
    }
}
