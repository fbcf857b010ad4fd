//! From triangles and objects to wide nodes.

use alloc::vec;
use alloc::vec::Vec;

use super::Bvh;
use super::binary::{Form, Item, Tree};
use super::block::TriangleBlock;
use super::collapse::Collapse;
use super::node::{Child, Content, Node};
use super::presplit::presplit;
use super::simd::pages;
use crate::geometry::Aabb;
use crate::geometry::triangle::Corners;
use crate::parallel;

/// A triangle to be held by a hierarchy.
#[derive(Clone, Copy, Debug)]
pub(in crate::geometry) struct TriangleRef {
    pub(in crate::geometry) corners: Corners,
    pub(in crate::geometry) shape: u32,
    pub(in crate::geometry) primitive: u32,
}

/// The triangles that a hierarchy is built over, which are asked for by number: a list of them would need as much memory as
/// the hierarchy.
pub(in crate::geometry) trait Triangles: Sync {
    /// How many numbers there are.
    fn count(&self) -> u32;
    /// The triangle of a number; `None` for one that no ray can hit.
    fn get(&self, number: u32) -> Option<TriangleRef>;
}

impl Bvh {
    /// Builds the hierarchy over triangles and the boxes of objects.
    ///
    /// Items with an empty or NaN box are left out. The result does not depend on the number of
    /// threads.
    pub(in crate::geometry) fn build(triangles: &impl Triangles, objects: &[Aabb]) -> Self {
        let first_object = triangles.count();
        let bounds = |number: u32| match objects.get(number.wrapping_sub(first_object) as usize) {
            Some(bounds) => *bounds,
            None => triangles.get(number).map_or(Aabb::EMPTY, |t| Aabb::from_points(t.corners)),
        };
        let mut items: Vec<Item> = (0..first_object + objects.len() as u32)
            .map(|number| Item { bounds: Aabb::EMPTY, number })
            .collect();
        parallel::update(&mut items, |item| Item { bounds: bounds(item.number), ..item });
        let mut left_out = 0;
        items.retain(|item| {
            let empty = item.bounds.is_empty();
            left_out += usize::from(empty && item.number < first_object);
            !empty
        });
        if items.is_empty() {
            let nodes = vec![Node::EMPTY];
            return Self { nodes, blocks: Vec::new(), bounds: Aabb::EMPTY, left_out };
        }
        presplit(&mut items, triangles);
        let mut tree = Tree::build(&mut items, first_object);
        tree.reinsert();
        // Of what is not needed any more nothing is kept: blocks take as much memory as all before them.
        let numbers: Vec<u32> = items.iter().map(|item| item.number).collect();
        drop(items);
        let mut wide = Wide {
            collapse: Collapse::new(&tree),
            tree: &tree,
            numbers: &numbers,
            first_object,
            nodes: vec![Node::EMPTY],
            leaves: Vec::new(),
        };
        wide.fill(0, Tree::ROOT);
        let Wide { nodes: filled, leaves, collapse, .. } = wide;
        drop(collapse);
        let mut nodes = pages::with_capacity(filled.len());
        nodes.extend(filled);
        let mut blocks = pages::with_capacity(leaves.len());
        parallel::extend(&mut blocks, &leaves, |&leaf| {
            let held = tree.held(leaf, &numbers).iter();
            TriangleBlock::new(held.filter_map(|&number| triangles.get(number)))
        });
        Self { nodes, blocks, bounds: tree.nodes[Tree::ROOT as usize].bounds, left_out }
    }
}

/// A hierarchy that is being filled.
struct Wide<'a> {
    tree: &'a Tree,
    collapse: Collapse,
    /// Of all items, in the order of the tree's leaves.
    numbers: &'a [u32],
    first_object: u32,
    nodes: Vec<Node>,
    /// The leaf of the tree that each block holds.
    leaves: Vec<u32>,
}

impl Wide<'_> {
    /// Fills a node with what is in a tree. Nodes and blocks are appended depth first, so that what
    /// a ray visits lies close together.
    fn fill(&mut self, node: usize, root: u32) {
        let children = self.collapse.children(self.tree, root);
        for (lane, &child) in children.as_slice().iter().enumerate() {
            let content = match self.tree.nodes[child as usize].form {
                Form::Inner(_) => {
                    let index = self.nodes.len();
                    self.nodes.push(Node::EMPTY);
                    self.fill(index, child);
                    Content::Node(index as u32)
                }
                Form::Leaf { .. } => match self.tree.held(child, self.numbers) {
                    &[number] if number >= self.first_object => {
                        Content::Object(number - self.first_object)
                    }
                    _ => {
                        self.leaves.push(child);
                        Content::Block(self.leaves.len() as u32 - 1)
                    }
                },
            };
            let bounds = &self.tree.nodes[child as usize].bounds;
            self.nodes[node].set(lane, bounds, Child::new(content));
        }
    }
}
