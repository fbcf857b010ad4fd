//! From items to a binary tree, top down.

use alloc::boxed::Box;

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
const PARALLEL_FROM: usize = 2048;

/// What is sorted while building: a box and the number of what is in it. Triangles come first in
/// the numbering, objects after them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    pub(super) bounds: Aabb,
    pub(super) number: u32,
}

/// A binary tree, and what it costs to make a wide one of it.
pub(super) struct Tree<'a> {
    pub(super) bounds: Aabb,
    pub(super) form: Form<'a>,
    /// Least areas of all wide nodes in this tree if it becomes 1, 2, … children of a wide node.
    costs: [f32; LANES],
}

/// What a tree is.
pub(super) enum Form<'a> {
    /// Up to eight triangles or one object.
    Leaf(&'a [Item]),
    /// Two trees.
    Inner(Box<[Tree<'a>; 2]>),
}

impl<'a> Tree<'a> {
    /// Builds the tree over at least one item; `triangles` is the number of the first object.
    ///
    /// The halves of large ranges are built in parallel with the feature `std`; the result does not
    /// depend on the number of threads.
    pub(super) fn new(items: &'a mut [Item], triangles: u32) -> Self {
        Self::below(items, triangles, 0)
    }

    fn below(items: &'a mut [Item], triangles: u32, depth: usize) -> Self {
        let bounds = items.iter().fold(Aabb::EMPTY, |b, item| b.union(item.bounds));
        let is_leaf = items.len() == 1
            || items.len() <= LANES && items.iter().all(|item| item.number < triangles);
        if is_leaf {
            return Self { bounds, form: Form::Leaf(items), costs: [0.0; LANES] };
        }
        // Free cuts only guarantee that a part is smaller than the whole.
        let levels = MAX_DEPTH.saturating_sub(depth + 1);
        let cut = if items.len() as u64 <= 1 << levels { Cut::SurfaceArea } else { Cut::Halves };
        let middle = split::cut(items, cut, triangles);
        #[cfg(feature = "std")]
        let parallel = items.len() >= PARALLEL_FROM;
        let (left, right) = items.split_at_mut(middle);
        let below = |items: &'a mut [Item]| Self::below(items, triangles, depth + 1);
        #[cfg(feature = "std")]
        if parallel {
            let trees = rayon::join(move || below(left), move || below(right));
            return Self::of(bounds, Box::new(trees.into()));
        }
        let trees = [below(left), below(right)];
        Self::of(bounds, Box::new(trees))
    }

    /// The tree over two, with the costs
    ///
    /// ```text
    /// D(n) = min over 0 < k < n of C_left(k) + C_right(n − k)
    /// C(1) = area + D(8),   C(n) = min(C(n − 1), D(n))
    /// ```
    ///
    /// # Source
    /// Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide
    /// BVHs", HPG 2017, section 3.2, with leaves that are given: their cost is the same for all.
    fn of(bounds: Aabb, trees: Box<[Self; 2]>) -> Self {
        let mut costs = [0.0; LANES];
        costs[0] = bounds.half_area() + shares(&trees, LANES).1;
        for n in 2..=LANES {
            costs[n - 1] = costs[n - 2].min(shares(&trees, n).1);
        }
        Self { bounds, form: Form::Inner(trees), costs }
    }

    /// Calls `f` with the trees that become the children of the wide node of this tree.
    pub(super) fn for_each_child(&self, f: &mut impl FnMut(&Self)) {
        match &self.form {
            Form::Leaf(_) => f(self),
            Form::Inner(trees) => open(trees, LANES, f),
        }
    }

    /// Calls `f` with up to `n` trees that this one falls apart into at least cost.
    fn split(&self, n: usize, f: &mut impl FnMut(&Self)) {
        // As few as give the least cost.
        let n = (1..n).find(|&fewer| self.costs[fewer - 1] == self.costs[n - 1]).unwrap_or(n);
        match &self.form {
            Form::Inner(trees) if n > 1 => open(trees, n, f),
            _ => f(self),
        }
    }
}

fn open<'a>(trees: &[Tree<'a>; 2], n: usize, f: &mut impl FnMut(&Tree<'a>)) {
    let [left, right] = trees;
    let (k, _) = shares(trees, n);
    left.split(k, f);
    right.split(n - k, f);
}

/// How many of `n` ≥ 2 places the left one of two trees gets, and the cost D(n).
fn shares([left, right]: &[Tree<'_>; 2], n: usize) -> (usize, f32) {
    (1..n)
        .map(|k| (k, left.costs[k - 1] + right.costs[n - k - 1]))
        .fold((1, f32::INFINITY), |best, share| if share.1 < best.1 { share } else { best })
}
