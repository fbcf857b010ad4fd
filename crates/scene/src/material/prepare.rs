//! From a material to its reflection model at one point.

use etendue_brdf::{
    Alpha, ComplexIor, DiffuseTransmitter, Exponent, Ior, KullaContyConductor, Lambert,
    Microfacets, Null, Opacity, OrenNayar, OrenNayarQualitative, Phong, Plastic, Reflectance,
    RoughConductor, RoughDielectric, RoughPlastic, Sigma, SmoothConductor, SmoothDielectric,
    ThinDielectric,
};

use etendue_math::glam::Vec3;

use super::composed::{Coat, Composed, Composition, Parts};
use super::model::{PrincipledModel, PrincipledThinModel};
use super::perturbed::Perturbed;
use super::prepared::Placed;
use super::{
    Compensated, Compensation, ConductorIndex, Dispersive, Material, MaterialId, Materials, Metal,
    Model, OrenNayarForm, PlasticSurface, PreparedBsdf, RelativeDispersion, Roughness, Side,
};
use crate::color::Channels;
use crate::geometry::SurfacePoint;
use crate::texture::{TextureId, TexturePoint, Textures};

/// The narrowest microfacet lobe of a rough material, as in Mitsuba: below, it is sharper than the
/// directions of a picture can resolve.
const LEAST_ALPHA: f32 = 1e-4;

/// The widest facets whose multiple scattering is tabulated.
const WIDEST_TABLE: f32 = 1.0;

/// The textures at one point of a surface.
#[derive(Clone, Copy)]
pub(super) struct At<'a, C> {
    materials: &'a Materials,
    textures: &'a Textures,
    point: TexturePoint<'a>,
    channels: C,
    /// Index of refraction outside of a body among others, where it is not that of its material.
    exterior: Option<f32>,
}

impl<'a, C: Channels> At<'a, C> {
    #[inline]
    pub(super) fn color(self, id: TextureId) -> C::Color {
        self.textures.matter(id, self.point, self.channels)
    }

    #[inline]
    pub(super) fn value(self, id: TextureId) -> f32 {
        self.textures.value(id, self.point)
    }

    fn composed(self, how: Composition) -> Model<'a, C> {
        let Self { materials, textures, point, channels, .. } = self;
        Model::Composed(Composed::new(Parts { materials, textures, point, channels }, how))
    }

    /// The normal, in the shading frame and of any length, of bumps of a height; `+z` where the surface is not known.
    ///
    /// ```text
    /// n ∝ (Pu + n ∂h/∂u) × (Pv + n ∂h/∂v),  Pu, Pv: the parts of ∂p/∂u, ∂p/∂v orthogonal to n
    /// ```
    ///
    /// on the side of the geometric normal.
    ///
    /// # Source
    /// J. Blinn, "Simulation of Wrinkled Surfaces", SIGGRAPH 1978, without the change of the normal; Mitsuba 3's
    /// `bumpmap`.
    fn bumped(self, height: TextureId, scale: f32) -> Vec3 {
        let Some(surface) = self.point.surface else { return Vec3::Z };
        let SurfacePoint { shading, normal, .. } = *surface.point();
        let slopes = self.textures.gradient(height, self.point.uv).map(|slope| slope * scale);
        let [du, dv] = surface.partials();
        let bumped = |d: Vec3, slope: f32| d + shading.n * (slope - shading.n.dot(d));
        let n = bumped(du, slopes[0]).cross(bumped(dv, slopes[1]));
        shading.to_local(if normal.dot(n) < 0.0 { -n } else { n })
    }

    #[inline]
    fn reflectance(self, id: TextureId) -> Reflectance<C::Color> {
        Reflectance::clamped(self.color(id))
    }

    #[inline]
    fn facets(self, roughness: &Roughness, widest: f32) -> Microfacets<f32> {
        let alpha = |id| Alpha::clamped(self.value(id).max(LEAST_ALPHA).min(widest));
        let (u, v) = (alpha(roughness.alpha_u), alpha(roughness.alpha_v));
        Microfacets::new(roughness.distribution, u, v, roughness.masking)
    }

    #[inline]
    fn complex_ior(self, index: ConductorIndex) -> ComplexIor<C::Color> {
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
    pub fn prepare<'a, C: Channels>(
        &'a self,
        id: MaterialId,
        textures: &'a Textures,
        point: TexturePoint<'a>,
        side: Side,
        channels: C,
    ) -> PreparedBsdf<'a, C> {
        self.prepare_within(id, textures, point, side, channels, None)
    }

    /// The same for a surface of a [body among others](super::Nesting), which has one of index `exterior` around it there.
    pub fn prepare_within<'a, C: Channels>(
        &'a self,
        id: MaterialId,
        textures: &'a Textures,
        point: TexturePoint<'a>,
        side: Side,
        channels: C,
        exterior: Option<f32>,
    ) -> PreparedBsdf<'a, C> {
        let at = At { materials: self, textures, point, channels, exterior };
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

