//! How vertices make triangles.

use alloc::format;
use alloc::vec::Vec;

use super::json::Json;
use crate::SceneError;

/// What a primitive's vertices make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Topology {
    Triangles,
    Strip,
    Fan,
    /// Points and lines, which have no surface.
    NoSurface,
}

impl Topology {
    /// The `mode` of a primitive; triangles where it says nothing.
    ///
    /// # Errors
    /// A number that is no mode.
    pub(super) fn of(primitive: &Json<'_>) -> Result<Self, SceneError> {
        let Some(mode) = primitive.get("mode")? else { return Ok(Self::Triangles) };
        match mode.as_index()? {
            0..=3 => Ok(Self::NoSurface),
            4 => Ok(Self::Triangles),
            5 => Ok(Self::Strip),
            6 => Ok(Self::Fan),
            other => Err(mode.error(format!("{other} is no mode; they are 0 to 6"))),
        }
    }

    /// The triangles of a list of vertices; those of a list that ends within one are fewer.
    ///
    /// # Source
    /// glTF 2.0, section 3.7.2.1: triangle i of a strip is `i, i + 1 + i mod 2, i + 2 − i mod 2`, of a fan `i + 1, i + 2, 0`.
    pub(super) fn triangles(self, vertices: &[u32]) -> Vec<[u32; 3]> {
        match self {
            Self::Triangles => vertices.as_chunks().0.to_vec(),
            Self::Strip => {
                let wind = |(i, w): (usize, &[u32])| {
                    if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[0], w[2], w[1]] }
                };
                vertices.windows(3).enumerate().map(wind).collect()
            }
            Self::Fan => match vertices {
                [center, rim @ ..] => rim.windows(2).map(|w| [w[0], w[1], *center]).collect(),
                [] => Vec::new(),
            },
            Self::NoSurface => Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_keep_their_side() {
        let vertices = [7, 8, 9, 10, 11];
        assert_eq!(Topology::Triangles.triangles(&vertices), [[7, 8, 9]]);
        let strip = [[7, 8, 9], [8, 10, 9], [9, 10, 11]];
        assert_eq!(Topology::Strip.triangles(&vertices), strip);
        assert_eq!(Topology::Fan.triangles(&vertices), [[8, 9, 7], [9, 10, 7], [10, 11, 7]]);
        for topology in [Topology::Triangles, Topology::Strip, Topology::Fan] {
            assert!(topology.triangles(&vertices[..2]).is_empty());
            assert!(topology.triangles(&[]).is_empty());
        }
    }
}
