//! Which properties of a PLY file are attributes of the mesh.

use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use rayon::prelude::*;

use super::header::{Element, Kind, Property};
use crate::Color;
use crate::geometry::{AttributeOwner, MeshAttribute};

/// The last letters of the properties that make up one attribute, in order.
const SCHEMES: [&str; 4] = ["xyzw", "rgba", "0123", "1234"];

/// Names of colours without a prefix.
const COLORS: [[&str; 3]; 2] = [["r", "g", "b"], ["red", "green", "blue"]];

/// An attribute and the places of its one or three properties in the element.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Group {
    name: String,
    columns: Vec<usize>,
}

impl Group {
    /// The value that a record's numbers have, and how many of them were moved to 0: those that are negative or not finite.
    fn color(&self, number: impl Fn(usize) -> f64) -> (Color, usize) {
        let mut moved = 0;
        let mut valid = |column: usize| {
            let value = number(column) as f32;
            let is_valid = value >= 0.0 && value.is_finite();
            moved += usize::from(!is_valid);
            if is_valid { value } else { 0.0 }
        };
        let color = match self.columns[..] {
            [r, g, b] => Color::new(valid(r), valid(g), valid(b)),
            _ => [valid(self.columns[0]); 3].into(),
        };
        (color, moved)
    }
}

/// The attributes of an element, and their values as far as they are read.
#[derive(Debug)]
pub(super) struct Attributes {
    owner: AttributeOwner,
    groups: Vec<Group>,
    values: Vec<Vec<Color>>,
    /// How many values were moved to 0.
    moved: usize,
}

impl Attributes {
    /// The attributes among the properties of an element.
    ///
    /// ```text
    /// r g b, or red green blue                      vertex_color, face_color
    /// P_0, or P_0 P_1 P_2 (likewise x y z, 1 2 3)   vertex_P, face_P
    /// P_r, or P_r P_g P_b                           vertex_P_color, face_P_color
    /// ```
    ///
    /// Properties of one attribute follow each other. All others, those with two or four parts among them, are none.
    ///
    /// # Source
    /// Mitsuba 3's `ply`, whose attributes have the same names.
    pub(super) fn of(element: &Element, owner: AttributeOwner) -> Self {
        let kind = match owner {
            AttributeOwner::Vertex => "vertex",
            AttributeOwner::Face => "face",
        };
        let properties = &element.properties;
        let mut groups: Vec<Group> = Vec::new();
        if let Some(columns) = colors(properties) {
            groups.push(Group { name: format!("{kind}_color"), columns });
        }
        let mut begun = Vec::new();
        let mut at = 0;
        while let Some(property) = properties.get(at) {
            let Some((prefix, letter)) = split(property) else {
                at += 1;
                continue;
            };
            // All that follows with the same prefix belongs together or is nothing.
            let run = properties[at..].iter().map_while(split).take_while(|(p, _)| *p == prefix);
            let letters: String = run.map(|(_, letter)| letter).collect();
            let scheme = SCHEMES.iter().find(|scheme| scheme.starts_with(letter));
            let valid = scheme.filter(|scheme| scheme.starts_with(&letters));
            if let (Some(&scheme), 1 | 3, false) = (valid, letters.len(), begun.contains(&prefix)) {
                let color = if scheme == "rgba" { "_color" } else { "" };
                let columns = (at..at + letters.len()).collect();
                groups.push(Group { name: format!("{kind}_{prefix}{color}"), columns });
                begun.push(prefix);
            }
            at += letters.len();
        }
        let values = vec![Vec::new(); groups.len()];
        Self { owner, groups, values, moved: 0 }
    }

    /// Adds what a record says, for `times` vertices or triangles; `record` has one number per property.
    ///
    /// Numbers that are negative or not finite are 0.
    pub(super) fn push(&mut self, record: &[f64], times: usize) {
        for (group, values) in self.groups.iter().zip(&mut self.values) {
            let (color, moved) = group.color(|column| record[column]);
            self.moved += moved;
            values.extend(core::iter::repeat_n(color, times));
        }
    }

