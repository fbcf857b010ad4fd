//! From items to wide nodes.

use alloc::vec;
use alloc::vec::Vec;

use super::Bvh;
use super::binary::{Form, Item, Tree};
use super::block::TriangleBlock;
use super::node::{Child, Content, Node};
use crate::geometry::Aabb;
use crate::geometry::triangle::Corners;

/// A triangle to be held by a hierarchy.
#[derive(Clone, Copy, Debug)]
pub(in crate::geometry) struct TriangleRef {
    pub(in crate::geometry) corners: Corners,
    pub(in crate::geometry) shape: u32,
    pub(in crate::geometry) primitive: u32,
}

impl Bvh {
    /// Builds the hierarchy over triangles and the boxes of objects.
    ///
    /// Items with an empty or NaN box are left out. The result does not depend on the number of
    /// threads.
    pub(in crate::geometry) fn build(triangles: &[TriangleRef], objects: &[Aabb]) -> Self {
        let boxes =
            triangles.iter().map(|t| Aabb::from_points(t.corners)).chain(objects.iter().copied());
        let mut items: Vec<Item> = (0..)
            .zip(boxes)
            .map(|(number, bounds)| Item { bounds, number })
            .filter(|item| !item.bounds.is_empty())
            .collect();
        let mut bvh = Self { nodes: vec![Node::EMPTY], blocks: Vec::new(), bounds: Aabb::EMPTY };
        if !items.is_empty() {
            let tree = Tree::new(&mut items, triangles.len() as u32);
            bvh.bounds = tree.bounds;
            bvh.fill(0, &tree, triangles);
        }
        bvh
    }

    /// Fills a node with what is in a tree. Nodes and blocks are appended depth first, so that what
    /// a ray visits lies close together.
    fn fill(&mut self, node: usize, tree: &Tree<'_>, triangles: &[TriangleRef]) {
        let mut lane = 0;
        tree.for_each_child(&mut |tree| {
            let content = match tree.form {
                Form::Inner(_) => {
                    let child = self.nodes.len();
                    self.nodes.push(Node::EMPTY);
                    self.fill(child, tree, triangles);
                    Content::Node(child as u32)
                }
                Form::Leaf(&[Item { number, .. }]) if number as usize >= triangles.len() => {
                    Content::Object(number - triangles.len() as u32)
                }
                Form::Leaf(items) => {
                    let held = items.iter().map(|item| &triangles[item.number as usize]);
                    self.blocks.push(TriangleBlock::new(held));
                    Content::Block(self.blocks.len() as u32 - 1)
                }
            };
            self.nodes[node].set(lane, &tree.bounds, Child::new(content));
            lane += 1;
        });
    }
}
