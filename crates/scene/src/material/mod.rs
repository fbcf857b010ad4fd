//! What surfaces are made of.
//!
//! A [`Material`] names textures; [`Materials::prepare`] looks them up at one point and gives the
//! reflection model there, a [`PreparedBsdf`].

mod model;
mod prepare;
mod prepared;
mod prepared_materials;
mod principled;

use alloc::boxed::Box;
use alloc::collections::BTreeSet;
use alloc::sync::Arc;
use alloc::vec::Vec;

use etendue_brdf::{
    Alpha, Distribution, InternalReflectance, InternalScattering, Ior, Masking, PlasticInterface,
    TransmittanceTable,
};

pub use model::{Model, PrincipledModel, PrincipledThinModel};
pub use prepared::{PreparedBsdf, Side};
pub use prepared_materials::{PreparedMaterials, Varying};
pub use principled::{PrincipledTextures, PrincipledThinTextures};

use crate::texture::TextureId;

/// Names a material of a [`Materials`] arena.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MaterialId(pub u32);

/// A reflection model whose parameters vary over the surface.
///
/// Values that textures give outside a parameter's domain are moved to its nearest end.
#[derive(Clone, Debug)]
pub enum Material {
    /// Lambert's ideal diffuse reflector.
    Diffuse {
        /// Albedo.
        reflectance: TextureId,
    },
    /// Oren and Nayar's rough diffuse reflector.
    RoughDiffuse {
        /// Albedo of a facet.
        reflectance: TextureId,
        /// Standard deviation of the facets' slope angle in radians.
        sigma: TextureId,
        /// Which of their two forms.
        form: OrenNayarForm,
    },
    /// An interface between two transparent media.
    Dielectric {
        /// Index of the medium behind the surface relative to the one in front.
        eta: Ior<f32>,
        /// None for a smooth one.
        roughness: Option<Roughness>,
        /// Factor of reflected light, 1 physically.
        specular_reflectance: TextureId,
        /// Factor of transmitted light, 1 physically.
        specular_transmittance: TextureId,
    },
    /// A pane with two parallel interfaces and no thickness.
    ThinDielectric {
        /// Index of the pane relative to its surroundings.
        eta: Ior<f32>,
        /// Factor of reflected light, 1 physically.
        specular_reflectance: TextureId,
        /// Factor of transmitted light, 1 physically.
        specular_transmittance: TextureId,
    },
    /// A metal.
    Conductor {
        /// Its complex index.
        index: ConductorIndex,
        /// None for a smooth one.
        roughness: Option<Roughness>,
        /// Factor of reflected light, 1 physically.
        specular_reflectance: TextureId,
    },
    /// A diffuse base under a dielectric interface.
    Plastic {
        /// The interface.
        surface: PlasticSurface,
        /// Albedo of the base, as `scattering` takes it.
        diffuse_reflectance: TextureId,
        /// Factor of light reflected by the interface, 1 physically.
        specular_reflectance: TextureId,
        /// Whether colours shift by scattering below the interface.
        scattering: InternalScattering,
    },
    /// Disney's material: diffuse, sheen, clear coat, metal and rough glass in shares.
    Principled(Box<PrincipledTextures>),
    /// The same as a sheet without thickness.
    PrincipledThin(Box<PrincipledThinTextures>),
    /// A surface that is partly not there.
    Mask {
        /// The share of light that meets the surface.
        opacity: TextureId,
        /// What the surface is made of where it is there.
        nested: MaterialId,
    },
    /// One-sided materials, used on both sides.
    TwoSided {
        /// On the side of the normal.
        front: MaterialId,
        /// On the other.
        back: MaterialId,
    },
    /// A surface that light does not notice.
    Null,
}

/// Which form of Oren and Nayar's model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OrenNayarForm {
    /// With interreflection.
    #[default]
    Full,
    /// Their simplification.
    Qualitative,
}

/// A microfacet surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roughness {
    /// Of the facets' normals.
    pub distribution: Distribution,
    /// How facets hide each other.
    pub masking: Masking,
    /// Width α along ∂p/∂u.
    pub alpha_u: TextureId,
    /// Width α along ∂p/∂v.
    pub alpha_v: TextureId,
}

/// The index of refraction of a metal relative to what surrounds it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConductorIndex {
    /// Reflects everything, at every angle.
    Mirror,
    /// η + ik per channel.
    Complex {
        /// Real part.
        eta: TextureId,
        /// Extinction coefficient.
        k: TextureId,
    },
}

/// The interface of plastic, with what has to be integrated over it beforehand.
#[derive(Clone, Debug)]
pub enum PlasticSurface {
    /// A mirror.
    Smooth(PlasticInterface<f32>),
    /// Microfacets.
    Rough(Arc<TransmittanceTable<f32>>),
}

impl PlasticSurface {
    /// A smooth interface to a base of relative index `eta`.
    pub fn smooth(eta: Ior<f32>, internal: InternalReflectance) -> Self {
        Self::Smooth(PlasticInterface::new(eta, internal))
    }

    /// A rough interface of isotropic width `alpha` to a base of relative index `eta`.
    pub fn rough(
        eta: Ior<f32>,
        distribution: Distribution,
        alpha: Alpha<f32>,
        masking: Masking,
        internal: InternalReflectance,
    ) -> Self {
        let table = TransmittanceTable::new(eta, distribution, alpha, masking, internal);
        Self::Rough(Arc::new(table))
    }
}

