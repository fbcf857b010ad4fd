//! Closest and any hit.

use super::block::TriangleBlock;
use super::build::MAX_DEPTH;
use super::node::{Child, Content, Node};
use super::simd::Simd;
use super::{Bvh, LANES, PreparedRay, boxes, triangles};

/// The closest hit so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::geometry) struct Found {
    pub(in crate::geometry) t: f32,
    pub(in crate::geometry) uv: [f32; 2],
    pub(in crate::geometry) shape: u32,
    pub(in crate::geometry) primitive: u32,
    pub(in crate::geometry) instance: u32,
}

impl Found {
    /// No hit, with `t` as the limit for one; its shape is `u32::MAX`.
    #[inline(always)]
    pub(in crate::geometry) fn nothing_before(t: f32) -> Self {
        Self { t, uv: [0.0; 2], shape: u32::MAX, primitive: 0, instance: u32::MAX }
    }
}

/// The objects that a hierarchy numbers: quadrics and instances.
pub(in crate::geometry) trait Objects {
    /// Replaces `found` if the object is hit at a smaller `t`.
    fn closest<S: Simd>(&self, simd: S, object: u32, found: &mut Found);
    /// Whether the object is hit before `t_max`.
    fn occluded<S: Simd>(&self, simd: S, object: u32, t_max: f32) -> bool;
}

/// Children still to visit, with the distance at which the ray enters them.
///
/// A node leaves at most seven siblings behind per level, and levels are limited by construction.
struct Stack {
    entries: [u64; (LANES - 1) * MAX_DEPTH + LANES],
    length: usize,
}

impl Stack {
    #[inline(always)]
    fn new() -> Self {
        Self { entries: [0; (LANES - 1) * MAX_DEPTH + LANES], length: 0 }
    }

    /// Distances are not negative, so that their bits are in the order of their values.
    #[inline(always)]
    fn push(&mut self, distance: f32, child: Child) {
        self.entries[self.length] = u64::from(distance.to_bits()) << 32 | u64::from(child.bits());
        self.length += 1;
    }

    /// The next child that is entered at `t_max` or before.
    #[inline(always)]
    fn pop(&mut self, t_max: f32) -> Option<Child> {
        while self.length > 0 {
            self.length -= 1;
            let entry = self.entries[self.length];
            if f32::from_bits((entry >> 32) as u32) <= t_max {
                return Some(Child::from_bits(entry as u32));
            }
        }
        None
    }

    /// Pushes the children in a mask so that nearer ones come out first, and returns the nearest.
    #[inline(always)]
    fn push_all_but_nearest(
        &mut self,
        node: &Node,
        mask: u32,
        distances: &[f32; LANES],
    ) -> Option<Child> {
        let mut entered = lanes(mask);
        let first = entered.next()?;
        // Most nodes have one or two such children: no sorting.
        let Some(second) = entered.next() else { return Some(node.children[first]) };
        let (near, far) =
            if distances[second] < distances[first] { (second, first) } else { (first, second) };
        let bottom = self.length;
        self.push(distances[far], node.children[far]);
        let Some(third) = entered.next() else { return Some(node.children[near]) };
        self.push(distances[near], node.children[near]);
        self.push_sorted(bottom, distances[third], node.children[third]);
        for lane in entered {
            self.push_sorted(bottom, distances[lane], node.children[lane]);
        }
        self.pop(f32::INFINITY)
    }

    /// Pushes into the descending entries above `bottom`, the nearest on top.
    #[inline(always)]
    fn push_sorted(&mut self, bottom: usize, distance: f32, child: Child) {
        self.push(distance, child);
        let mut i = self.length - 1;
        let entry = self.entries[i];
        while i > bottom && self.entries[i - 1] < entry {
            self.entries[i] = self.entries[i - 1];
            i -= 1;
        }
        self.entries[i] = entry;
    }
}

/// The set bits of a mask, lowest first.
#[inline(always)]
fn lanes(mut mask: u32) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        (mask != 0).then(|| {
            let lane = mask.trailing_zeros() as usize & (LANES - 1);
            mask &= mask - 1;
            lane
        })
    })
}

impl Bvh {
    /// Replaces `found` by the closest hit with a smaller `t`, if there is one.
    #[inline(always)]
    pub(in crate::geometry) fn closest<S: Simd, O: Objects>(
        &self,
        simd: S,
        ray: &PreparedRay<S::F>,
        objects: &O,
        found: &mut Found,
    ) {
        let mut stack = Stack::new();
        let mut next = Some(Child::new(Content::Node(0)));
        while let Some(child) = next {
            match child.content() {
                Content::Node(index) => {
                    let node = &self.nodes[index as usize];
                    let (mask, distances) = boxes::entered(simd, node, &ray.boxes, found.t);
                    next = stack.push_all_but_nearest(node, mask, &distances);
                    if next.is_some() {
                        continue;
                    }
                }
                Content::Block(index) => {
                    let block = &self.blocks[index as usize];
                    if let Some(hits) = triangles::hits(simd, block, &ray.triangles, found.t) {
                        for lane in lanes(hits.mask) {
                            if hits.t[lane] < found.t {
                                *found = hit_in(block, &hits, lane);
                            }
                        }
                    }
                }
                Content::Object(object) => objects.closest(simd, object, found),
            }
            next = stack.pop(found.t);
        }
    }

    /// Whether anything is hit before `t_max`.
    #[inline(always)]
    pub(in crate::geometry) fn occluded<S: Simd, O: Objects>(
        &self,
        simd: S,
        ray: &PreparedRay<S::F>,
        objects: &O,
        t_max: f32,
    ) -> bool {
        let mut stack = Stack::new();
        let mut next = Some(Child::new(Content::Node(0)));
        while let Some(child) = next {
            let hit = match child.content() {
                Content::Node(index) => {
                    let node = &self.nodes[index as usize];
                    let (mask, _) = boxes::entered(simd, node, &ray.boxes, t_max);
                    // In any order: sorting costs more than it finds sooner.
                    for lane in lanes(mask) {
                        stack.push(0.0, node.children[lane]);
                    }
                    false
                }
                Content::Block(index) => {
                    triangles::hits(simd, &self.blocks[index as usize], &ray.triangles, t_max)
                        .is_some()
                }
                Content::Object(object) => objects.occluded(simd, object, t_max),
            };
            if hit {
                return true;
            }
            next = stack.pop(t_max);
        }
        false
    }
}

#[inline(always)]
fn hit_in(block: &TriangleBlock, hits: &triangles::BlockHits, lane: usize) -> Found {
    Found {
        t: hits.t[lane],
        uv: [hits.b1[lane], hits.b2[lane]],
        shape: block.shapes[lane],
        primitive: block.primitives[lane],
        instance: u32::MAX,
    }
}
