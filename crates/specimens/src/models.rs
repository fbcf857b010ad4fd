//! The list of models.

use etendue_brdf::{
    AbsorbingSlab, Alpha, AnyCoupled, AnyPlastic, AshikhminShirley, AshikhminShirleyDiffuse,
    AshikhminShirleySampling, AshikhminShirleySpecular, BeckmannLambda, Blend, Bsdf, Burley,
    ComplexIor, Conductor, Coupled, CoupledInterface, Dielectric, DiffuseTransmitter, Distribution,
    Eon, EonAlbedo, EonSampling, Exponent, InternalReflectance, InternalScattering, Ior,
    KullaContyConductor, KullaContyDielectric, Lambert, LayeredFresnel, LayeredLinear, Mask,
    Masking, Microfacets, Null, Opacity, OpenPbr, OpenPbrParameters, OpticalDepth, OrenNayar,
    OrenNayarFujii, OrenNayarQualitative, ParameterError, Phong, Plastic, PlasticInterface,
    PlasticSurface, Principled, PrincipledParameters, PrincipledThin, PrincipledThinParameters,
    Reflectance, RoughConductor, RoughCoupled, RoughDielectric, RoughPlastic, Roughness, Sigma,
    SmoothConductor, SmoothDielectric, ThinDielectric, TransmittanceTable, TurquinConductor,
    TwoSided,
};

use etendue_math::{Real, Spectrum};

use crate::Parameters;

/// A model and how it is built.
pub trait Specimen {
    /// Its name in `etendue_brdf::registry::MODELS`; behind a slash its form, where there are several.
    const NAME: &'static str;

    /// Builds the model and shows it to `visitor` (a model may borrow a table, so it cannot be returned).
    ///
    /// # Errors
    /// [`ParameterError`] where the model refuses a parameter.
    fn show<C: Spectrum, V: Visitor<C>>(
        parameters: &mut impl Parameters,
        visitor: V,
    ) -> Result<V::Output, ParameterError>;

    /// The facets that its reflection comes from, where the model has such: what ways of drawing facet normals are tried
    /// on. Those of a model of several parts are the facets of one of them.
    ///
    /// # Errors
    /// [`ParameterError`] where a width is refused.
    fn facets<T: Real>(
        _parameters: &mut impl Parameters,
    ) -> Result<Option<Microfacets<T>>, ParameterError> {
        Ok(None)
    }
}

/// What is done with one model.
pub trait Visitor<C: Spectrum> {
    /// What comes of it.
    type Output;

    /// Does it.
    fn visit(self, model: &impl Bsdf<Color = C>) -> Self::Output;
}

/// What is done with the list of models.
pub trait Each {
    /// Does it to one.
    fn each<S: Specimen>(&mut self);
}

/// A specimen per line: type, name, the model as an expression of parameters `p` and colour `C`, and its facets.
macro_rules! models {
    ($($kind:ident $name:literal |$p:ident| $model:expr $(, $facets:ident)?;)*) => {
        /// The specimens as types.
        pub mod specimen {
            $(#[doc = concat!("`", $name, "`")]
            #[derive(Clone, Copy, Debug)]
            pub struct $kind;)*
        }

        $(impl Specimen for specimen::$kind {
            const NAME: &'static str = $name;

            #[inline]
            fn show<C: Spectrum, V: Visitor<C>>(
                $p: &mut impl Parameters,
                visitor: V,
            ) -> Result<V::Output, ParameterError> {
                Ok(visitor.visit(&$model))
            }

            $(fn facets<T: Real>(
                parameters: &mut impl Parameters,
            ) -> Result<Option<Microfacets<T>>, ParameterError> {
                $facets(parameters).map(Some)
            })?
        })*

        /// Shows every specimen to `each`, in the order of the names.
        pub fn for_each(each: &mut impl Each) {
            $(each.each::<specimen::$kind>();)*
        }

        /// The names, in order.
        pub const NAMES: &[&str] = &[$($name),*];
    };
}

