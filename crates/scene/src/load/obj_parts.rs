//! The parts of an OBJ file while it is read: faces by name and material, corners joined to vertices.

use alloc::string::String;
use alloc::vec::Vec;
use std::collections::HashMap;

use etendue_math::glam::{Vec2, Vec3};

use crate::parallel;

/// A corner of a face: indices counted from 1.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Corner {
    pub(super) position: u32,
    pub(super) uv: u32,
    pub(super) normal: u32,
}

impl Corner {
    /// The index of a missing texture coordinate or normal.
    pub(super) const NONE: u32 = 0;
}

/// Faces with the same name and material.
#[derive(Default)]
pub(super) struct Part {
    pub(super) name: String,
    pub(super) material: Option<String>,
    /// What each vertex is made of.
    corners: Vec<Corner>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl Part {
    /// The positions, texture coordinates and normals of the vertices; no array where no corner names one. The corners' indices are
    /// within the arrays.
    pub(super) fn vertices(
        &self,
        positions: &[Vec3],
        uvs: &[Vec2],
        normals: &[Vec3],
    ) -> (Vec<Vec3>, Vec<Vec2>, Vec<Vec3>) {
        let corners = self.corners.as_slice();
        (
            chosen(corners, positions, |c| c.position),
            chosen(corners, uvs, |c| c.uv),
            chosen(corners, normals, |c| c.normal),
        )
    }
}

/// The values that corners name, zero where they name none; nothing where none does.
fn chosen<T: Copy + Default + Send + Sync>(
    corners: &[Corner],
    values: &[T],
    index: impl Fn(&Corner) -> u32 + Sync + Send,
) -> Vec<T> {
    if parallel::position(corners, |c| index(c) != Corner::NONE).is_none() {
        return Vec::new();
    }
    let value = |c: &Corner| index(c).checked_sub(1).map(|i| values[i as usize]);
    parallel::map(corners, |c| value(c).unwrap_or_default())
}

/// A vertex in the chain of those with the same position.
#[derive(Clone, Copy)]
struct Link {
    part: u32,
    vertex: u32,
    next: u32,
}

/// No link.
const END: u32 = u32::MAX;

/// The most links of a chain that are looked at. Positions with more vertices, which no usual mesh has, keep
/// the others in a hash table: chains would take quadratic time in a file that uses one position throughout.
const LONGEST_CHAIN: usize = 16;

/// All parts, and which vertices their corners have become.
#[derive(Default)]
pub(super) struct Parts {
    name: String,
    material: Option<String>,
    current: Option<u32>,
    by_key: HashMap<(String, Option<String>), u32>,
    all: Vec<Part>,
    /// The first link of each position.
    first: Vec<u32>,
    links: Vec<Link>,
    others: HashMap<(u32, Corner), u32>,
}

impl Parts {
    /// The following faces belong to this object or group.
    pub(super) fn name(&mut self, name: String) {
        self.name = name;
        self.current = None;
    }

    /// The following faces have this material.
    pub(super) fn material(&mut self, name: String) {
        self.material = Some(name);
        self.current = None;
    }

    /// There are so many positions now.
    pub(super) fn positions(&mut self, count: usize) {
        self.first.resize(count, END);
    }

    /// The part that faces go to, made when its first face comes.
    fn current(&mut self) -> Option<u32> {
        if self.current.is_none() {
            let fresh = u32::try_from(self.all.len()).ok()?;
            let key = (self.name.clone(), self.material.clone());
            let part = *self.by_key.entry(key).or_insert(fresh);
            if part == fresh {
                let (name, material) = (self.name.clone(), self.material.clone());
                self.all.push(Part { name, material, ..Part::default() });
            }
            self.current = Some(part);
        }
        self.current
    }

    /// Adds a face, cut into a fan, to the current part; `None` when there are too many vertices. The positions of the corners
    /// are within those there are.
    pub(super) fn face(&mut self, corners: &[Corner]) -> Option<()> {
        let mut fan = [0; 2];
        for (number, &corner) in corners.iter().enumerate() {
            let vertex = self.vertex(corner)?;
            match number {
                0 | 1 => fan[number] = vertex,
                _ => {
                    let part = self.current()?;
                    self.all[part as usize].triangles.push([fan[0], fan[1], vertex]);
                    fan[1] = vertex;
                }
            }
        }
        Some(())
    }

    /// The vertex of a corner in the current part, new or known; `None` when there are too many.
    fn vertex(&mut self, corner: Corner) -> Option<u32> {
        let current = self.current()?;
        let part = &mut self.all[current as usize];
        let fresh = u32::try_from(part.corners.len()).ok().filter(|&fresh| fresh != END)?;
        let first = &mut self.first[corner.position as usize - 1];
        let (mut at, mut length) = (*first, 0);
        while at != END && length < LONGEST_CHAIN {
            let link = self.links[at as usize];
            if link.part == current && part.corners[link.vertex as usize] == corner {
                return Some(link.vertex);
            }
            (at, length) = (link.next, length + 1);
        }
        if length < LONGEST_CHAIN {
            let link = Link { part: current, vertex: fresh, next: *first };
            *first = u32::try_from(self.links.len()).ok().filter(|&at| at != END)?;
            self.links.push(link);
        } else {
            let vertex = *self.others.entry((current, corner)).or_insert(fresh);
            if vertex != fresh {
                return Some(vertex);
            }
        }
        part.corners.push(corner);
        Some(fresh)
    }

    /// The parts that have triangles, in order of first use.
    pub(super) fn into_vec(self) -> Vec<Part> {
        let mut parts = self.all;
        parts.retain(|part| !part.triangles.is_empty());
        parts
    }
}
