//! Which nodes of a binary tree become children of one wide node.

use alloc::vec;
use alloc::vec::Vec;

use super::LANES;
use super::binary::{Form, Tree};

/// Least areas of all wide nodes in each tree if it becomes 1, 2, … children of a wide node:
///
/// ```text
/// D(n) = min over 0 < k < n of C_left(k) + C_right(n − k)
/// C(1) = area + D(8),   C(n) = min(C(n − 1), D(n))
/// ```
///
/// # Source
/// Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide
/// BVHs", HPG 2017, section 3.2, with leaves that are given: their cost is the same for all.
pub(super) struct Collapse {
    costs: Vec<[f32; LANES]>,
}

/// Up to eight nodes.
pub(super) struct Children {
    nodes: [u32; LANES],
    count: usize,
}

impl Children {
    pub(super) fn as_slice(&self) -> &[u32] {
        &self.nodes[..self.count]
    }
}

impl Collapse {
    pub(super) fn new(tree: &Tree) -> Self {
        let mut collapse = Self { costs: vec![[0.0; LANES]; tree.nodes.len()] };
        collapse.find(tree, Tree::ROOT);
        collapse
    }

    fn find(&mut self, tree: &Tree, node: u32) {
        let Form::Inner(children) = tree.nodes[node as usize].form else { return };
        for child in children {
            self.find(tree, child);
        }
        let mut costs = [0.0; LANES];
        costs[0] = tree.nodes[node as usize].bounds.half_area() + self.shares(children, LANES).1;
        for n in 2..=LANES {
            costs[n - 1] = costs[n - 2].min(self.shares(children, n).1);
        }
        self.costs[node as usize] = costs;
    }

    /// How many of `n` ≥ 2 places the left one of two trees gets, and the cost D(n).
    fn shares(&self, children: [u32; 2], n: usize) -> (usize, f32) {
        let [left, right] = children.map(|child| &self.costs[child as usize]);
        (1..n)
            .map(|k| (k, left[k - 1] + right[n - k - 1]))
            .fold((1, f32::INFINITY), |best, share| if share.1 < best.1 { share } else { best })
    }

    /// The children of the wide node that a tree becomes.
    pub(super) fn children(&self, tree: &Tree, node: u32) -> Children {
        let mut children = Children { nodes: [0; LANES], count: 0 };
        match tree.nodes[node as usize].form {
            Form::Leaf { .. } => children.push(node),
            Form::Inner(two) => self.open(tree, two, LANES, &mut children),
        }
        children
    }

    /// Adds up to `n` nodes that a tree falls apart into at least cost.
    fn split(&self, tree: &Tree, node: u32, n: usize, to: &mut Children) {
        // As few as give the least cost.
        let costs = &self.costs[node as usize];
        let n = (1..n).find(|&fewer| costs[fewer - 1] == costs[n - 1]).unwrap_or(n);
        match tree.nodes[node as usize].form {
            Form::Inner(children) if n > 1 => self.open(tree, children, n, to),
            _ => to.push(node),
        }
    }

    fn open(&self, tree: &Tree, children: [u32; 2], n: usize, to: &mut Children) {
        let (k, _) = self.shares(children, n);
        self.split(tree, children[0], k, to);
        self.split(tree, children[1], n - k, to);
    }
}

impl Children {
    fn push(&mut self, node: u32) {
        self.nodes[self.count] = node;
        self.count += 1;
    }
}
