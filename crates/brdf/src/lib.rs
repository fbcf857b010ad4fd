//! Reflection models: exact, stable in the hard cases, in two precisions, without `std`.
//!
//! A model is a small value that implements [`Bsdf`]: `eval` gives the scattering function,
//! `sample` draws a direction with its weight, `pdf` says how likely a direction was, `albedo`
//! integrates where that has a closed form. Parameters are checked once, by the types that hold them;
//! evaluation is total: outside its domain it is 0 or `None`, and never NaN.
//!
//! # Conventions
//! - Local shading frame, unit normal `n = +z`; `wo` (viewer) and `wi` (light) are unit vectors pointing away
//!   from the surface. `cos θ = w.z`.
//! - `eval` is in sr⁻¹ and excludes the cosine; a sample's weight is `f |cos θi| / pdf`.
//! - `alpha` is the width of the microfacet distribution itself, never its root; `eta` is
//!   n(far side) / n(near side); angles are in radians.
//! - Radiance is transported: refraction into a denser medium scales it by `1/η²`.
//! - Delta lobes are apart from the rest by type ([`Density`]), not by a huge number.
//! - Uniforms are arguments in `[0, 1)`: one to choose a lobe, two for the direction in it.
//!
//! # Models
//! | type | what | sampling |
//! | --- | --- | --- |
//! | [`Lambert`] | ideal diffuse | cosine |
//! | [`OrenNayar`], [`OrenNayarQualitative`], [`OrenNayarFujii`] | rough diffuse (V-cavities) | cosine |
//! | [`Eon`] | rough diffuse, all orders of scattering | cosine, or clipped transformed cosine |
//! | [`Burley`] | Disney diffuse | cosine |
//! | [`DiffuseTransmitter`] | leaf, paper | cosine on either side |
//! | [`Phong`] | diffuse and a cosine power about the mirror direction | lobe and cosine |
//! | [`AshikhminShirley`], [its specular](AshikhminShirleySpecular) and [diffuse part](AshikhminShirleyDiffuse) | anisotropic Phong over a diffuse base | half vectors, cosine |
//! | [`SmoothConductor`], [`RoughConductor`], [`Conductor`] | metal; the last chooses by roughness | mirror; visible normals |
//! | [`SmoothDielectric`], [`RoughDielectric`], [`Dielectric`] | glass; the last chooses by roughness and index | Fresnel; visible normals |
//! | [`ThinDielectric`] | pane | Fresnel of the slab |
//! | [`Plastic`], [`RoughPlastic`] | diffuse base under a dielectric | mirror or visible normals, and cosine |
//! | [`AbsorbingSlab`] | pane of tinted glass | reflected and transmitted shares |
//! | [`LayeredLinear`], [`LayeredFresnel`] | mirror and matte term, uncoupled (the latter not reciprocal) | mirror and cosine |
//! | [`Coupled`], [`RoughCoupled`] | matte term coupled to a mirror or a rough lobe | mirror or visible normals, and cosine |
//! | [`Null`] | nothing: straight on | – |
//! | [`Blend`], [`Mask`], [`TwoSided`] | adapters | that of the inner models |
//!
//! [`StochasticLayers`] is no model but a reference: any interface over any base, followed bounce by bounce.
//!
//! [`registry::MODELS`] is the same table with domains, laws and sources, as data. Below the models lie
//! [`fresnel`], [`microfacet`], [`fon`], [`PhongHalfVectors`] and [`ClippedCosine`], usable alone. Beside them,
//! [`Absorption`] is what happens inside a medium and [`radiometry`] what lights do to a surface.
//!
//! # Examples
//! ```
//! use etendue_brdf::{Alpha, Bsdf, ComplexIor, Microfacets, RoughConductor};
//! use etendue_math::glam::DVec3;
//!
//! let copper = ComplexIor::new(0.21_f64, 4.25)?;
//! let model = RoughConductor::new(copper, Microfacets::ggx(Alpha::new(0.3)?));
//! let wo = DVec3::new(0.6, 0.0, 0.8);
//! let sample = model.sample(wo, 0.0, [0.3, 0.6]).expect("above the surface");
//! let (f, pdf) = model.eval_pdf(wo, sample.wi);
//! assert!((sample.weight - f * sample.wi.z / pdf).abs() < 1e-12);
//! # Ok::<(), etendue_brdf::ParameterError>(())
//! ```
//!
//! # Precision
//! Every value is within a few ulp of the exact one, scaled by the condition of the problem: the
//! effect of half-ulp changes of the inputs. `tests/golden.rs` holds the crate to 8 such ulps on random
//! inputs and 64 on hard ones (grazing, near-normal, α = 1e-4, η → 1) against values computed to 60 digits.
//!
//! # Features
//! `std` (default) and `libm` choose the float functions; `libm` wins and gives the same bits on every
//! target. `arch` makes `libm` faster without `std`.
//!
//! # Non-goals
//! No textures, no world space, no normal maps: those belong to a scene. No polarisation. No
//! multiple scattering between facets yet: rough models lose what it would return.
#![no_std]
#![forbid(unsafe_code)]
#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "`!(x > 0)` is how NaN is refused along with what is not positive"
)]

#[cfg(any(feature = "std", test))]
extern crate std;

#[cfg(test)]
extern crate alloc;

mod absorption;
mod adapter;
mod bsdf;
mod diffuse;
pub mod direction;
pub mod fresnel;
#[cfg(test)]
mod laws;
mod layered;
pub mod microfacet;
mod param;
mod phong;
pub mod quadrature;
pub mod radiometry;
pub mod registry;
mod rough;
mod smooth;

pub use absorption::Absorption;
pub use adapter::{Blend, Mask, TwoSided};
pub use bsdf::{Bsdf, BsdfReal, BsdfVec, Density, Lobes, Sample};
pub use diffuse::{
    Burley, ClippedCosine, DiffuseTransmitter, Eon, EonAlbedo, EonSampling, Lambert, OrenNayar,
    OrenNayarFujii, OrenNayarQualitative, fon,
};
pub use layered::{
    Coupled, CoupledInterface, InternalReflectance, InternalScattering, LayeredFresnel,
    LayeredLinear, MirrorOverMatte, Plastic, PlasticInterface, RoughCoupled, RoughPlastic,
    StochasticLayers, TransmittanceTable,
};
pub use microfacet::{BeckmannLambda, Distribution, Masking, Microfacets};
pub use param::{
    Alpha, ComplexIor, Exponent, Ior, Opacity, OpticalDepth, ParameterError, Reflectance,
    Roughness, Sigma,
};
pub use phong::{
    AshikhminShirley, AshikhminShirleyDiffuse, AshikhminShirleySampling, AshikhminShirleySpecular,
    Phong, PhongHalfVectors,
};
pub use rough::{Conductor, Dielectric, RoughConductor, RoughDielectric};
pub use smooth::{AbsorbingSlab, Null, SmoothConductor, SmoothDielectric, ThinDielectric};

/// Runs the README's example.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
