//! From items to nodes, top down.

use alloc::vec;
use alloc::vec::Vec;

use super::block::TriangleBlock;
use super::node::{Child, Content, Node};
use super::split::{self, Cut};
use super::{Bvh, LANES};
use crate::geometry::Aabb;
use crate::geometry::triangle::Corners;

/// Levels of nodes. 8¹¹ items fit into the levels below the root by halving alone, so that the
/// limit leaves the heuristic free nearly everywhere; the traversal's stack follows from it.
pub(super) const MAX_DEPTH: usize = 12;

/// Ranges with fewer items are built on the thread that finds them.
#[cfg(feature = "std")]
const PARALLEL_FROM: usize = 2048;

/// A triangle to be held by a hierarchy.
#[derive(Clone, Copy, Debug)]
pub(in crate::geometry) struct TriangleRef {
    pub(in crate::geometry) corners: Corners,
    pub(in crate::geometry) shape: u32,
    pub(in crate::geometry) primitive: u32,
}

/// What is sorted while building: a box and the number of what is in it. Triangles come first in
/// the numbering, objects after them.
#[derive(Clone, Copy, Debug)]
pub(in crate::geometry) struct Item {
    pub(super) bounds: Aabb,
    pub(super) number: u32,
}

/// A subtree with indices relative to itself; its root is its first node.
struct Subtree {
    nodes: Vec<Node>,
    blocks: Vec<TriangleBlock>,
}

/// A range of items that becomes one child.
struct Part<'a> {
    items: &'a mut [Item],
    bounds: Aabb,
}

impl Bvh {
    /// Builds the hierarchy over triangles and the boxes of objects.
    ///
    /// Subtrees are built in parallel with the feature `std` and joined in order: the result does
    /// not depend on the number of threads. Items with an empty or NaN box are left out.
    pub(in crate::geometry) fn build(triangles: &[TriangleRef], objects: &[Aabb]) -> Self {
        let boxes =
            triangles.iter().map(|t| Aabb::from_points(t.corners)).chain(objects.iter().copied());
        let mut items: Vec<Item> = (0..)
            .zip(boxes)
            .map(|(number, bounds)| Item { bounds, number })
            .filter(|item| !item.bounds.is_empty())
            .collect();
        let bounds = items.iter().fold(Aabb::EMPTY, |b, item| b.union(item.bounds));
        let Subtree { nodes, blocks } = Builder { triangles }.node(&mut items, bounds, 0);
        Self { nodes, blocks, bounds }
    }
}

/// What every step of the construction reads.
struct Builder<'a> {
    triangles: &'a [TriangleRef],
}

impl Builder<'_> {
    /// The node over all `items` with its subtrees; `depth` is 0 at the root.
    fn node(&self, items: &mut [Item], bounds: Aabb, depth: usize) -> Subtree {
        let count = items.len();
        // Halving by number of items makes every child an eighth; free cuts only guarantee that a
        // child is no larger than its parent.
        let cut = if depth < MAX_DEPTH && count as u64 <= 8_u64.pow((MAX_DEPTH - 1 - depth) as u32)
        {
            Cut::SurfaceArea
        } else {
            Cut::Halves
        };
        let parts = self.parts(Part { items, bounds }, cut);
        let boxes: Vec<Aabb> = parts.iter().map(|part| part.bounds).collect();
        let below = |part: Part<'_>| self.child(part, depth + 1);

        #[cfg(feature = "std")]
        let children: Vec<(Child, Subtree)> = {
            use rayon::prelude::*;
            if count >= PARALLEL_FROM {
                parts.into_par_iter().map(below).collect()
            } else {
                parts.into_iter().map(below).collect()
            }
        };
        #[cfg(not(feature = "std"))]
        let children: Vec<(Child, Subtree)> = parts.into_iter().map(below).collect();

        let mut tree = Subtree { nodes: vec![Node::EMPTY], blocks: Vec::new() };
        for (lane, ((child, subtree), bounds)) in children.into_iter().zip(&boxes).enumerate() {
            let (nodes, blocks) = (tree.nodes.len() as u32, tree.blocks.len() as u32);
            tree.nodes[0].set(lane, bounds, child.shifted(nodes, blocks));
            tree.nodes.extend(subtree.nodes.into_iter().map(|mut node| {
                for child in &mut node.children {
                    *child = child.shifted(nodes, blocks);
                }
                node
            }));
            tree.blocks.extend(subtree.blocks);
        }
        tree
    }

    /// Cuts a range into up to eight, the largest one first.
    fn parts<'a>(&self, whole: Part<'a>, cut: Cut) -> Vec<Part<'a>> {
        let mut parts = Vec::with_capacity(LANES);
        if whole.items.is_empty() {
            return parts;
        }
        parts.push(whole);
        while parts.len() < LANES {
            let size = |part: &Part<'_>| match cut {
                Cut::SurfaceArea => part.bounds.half_area(),
                Cut::Halves => part.items.len() as f32,
            };
            let largest = (0..parts.len())
                .filter(|&i| self.leaf(parts[i].items).is_none())
                .max_by(|&i, &j| size(&parts[i]).total_cmp(&size(&parts[j])));
            let Some(largest) = largest else { break };
            let Part { items, .. } = parts.swap_remove(largest);
            let middle = split::cut(items, cut, self.triangles.len() as u32);
            let (left, right) = items.split_at_mut(middle);
            for items in [left, right] {
                let bounds = items.iter().fold(Aabb::EMPTY, |b, item| b.union(item.bounds));
                parts.push(Part { items, bounds });
            }
        }
        parts
    }

    /// The leaf that a range can become, if it can: one block of triangles or one object.
    fn leaf(&self, items: &[Item]) -> Option<(Child, Subtree)> {
        let triangles = self.triangles;
        let (content, blocks) = match items {
            [item] if item.number as usize >= triangles.len() => {
                (Content::Object(item.number - triangles.len() as u32), Vec::new())
            }
            _ if items.len() <= LANES
                && items.iter().all(|item| (item.number as usize) < triangles.len()) =>
            {
                let held = items.iter().map(|item| &triangles[item.number as usize]);
                (Content::Block(0), vec![TriangleBlock::new(held)])
            }
            _ => return None,
        };
        Some((Child::new(content), Subtree { nodes: Vec::new(), blocks }))
    }

    fn child(&self, Part { items, bounds }: Part<'_>, depth: usize) -> (Child, Subtree) {
        self.leaf(items).unwrap_or_else(|| {
            let subtree = self.node(items, bounds, depth);
            (Child::new(Content::Node(0)), subtree)
        })
    }
}
