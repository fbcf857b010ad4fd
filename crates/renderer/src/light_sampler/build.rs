//! Building the light tree.

use super::cluster::Cluster;
use super::node::{Link, Node};
use super::pair::Pair;

/// Buckets per axis in which splits are tried.
const BUCKETS: usize = 12;

/// From this depth on, halves instead of the best split: no path is longer than 64 steps.
const BALANCED_DEPTH: u32 = 32;

/// A tree under construction.
#[derive(Default)]
pub(super) struct Builder {
    pub(super) pairs: Vec<Pair>,
    /// For each emitter, the way down to it: bit i says which child is taken at depth i.
    pub(super) trails: Vec<u64>,
}

/// An emitter and its place in the caller's list.
#[derive(Clone, Copy)]
pub(super) struct Emitter {
    pub(super) cluster: Cluster,
    pub(super) index: u32,
}

/// A subtree's root and what it bounds.
#[derive(Clone, Copy)]
pub(super) struct Subtree {
    pub(super) node: Node,
    cluster: Cluster,
}

impl Builder {
    /// Builds the tree over at least one emitter, top down, splitting where the surface area
    /// orientation heuristic is least. `None` for no emitter.
    pub(super) fn build(
        &mut self,
        emitters: &mut [Emitter],
        trail: u64,
        depth: u32,
    ) -> Option<Subtree> {
        if let [emitter] = emitters {
            self.trails[emitter.index as usize] = trail;
            let node = Node::new(&emitter.cluster, Link::Emitter(emitter.index));
            return Some(Subtree { node, cluster: emitter.cluster });
        }
        let middle = split(emitters, depth);
        let (left, right) = emitters.split_at_mut(middle);
        let place = self.pairs.len();
        // Reserves the place, so that parents come before their children in memory.
        let (first, last) = (left.first()?, right.first()?);
        let clusters = [&first.cluster, &last.cluster];
        let nodes = clusters.map(|cluster| Node::new(cluster, Link::Emitter(first.index)));
        self.pairs.push(Pair::new(nodes, clusters));
        let left = self.build(left, trail, depth + 1)?;
        let right = self.build(right, trail | 1 << depth, depth + 1)?;
        self.pairs[place] = Pair::new([left.node, right.node], [&left.cluster, &right.cluster]);
        let cluster = left.cluster.union(&right.cluster);
        Some(Subtree { node: Node::new(&cluster, Link::Pair(place as u32)), cluster })
    }
}

/// Reorders the emitters and returns where the second child begins, neither 0 nor the length.
fn split(emitters: &mut [Emitter], depth: u32) -> usize {
    let half = emitters.len() / 2;
    if depth >= BALANCED_DEPTH {
        return half;
    }
    let Some(best) = best_split(emitters) else { return half };
    let middle = partition(emitters, |emitter| best.bucket_of(&emitter.cluster) <= best.bucket);
    if middle == 0 || middle == emitters.len() { half } else { middle }
}

/// Cut behind bucket `bucket` of the centres' extent along `axis`.
#[derive(Clone, Copy)]
struct Split {
    axis: usize,
    low: f32,
    scale: f32,
    bucket: usize,
}

impl Split {
    fn bucket_of(&self, cluster: &Cluster) -> usize {
        (((cluster.centre()[self.axis] - self.low) * self.scale) as usize).min(BUCKETS - 1)
    }
}

fn best_split(emitters: &[Emitter]) -> Option<Split> {
    let first = emitters.first()?.cluster;
    let mut all = first;
    let (mut low, mut high) = (first.centre(), first.centre());
    for emitter in emitters {
        all = all.union(&emitter.cluster);
        low = low.min(emitter.cluster.centre());
        high = high.max(emitter.cluster.centre());
    }
    let extent = all.high - all.low;
    let mut best: Option<(f32, Split)> = None;
    for axis in 0..3 {
        let scale = BUCKETS as f32 / (high[axis] - low[axis]);
        if !scale.is_finite() || scale <= 0.0 {
            continue;
        }
        let split = Split { axis, low: low[axis], scale, bucket: 0 };
        let mut buckets: [Option<Cluster>; BUCKETS] = [None; BUCKETS];
        for emitter in emitters {
            let bucket = &mut buckets[split.bucket_of(&emitter.cluster)];
            *bucket = join(*bucket, Some(emitter.cluster));
        }
        // Long boxes are cut across: Conty Estevez and Kulla's regularisation.
        let shape = extent.max_element() / extent[axis];
        for (bucket, cost) in costs(&buckets).into_iter().enumerate() {
            let cost = cost * shape;
            if cost.is_finite() && best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, Split { bucket, ..split }));
            }
        }
    }
    best.map(|(_, split)| split)
}

/// Cost of cutting behind each bucket but the last; infinite where one side would be empty.
fn costs(buckets: &[Option<Cluster>; BUCKETS]) -> [f32; BUCKETS - 1] {
    let cost = |side: Option<Cluster>| side.map_or(f32::INFINITY, |cluster| cluster.cost());
    let mut costs = [0.0; BUCKETS - 1];
    let mut below = None;
    for (total, bucket) in costs.iter_mut().zip(buckets) {
        below = join(below, *bucket);
        *total += cost(below);
    }
    let mut above = None;
    for (total, bucket) in costs.iter_mut().zip(&buckets[1..]).rev() {
        above = join(above, *bucket);
        *total += cost(above);
    }
    costs
}

fn join(a: Option<Cluster>, b: Option<Cluster>) -> Option<Cluster> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.union(&b)),
        (a, b) => a.or(b),
    }
}

/// Moves the emitters for which `first` holds to the front, keeping an order that depends on the
/// input only, and returns their number.
fn partition(emitters: &mut [Emitter], first: impl Fn(&Emitter) -> bool) -> usize {
    let mut count = 0;
    for i in 0..emitters.len() {
        if first(&emitters[i]) {
            emitters.swap(i, count);
            count += 1;
        }
    }
    count
}
