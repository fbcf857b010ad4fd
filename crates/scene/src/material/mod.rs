//! What surfaces are made of.
//!
//! A [`Material`] names textures; [`Materials::prepare`] looks them up at one point and gives the
//! reflection model there, a [`PreparedBsdf`].

mod coated;
mod compensated;
mod composed;
mod dispersive;
mod model;
mod nesting;
mod perturbed;
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

pub use compensated::{Compensated, Compensation, Metal};
pub use composed::Composed;
pub use dispersive::{Dispersed, Dispersive, RelativeDispersion};
pub use model::{Model, PrincipledModel, PrincipledThinModel};
pub use nesting::Nesting;
pub use perturbed::Perturbation;
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
    /// A thin sheet that scatters to both sides.
    DiffuseTransmitter {
        /// Share of light that it reflects.
        reflectance: TextureId,
        /// Share of light that it lets through; where both exceed 1 together, both are scaled.
        transmittance: TextureId,
    },
    /// Phong's model, modified: a diffuse part and a power of the cosine around the mirror direction.
    Phong {
        /// Share of light in the diffuse part.
        diffuse_reflectance: TextureId,
        /// Share of light in the lobe; where both exceed 1 together, both are scaled.
        specular_reflectance: TextureId,
        /// The power.
        exponent: TextureId,
    },
    /// An interface between two transparent media.
    Dielectric {
        /// Index of the medium behind the surface relative to the one in front.
        eta: Ior<f32>,
        /// The same index for every wavelength; none where it is that of all.
        dispersion: Option<Box<RelativeDispersion>>,
        /// What it is where bodies overlap; none where they do not.
        nesting: Option<Nesting>,
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
    /// A rough metal or rough glass with the light that its facets scatter more than once.
    Compensated {
        /// The same without.
        nested: MaterialId,
        /// Where that light goes.
        how: Compensation,
    },
    /// A surface under a smooth dielectric layer.
    Coated {
        /// Index of the layer relative to what is above it.
        eta: Ior<f32>,
        /// Absorption coefficient of the layer, per unit of its thickness.
        absorption: TextureId,
        /// Thickness of the layer, which only its absorption depends on.
        thickness: f32,
        /// Factor of light reflected by the interface, 1 physically.
        specular_reflectance: TextureId,
        /// The surface, an opaque one.
        nested: MaterialId,
    },
    /// A surface that is partly not there.
    Mask {
        /// The share of light that meets the surface.
        opacity: TextureId,
        /// What the surface is made of where it is there.
        nested: MaterialId,
    },
    /// Two materials in shares.
    Blend {
        /// The share of the second.
        weight: TextureId,
        /// The first and the second.
        parts: [MaterialId; 2],
    },
    /// A surface that is shaded as if its normal were another.
    NormalMap {
        /// `(n + 1)/2` of the normal in the shading frame, per channel.
        normal: TextureId,
        /// What is done where the normals disagree.
        options: Perturbation,
        /// What the surface is made of.
        nested: MaterialId,
    },
    /// A surface that is shaded as if it had bumps.
    BumpMap {
        /// Height of the bumps: a bitmap, or a constant, which has none.
        height: TextureId,
        /// What the height is multiplied by.
        scale: f32,
        /// What is done where the normals disagree.
        options: Perturbation,
        /// What the surface is made of.
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
    /// It belongs to a family that the program was compiled without.
    #[error(
        "this program was compiled without the materials of the feature “{0}” of etendue-scene"
    )]
    NotCompiled(&'static str),
    /// It puts bumps on what is already seen in another frame.
    #[error("a bump map cannot be used inside a normal map or a bump map")]
    NestedBumps,
    /// It puts something that light can pass on one side of a surface.
    #[error("only an opaque material can be used on one side of a surface")]
    TransmissiveSide,
    /// It puts a layer on something that light can pass.
    #[error("only an opaque material, of one side, can have a coating")]
    TransmissiveBase,
    /// It is made of too many others, those that are met more than once counted every time.
    #[error("the material is made of {0} others, {MOST_PARTS} are possible")]
    TooManyParts(u32),
}

/// The most parts of a material: each is looked at at every hit. A few that refer to each other twice could make a number that no
/// machine has time for.
const MOST_PARTS: u32 = 4096;

/// All materials of a scene.
#[derive(Clone, Debug, Default)]
pub struct Materials {
    materials: Vec<Material>,
    /// Of how many parts each consists, with itself, each counted as often as it is met.
    parts: Vec<u32>,
}

impl Materials {
    /// Adds a material.
    ///
    /// # Errors
    /// A family that the program was compiled without; a reference to a material that was not added before; a [`Material::TwoSided`]
    /// or [`Material::Coated`] of materials that transmit, are masked or are two-sided themselves; a [`Material::BumpMap`] inside another or inside a
    /// [`Material::NormalMap`]; a material of more than 4096 parts.
    pub fn add(&mut self, material: Material) -> Result<MaterialId, MaterialError> {
        if let Some((family, false)) = material.family() {
            return Err(MaterialError::NotCompiled(family));
        }
        match material {
            Material::Mask { nested, .. } | Material::Compensated { nested, .. } => {
                self.get(nested).ok_or(MaterialError::Unknown(nested.0))?;
            }
            Material::NormalMap { nested, .. } | Material::BumpMap { nested, .. } => {
                self.get(nested).ok_or(MaterialError::Unknown(nested.0))?;
                let is_bump = |part| matches!(self.get(part), Some(Material::BumpMap { .. }));
                if self.with_parts([nested]).into_iter().any(is_bump) {
                    return Err(MaterialError::NestedBumps);
                }
            }
            Material::Blend { parts, .. } => {
                for part in parts {
                    self.get(part).ok_or(MaterialError::Unknown(part.0))?;
                }
            }
            Material::Coated { nested, .. } => {
                let base = self.get(nested).ok_or(MaterialError::Unknown(nested.0))?;
                if !self.is_one_sided(base) {
                    return Err(MaterialError::TransmissiveBase);
                }
            }
            Material::TwoSided { front, back } => {
                for side in [front, back] {
                    let material = self.get(side).ok_or(MaterialError::Unknown(side.0))?;
                    if !self.is_one_sided(material) {
                        return Err(MaterialError::TransmissiveSide);
                    }
                }
            }
            _ => {}
        }
        let parts = material.nested().filter_map(|part| self.parts.get(part.0 as usize));
        let parts = parts.fold(1_u32, |sum, part| sum.saturating_add(*part));
        if parts > MOST_PARTS {
            return Err(MaterialError::TooManyParts(parts));
        }
        self.materials.push(material);
        self.parts.push(parts);
        Ok(MaterialId(self.materials.len() as u32 - 1))
    }

