//! Which parameters of which model are audited.
//!
//! Adding a model: a function that lists its cases in the file of its family, and a line in [`models`].

mod adapter;
mod diffuse;
mod layered;
mod measured;
mod openpbr;
mod parameters;
mod phong;
mod principled;
mod rough;
mod smooth;
pub(crate) mod textbook;

use etendue_brdf::registry::{MODELS, ModelInfo};

pub use parameters::{Surface, surfaces};

use crate::subject::Case;

/// A model's name in the registry and its cases.
pub struct ModelCases {
    /// Name in `etendue_brdf::registry::MODELS`.
    pub name: &'static str,
    /// Its cases in `f32`.
    pub single: fn() -> Vec<Case<f32>>,
    /// The same cases in `f64`.
    pub double: fn() -> Vec<Case<f64>>,
}

/// Every model. The order is that of the report.
pub fn models() -> Vec<ModelCases> {
    let of = |name, single, double| ModelCases { name, single, double };
    vec![
        of("lambert", diffuse::lambert, diffuse::lambert),
        of("oren-nayar", diffuse::oren_nayar, diffuse::oren_nayar),
        of(
            "oren-nayar-qualitative",
            diffuse::oren_nayar_qualitative,
            diffuse::oren_nayar_qualitative,
        ),
        of("oren-nayar-fujii", diffuse::oren_nayar_fujii, diffuse::oren_nayar_fujii),
        of("eon", diffuse::eon, diffuse::eon),
        of("eon-approx", diffuse::eon_approx, diffuse::eon_approx),
        of("burley", diffuse::burley, diffuse::burley),
        of("diffuse-transmitter", diffuse::diffuse_transmitter, diffuse::diffuse_transmitter),
        of("phong", phong::phong, phong::phong),
        of("ashikhmin-shirley", phong::ashikhmin_shirley, phong::ashikhmin_shirley),
        of(
            "ashikhmin-shirley-specular",
            phong::ashikhmin_shirley_specular,
            phong::ashikhmin_shirley_specular,
        ),
        of(
            "ashikhmin-shirley-diffuse",
            phong::ashikhmin_shirley_diffuse,
            phong::ashikhmin_shirley_diffuse,
        ),
        of("smooth-conductor", smooth::smooth_conductor, smooth::smooth_conductor),
        of("rough-conductor", rough::rough_conductor, rough::rough_conductor),
        of("kulla-conty-conductor", rough::kulla_conty, rough::kulla_conty),
        of("kulla-conty-dielectric", rough::kulla_conty_dielectric, rough::kulla_conty_dielectric),
        of("turquin-conductor", rough::turquin, rough::turquin),
        of("conductor", rough::conductor, rough::conductor),
        of("smooth-dielectric", smooth::smooth_dielectric, smooth::smooth_dielectric),
        of("thin-dielectric", smooth::thin_dielectric, smooth::thin_dielectric),
        of("rough-dielectric", rough::rough_dielectric, rough::rough_dielectric),
        of("dielectric", rough::dielectric, rough::dielectric),
        of("absorbing-slab", smooth::absorbing_slab, smooth::absorbing_slab),
        of("null", smooth::null, smooth::null),
        of("plastic", layered::plastic, layered::plastic),
        of("rough-plastic", layered::rough_plastic, layered::rough_plastic),
        of("any-plastic", layered::any_plastic, layered::any_plastic),
        of("any-coupled", layered::any_coupled, layered::any_coupled),
        of("layered-linear", layered::layered_linear, layered::layered_linear),
        of("layered-fresnel", layered::layered_fresnel, layered::layered_fresnel),
        of("coupled", layered::coupled, layered::coupled),
        of("rough-coupled", layered::rough_coupled, layered::rough_coupled),
        of("blend", adapter::blend, adapter::blend),
        of("principled", principled::principled, principled::principled),
        of("principled-thin", principled::principled_thin, principled::principled_thin),
        of("open-pbr", openpbr::open_pbr, openpbr::open_pbr),
        of("measured", measured::measured, measured::measured),
        of("mask", adapter::mask, adapter::mask),
        of("two-sided", adapter::two_sided, adapter::two_sided),
    ]
}

impl ModelCases {
    /// The model's entry in the registry, if it has one.
    pub fn info(&self) -> Option<&'static ModelInfo> {
        MODELS.iter().find(|info| info.name == self.name)
    }
}
