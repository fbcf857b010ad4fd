//! Where the mesh of a node stands: `EXT_mesh_gpu_instancing`.

use alloc::vec;
use alloc::vec::Vec;

use etendue_math::glam::{DAffine3, DQuat, DVec3};

use super::accessor::Accessor;
use super::buffers::Buffers;
use super::node::{Node, placed};
use crate::SceneError;

/// The places of a node's mesh: one, or as many as the extension lists.
///
/// # Errors
/// Lists of unequal length, a turn of length 0.
pub(super) fn of(buffers: &Buffers<'_>, node: &Node<'_>) -> Result<Vec<DAffine3>, SceneError> {
    let Some(extension) = node.json.extension("EXT_mesh_gpu_instancing")? else {
        return Ok(vec![node.to_world]);
    };
    let attributes = extension.need("attributes")?;
    let named = |name: &str| Accessor::named(buffers, &attributes, name);
    let (translation, rotation, scale) =
        (named("TRANSLATION")?, named("ROTATION")?, named("SCALE")?);
    let lists = [&translation, &rotation, &scale];
    let mut lengths = lists.into_iter().flatten().map(Accessor::len);
    let Some(count) = lengths.next() else { return Ok(vec![node.to_world]) };
    if lengths.any(|length| length != count) {
        return Err(attributes.error("the lists of places are not equally long"));
    }
    let vectors = |list: &Option<Accessor<'_>>, default: f32| match list {
        Some(list) => list.vectors::<3>(&[3], 0.0),
        None => Ok(vec![[default; 3]; count]),
    };
    let (translations, scales) = (vectors(&translation, 0.0)?, vectors(&scale, 1.0)?);
    let turns = match &rotation {
        Some(list) => list.vectors::<4>(&[4], 0.0)?,
        None => vec![[0.0, 0.0, 0.0, 1.0]; count],
    };
    let mut places = Vec::with_capacity(count);
    for ((translation, turn), scale) in translations.into_iter().zip(turns).zip(scales) {
        let vector = |v: [f32; 3]| DVec3::from(v.map(f64::from));
        let turn = DQuat::from_array(turn.map(f64::from));
        let length = turn.length();
        if length == 0.0 {
            return Err(attributes.error("a quaternion of length 0 is no rotation"));
        }
        places.push(node.to_world * placed(vector(translation), turn / length, vector(scale)));
    }
    Ok(places)
}