models! {
    AbsorbingSlab "absorbing-slab" |p| AbsorbingSlab::new(ior(p)?, OpticalDepth::new(C::splat(p.number(0.5)))?);
    AnyCoupled "any-coupled" |p| AnyCoupled::new(CoupledInterface::schlick(reflectance::<C>(p, 0.04)?), distribution(p), [number(p, 0.25), number(p, 0.4)], masking(p), reflectance(p, 0.6)?)?, wide_facets;
    AnyPlastic "any-plastic" |p| AnyPlastic::new(&PlasticSurface::new(ior(p)?, distribution(p), number(p, 0.0), masking(p), internal(p))?, reflectance::<C>(p, 0.5)?, scattering(p));
    AshikhminShirley "ashikhmin-shirley" |p| AshikhminShirley::new(exponent(p, 100.0)?, exponent(p, 10.0)?, reflectance::<C>(p, 0.2)?, reflectance(p, 0.6)?).with_sampling(p.choice([AshikhminShirleySampling::Mixture, AshikhminShirleySampling::Specular]));
    AshikhminShirleyDiffuse "ashikhmin-shirley-diffuse" |p| AshikhminShirleyDiffuse::new(reflectance::<C>(p, 0.2)?, reflectance(p, 0.6)?);
    AshikhminShirleySpecular "ashikhmin-shirley-specular" |p| AshikhminShirleySpecular::new(exponent(p, 100.0)?, exponent(p, 10.0)?, reflectance::<C>(p, 0.2)?);
    Blend "blend" |p| Blend::new(Lambert::new(reflectance::<C>(p, 0.6)?), RoughConductor::new(metal(p)?, facets(p)?), Opacity::new(number(p, 0.5))?), facets;
    Burley "burley" |p| Burley::new(reflectance::<C>(p, 0.6)?, roughness(p)?);
    Conductor "conductor" |p| Conductor::new(metal(p)?, distribution(p), [number(p, 0.25), number(p, 0.4)], masking(p))?, wide_facets;
    Coupled "coupled" |p| Coupled::new(CoupledInterface::schlick(reflectance::<C>(p, 0.04)?), reflectance(p, 0.6)?);
    Dielectric "dielectric" |p| Dielectric::<C>::new(ior(p)?, distribution(p), [number(p, 0.25), number(p, 0.4)], masking(p))?;
    DiffuseTransmitter "diffuse-transmitter" |p| DiffuseTransmitter::new(reflectance::<C>(p, 0.4)?, reflectance(p, 0.3)?)?;
    Eon "eon" |p| Eon::new(reflectance::<C>(p, 0.6)?, roughness(p)?).with_sampling(p.choice([EonSampling::Cosine, EonSampling::Cltc]));
    EonApproximate "eon-approx" |p| Eon::new(reflectance::<C>(p, 0.6)?, roughness(p)?).with_albedo(EonAlbedo::Approximate).with_sampling(p.choice([EonSampling::Cltc, EonSampling::Cosine]));
    KullaContyConductor "kulla-conty-conductor" |p| KullaContyConductor::new(metal::<C>(p)?, round_facets(p)?)?, round_facets;
    KullaContyDielectric "kulla-conty-dielectric" |p| KullaContyDielectric::<C>::new(ior(p)?, round_facets(p)?)?;
    Lambert "lambert" |p| Lambert::new(reflectance::<C>(p, 0.6)?);
    LayeredFresnel "layered-fresnel" |p| LayeredFresnel::new(reflectance::<C>(p, 0.04)?, reflectance(p, 0.6)?);
    LayeredLinear "layered-linear" |p| LayeredLinear::new(reflectance::<C>(p, 0.6)?, reflectance(p, 0.1)?)?;
    Mask "mask" |p| Mask::new(Lambert::new(reflectance::<C>(p, 0.6)?), Opacity::new(number(p, 0.5))?);
    Null "null" |_p| Null::<C>::new();
    OpenPbr "open-pbr" |p| OpenPbr::new(open_pbr::<C>(p))?;
    OrenNayar "oren-nayar" |p| OrenNayar::new(reflectance::<C>(p, 0.6)?, Sigma::new(number(p, 0.4))?);
    OrenNayarFujii "oren-nayar-fujii" |p| OrenNayarFujii::new(reflectance::<C>(p, 0.6)?, roughness(p)?);
    OrenNayarQualitative "oren-nayar-qualitative" |p| OrenNayarQualitative::new(reflectance::<C>(p, 0.6)?, Sigma::new(number(p, 0.4))?);
    Phong "phong" |p| Phong::new(reflectance::<C>(p, 0.5)?, reflectance(p, 0.3)?, exponent(p, 50.0)?)?;
    Plastic "plastic" |p| Plastic::new(PlasticInterface::new(ior(p)?, internal(p)), reflectance::<C>(p, 0.6)?, scattering(p));
    Principled "principled" |p| Principled::new(principled::<C>(p))?;
    PrincipledThin "principled-thin" |p| PrincipledThin::new(principled_thin::<C>(p))?;
    RoughConductor "rough-conductor" |p| RoughConductor::new(metal::<C>(p)?, facets(p)?), facets;
    RoughConductorBeckmann "rough-conductor/beckmann" |p| RoughConductor::new(metal::<C>(p)?, beckmann_facets(p)?), beckmann_facets;
    RoughCoupled "rough-coupled" |p| RoughCoupled::new(CoupledInterface::schlick(reflectance::<C>(p, 0.04)?), facets(p)?, reflectance(p, 0.6)?), facets;
    RoughDielectric "rough-dielectric" |p| RoughDielectric::<C>::new(ior(p)?, facets(p)?)?;
    RoughDielectricBeckmann "rough-dielectric/beckmann" |p| RoughDielectric::<C>::new(ior(p)?, beckmann_facets(p)?)?;
    RoughPlastic "rough-plastic" |p| RoughPlastic::new(&TransmittanceTable::new(ior(p)?, distribution(p), alpha(p, 0.3)?, masking(p), internal(p)), reflectance::<C>(p, 0.6)?, scattering(p)), round_facets;
    SmoothConductor "smooth-conductor" |p| SmoothConductor::new(metal::<C>(p)?);
    SmoothDielectric "smooth-dielectric" |p| SmoothDielectric::<C>::new(ior(p)?);
    ThinDielectric "thin-dielectric" |p| ThinDielectric::<C>::new(ior(p)?);
    TurquinConductor "turquin-conductor" |p| TurquinConductor::new(metal::<C>(p)?, round_facets(p)?)?, round_facets;
    TwoSided "two-sided" |p| TwoSided::new(RoughConductor::new(metal::<C>(p)?, facets(p)?), Lambert::new(reflectance(p, 0.6)?)), facets;
}

