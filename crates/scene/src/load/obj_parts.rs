//! The parts of an OBJ file while it is read: faces by name and material, corners joined to vertices.

use alloc::borrow::ToOwned as _;
use alloc::string::String;
use alloc::vec::Vec;
use std::collections::HashMap;

use etendue_math::glam::{Vec2, Vec3};

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
    pub(super) positions: Vec<Vec3>,
    pub(super) uvs: Vec<Vec2>,
    pub(super) normals: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    has_uvs: bool,
    has_normals: bool,
}

/// A corner of a part and the vertex made for it.
#[derive(Clone, Copy)]
struct Binding {
    part: u32,
    corner: Corner,
    vertex: u32,
}

/// All parts, and which vertices their corners have become.
///
/// Most positions have one corner only, which is kept beside the position; the others are in a hash
/// table. Chains per position would be quadratic in a file that uses one position throughout.
#[derive(Default)]
pub(super) struct Parts {
    name: String,
    material: Option<String>,
    current: Option<u32>,
    by_key: HashMap<(String, Option<String>), u32>,
    all: Vec<Part>,
    first: Vec<Option<Binding>>,
    others: HashMap<(u32, Corner), u32>,
}

impl Parts {
    /// The following faces belong to this object or group.
    pub(super) fn name(&mut self, name: &str) {
        name.clone_into(&mut self.name);
        self.current = None;
    }

    /// The following faces have this material.
    pub(super) fn material(&mut self, name: &str) {
        self.material = Some(name.to_owned());
        self.current = None;
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

    /// The vertex of a corner in the current part, new or known; `None` when there are too many.
    /// The corner's indices are within the arrays.
    pub(super) fn vertex(
        &mut self,
        corner: Corner,
        positions: &[Vec3],
        uvs: &[Vec2],
        normals: &[Vec3],
    ) -> Option<u32> {
        let current = self.current()?;
        let part = &mut self.all[current as usize];
        let fresh = u32::try_from(part.positions.len()).ok()?;
        if self.first.len() < positions.len() {
            self.first.resize(positions.len(), None);
        }
        let vertex = match &mut self.first[corner.position as usize - 1] {
            Some(b) if b.part == current && b.corner == corner => b.vertex,
            Some(_) => *self.others.entry((current, corner)).or_insert(fresh),
            empty => {
                *empty = Some(Binding { part: current, corner, vertex: fresh });
                fresh
            }
        };
        if vertex == fresh {
            let at = |i: u32| i.checked_sub(1).map(|i| i as usize);
            part.positions.push(positions[corner.position as usize - 1]);
            part.uvs.push(at(corner.uv).map_or(Vec2::ZERO, |i| uvs[i]));
            part.normals.push(at(corner.normal).map_or(Vec3::ZERO, |i| normals[i]));
            part.has_uvs |= corner.uv != Corner::NONE;
            part.has_normals |= corner.normal != Corner::NONE;
        }
        Some(vertex)
    }

    /// Adds a triangle of vertices of the current part.
    pub(super) fn triangle(&mut self, vertices: [u32; 3]) {
        if let Some(current) = self.current {
            self.all[current as usize].triangles.push(vertices);
        }
    }

    /// The parts that have triangles, in order of first use.
    pub(super) fn into_vec(self) -> Vec<Part> {
        let mut parts = self.all;
        parts.retain(|part| !part.triangles.is_empty());
        for part in &mut parts {
            if !part.has_uvs {
                part.uvs = Vec::new();
            }
            if !part.has_normals {
                part.normals = Vec::new();
            }
        }
        parts
    }
}
