//! The bounding volume hierarchy: eight-wide nodes over blocks of eight triangles and single objects.
//!
//! | file | what |
//! | --- | --- |
//! | `node` | a node's boxes side by side, and references to children |
//! | `block` | eight triangles side by side |
//! | `build` | from items to nodes, top down |
//! | `split` | where to cut a range of items: binned surface area heuristic |
//! | `boxes` | a ray against the eight boxes of a node |
//! | `triangles` | a ray against the eight triangles of a block |
//! | `traverse` | closest and any hit |
//! | `simd` | eight floats at a time on what the processor offers, the only `unsafe` code |

mod binary;
mod block;
mod boxes;
mod build;
mod node;
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

pub(super) use build::TriangleRef;
pub(super) use traverse::{Found, Objects};

/// Floats in a vector, children of a node, triangles of a block.
const LANES: usize = 8;

/// A hierarchy over triangles, which it holds, and objects, which it only numbers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Bvh {
    nodes: Vec<Node>,
    blocks: Vec<TriangleBlock>,
    bounds: Aabb,
}

impl Bvh {
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
        Self { boxes: BoxRay::new(simd, ray), triangles: TriangleRay::new(simd, ray) }
    }
}
