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
//! <!-- begin models -->
//! | model | parameters | laws | sampled by | source |
//! | --- | --- | --- | --- | --- |
//! | [`AbsorbingSlab`] | eta, optical_depth | reciprocal; albedo ≤ 1 in closed form | delta, by the mean shares | Heavens 1955 |
//! | [`AnyCoupled`] | r0, rm, distribution, alpha_x, alpha_y, masking | reciprocal; albedo ≤ 1.5 | that of the variant chosen at construction | coupled, or rough-coupled for alpha >= 1e-8 |
//! | [`AnyPlastic`] | eta, distribution, alpha, masking, reflectance, specular_reflectance, scattering, internal_reflectance | reciprocal; albedo ≤ 1 | that of the variant chosen at construction | plastic, or rough-plastic for alpha >= 1e-8 |
//! | [`AshikhminShirley`] | nu, nv, rs, rd, sampling | reciprocal; albedo ≤ 1 | half vectors, p(h)/(4 h·wo), and cosine by albedos; or half vectors alone | Ashikhmin and Shirley 2000 |
//! | [`AshikhminShirleyDiffuse`] | rs, rd | reciprocal; albedo ≤ 1 in closed form | cosine | Ashikhmin and Shirley 2000, eq. 5 |
//! | [`AshikhminShirleySpecular`] | nu, nv, rs | reciprocal; albedo ≤ 1 | half vectors, p(h)/(4 h·wo) | Ashikhmin and Shirley 2000 |
//! | [`Blend`] | first, second, weight | reciprocal up to η²; albedo ≤ 1 | mixture of the two | Mitsuba, blendbsdf |
//! | [`Burley`] | base_color, roughness | reciprocal; albedo ≤ 1.5575396825396826 in closed form | cosine | Burley 2012 |
//! | [`Conductor`] | eta, k, distribution, alpha_x, alpha_y, masking, specular_reflectance | reciprocal; albedo ≤ 1 | that of the variant chosen at construction | smooth-conductor, or rough-conductor for alpha >= 1e-8 |
//! | [`Coupled`] | r0, rm | reciprocal; albedo ≤ 1 in closed form | mirror or cosine, by mean albedos | Shirley et al. 1997, section 3 |
//! | [`Dielectric`] | eta, distribution, alpha_x, alpha_y, masking, specular_reflectance, specular_transmittance | reciprocal up to η²; albedo ≤ 1 | that of the variant chosen at construction | null for eta = 1, smooth-dielectric, or rough-dielectric for alpha >= 1e-8 |
//! | [`DiffuseTransmitter`] | reflectance, transmittance | reciprocal; albedo ≤ 1 in closed form | cosine on the side chosen by mean colours | two Lambertian lobes |
//! | [`Eon`] | reflectance, roughness, sampling | reciprocal; albedo ≤ 1 in closed form | cosine, or clipped linearly transformed cosine | Portsmouth, Kutz and Hill 2025 |
//! | [`Eon`] | reflectance, roughness, sampling | reciprocal; albedo ≤ 1.000147 in closed form | cosine, or clipped linearly transformed cosine | Portsmouth, Kutz and Hill 2025 |
//! | [`KullaContyConductor`] | eta, k, distribution, alpha, masking, specular_reflectance | reciprocal; albedo ≤ 1.004 | mixture of visible normals and cosine | Kulla and Conty 2017, with the square of F_avg |
//! | [`KullaContyDielectric`] | eta, distribution, alpha, masking, specular_reflectance, specular_transmittance | reciprocal up to η²; albedo ≤ 1.013 | mixture of visible normals and cosine on either side | Kulla and Conty 2017, with shares by energy |
//! | [`Lambert`] | reflectance | reciprocal; albedo ≤ 1 in closed form | cosine | Lambert 1760 |
//! | [`LayeredFresnel`] | r0, rd | **not reciprocal**; albedo ≤ 1.952381 in closed form | mirror or cosine, by mean albedos | Shirley et al. 1997, section 2 |
//! | [`LayeredLinear`] | rd, rs | reciprocal; albedo ≤ 1 in closed form | mirror or cosine, by mean shares | Shirley et al. 1997, section 2 |
//! | [`Mask`] | opacity, inner | reciprocal; albedo ≤ 1 | the inner one with probability opacity | Mitsuba, mask |
//! | [`Measured`] | table, interpolation | reciprocal; albedo as measured | mixture of cosine and rings of half vectors | Matusik et al. 2003; Rusinkiewicz 1998 |
//! | [`Null`] |  | reciprocal; albedo ≤ 1 in closed form | delta | index-matched limit of a dielectric |
//! | [`OpenPbr`] | base_weight, base_color, base_diffuse_roughness, base_metalness, specular_weight, specular_color, specular_roughness, specular_roughness_anisotropy, specular_ior, coat_weight, coat_color, coat_roughness, coat_roughness_anisotropy, coat_ior, coat_darkening, fuzz_weight, fuzz_color, fuzz_roughness | reciprocal; albedo ≤ 1.08 | mixture of uniform, visible normals of coat and base, and cosine; or mirrors | OpenPBR 1.1 |
//! | [`OrenNayar`] | reflectance, sigma | reciprocal; albedo ≤ 1.0509 | cosine | Oren and Nayar 1994, eqs. 27 to 29 |
//! | [`OrenNayarFujii`] | reflectance, roughness | reciprocal; albedo ≤ 1 in closed form | cosine | Fujii 2012 |
//! | [`OrenNayarQualitative`] | reflectance, sigma | reciprocal; albedo ≤ 1.0152 | cosine | Oren and Nayar 1994, eq. 30 |
//! | [`Phong`] | kd, ks, exponent | reciprocal; albedo ≤ 1 in closed form | cosine, or the lobe, by mean colours | Lafortune and Willems 1994 |
//! | [`Plastic`] | eta, reflectance, specular_reflectance, scattering, internal_reflectance | reciprocal; albedo ≤ 1 in closed form | mirror or cosine, by Fresnel and mean colours | Mitsuba, plastic; Wolff 1994 |
//! | [`Principled`] | base_color, roughness, anisotropic, metallic, spec_trans, eta, spec_tint, sheen, sheen_tint, flatness, clearcoat, clearcoat_gloss, diffuse_reflectance_sampling_rate, main_specular_sampling_rate, clearcoat_sampling_rate | reciprocal up to η²; albedo ≤ 2.86 | mixture of cosine, clear coat's facets and visible normals | Burley 2012, 2015; Mitsuba 3, principled |
//! | [`PrincipledThin`] | base_color, roughness, anisotropic, spec_trans, eta, spec_tint, sheen, sheen_tint, flatness, diff_trans, specular_reflectance_sampling_rate, specular_transmittance_sampling_rate, diffuse_reflectance_sampling_rate, diffuse_transmittance_sampling_rate | reciprocal in reflection only; albedo ≤ 1.65 | mixture of visible normals and cosine on either side | Burley 2015; Mitsuba 3, principledthin |
//! | [`RoughConductor`] | eta, k, distribution, alpha_x, alpha_y, masking, specular_reflectance | reciprocal; albedo ≤ 1 | visible normals; bounded ones or all by choice | Walter et al. 2007; Heitz 2014, 2018; Dupuy and Benyoub 2023; Eto and Tokuyoshi 2023 |
//! | [`RoughCoupled`] | r0, rm, distribution, alpha_x, alpha_y, masking | reciprocal; albedo ≤ 1.5 | mixture of visible normals and cosine | Shirley et al. 1997, section 3; Walter et al. 2007 |
//! | [`RoughDielectric`] | eta, distribution, alpha_x, alpha_y, masking, specular_reflectance, specular_transmittance | reciprocal up to η²; albedo ≤ 1 | visible normals, reflection with probability F | Walter et al. 2007; Heitz and d'Eon 2014 |
//! | [`RoughPlastic`] | eta, distribution, alpha, masking, reflectance, specular_reflectance, scattering, internal_reflectance | reciprocal; albedo ≤ 1 | mixture of visible normals and cosine | Mitsuba, roughplastic |
//! | [`SmoothConductor`] | eta, k, specular_reflectance | reciprocal; albedo ≤ 1 in closed form | delta | Born and Wolf, section 14.2 |
//! | [`SmoothDielectric`] | eta, specular_reflectance, specular_transmittance | reciprocal up to η²; albedo ≤ 1 in closed form | delta, reflection with probability F | Born and Wolf, section 1.5 |
//! | [`ThinDielectric`] | eta, specular_reflectance, specular_transmittance | reciprocal; albedo ≤ 1 in closed form | delta, reflection with probability 2F/(1 + F) | Mitsuba, thindielectric |
//! | [`TurquinConductor`] | eta, k, distribution, alpha, masking, specular_reflectance | **not reciprocal**; albedo ≤ 1.005 | visible normals | Turquin 2019 |
//! | [`TwoSided`] | front, back | reciprocal; albedo ≤ 1 | that of the side | Mitsuba, twosided |
//! <!-- end models -->
//!
//! [`StochasticLayers`] is no model but a reference: any interface over any base, followed bounce by bounce.
//!
//! [`registry::MODELS`] is the same table with the domains of the parameters, as data. Below the models lie
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
//! target. `arch` makes `libm` faster without `std`. `alloc` adds the module `named`, models and functions by name
//! for files and command lines, and `serde` reads such descriptions from JSON and other formats.
//!
//! Families of models are features too, all on by default: `adapters`, `diffuse`, `layered`, `measured`, `openpbr`, `phong`,
//! `principled`, `rough`, `smooth`; `models` is all of them. Without any, what they share is there: Fresnel's equations,
//! quadrature, radiometry.
//!
//! # Non-goals
//! No textures, no world space, no normal maps: those belong to a scene. No polarisation. Rough
//! models lose what scatters more than once between facets, but for those that say otherwise.
#![no_std]
#![forbid(unsafe_code)]
#![cfg_attr(
    not(feature = "models"),
    allow(dead_code, unused_imports, reason = "families share what not each of them uses")
)]
#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "`!(x > 0)` is how NaN is refused along with what is not positive"
)]