    /// Whether a material reflects on the front and is black from behind.
    fn is_one_sided(&self, material: &Material) -> bool {
        match material {
            Material::Diffuse { .. }
            | Material::RoughDiffuse { .. }
            | Material::Phong { .. }
            | Material::Coated { .. }
            | Material::Conductor { .. }
            | Material::Plastic { .. } => true,
            Material::Principled(textures) => textures.spec_trans.is_none(),
            // What they are made of was there before them: this ends.
            Material::Compensated { .. }
            | Material::Blend { .. }
            | Material::NormalMap { .. }
            | Material::BumpMap { .. } => {
                let part = |id| self.get(id).is_some_and(|part| self.is_one_sided(part));
                material.nested().all(part)
            }
            Material::DiffuseTransmitter { .. }
            | Material::Dielectric { .. }
            | Material::ThinDielectric { .. }
            | Material::PrincipledThin(_)
            | Material::Mask { .. }
            | Material::TwoSided { .. }
            | Material::Null => false,
        }
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
            Some(Material::Dielectric { eta, dispersion: None, .. }) => eta.is_matched(),
            // A material refers to earlier ones only: this ends.
            Some(material) => material.nested().any(|part| self.may_pass(part)),
        }
    }

    /// Whether there are [bodies among others](Nesting).
    pub fn nest(&self) -> bool {
        self.materials.iter().any(|material| material.nesting().is_some())
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
            Self::DiffuseTransmitter { reflectance, transmittance } => {
                Vec::from([reflectance, transmittance])
            }
            Self::Phong { diffuse_reflectance, specular_reflectance, exponent } => {
                Vec::from([diffuse_reflectance, specular_reflectance, exponent])
            }
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
            Self::Coated { absorption, specular_reflectance, .. } => {
                Vec::from([absorption, specular_reflectance])
            }
            Self::Mask { opacity, .. } => Vec::from([opacity]),
            Self::Blend { weight, .. } => Vec::from([weight]),
            Self::NormalMap { normal, .. } => Vec::from([normal]),
            Self::BumpMap { height, .. } => Vec::from([height]),
            Self::Compensated { .. } | Self::TwoSided { .. } | Self::Null => Vec::new(),
        };
        textures.into_iter()
    }

    /// The feature of this crate that it belongs to, and whether the program was compiled with it; none for what is always
    /// there.
    pub fn family(&self) -> Option<(&'static str, bool)> {
        Some(match self {
            Self::Dielectric { dispersion: Some(_), .. } => {
                ("dispersion", cfg!(feature = "dispersion"))
            }
            Self::Dielectric { roughness: Some(_), .. }
            | Self::Conductor { roughness: Some(_), .. }
            | Self::Compensated { .. } => ("rough", cfg!(feature = "rough")),
            Self::Dielectric { .. } | Self::ThinDielectric { .. } | Self::Conductor { .. } => {
                ("smooth", cfg!(feature = "smooth"))
            }
            Self::Phong { .. } => ("phong", cfg!(feature = "phong")),
            Self::Plastic { .. } => ("layered", cfg!(feature = "layered")),
            Self::Principled(_) | Self::PrincipledThin(_) => {
                ("principled", cfg!(feature = "principled"))
            }
            Self::Coated { .. }
            | Self::Blend { .. }
            | Self::NormalMap { .. }
            | Self::BumpMap { .. } => ("composed", cfg!(feature = "composed")),
            Self::Diffuse { .. }
            | Self::RoughDiffuse { .. }
            | Self::DiffuseTransmitter { .. }
            | Self::Mask { .. }
            | Self::TwoSided { .. }
            | Self::Null => return None,
        })
    }

    /// What it is among other bodies, if it is a body among others.
    #[inline]
    pub fn nesting(&self) -> Option<Nesting> {
        match *self {
            Self::Dielectric { nesting, .. } => nesting,
            _ => None,
        }
    }

    /// Whether it refracts light of different wavelengths into different directions.
    pub fn disperses(&self) -> bool {
        matches!(self, Self::Dielectric { dispersion: Some(_), .. })
    }

    /// The materials that it is made of.
    pub fn nested(&self) -> impl Iterator<Item = MaterialId> + use<> {
        let parts = match *self {
            Self::Compensated { nested, .. }
            | Self::Coated { nested, .. }
            | Self::Mask { nested, .. }
            | Self::NormalMap { nested, .. }
            | Self::BumpMap { nested, .. } => [Some(nested), None],
            Self::Blend { parts: [first, second], .. } => [Some(first), Some(second)],
            Self::TwoSided { front, back } => [Some(front), Some(back)],
            _ => [None; 2],
        };
        parts.into_iter().flatten()
    }
}

#[cfg(test)]
mod tests;