fn number<T: Real>(p: &mut impl Parameters, typical: f64) -> T {
    p.number(typical)
}

fn reflectance<C: Spectrum>(
    p: &mut impl Parameters,
    typical: f64,
) -> Result<Reflectance<C>, ParameterError> {
    Reflectance::new(C::splat(p.number(typical)))
}

fn alpha<T: Real>(p: &mut impl Parameters, typical: f64) -> Result<Alpha<T>, ParameterError> {
    Alpha::new(p.number(typical))
}

fn roughness<T: Real>(p: &mut impl Parameters) -> Result<Roughness<T>, ParameterError> {
    Roughness::new(p.number(0.5))
}

fn exponent<T: Real>(p: &mut impl Parameters, typical: f64) -> Result<Exponent<T>, ParameterError> {
    Exponent::new(p.number(typical))
}

fn ior<T: Real>(p: &mut impl Parameters) -> Result<Ior<T>, ParameterError> {
    Ior::new(p.number(1.5))
}

/// Copper at 600 nm.
fn metal<C: Spectrum>(p: &mut impl Parameters) -> Result<ComplexIor<C>, ParameterError> {
    ComplexIor::new(C::splat(p.number(0.24)), C::splat(p.number(3.34)))
}

const EXACT: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Exact };
const WALTER: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Walter };

fn distribution(p: &mut impl Parameters) -> Distribution {
    p.choice([Distribution::Ggx, EXACT, WALTER])
}

fn masking(p: &mut impl Parameters) -> Masking {
    p.choice([Masking::HeightCorrelated, Masking::Separable])
}

