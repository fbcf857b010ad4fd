//! Which properties of the vertices are their coordinates.

use alloc::vec::Vec;

use super::header::{Element, Kind};

/// Where the values of a vertex property go: eight slots for position, normal and (u, v), and one
/// that is never read.
pub(super) const UNUSED: usize = 8;

fn slot(name: &str) -> usize {
    match name {
        "x" => 0,
        "y" => 1,
        "z" => 2,
        "nx" => 3,
        "ny" => 4,
        "nz" => 5,
        "u" | "s" | "texture_u" | "texture_s" => 6,
        "v" | "t" | "texture_v" | "texture_t" => 7,
        _ => UNUSED,
    }
}

/// The slots of the properties of a vertex, in order.
pub(super) struct Columns {
    pub(super) slots: Vec<usize>,
    pub(super) has_positions: bool,
    pub(super) has_normals: bool,
    pub(super) has_uvs: bool,
}

impl Columns {
    pub(super) fn of(element: &Element) -> Self {
        let slots: Vec<usize> = element
            .properties
            .iter()
            .map(|property| match property.kind {
                Kind::Scalar(_) => slot(&property.name),
                Kind::List { .. } => UNUSED,
            })
            .collect();
        let has = |mut all: core::ops::Range<usize>| all.all(|slot| slots.contains(&slot));
        let (has_positions, has_normals, has_uvs) = (has(0..3), has(3..6), has(6..8));
        Self { slots, has_positions, has_normals, has_uvs }
    }

    /// Whether the values of a slot are read.
    pub(super) fn uses(&self, slot: usize) -> bool {
        match slot {
            0..3 => true,
            3..6 => self.has_normals,
            6..8 => self.has_uvs,
            _ => false,
        }
    }

    /// The columns of some slots, if each has one and not several.
    pub(super) fn only<const N: usize>(&self, wanted: [usize; N]) -> Option<[usize; N]> {
        let mut columns = [0; N];
        for (column, wanted) in columns.iter_mut().zip(wanted) {
            let mut found = (0..self.slots.len()).filter(|&column| self.slots[column] == wanted);
            *column = found.next()?;
            if found.next().is_some() {
                return None;
            }
        }
        Some(columns)
    }
}
