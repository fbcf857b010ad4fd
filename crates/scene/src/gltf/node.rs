//! The tree of nodes.

use alloc::format;
use alloc::vec;
use alloc::vec::Vec;

use etendue_math::glam::{DAffine3, DMat3, DQuat, DVec3};

use super::document::Document;
use super::json::Json;
use crate::SceneError;

/// A node of the scene and where it is.
#[derive(Clone, Debug)]
pub(super) struct Node<'a> {
    /// What the document says of it.
    pub(super) json: Json<'a>,
    /// Its place in the document's list.
    pub(super) index: usize,
    /// From its own space to that of the world.
    pub(super) to_world: DAffine3,
}

/// All nodes of the scene, parents before children and in the order of the document otherwise: of its default scene, else of
/// its first one, else all there are.
///
/// # Errors
/// A node that does not exist, a node that is reached twice, as in cycles; a transform that is none.
pub(super) fn all(document: &Document) -> Result<Vec<Node<'_>>, SceneError> {
    let nodes = document.list("nodes")?;
    let mut seen = vec![false; nodes.len()];
    let mut found = Vec::with_capacity(nodes.len());
    // What is left to visit, the next one last.
    let mut rest: Vec<(usize, DAffine3)> = Vec::new();
    let mut visit = |list: Vec<Json<'_>>, parent: DAffine3, rest: &mut Vec<(usize, DAffine3)>| {
        let first = rest.len();
        for item in list {
            let index = item.as_index()?;
            document.element(&item, index, "nodes")?;
            if core::mem::replace(&mut seen[index], true) {
                let error = item.error(format!("leads to nodes[{index}] a second time"));
                return Err(error.help("nodes make a tree: each has one parent at most"));
            }
            rest.push((index, parent));
        }
        rest[first..].reverse();
        Ok(())
    };
    match roots(document, &nodes)? {
        Roots::Scene(list) => visit(list, DAffine3::IDENTITY, &mut rest)?,
        Roots::Orphans(list) => {
            rest.extend(list.into_iter().rev().map(|index| (index, DAffine3::IDENTITY)));
        }
    }
    while let Some((index, parent)) = rest.pop() {
        let json = nodes[index].clone();
        let to_world = parent * own(&json)?;
        visit(json.items("children")?, to_world, &mut rest)?;
        found.push(Node { json, index, to_world });
    }
    Ok(found)
}

/// Where a scene begins.
enum Roots<'a> {
    /// With the nodes of a list.
    Scene(Vec<Json<'a>>),
    /// With those that are nobody's child.
    Orphans(Vec<usize>),
}

fn roots<'a>(document: &'a Document, nodes: &[Json<'_>]) -> Result<Roots<'a>, SceneError> {
    let root = document.root();
    let scene = match document.named(&root, "scene", "scenes")? {
        Some((_, scene)) => Some(scene),
        None => document.list("scenes")?.into_iter().next(),
    };
    if let Some(scene) = scene {
        return Ok(Roots::Scene(scene.items("nodes")?));
    }
    let mut is_child = vec![false; nodes.len()];
    for node in nodes {
        for child in node.items("children")? {
            let index = child.as_index()?;
            document.element(&child, index, "nodes")?;
            is_child[index] = true;
        }
    }
    let orphans: Vec<usize> = (0..nodes.len()).filter(|&index| !is_child[index]).collect();
    if orphans.is_empty() && !nodes.is_empty() {
        let error = root.error("every node is the child of another one");
        return Err(error.help("nodes make a tree: each has one parent at most"));
    }
    Ok(Roots::Orphans(orphans))
}

/// From the space of a node to that of its parent: `matrix`, column by column, or `T R S`.
fn own(json: &Json<'_>) -> Result<DAffine3, SceneError> {
    if let Some(matrix) = json.get("matrix")? {
        let m = matrix.as_numbers::<16>()?;
        if [m[3], m[7], m[11], m[15]] != [0.0, 0.0, 0.0, 1.0] {
            return Err(matrix.error("the last row of the matrix is not 0 0 0 1"));
        }
        let column = |i: usize| DVec3::new(m[i], m[i + 1], m[i + 2]);
        return Ok(DAffine3::from_cols(column(0), column(4), column(8), column(12)));
    }
    let vector = |name: &str, default: [f64; 3]| {
        json.numbers(name).map(|numbers| DVec3::from(numbers.unwrap_or(default)))
    };
    let translation = vector("translation", [0.0; 3])?;
    let scale = vector("scale", [1.0; 3])?;
    let turn = match json.get("rotation")? {
        Some(rotation) => {
            let quaternion = DQuat::from_array(rotation.as_numbers()?);
            let length = quaternion.length();
            if length == 0.0 {
                return Err(rotation.error("a quaternion of length 0 is no rotation"));
            }
            quaternion / length
        }
        None => DQuat::IDENTITY,
    };
    Ok(placed(translation, turn, scale))
}

/// `T R S`.
pub(super) fn placed(translation: DVec3, turn: DQuat, scale: DVec3) -> DAffine3 {
    DAffine3 { matrix3: DMat3::from_quat(turn) * DMat3::from_diagonal(scale), translation }
}
