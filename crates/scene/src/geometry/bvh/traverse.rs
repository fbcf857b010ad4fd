//! Closest and any hit.

use super::binary::MAX_DEPTH;
use super::node::{Child, Content, Node};
use super::simd::{Kernel, Memory, Simd, Stack};
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

/// The objects that a hierarchy numbers: those of shapes, and instances.
pub(in crate::geometry) trait Objects {
    /// Replaces `found` if the object is hit at a smaller `t`.
    fn closest<S: Simd>(&self, simd: S, object: u32, found: &mut Found);
    /// Whether the object is hit before `t_max`.
    fn occluded<S: Simd>(&self, simd: S, object: u32, t_max: f32) -> bool;
}

/// A node leaves at most seven siblings behind per level, and levels are limited by construction.
const CAPACITY: usize = (LANES - 1) * (MAX_DEPTH + 2) + LANES;

/// A child still to visit and where the ray enters it, in the order of the latter: distances are
/// not negative, so that their bits are in the order of their values.
#[inline(always)]
fn entry(distance: f32, child: Child) -> u64 {
    u64::from(distance.to_bits()) << 32 | u64::from(child.bits())
}

/// The next child that is entered at `t_max` or before.
#[inline(always)]
fn pop(stack: &mut Stack<'_, u64, CAPACITY>, t_max: f32) -> Option<Child> {
    while let Some(entry) = stack.pop() {
        if f32::from_bits((entry >> 32) as u32) <= t_max {
            return Some(Child::from_bits(entry as u32));
        }
    }
    None
}

/// Pushes the children in a mask so that nearer ones come out first, and returns the nearest.
///
/// The counts 0, 1, 2 and more have code of their own: most nodes have one or two such children,
/// and what comes next is loaded while the distances are still on their way.
#[inline(always)]
fn push_all_but_nearest(
    stack: &mut Stack<'_, u64, CAPACITY>,
    node: &Node,
    mask: u32,
    distances: &[f32; LANES],
    prefetch: impl Fn(Child),
) -> Option<Child> {
    let mut entered = lanes(mask);
    let first = entered.next()?;
    let Some(second) = entered.next() else { return Some(node.children[first]) };
    let key = |lane: usize| {
        prefetch(node.children[lane]);
        entry(distances[lane], node.children[lane])
    };
    let (a, b) = (key(first), key(second));
    let (mut near, far) = (a.min(b), a.max(b));
    let bottom = stack.len();
    stack.push(far);
    for lane in entered {
        let new = key(lane);
        stack.push(near.max(new));
        near = near.min(new);
        sift(stack, bottom);
    }
    Some(Child::from_bits(near as u32))
}

/// Moves the last entry down into the descending ones above `bottom`.
#[inline(always)]
fn sift(stack: &mut Stack<'_, u64, CAPACITY>, bottom: usize) {
    let entries = &mut stack.as_mut_slice()[bottom..];
    let mut i = entries.len() - 1;
    while i > 0 && entries[i - 1] < entries[i] {
        entries.swap(i - 1, i);
        i -= 1;
    }
}

/// The set bits of a mask, lowest first.
#[inline(always)]
pub(super) fn lanes(mut mask: u32) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        (mask != 0).then(|| {
            let lane = mask.trailing_zeros() as usize & (LANES - 1);
            mask &= mask - 1;
            lane
        })
    })
}

impl Bvh {
    /// Asks for what a child is.
    #[inline(always)]
    fn prefetch<S: Simd>(&self, simd: S, child: Child) {
        match child.content() {
            Content::Node(index) => simd.prefetch(&self.nodes, index as usize),
            Content::Block(index) => simd.prefetch(&self.blocks, index as usize),
            Content::Object(_) => {}
        }
    }

    /// Replaces `found` by the closest hit with a smaller `t`, if there is one.
    #[inline(always)]
    pub(in crate::geometry) fn closest<S: Simd, O: Objects>(
        &self,
        simd: S,
        ray: &PreparedRay<S::F>,
        objects: &O,
        found: &mut Found,
    ) {
        let mut memory = Memory::<u64, CAPACITY>::new();
        let mut stack = Stack::new(&mut memory);
        let mut next = Some(Child::new(Content::Node(0)));
        while let Some(child) = next {
            match child.content() {
                Content::Node(index) => {
                    let node = &self.nodes[index as usize];
                    let (mask, distances) = boxes::entered(simd, node, &ray.boxes, found.t);
                    next = push_all_but_nearest(&mut stack, node, mask, &distances, |child| {
                        self.prefetch(simd, child);
                    });
                    if next.is_some() {
                        continue;
                    }
                }
                Content::Block(index) => {
                    let block = &self.blocks[index as usize];
                    triangles::closest(simd, block, &ray.triangles, found);
                }
                Content::Object(object) => {
                    *found = simd.call(Closest { objects, object, found: *found });
                }
            }
            next = pop(&mut stack, found.t);
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
        // Nodes left for one of their children, and which others are still to visit. In any order:
        // sorting costs more than it finds sooner.
        let mut memory = Memory::<(u32, u32), { MAX_DEPTH + 2 }>::new();
        let mut stack = Stack::new(&mut memory);
        let mut index = 0;
        'nodes: loop {
            let mut node = &self.nodes[index as usize];
            let (mut mask, _) = boxes::entered(simd, node, &ray.boxes, t_max);
            loop {
                if mask == 0 {
                    let Some(left) = stack.pop() else { return false };
                    (index, mask) = left;
                    node = &self.nodes[index as usize];
                }
                let lane = mask.trailing_zeros() as usize & (LANES - 1);
                mask &= mask.wrapping_sub(1);
                if mask != 0 {
                    let sibling = mask.trailing_zeros() as usize & (LANES - 1);
                    self.prefetch(simd, node.children[sibling]);
                }
                let hit = match node.children[lane].content() {
                    Content::Node(child) => {
                        if mask != 0 {
                            stack.push((index, mask));
                        }
                        index = child;
                        continue 'nodes;
                    }
                    Content::Block(block) => {
                        let block = &self.blocks[block as usize];
                        triangles::any(simd, block, &ray.triangles, t_max)
                    }
                    Content::Object(object) => simd.call(Occluded { objects, object, t_max }),
                };
                if hit {
                    return true;
                }
            }
        }
    }
}

/// An object's closest hit, apart from the loop over nodes: a hierarchy in a hierarchy would cost
/// the outer one its registers.
struct Closest<'a, O> {
    objects: &'a O,
    object: u32,
    /// By value: a reference would keep it in memory all along.
    found: Found,
}

impl<O: Objects> Kernel for Closest<'_, O> {
    type Output = Found;

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) -> Found {
        self.objects.closest(simd, self.object, &mut self.found);
        self.found
    }
}

/// Whether an object is hit, apart from the loop over nodes as well.
struct Occluded<'a, O> {
    objects: &'a O,
    object: u32,
    t_max: f32,
}

impl<O: Objects> Kernel for Occluded<'_, O> {
    type Output = bool;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> bool {
        self.objects.occluded(simd, self.object, self.t_max)
    }
}