#[cfg(any(feature = "std", test))]
extern crate std;

#[cfg(any(feature = "alloc", test))]
extern crate alloc;

mod absorption;
#[cfg(feature = "adapters")]
mod adapter;
mod bsdf;
#[cfg(feature = "diffuse")]
mod diffuse;
pub mod direction;
pub mod fresnel;
#[cfg(test)]
mod laws;
#[cfg(feature = "layered")]
mod layered;
#[cfg(feature = "measured")]
mod measured;
#[cfg(feature = "rough")]
pub mod microfacet;
#[cfg(any(feature = "measured", feature = "phong", feature = "rough"))]
mod mixture;
#[cfg(feature = "alloc")]
pub mod named;
#[cfg(feature = "openpbr")]
mod openpbr;
mod param;
#[cfg(feature = "phong")]
mod phong;
#[cfg(feature = "principled")]
mod principled;
pub mod quadrature;
pub mod radiometry;
pub mod registry;
#[cfg(feature = "rough")]
mod rough;
#[cfg(feature = "smooth")]
mod smooth;

pub use absorption::Absorption;
#[cfg(feature = "adapters")]
pub use adapter::{Blend, Mask, TwoSided};
pub use bsdf::{Bsdf, BsdfReal, BsdfVec, Density, Lobes, Sample};
#[cfg(feature = "diffuse")]
pub use diffuse::{
    Burley, ClippedCosine, DiffuseTransmitter, Eon, EonAlbedo, EonSampling, Lambert, OrenNayar,
    OrenNayarFujii, OrenNayarQualitative, fon,
};
#[cfg(feature = "layered")]
pub use layered::{
    AnyCoupled, AnyPlastic, Coupled, CoupledInterface, InternalReflectance, InternalScattering,
    LayeredFresnel, LayeredLinear, MirrorOverMatte, Plastic, PlasticInterface, PlasticSurface,
    RoughCoupled, RoughPlastic, StochasticLayers, TransmittanceTable,
};
#[cfg(feature = "measured")]
pub use measured::{Interpolation, Measured, MerlError, MerlTable, tabulate};
#[cfg(feature = "rough")]
pub use microfacet::{BeckmannLambda, Distribution, Masking, Microfacets};
#[cfg(feature = "openpbr")]
pub use openpbr::{FuzzTable, OpenPbr, OpenPbrParameters};
pub use param::{
    Alpha, ComplexIor, Exponent, Given, Ior, Opacity, OpticalDepth, ParameterError, Reflectance,
    Roughness, Sigma,
};
#[cfg(feature = "phong")]
pub use phong::{
    AshikhminShirley, AshikhminShirleyDiffuse, AshikhminShirleySampling, AshikhminShirleySpecular,
    Phong, PhongHalfVectors,
};
#[cfg(feature = "principled")]
pub use principled::{Principled, PrincipledParameters, PrincipledThin, PrincipledThinParameters};
#[cfg(feature = "rough")]
pub use rough::{
    Conductor, Dielectric, KullaContyConductor, KullaContyDielectric, RoughConductor,
    RoughDielectric, TurquinConductor,
};
#[cfg(feature = "smooth")]
pub use smooth::{AbsorbingSlab, Null, SmoothConductor, SmoothDielectric, ThinDielectric};

/// Runs the README's example.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
