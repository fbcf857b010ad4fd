//! Disney's material.

use etendue_brdf::{Principled, PrincipledParameters, PrincipledThin, PrincipledThinParameters};
use etendue_math::Real;

use super::parameters::{Changed, changed_text as text, valid};
use super::textbook;
use crate::scalar::{Scalar, shared};
use crate::subject::Case;

pub(super) fn principled<T: Scalar>() -> Vec<Case<T>> {
    let case = |changed: &Changed| {
        let literal = solid_parameters::<f64>(changed);
        Case::new(text(changed), valid(Principled::new(solid_parameters::<T>(changed))))
            .textbook(move |wo, wi| textbook::principled::solid(&literal, wo, wi))
    };
    let white = ("base_color", 1.0);
    vec![
        case(&[]),
        case(&[("metallic", 1.0), ("roughness", 0.3), ("anisotropic", 0.8)]),
        case(&[white, ("roughness", 1.0), ("sheen", 1.0), ("clearcoat", 1.0), ("eta", 4.0)]),
        case(&[white, ("roughness", 0.5), ("sheen", 1.0), ("clearcoat", 1.0), ("eta", 0.01)]),
        case(&[white, ("roughness", 1.0), ("flatness", 1.0)]),
        case(&[("clearcoat", 1.0), ("clearcoat_gloss", 0.5), ("spec_tint", 0.5)]),
        case(&[("metallic", 0.4), ("spec_tint", 0.6), ("sheen", 0.5), ("roughness", 0.6)]),
        // The coat's own density: no other lobe is drawn.
        case(&[("clearcoat", 1.0), ("diffuse_rate", 0.0), ("specular_rate", 0.0)]),
        case(&[white, ("spec_trans", 1.0), ("roughness", 0.6)]),
        case(&[("spec_trans", 0.5), ("metallic", 0.3), ("eta", 0.7), ("roughness", 0.7)]),
    ]
}

pub(super) fn principled_thin<T: Scalar>() -> Vec<Case<T>> {
    let case = |changed: &Changed| {
        let literal = thin_parameters::<f64>(changed);
        Case::new(text(changed), valid(PrincipledThin::new(thin_parameters::<T>(changed))))
            .textbook(move |wo, wi| textbook::principled::thin(&literal, wo, wi))
    };
    let white = ("base_color", 1.0);
    vec![
        case(&[]),
        case(&[white, ("roughness", 1.0), ("sheen", 1.0)]),
        case(&[white, ("diff_trans", 1.2), ("flatness", 0.5)]),
        case(&[white, ("spec_trans", 1.0), ("roughness", 0.4)]),
        case(&[("spec_trans", 0.5), ("diff_trans", 0.5), ("roughness", 0.8), ("anisotropic", 0.7)]),
        // Transmission of width 0.03: half of it in the mixture is about what cells resolve.
        case(&[("spec_trans", 0.7), ("eta", 0.8), ("diff_trans", 2.0), ("roughness", 1.0)]),
    ]
}

fn solid_parameters<T: Scalar>(changed: &Changed) -> PrincipledParameters<T> {
    let mut parameters = PrincipledParameters::default();
    for &(name, value) in changed {
        *field(&mut parameters, name) = shared::<T>(value);
    }
    parameters
}

fn thin_parameters<T: Scalar>(changed: &Changed) -> PrincipledThinParameters<T> {
    let mut parameters = PrincipledThinParameters::default();
    for &(name, value) in changed {
        *thin_field(&mut parameters, name) = shared::<T>(value);
    }
    parameters
}

fn field<'a, T: Real + etendue_math::Spectrum<Real = T>>(
    p: &'a mut PrincipledParameters<T>,
    name: &str,
) -> &'a mut T {
    match name {
        "base_color" => &mut p.base_color,
        "roughness" => &mut p.roughness,
        "anisotropic" => &mut p.anisotropic,
        "metallic" => &mut p.metallic,
        "spec_trans" => &mut p.spec_trans,
        "eta" => &mut p.eta,
        "spec_tint" => &mut p.spec_tint,
        "sheen" => &mut p.sheen,
        "flatness" => &mut p.flatness,
        "clearcoat" => &mut p.clearcoat,
        "clearcoat_gloss" => &mut p.clearcoat_gloss,
        "diffuse_rate" => &mut p.diffuse_reflectance_sampling_rate,
        "specular_rate" => &mut p.main_specular_sampling_rate,
        _ => unreachable!("no parameter {name}"),
    }
}

fn thin_field<'a, T: Real + etendue_math::Spectrum<Real = T>>(
    p: &'a mut PrincipledThinParameters<T>,
    name: &str,
) -> &'a mut T {
    match name {
        "base_color" => &mut p.base_color,
        "roughness" => &mut p.roughness,
        "anisotropic" => &mut p.anisotropic,
        "spec_trans" => &mut p.spec_trans,
        "eta" => &mut p.eta,
        "spec_tint" => &mut p.spec_tint,
        "sheen" => &mut p.sheen,
        "flatness" => &mut p.flatness,
        "diff_trans" => &mut p.diff_trans,
        _ => unreachable!("no parameter {name}"),
    }
}
