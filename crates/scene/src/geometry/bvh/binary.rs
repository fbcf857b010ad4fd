//! From items to a binary tree, top down.

use alloc::vec::Vec;

use super::LANES;
use super::split::{self, Cut};
use crate::geometry::Aabb;

/// Levels of the binary tree below its root. As many as 2⁴⁷ items fit by halving alone, so that the
/// limit leaves the heuristic free nearly everywhere; the traversal's stack follows from it.
///
/// A range of objects and triangles that ends up among the last levels may need one more.
pub(super) const MAX_DEPTH: usize = 48;

/// Ranges with fewer items are built on the thread that finds them.
#[cfg(feature = "std")]
const PARALLEL_FROM: usize = 8192;

/// What is sorted while building: a box and the number of what is in it. Triangles come first in
/// the numbering, objects after them. A triangle may be in several items, each with a part of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    pub(super) bounds: Aabb,
    pub(super) number: u32,
}

/// A binary tree in one array.
pub(super) struct Tree {
    pub(super) nodes: Vec<TreeNode>,
}

/// A node of a [`Tree`].
#[derive(Clone, Copy, Debug)]
pub(super) struct TreeNode {
    pub(super) bounds: Aabb,
    /// The node of which it is a child; itself for the root.
    pub(super) parent: u32,
    pub(super) form: Form,
}

/// What a node is.
#[derive(Clone, Copy, Debug)]
pub(super) enum Form {
    /// Up to eight triangles or one object: where in the items, and how many.
    Leaf { first: u32, count: u32 },
    /// Two nodes.
    Inner([u32; 2]),
}

impl Tree {
    pub(super) const ROOT: u32 = 0;

    /// Builds the tree over at least one item; `first_object` is the number of the first object.
    ///
    /// The halves of large ranges are built in parallel with the feature `std`; the result does not
    /// depend on the number of threads.
    pub(super) fn build(items: &mut [Item], first_object: u32) -> Self {
        let mut nodes = Vec::new();
        below(items, 0, first_object, 0, &mut nodes);
        Self { nodes }
    }

    /// What a leaf holds, of something there is for each item; nothing of an inner node.
    pub(super) fn held<'a, T>(&self, node: u32, items: &'a [T]) -> &'a [T] {
        match self.nodes[node as usize].form {
            Form::Leaf { first, count } => &items[first as usize..(first + count) as usize],
            Form::Inner(_) => &[],
        }
    }
}

/// Appends the tree over a range of items, of which the first has the index `first`; returns where its root is. Places are
/// counted from the start of `nodes`.
fn below(
    items: &mut [Item],
    first: u32,
    first_object: u32,
    depth: usize,
    nodes: &mut Vec<TreeNode>,
) -> u32 {
    let root = nodes.len() as u32;
    let count = items.len();
    let bounds = items.iter().fold(Aabb::EMPTY, |b, item| b.union(item.bounds));
    let form = Form::Leaf { first, count: count as u32 };
    nodes.push(TreeNode { bounds, parent: root, form });
    if count == 1 || count <= LANES && items.iter().all(|item| item.number < first_object) {
        return root;
    }
    // Free cuts only guarantee that a part is smaller than the whole.
    let levels = MAX_DEPTH.saturating_sub(depth + 1);
    let cut = if count as u64 <= 1 << levels { Cut::SurfaceArea } else { Cut::Halves };
    let middle = split::cut(items, cut, first_object);
    let (left, right) = items.split_at_mut(middle);
    let parts = [(left, first), (right, first + middle as u32)];
    let build = |(items, first), nodes: &mut Vec<TreeNode>| {
        below(items, first, first_object, depth + 1, nodes)
    };
    #[cfg(feature = "std")]
    let children = if count >= PARALLEL_FROM {
        let [left, right] = parts;
        let others = || {
            let mut nodes = Vec::new();
            build(right, &mut nodes);
            nodes
        };
        let (left, mut others) = rayon::join(|| build(left, nodes), others);
        let right = nodes.len() as u32;
        for node in &mut others {
            node.parent += right;
            if let Form::Inner(children) = &mut node.form {
                for child in children.iter_mut() {
                    *child += right;
                }
            }
        }
        nodes.append(&mut others);
        [left, right]
    } else {
        parts.map(|part| build(part, nodes))
    };
    #[cfg(not(feature = "std"))]
    let children = parts.map(|part| build(part, nodes));
    nodes[root as usize].form = Form::Inner(children);
    for child in children {
        nodes[child as usize].parent = root;
    }
    root
}
