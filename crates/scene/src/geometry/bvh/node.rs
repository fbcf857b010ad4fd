//! Nodes.

use super::LANES;
use crate::geometry::Aabb;

/// Eight boxes side by side, and what is in them.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub(super) struct Node {
    /// Least and largest coordinates of each child, by axis.
    pub(super) bounds: [[[f32; LANES]; 2]; 3],
    pub(super) children: [Child; LANES],
}

/// What a box holds: the kind in the two upper bits, an index in the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(transparent)]
pub(super) struct Child(u32);

/// A decoded [`Child`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Content {
    /// A node, by index.
    Node(u32),
    /// A block of triangles, by index.
    Block(u32),
    /// An object, by number.
    Object(u32),
}

impl Child {
    const INDEX: u32 = (1 << 30) - 1;

    #[inline(always)]
    pub(super) fn new(content: Content) -> Self {
        let (kind, index) = match content {
            Content::Node(i) => (0, i),
            Content::Block(i) => (1, i),
            Content::Object(i) => (2, i),
        };
        debug_assert!(index <= Self::INDEX, "2³⁰ nodes of 256 bytes do not fit into memory");
        Self(kind << 30 | index)
    }

    #[inline(always)]
    pub(super) fn content(self) -> Content {
        let index = self.0 & Self::INDEX;
        match self.0 >> 30 {
            0 => Content::Node(index),
            1 => Content::Block(index),
            _ => Content::Object(index),
        }
    }

    #[inline(always)]
    pub(super) fn bits(self) -> u32 {
        self.0
    }

    #[inline(always)]
    pub(super) fn from_bits(bits: u32) -> Self {
        Self(bits)
    }
}

impl Node {
    /// A node without children: its boxes are empty, so that no ray enters them.
    pub(super) const EMPTY: Self = Self {
        bounds: [[[f32::INFINITY; LANES], [f32::NEG_INFINITY; LANES]]; 3],
        children: [Child(0); LANES],
    };

    pub(super) fn set(&mut self, lane: usize, bounds: &Aabb, child: Child) {
        for axis in 0..3 {
            self.bounds[axis][0][lane] = bounds.min[axis];
            self.bounds[axis][1][lane] = bounds.max[axis];
        }
        self.children[lane] = child;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn children_survive_their_encoding() {
        for content in [Content::Node(7), Content::Block(0), Content::Object(Child::INDEX)] {
            assert_eq!(Child::new(content).content(), content);
        }
    }

    #[test]
    fn a_node_fills_four_cache_lines() {
        assert_eq!(size_of::<Node>(), 256);
    }
}
