//! From a material to its reflection model at one point.

use etendue_brdf::{
    Alpha, ComplexIor, Lambert, Microfacets, Null, OrenNayar, OrenNayarQualitative, Plastic,
    Reflectance, RoughConductor, RoughDielectric, RoughPlastic, Sigma, SmoothConductor,
    SmoothDielectric, ThinDielectric,
};

use super::model::{PrincipledModel, PrincipledThinModel};
use super::prepared::Placed;
use super::{
    ConductorIndex, Material, MaterialId, Materials, Model, OrenNayarForm, PlasticSurface,
    PreparedBsdf, Roughness, Side,
};
use crate::Color;
use crate::texture::{TextureId, TexturePoint, Textures};

/// The narrowest microfacet lobe of a rough material, as in Mitsuba: below, it is sharper than the
/// directions of a picture can resolve.
const LEAST_ALPHA: f32 = 1e-4;

/// The textures at one point of a surface.
#[derive(Clone, Copy)]
pub(super) struct At<'a> {
    textures: &'a Textures,
    point: TexturePoint<'a>,
}

impl At<'_> {
    #[inline]
    pub(super) fn color(self, id: TextureId) -> Color {
        self.textures.color(id, self.point)
    }

    #[inline]
    pub(super) fn value(self, id: TextureId) -> f32 {
        self.textures.value(id, self.point)
    }

    #[inline]
    fn reflectance(self, id: TextureId) -> Reflectance<Color> {
        Reflectance::clamped(self.color(id))
    }

    #[inline]
    fn facets(self, roughness: &Roughness) -> Microfacets<f32> {
        let alpha = |id| Alpha::clamped(self.value(id).max(LEAST_ALPHA));
        let (u, v) = (alpha(roughness.alpha_u), alpha(roughness.alpha_v));
        Microfacets::new(roughness.distribution, u, v, roughness.masking)
    }

    #[inline]
    fn complex_ior(self, index: ConductorIndex) -> ComplexIor<Color> {
        match index {
            ConductorIndex::Mirror => ComplexIor::perfect(),
            ConductorIndex::Complex { eta, k } => {
                ComplexIor::clamped(self.color(eta), self.color(k))
            }
        }
    }
}

impl Materials {
    /// The reflection model of a material at a point, looked at from one side.
    ///
    /// A material that does not exist is [`Material::Null`].
    #[inline(never)]
    pub fn prepare<'a>(
        &'a self,
        id: MaterialId,
        textures: &'a Textures,
        point: TexturePoint<'a>,
        side: Side,
    ) -> PreparedBsdf<'a> {
        let at = At { textures, point };
        let mut material = self.get(id);
        let mut opacity = 1.0;
        // Masks of masks end: each refers to a material before itself.
        while let Some(&Material::Mask { opacity: texture, nested }) = material {
            opacity *= at.value(texture).min(1.0);
            material = self.get(nested);
        }
        let mut placed_on = Side::Front;
        if let Some(&Material::TwoSided { front, back }) = material {
            placed_on = side;
            material = self.get(match side {
                Side::Front => front,
                Side::Back => back,
            });
        }
        PreparedBsdf::new(Placed::new(model(material, at), placed_on), opacity)
    }
}

/// The model of a material that is made of no others.
#[inline]
fn model<'a>(material: Option<&'a Material>, at: At) -> Model<'a> {
    let Some(material) = material else { return Model::Null(Null::new()) };
    match *material {
        Material::Diffuse { reflectance } => {
            Model::Lambert(Lambert::new(at.reflectance(reflectance)))
        }
        Material::RoughDiffuse { reflectance, sigma, form } => {
            let reflectance = at.reflectance(reflectance);
            let sigma = Sigma::clamped(at.value(sigma));
            match form {
                OrenNayarForm::Full => Model::OrenNayar(OrenNayar::new(reflectance, sigma)),
                OrenNayarForm::Qualitative => {
                    Model::OrenNayarQualitative(OrenNayarQualitative::new(reflectance, sigma))
                }
            }
        }
        Material::Dielectric {
            eta,
            ref roughness,
            specular_reflectance,
            specular_transmittance,
        } => {
            let ks = at.reflectance(specular_reflectance);
            let kt = at.reflectance(specular_transmittance);
            let smooth = SmoothDielectric::new(eta).with_factors(ks, kt);
            let Some(roughness) = roughness else { return Model::SmoothDielectric(smooth) };
            match RoughDielectric::new(eta, at.facets(roughness)) {
                Ok(rough) => Model::RoughDielectric(rough.with_factors(ks, kt)),
                // Refused for equal indices only: no facet refracts, whatever its normal.
                Err(_) => Model::SmoothDielectric(smooth),
            }
        }
        Material::ThinDielectric { eta, specular_reflectance, specular_transmittance } => {
            let ks = at.reflectance(specular_reflectance);
            let kt = at.reflectance(specular_transmittance);
            Model::ThinDielectric(ThinDielectric::new(eta).with_factors(ks, kt))
        }
        Material::Conductor { index, ref roughness, specular_reflectance } => {
            let (ior, ks) = (at.complex_ior(index), at.reflectance(specular_reflectance));
            match roughness {
                None => {
                    Model::SmoothConductor(SmoothConductor::new(ior).with_specular_reflectance(ks))
                }
                Some(roughness) => Model::RoughConductor(
                    RoughConductor::new(ior, at.facets(roughness)).with_specular_reflectance(ks),
                ),
            }
        }
        Material::Plastic {
            ref surface,
            diffuse_reflectance,
            specular_reflectance,
            scattering,
        } => {
            let kd = at.reflectance(diffuse_reflectance);
            let ks = at.reflectance(specular_reflectance);
            match surface {
                PlasticSurface::Smooth(interface) => Model::Plastic(
                    Plastic::new(*interface, kd, scattering).with_specular_reflectance(ks),
                ),
                PlasticSurface::Rough(table) => Model::RoughPlastic(
                    RoughPlastic::new(table, kd, scattering).with_specular_reflectance(ks),
                ),
            }
        }
        Material::Principled(ref textures) => Model::Principled(PrincipledModel(textures.at(at))),
        Material::PrincipledThin(ref textures) => {
            Model::PrincipledThin(PrincipledThinModel(textures.at(at)))
        }
        // A mask or a two-sided material in a place for simple ones: `add` refuses it.
        Material::Mask { .. } | Material::TwoSided { .. } | Material::Null => {
            Model::Null(Null::new())
        }
    }
}