/// Why a material is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MaterialError {
    /// It refers to a material that was not added before it.
    #[error("there is no material {0} yet")]
    Unknown(u32),
    /// It puts something that light can pass on one side of a surface.
    #[error("only an opaque material can be used on one side of a surface")]
    TransmissiveSide,
}

/// All materials of a scene.
#[derive(Clone, Debug, Default)]
pub struct Materials {
    materials: Vec<Material>,
}

impl Materials {
    /// Adds a material.
    ///
    /// # Errors
    /// A reference to a material that was not added before; a [`Material::TwoSided`] of materials
    /// that transmit, are masked or are two-sided themselves.
    pub fn add(&mut self, material: Material) -> Result<MaterialId, MaterialError> {
        match material {
            Material::Mask { nested, .. } => {
                self.get(nested).ok_or(MaterialError::Unknown(nested.0))?;
            }
            Material::TwoSided { front, back } => {
                for side in [front, back] {
                    let material = self.get(side).ok_or(MaterialError::Unknown(side.0))?;
                    if !material.is_one_sided() {
                        return Err(MaterialError::TransmissiveSide);
                    }
                }
            }
            _ => {}
        }
        self.materials.push(material);
        Ok(MaterialId(self.materials.len() as u32 - 1))
    }

    /// All materials, in the order of [`MaterialId`].
    pub fn iter(&self) -> impl Iterator<Item = &Material> {
        self.materials.iter()
    }

    /// Puts `change(material, earlier)` in the place of each material that it changes, in order; `earlier` are the materials
    /// before it, changed already.
    pub(crate) fn change(&mut self, change: impl Fn(&Material, &[Material]) -> Option<Material>) {
        for i in 0..self.materials.len() {
            let (earlier, rest) = self.materials.split_at_mut(i);
            if let Some(changed) = change(&rest[0], earlier) {
                rest[0] = changed;
            }
        }
    }

    /// Whether light may pass a surface of this material straight on, as if it were not there; true for
    /// an unknown one, which is [`Material::Null`].
    pub fn may_pass(&self, id: MaterialId) -> bool {
        match self.get(id) {
            None
            | Some(Material::Null | Material::Mask { .. } | Material::ThinDielectric { .. }) => {
                true
            }
            Some(Material::Dielectric { eta, .. }) => eta.is_matched(),
            // A material refers to earlier ones only: this ends.
            Some(material) => material.nested().any(|part| self.may_pass(part)),
        }
    }

    /// Materials and those that they are made of.
    pub fn with_parts(&self, ids: impl IntoIterator<Item = MaterialId>) -> BTreeSet<MaterialId> {
        let mut all = BTreeSet::new();
        let mut rest: Vec<MaterialId> = ids.into_iter().collect();
        while let Some(id) = rest.pop() {
            if all.insert(id) {
                rest.extend(self.get(id).into_iter().flat_map(Material::nested));
            }
        }
        all
    }

    /// A material, or `None` for an unknown `id`.
    #[inline]
    pub fn get(&self, id: MaterialId) -> Option<&Material> {
        self.materials.get(id.0 as usize)
    }
}

impl Material {
    /// The textures that it names itself.
    pub fn textures(&self) -> impl Iterator<Item = TextureId> + use<> {
        let widths = |roughness: Option<Roughness>| {
            roughness.into_iter().flat_map(|r| [r.alpha_u, r.alpha_v])
        };
        let textures = match *self {
            Self::Diffuse { reflectance } => Vec::from([reflectance]),
            Self::RoughDiffuse { reflectance, sigma, .. } => Vec::from([reflectance, sigma]),
            Self::Dielectric {
                roughness, specular_reflectance, specular_transmittance, ..
            } => {
                let factors = [specular_reflectance, specular_transmittance];
                factors.into_iter().chain(widths(roughness)).collect()
            }
            Self::ThinDielectric { specular_reflectance, specular_transmittance, .. } => {
                Vec::from([specular_reflectance, specular_transmittance])
            }
            Self::Conductor { index, roughness, specular_reflectance } => {
                let index = match index {
                    ConductorIndex::Mirror => None,
                    ConductorIndex::Complex { eta, k } => Some([eta, k]),
                };
                let index = index.into_iter().flatten();
                [specular_reflectance].into_iter().chain(widths(roughness)).chain(index).collect()
            }
            Self::Plastic { diffuse_reflectance, specular_reflectance, .. } => {
                Vec::from([diffuse_reflectance, specular_reflectance])
            }
            Self::Principled(ref textures) => textures.textures(),
            Self::PrincipledThin(ref textures) => textures.textures(),
            Self::Mask { opacity, .. } => Vec::from([opacity]),
            Self::TwoSided { .. } | Self::Null => Vec::new(),
        };
        textures.into_iter()
    }

    /// The materials that it is made of.
    pub fn nested(&self) -> impl Iterator<Item = MaterialId> + use<> {
        let parts = match *self {
            Self::Mask { nested, .. } => [Some(nested), None],
            Self::TwoSided { front, back } => [Some(front), Some(back)],
            _ => [None; 2],
        };
        parts.into_iter().flatten()
    }

    /// Reflects on the front and is black from behind.
    fn is_one_sided(&self) -> bool {
        match self {
            Self::Diffuse { .. }
            | Self::RoughDiffuse { .. }
            | Self::Conductor { .. }
            | Self::Plastic { .. } => true,
            Self::Principled(textures) => textures.spec_trans.is_none(),
            Self::Dielectric { .. }
            | Self::ThinDielectric { .. }
            | Self::PrincipledThin(_)
            | Self::Mask { .. }
            | Self::TwoSided { .. }
            | Self::Null => false,
        }
    }
}

#[cfg(test)]
mod tests;
