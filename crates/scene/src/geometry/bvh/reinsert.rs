//! Making a binary tree better by taking nodes out and putting them where they enlarge others least.

use alloc::vec;
use alloc::vec::Vec;

use super::binary::{Form, MAX_DEPTH, Tree};
use crate::geometry::Aabb;
use crate::parallel;

/// How often nodes are looked for that have a better place, and the share of all nodes, the largest, that is looked at.
const ROUNDS: usize = 6;
const SHARE: f32 = 0.3;
/// At most so many in a round: in the trees of large scans there is little to gain.
const MOST: usize = 40_000;

/// A node and what it is to become the sibling of.
#[derive(Clone, Copy)]
struct Move {
    node: u32,
    to: u32,
    /// By how much the sum of all areas shrinks.
    gain: f32,
}

impl Tree {
    /// Moves nodes for which there is a place with a smaller sum of areas.
    ///
    /// # Source
    /// Bittner, Hapala, Havran, "Fast Insertion-Based Optimization of Bounding Volume Hierarchies", 2013; Meister, Bittner,
    /// "Parallel Reinsertion for Bounding Volume Hierarchy Optimization", 2018: all searches of a round see the same tree.
    pub(super) fn reinsert(&mut self) {
        let mut heights = self.heights();
        let mut order: Vec<u32> = (1..self.nodes.len() as u32).collect();
        let count = ((order.len() as f32 * SHARE) as usize).clamp(order.len().min(64), MOST);
        if count == 0 {
            return;
        }
        let area = |node: u32| self.nodes[node as usize].bounds.half_area();
        order.select_nth_unstable_by(count - 1, |&a, &b| {
            area(b).total_cmp(&area(a)).then(a.cmp(&b))
        });
        // In an order that no algorithm of a library decides.
        let order = &mut order[..count];
        order.sort_unstable();
        for _ in 0..ROUNDS {
            let mut moves: Vec<Move> = parallel::map_slowly(order, |&node| self.search(node));
            moves.retain(|m| m.gain > 0.0);
            moves.sort_unstable_by(|a, b| b.gain.total_cmp(&a.gain).then(a.node.cmp(&b.node)));
            let mut touched = vec![false; self.nodes.len()];
            for m in moves {
                self.apply(m, &mut touched, &mut heights);
            }
        }
    }

    /// Levels below each node.
    fn heights(&self) -> Vec<u8> {
        let mut heights = vec![0; self.nodes.len()];
        // Children come after their parents as long as nothing has been moved.
        for (i, node) in self.nodes.iter().enumerate().rev() {
            if let Form::Inner([left, right]) = node.form {
                heights[i] = 1 + u8::max(heights[left as usize], heights[right as usize]);
            }
        }
        heights
    }

    fn bounds(&self, node: u32) -> &Aabb {
        &self.nodes[node as usize].bounds
    }

    fn parent(&self, node: u32) -> u32 {
        self.nodes[node as usize].parent
    }

    fn sibling(&self, node: u32) -> u32 {
        match self.nodes[self.parent(node) as usize].form {
            Form::Inner([left, right]) if left == node => right,
            Form::Inner([left, _]) => left,
            Form::Leaf { .. } => node,
        }
    }

    /// The best place for a node, which is not the root. Gain 0 where it is best where it is.
    fn search(&self, node: u32) -> Move {
        let bounds = *self.bounds(node);
        let area = bounds.half_area();
        let parent = self.parent(node);
        let mut best = Move { node, to: node, gain: 0.0 };
        // Trees to look at, and what is gained before their roots are enlarged.
        let mut stack = Vec::with_capacity(64);
        // Upwards from the parent, which goes: its sibling takes its place.
        let mut around = *self.bounds(self.sibling(node));
        let mut gain = self.bounds(parent).half_area();
        let (mut pivot, mut side) = (parent, self.sibling(node));
        loop {
            stack.push((gain, side));
            while let Some((gain, place)) = stack.pop() {
                // At least the node's own area is added for the new parent.
                if gain - area <= best.gain {
                    continue;
                }
                let there = self.bounds(place);
                let after = gain - there.union(bounds).half_area();
                if after > best.gain {
                    best = Move { node, to: place, gain: after };
                }
                if let Form::Inner([left, right]) = self.nodes[place as usize].form {
                    let enlarged = after + there.half_area();
                    stack.push((enlarged, left));
                    stack.push((enlarged, right));
                }
            }
            if pivot == Self::ROOT {
                break;
            }
            if pivot != parent {
                around = around.union(*self.bounds(side));
                gain += self.bounds(pivot).half_area() - around.half_area();
            }
            side = self.sibling(pivot);
            pivot = self.parent(pivot);
        }
        let stays = best.to == self.sibling(node) || best.to == parent;
        if stays { Move { gain: 0.0, ..best } } else { best }
    }

    /// Moves a node unless one of those involved has been moved in this round, or the tree would become too deep.
    fn apply(&mut self, Move { node, to, .. }: Move, touched: &mut [bool], heights: &mut [u8]) {
        let (parent, sibling, above) = (self.parent(node), self.sibling(node), self.parent(to));
        let involved = [node, to, parent, sibling, above];
        if parent == Self::ROOT || involved.iter().any(|&n| touched[n as usize]) {
            return;
        }
        // Other moves may have put the place into the node itself.
        let mut depth = 1;
        let mut up = to;
        while up != Self::ROOT {
            if up == node {
                return;
            }
            up = self.parent(up);
            depth += 1;
        }
        let height = heights[node as usize].max(heights[to as usize]);
        if depth + usize::from(height) > MAX_DEPTH {
            return;
        }
        for &n in &involved {
            touched[n as usize] = true;
        }
        let grandparent = self.parent(parent);
        self.replace(grandparent, parent, sibling);
        // `above` may have been the parent itself only if the place is the sibling, which is excluded.
        self.replace(above, to, parent);
        self.nodes[parent as usize].form = Form::Inner([to, node]);
        self.nodes[to as usize].parent = parent;
        self.refit(grandparent, heights);
        self.refit(parent, heights);
    }

    /// Exchanges a child of a node.
    fn replace(&mut self, node: u32, old: u32, new: u32) {
        if let Form::Inner(children) = &mut self.nodes[node as usize].form {
            children.iter_mut().filter(|child| **child == old).for_each(|child| *child = new);
        }
        self.nodes[new as usize].parent = node;
    }

    /// Boxes and heights of a node and all above it.
    fn refit(&mut self, mut node: u32, heights: &mut [u8]) {
        loop {
            if let Form::Inner([left, right]) = self.nodes[node as usize].form {
                let bounds = self.bounds(left).union(*self.bounds(right));
                self.nodes[node as usize].bounds = bounds;
                heights[node as usize] =
                    1 + u8::max(heights[left as usize], heights[right as usize]);
            }
            if node == Self::ROOT {
                return;
            }
            node = self.parent(node);
        }
    }
}
