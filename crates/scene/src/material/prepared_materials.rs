//! The materials of a scene, ready for look-ups.

use alloc::vec::Vec;

use super::{Material, MaterialId, Materials, PreparedBsdf, Side};
use crate::texture::Textures;

/// Materials with their textures: those that are the same everywhere are prepared once, the others
/// where they are asked for.
///
/// Gives the same reflection models as [`Materials::prepare`].
#[derive(Debug)]
pub struct PreparedMaterials<'a> {
    materials: &'a Materials,
    textures: &'a Textures,
    /// For each material that is the same everywhere, its models seen from the front and the back.
    uniform: Vec<Option<[PreparedBsdf<'a>; 2]>>,
}

impl<'a> PreparedMaterials<'a> {
    /// Prepares what does not depend on the place.
    pub fn new(materials: &'a Materials, textures: &'a Textures) -> Self {
        let prepare = |id| {
            [Side::Front, Side::Back].map(|side| materials.prepare(id, textures, [0.0; 2], side))
        };
        let uniform = (0..)
            .map(MaterialId)
            .zip(materials.iter())
            .map(|(id, material)| is_uniform(material, materials, textures).then(|| prepare(id)))
            .collect();
        Self { materials, textures, uniform }
    }

    /// The reflection model of a material where the texture coordinates are `uv`, looked at from one
    /// side.
    ///
    /// * `varying`: where the model is put if it had to be made for this place.
    #[inline(always)]
    pub fn at<'b>(
        &'b self,
        id: MaterialId,
        uv: [f32; 2],
        side: Side,
        varying: &'b mut Option<PreparedBsdf<'a>>,
    ) -> &'b PreparedBsdf<'a> {
        match (self.uniform.get(id.0 as usize), side) {
            (Some(Some([front, _])), Side::Front) => front,
            (Some(Some([_, back])), Side::Back) => back,
            _ => varying.insert(self.materials.prepare(id, self.textures, uv, side)),
        }
    }
}

/// Whether all textures of a material, and of those that it is made of, are constant.
fn is_uniform(material: &Material, materials: &Materials, textures: &Textures) -> bool {
    // A material refers to earlier ones only: this ends.
    let uniform = |id| materials.get(id).is_some_and(|part| is_uniform(part, materials, textures));
    material.textures().all(|id| textures.is_constant(id)) && material.nested().all(uniform)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Color;
    use crate::texture::{Checkerboard, Texture, UvTransform};
    use etendue_brdf::Bsdf;
    use etendue_math::Spectrum;
    use etendue_math::glam::Vec3;

    #[test]
    fn models_are_those_of_the_place_whether_prepared_before_or_not() {
        let mut textures = Textures::default();
        let color0 = textures.constant(Color::splat(0.25));
        let color1 = textures.constant(Color::splat(0.75));
        let board = Checkerboard { color0, color1, uv: UvTransform::IDENTITY };
        let board = textures.add(Texture::Checkerboard(board));
        let mut materials = Materials::default();
        let mut add = |material| materials.add(material).expect("it refers to earlier ones");
        let grey = add(Material::Diffuse { reflectance: color1 });
        let chequered = add(Material::Diffuse { reflectance: board });
        let ids = [
            grey,
            chequered,
            add(Material::TwoSided { front: grey, back: chequered }),
            add(Material::TwoSided { front: grey, back: grey }),
            add(Material::Mask { opacity: color0, nested: grey }),
            MaterialId(99),
        ];
        let prepared = PreparedMaterials::new(&materials, &textures);
        let wi = Vec3::new(0.6, 0.0, 0.8);
        for id in ids {
            for (side, z) in [(Side::Front, 1.0), (Side::Back, -1.0)] {
                for uv in [[0.1, 0.1], [0.6, 0.1]] {
                    let mut varying = None;
                    let model = prepared.at(id, uv, side, &mut varying);
                    let want = materials.prepare(id, &textures, uv, side);
                    let (wo, wi) = (Vec3::Z * z, wi * z);
                    assert_eq!(model.eval(wo, wi), want.eval(wo, wi), "{id:?} {side:?} {uv:?}");
                    assert_eq!(model.lobes(), want.lobes());
                }
            }
        }
    }

    #[test]
    fn only_what_varies_is_made_on_the_spot() {
        let mut textures = Textures::default();
        let white = textures.constant(Color::splat(1.0));
        let board = Checkerboard { color0: white, color1: white, uv: UvTransform::IDENTITY };
        let board = textures.add(Texture::Checkerboard(board));
        let mut materials = Materials::default();
        for (reflectance, made) in [(white, false), (board, true)] {
            let id = materials.add(Material::Diffuse { reflectance }).expect("it refers to none");
            let prepared = PreparedMaterials::new(&materials, &textures);
            let mut varying = None;
            prepared.at(id, [0.0; 2], Side::Front, &mut varying);
            assert_eq!(varying.is_some(), made);
        }
    }
}