    /// Sets what all records say, one per vertex or triangle, on all cores; `number` is that of a property in a record.
    pub(super) fn collect<'a>(
        &mut self,
        records: &(impl IndexedParallelIterator<Item = &'a [u8]> + Clone),
        number: impl Fn(&[u8], usize) -> f64 + Sync,
    ) {
        for (group, values) in self.groups.iter().zip(&mut self.values) {
            let colors = records.clone().map(|r| group.color(|column| number(r, column)));
            self.moved += colors.clone().map(|(_, moved)| moved).sum::<usize>();
            *values = colors.map(|(color, _)| color).collect();
        }
    }

    /// Whether there are none.
    pub(super) fn is_empty(&self) -> bool {
        self.groups.is_empty()
    }

    /// How many numbers were negative or not finite.
    pub(super) fn moved(&self) -> usize {
        self.moved
    }

    /// The attributes with their values.
    pub(super) fn finish(self) -> impl Iterator<Item = MeshAttribute> {
        let owner = self.owner;
        let named = self.groups.into_iter().zip(self.values);
        named.map(move |(group, values)| MeshAttribute { name: group.name, owner, values })
    }
}

/// The places of red, green and blue.
fn colors(properties: &[Property]) -> Option<Vec<usize>> {
    let place = |name: &str| properties.iter().position(|p| p.name == name && is_scalar(p));
    COLORS.iter().find_map(|names| names.iter().map(|name| place(name)).collect())
}

/// The name of a property without its last letter, and the letter; `None` where an underscore does not precede it.
fn split(property: &Property) -> Option<(&str, char)> {
    let (prefix, letter) = property.name.rsplit_once('_').filter(|_| is_scalar(property))?;
    let mut letters = letter.chars();
    letters.next().filter(|_| letters.next().is_none()).map(|letter| (prefix, letter))
}

fn is_scalar(property: &Property) -> bool {
    matches!(property.kind, Kind::Scalar(_))
}

#[cfg(test)]
mod tests {
    use super::super::header::Scalar;
    use super::*;

    /// Names of the attributes of vertices with these properties, each with the places of its parts.
    fn groups(names: &[&str]) -> Vec<(String, Vec<usize>)> {
        let kind = Kind::Scalar(Scalar::F32);
        let properties = names.iter().map(|&name| Property { name: name.into(), kind }).collect();
        let element = Element { name: "vertex".into(), count: 0, properties, line: 1 };
        let attributes = Attributes::of(&element, AttributeOwner::Vertex);
        attributes.groups.into_iter().map(|group| (group.name, group.columns)).collect()
    }

    #[test]
    fn properties_become_the_attributes_that_mitsuba_makes_of_them() {
        // The names are those of mi.traverse(mi.load_dict({'type': 'ply', …})), 3.9.1.
        let found =
            groups(&["x", "red", "green", "blue", "alpha", "heat", "w_0", "c_r", "c_g", "c_b"]);
        let expected = [
            ("vertex_color", vec![1, 2, 3]),
            ("vertex_w", vec![6]),
            ("vertex_c_color", vec![7, 8, 9]),
        ];
        assert_eq!(found, expected.map(|(name, columns)| (name.into(), columns)));
    }

    #[test]
    fn what_is_no_attribute_is_left_out() {
        // Two and four parts, parts out of order, a prefix that comes back, a scheme begun in the middle.
        assert_eq!(groups(&["a_x", "a_y", "b_0", "b_1", "b_2", "b_3"]), []);
        assert_eq!(groups(&["a_0", "a_2", "a_1", "b_y", "texture_u", "texture_v"]), []);
        assert_eq!(groups(&["a_0", "b_1", "a_0"]).len(), 2);
    }
}
