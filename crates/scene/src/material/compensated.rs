//! Rough metal and glass with the light that their facets scatter more than once.

use etendue_brdf::{
    Bsdf, ComplexIor, Ior, KullaContyConductor, KullaContyDielectric, Lobes, Microfacets,
    Reflectance, Sample, TurquinConductor,
};
use etendue_math::Spectrum;
use etendue_math::glam::Vec3;

/// What becomes of light that a facet sends to another one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MultipleScattering {
    /// It is lost, as in Walter's model.
    #[default]
    Lost,
    /// A second lobe brings it back, reciprocally.
    KullaConty,
    /// The lobe is brightened; of metals.
    Turquin,
}

/// A microfacet model with a compensation, as its parameters: one that was put together takes several times the memory of
/// any other, so this is done in each call.
///
/// Black where there is no table for the facets: anisotropic ones, Walter's fit of Beckmann's Λ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Compensated<S: Spectrum<Real = f32>> {
    /// Metal after Kulla and Conty.
    KullaContyMetal(Metal<S>),
    /// Metal after Turquin.
    TurquinMetal(Metal<S>),
    /// Glass after Kulla and Conty.
    KullaContyGlass(Glass<S>),
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

/// Parameters of rough glass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glass<S: Spectrum<Real = f32>> {
    /// Relative index.
    pub eta: Ior<f32>,
    /// Its facets.
    pub facets: Microfacets<f32>,
    /// Factor of reflected light.
    pub specular_reflectance: Reflectance<S>,
    /// Factor of transmitted light.
    pub specular_transmittance: Reflectance<S>,
}

impl<S: Spectrum<Real = f32>> Metal<S> {
    fn kulla_conty(self) -> Option<KullaContyConductor<S>> {
        let model = KullaContyConductor::new(self.ior, self.facets).ok()?;
        Some(model.with_specular_reflectance(self.specular_reflectance))
    }

    fn turquin(self) -> Option<TurquinConductor<S>> {
        let model = TurquinConductor::new(self.ior, self.facets).ok()?;
        Some(model.with_specular_reflectance(self.specular_reflectance))
    }
}

impl<S: Spectrum<Real = f32>> Glass<S> {
    fn kulla_conty(self) -> Option<KullaContyDielectric<S>> {
        let model = KullaContyDielectric::new(self.eta, self.facets).ok()?;
        Some(model.with_factors(self.specular_reflectance, self.specular_transmittance))
    }
}

impl<S: Spectrum<Real = f32>> Compensated<S> {
    /// Whether there is a table for its facets.
    pub(super) fn is_possible(&self) -> bool {
        self.lobes() != Lobes::default()
    }
}

/// Puts the model together and calls it.
macro_rules! call {
    ($compensated:ident, $method:ident($($argument:expr),*), $nothing:expr) => {
        match $compensated {
            Compensated::KullaContyMetal(metal) => {
                metal.kulla_conty().map_or($nothing, |model| model.$method($($argument),*))
            }
            Compensated::TurquinMetal(metal) => {
                metal.turquin().map_or($nothing, |model| model.$method($($argument),*))
            }
            Compensated::KullaContyGlass(glass) => {
                glass.kulla_conty().map_or($nothing, |model| model.$method($($argument),*))
            }
        }
    };
}

impl<S: Spectrum<Real = f32>> Bsdf for Compensated<S> {
    type Color = S;

    fn lobes(&self) -> Lobes {
        call!(self, lobes(), Lobes::default())
    }

    fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (S, f32) {
        call!(self, eval_pdf(wo, wi), (S::black(), 0.0))
    }

    fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Option<Sample<S>> {
        call!(self, sample(wo, u_lobe, u), None)
    }

    fn albedo(&self, wo: Vec3) -> Option<S> {
        call!(self, albedo(wo), None)
    }
}