fn facets<T: Real>(p: &mut impl Parameters) -> Result<Microfacets<T>, ParameterError> {
    Ok(Microfacets::new(distribution(p), alpha(p, 0.3)?, alpha(p, 0.2)?, masking(p)))
}

fn wide_facets<T: Real>(p: &mut impl Parameters) -> Result<Microfacets<T>, ParameterError> {
    Ok(Microfacets::new(distribution(p), alpha(p, 0.25)?, alpha(p, 0.4)?, masking(p)))
}

fn beckmann_facets<T: Real>(p: &mut impl Parameters) -> Result<Microfacets<T>, ParameterError> {
    let distribution = p.choice([EXACT, WALTER]);
    Ok(Microfacets::new(distribution, alpha(p, 0.3)?, alpha(p, 0.2)?, masking(p)))
}

/// Isotropic ones, for which there are tables.
fn round_facets<T: Real>(p: &mut impl Parameters) -> Result<Microfacets<T>, ParameterError> {
    let width = alpha(p, 0.3)?;
    Ok(Microfacets::new(distribution(p), width, width, masking(p)))
}

fn internal(p: &mut impl Parameters) -> InternalReflectance {
    p.choice([InternalReflectance::Exact, InternalReflectance::Mitsuba])
}

fn scattering(p: &mut impl Parameters) -> InternalScattering {
    p.choice([InternalScattering::Linear, InternalScattering::NonLinear])
}

/// Every lobe.
fn open_pbr<C: Spectrum>(p: &mut impl Parameters) -> OpenPbrParameters<C> {
    OpenPbrParameters {
        base_weight: p.number(0.9),
        base_color: C::splat(p.number(0.6)),
        base_diffuse_roughness: p.number(0.3),
        base_metalness: p.number(0.4),
        specular_weight: p.number(0.8),
        specular_color: C::splat(p.number(0.7)),
        specular_roughness: p.number(0.4),
        specular_roughness_anisotropy: p.number(0.2),
        specular_ior: p.number(1.5),
        coat_weight: p.number(0.5),
        coat_color: C::splat(p.number(0.8)),
        coat_roughness: p.number(0.3),
        coat_roughness_anisotropy: p.number(0.1),
        coat_ior: p.number(1.6),
        coat_darkening: p.number(0.7),
        fuzz_weight: p.number(0.5),
        fuzz_color: C::splat(p.number(0.9)),
        fuzz_roughness: p.number(0.5),
    }
}

/// Every lobe.
fn principled<C: Spectrum>(p: &mut impl Parameters) -> PrincipledParameters<C> {
    PrincipledParameters {
        base_color: C::splat(p.number(0.6)),
        roughness: p.number(0.5),
        anisotropic: p.number(0.3),
        metallic: p.number(0.2),
        spec_trans: p.number(0.4),
        eta: p.number(1.5),
        spec_tint: p.number(0.1),
        sheen: p.number(0.5),
        sheen_tint: p.number(0.5),
        flatness: p.number(0.2),
        clearcoat: p.number(0.8),
        clearcoat_gloss: p.number(0.6),
        ..Default::default()
    }
}

/// Every lobe.
fn principled_thin<C: Spectrum>(p: &mut impl Parameters) -> PrincipledThinParameters<C> {
    PrincipledThinParameters {
        base_color: C::splat(p.number(0.6)),
        roughness: p.number(0.5),
        anisotropic: p.number(0.3),
        spec_trans: p.number(0.4),
        eta: p.number(1.5),
        spec_tint: p.number(0.1),
        sheen: p.number(0.5),
        sheen_tint: p.number(0.5),
        flatness: p.number(0.2),
        diff_trans: p.number(0.7),
        ..Default::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;
    use etendue_brdf::registry::MODELS;

    #[test]
    fn every_registered_model_has_a_specimen() {
        let mut names: Vec<_> = NAMES.iter().map(|n| n.split('/').next().unwrap()).collect();
        names.dedup();
        // The table of a measured material is larger than what the specimens run on.
        let registered = MODELS.iter().filter(|info| info.name != "measured");
        let registered: Vec<_> = registered.map(|info| info.name).collect();
        assert_eq!(names, registered);
    }
}
