//! Rough metal and glass with the light that their facets scatter more than once.

use alloc::sync::Arc;

use etendue_brdf::{
    Bsdf, ComplexIor, KullaContyConductor, KullaContyDielectric, Lobes, Microfacets, Reflectance,
    Sample, TurquinConductor,
};
use etendue_math::Spectrum;
use etendue_math::glam::Vec3;

/// How light that facets scatter more than once is brought back.
#[derive(Clone, Debug, PartialEq)]
pub enum Compensation {
    /// By a second lobe of metal, reciprocally.
    KullaContyMetal,
    /// By a brighter lobe of metal.
    TurquinMetal,
    /// By a second lobe of glass on either side, whose tables are made for one index and one width.
    KullaContyGlass(Arc<KullaContyDielectric<f32>>),
}

/// A microfacet model with a compensation.
///
/// Metal is there as its parameters: a model that was put together takes several times the memory of any other, so this is done
/// in each call. Black where there is no table for the facets: anisotropic ones, Walter's fit of Beckmann's Λ.
#[derive(Clone, Copy, Debug)]
pub enum Compensated<'a, S: Spectrum<Real = f32>> {
    /// Metal after Kulla and Conty, and the average of its Fresnel term.
    KullaContyMetal(Metal<S>, S),
    /// Metal after Turquin.
    TurquinMetal(Metal<S>),
    /// Glass after Kulla and Conty, and factors of reflected and transmitted light.
    KullaContyGlass(&'a KullaContyDielectric<f32>, [Reflectance<S>; 2]),
}

/// Parameters of a rough metal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metal<S: Spectrum<Real = f32>> {
    /// η + ik.
    pub ior: ComplexIor<S>,
    /// Its facets.
    pub facets: Microfacets<f32>,
    /// Factor of reflected light.
    pub specular_reflectance: Reflectance<S>,
}

impl<S: Spectrum<Real = f32>> Metal<S> {
    fn kulla_conty(self, average: S) -> Option<KullaContyConductor<S>> {
        let model = KullaContyConductor::with_average(self.ior, self.facets, average).ok()?;
        Some(model.with_specular_reflectance(self.specular_reflectance))
    }

    fn turquin(self) -> Option<TurquinConductor<S>> {
        let model = TurquinConductor::new(self.ior, self.facets).ok()?;
        Some(model.with_specular_reflectance(self.specular_reflectance))
    }
}

/// The factor of light between two directions.
fn factor<S: Spectrum<Real = f32>>([ks, kt]: [Reflectance<S>; 2], wo: Vec3, wi: Vec3) -> S {
    if wo.z * wi.z > 0.0 { ks.value() } else { kt.value() }
}

impl<S: Spectrum<Real = f32>> Bsdf for Compensated<'_, S> {
    type Color = S;

    fn lobes(&self) -> Lobes {
        Lobes {
            continuous: true,
            delta: false,
            transmission: matches!(self, Self::KullaContyGlass(..)),
        }
    }

    fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (S, f32) {
        let nothing = (S::black(), 0.0);
        match *self {
            Self::KullaContyMetal(metal, average) => {
                metal.kulla_conty(average).map_or(nothing, |model| model.eval_pdf(wo, wi))
            }
            Self::TurquinMetal(metal) => {
                metal.turquin().map_or(nothing, |model| model.eval_pdf(wo, wi))
            }
            Self::KullaContyGlass(glass, factors) => {
                let (f, pdf) = glass.eval_pdf(wo, wi);
                (factor(factors, wo, wi).scale(f), pdf)
            }
        }
    }

    fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Option<Sample<S>> {
        match *self {
            Self::KullaContyMetal(metal, average) => {
                metal.kulla_conty(average)?.sample(wo, u_lobe, u)
            }
            Self::TurquinMetal(metal) => metal.turquin()?.sample(wo, u_lobe, u),
            Self::KullaContyGlass(glass, factors) => {
                let Sample { wi, weight, density, eta } = glass.sample(wo, u_lobe, u)?;
                let weight = factor(factors, wo, wi).scale(weight);
                (!weight.is_black()).then_some(Sample { wi, weight, density, eta })
            }
        }
    }
}
