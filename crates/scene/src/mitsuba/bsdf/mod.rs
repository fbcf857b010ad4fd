//! Surface scattering models.

mod adapter;
mod compensation;
mod conductor;
mod dielectric;
mod diffuse;
mod phong;
mod plastic;
mod principled;
mod roughness;

use super::{Context, Family};
use crate::SceneError;
use crate::effect::Element;
use crate::material::MaterialId;
use crate::xml::NodeId;

/// The models there are.
const BSDFS: &Family<MaterialId> = &[
    ("blendbsdf", adapter::blend),
    ("bumpmap", adapter::bump_map),
    ("coating", adapter::coating),
    ("conductor", conductor::smooth),
    ("dielectric", dielectric::smooth),
    ("difftrans", diffuse::transmitter),
    ("diffuse", diffuse::diffuse),
    ("mask", adapter::mask),
    ("mixturebsdf", adapter::mixture),
    ("normalmap", adapter::normal_map),
    ("null", adapter::null),
    ("phong", phong::phong),
    ("plastic", plastic::smooth),
    ("principled", principled::solid),
    ("principledthin", principled::thin),
    ("roughconductor", conductor::rough),
    ("roughdielectric", dielectric::rough),
    ("roughdiffuse", diffuse::rough),
    ("roughplastic", plastic::rough),
    ("thindielectric", dielectric::thin),
    ("twosided", adapter::two_sided),
];

/// The material a node describes, translated once however often it is referred to.
pub(super) fn translate(context: &mut Context<'_>, id: NodeId) -> Result<MaterialId, SceneError> {
    if let Some(&material) = context.material_ids.get(&id) {
        return Ok(material);
    }
    let node = context.description.node(id);
    let material = context.translate(BSDFS, node)?;
    context.origins.note(Element::Material(material), node);
    context.material_ids.insert(id, material);
    Ok(material)
}