/// The model of a rough material with a compensation; `None` where it is of another kind than that is for.
fn compensated<'a, C: Channels>(
    material: &Material,
    how: &'a Compensation,
    at: At<'a, C>,
) -> Option<Compensated<'a, C::Color>> {
    match (material, how) {
        (
            &Material::Dielectric { specular_reflectance, specular_transmittance, .. },
            Compensation::KullaContyGlass(glass),
        ) => {
            let factors = [specular_reflectance, specular_transmittance];
            Some(Compensated::KullaContyGlass(glass, factors.map(|id| at.reflectance(id))))
        }
        (
            &Material::Conductor { index, roughness: Some(ref roughness), specular_reflectance },
            Compensation::KullaContyMetal | Compensation::TurquinMetal,
        ) => {
            let ior = at.complex_ior(index);
            let facets = at.facets(roughness, WIDEST_TABLE);
            let specular_reflectance = at.reflectance(specular_reflectance);
            let metal = Metal { ior, facets, specular_reflectance };
            Some(if *how == Compensation::TurquinMetal {
                Compensated::TurquinMetal(metal)
            } else {
                let average = KullaContyConductor::average_reflectance(ior);
                Compensated::KullaContyMetal(metal, average)
            })
        }
        _ => None,
    }
}

/// The model of an interface between transparent media.
fn interface<'a, C: Channels>(
    eta: Ior<f32>,
    dispersion: Option<RelativeDispersion>,
    roughness: Option<&Roughness>,
    [ks, kt]: [Reflectance<C::Color>; 2],
    at: At<'a, C>,
) -> Model<'a, C> {
    let facets = roughness.map(|roughness| at.facets(roughness, f32::INFINITY));
    if let Some(dispersion) = dispersion
        && let Some(indices) = at.channels.indices(|nm| dispersion.index(nm))
    {
        return Model::Dispersive(Dispersive::new(indices, facets).with_factors(ks, kt));
    }
    // Refused for equal indices only: no facet refracts, whatever its normal.
    let rough = facets.and_then(|facets| RoughDielectric::new(eta, facets).ok());
    match rough {
        Some(rough) => Model::RoughDielectric(rough.with_factors(ks, kt)),
        None => Model::SmoothDielectric(SmoothDielectric::new(eta).with_factors(ks, kt)),
    }
}

/// How a material is made of others; `None` for one that is not.
fn composition<C: Channels>(material: &Material, at: At<'_, C>) -> Option<Composition> {
    Some(match *material {
        Material::Blend { weight, parts } => {
            let weight = Opacity::clamped(at.value(weight));
            Composition::Blend { parts, weight }
        }
        Material::Coated { eta, absorption, thickness, specular_reflectance, nested } => {
            let coat = Coat { eta, absorption, thickness, specular_reflectance };
            Composition::Coated { nested, coat }
        }
        Material::NormalMap { normal, options, nested } => {
            let color = at.textures.color(normal, at.point);
            let normal = Vec3::from(color.to_array()) * 2.0 - Vec3::ONE;
            Composition::Perturbed { nested, perturbed: Perturbed { normal, options } }
        }
        Material::BumpMap { height, scale, options, nested } => {
            let normal = at.bumped(height, scale);
            Composition::Perturbed { nested, perturbed: Perturbed { normal, options } }
        }
        _ => return None,
    })
}

/// The model of a material.
#[inline]
fn model<'a, C: Channels>(material: Option<&'a Material>, at: At<'a, C>) -> Model<'a, C> {
    let Some(material) = material else { return Model::Null(Null::new()) };
    if let Some((_, false)) = material.family() {
        // Refused when it was added; said again so that nothing of it is linked.
        return Model::Null(Null::new());
    }
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
        Material::DiffuseTransmitter { reflectance, transmittance } => {
            let [r, t] = [reflectance, transmittance].map(|id| at.reflectance(id));
            Model::DiffuseTransmitter(DiffuseTransmitter::clamped(r, t))
        }
        Material::Phong { diffuse_reflectance, specular_reflectance, exponent } => {
            let [kd, ks] = [diffuse_reflectance, specular_reflectance].map(|id| at.reflectance(id));
            Model::Phong(Phong::clamped(kd, ks, Exponent::clamped(at.value(exponent))))
        }
        Material::Dielectric {
            eta,
            ref dispersion,
            nesting,
            ref roughness,
            specular_reflectance,
            specular_transmittance,
        } => {
            let factors =
                [specular_reflectance, specular_transmittance].map(|id| at.reflectance(id));
            let exterior = nesting.and(at.exterior);
            // An index outside the domain is as good as that of the material: the scene format knows how far they go.
            let nested = nesting.zip(exterior).and_then(|(n, e)| Ior::new(n.interior / e).ok());
            let dispersion = dispersion.as_deref().map(|&dispersion| RelativeDispersion {
                exterior: exterior.map_or(dispersion.exterior, f64::from),
                ..dispersion
            });
            interface(nested.unwrap_or(eta), dispersion, roughness.as_ref(), factors, at)
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
                    RoughConductor::new(ior, at.facets(roughness, f32::INFINITY))
                        .with_specular_reflectance(ks),
                ),
            }
        }
        Material::Compensated { nested, ref how } => {
            match at.materials.get(nested).and_then(|nested| compensated(nested, how, at)) {
                Some(compensated) => Model::Compensated(compensated),
                None => model(at.materials.get(nested), at),
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
        Material::Blend { .. }
        | Material::Coated { .. }
        | Material::NormalMap { .. }
        | Material::BumpMap { .. } => {
            composition(material, at).map_or(Model::Null(Null::new()), |how| at.composed(how))
        }
        // A mask or a two-sided material in a place for simple ones: `add` refuses it.
        Material::Mask { .. } | Material::TwoSided { .. } | Material::Null => {
            Model::Null(Null::new())
        }
    }
}
