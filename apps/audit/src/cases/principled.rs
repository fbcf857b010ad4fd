//! Disney's material.

use etendue_brdf::{Principled, PrincipledParameters, PrincipledThin, PrincipledThinParameters};
use etendue_math::Real;

use super::parameters::{Changed, changed_text as text, valid};
use crate::scalar::{Scalar, shared};
use crate::subject::Case;

pub(super) fn principled<T: Scalar>() -> Vec<Case<T>> {
    let case = |changed: &Changed| {
        let mut p = PrincipledParameters::<T>::default();
        for &(name, value) in changed {
            *field(&mut p, name) = shared::<T>(value);
        }
        Case::new(text(changed), valid(Principled::new(p)))
    };
    let white = ("base_color", 1.0);
    vec![
        case(&[]),
        case(&[("metallic", 1.0), ("roughness", 0.3), ("anisotropic", 0.8)]),
        case(&[white, ("roughness", 1.0), ("sheen", 1.0), ("clearcoat", 1.0), ("eta", 4.0)]),
        case(&[white, ("roughness", 0.5), ("sheen", 1.0), ("clearcoat", 1.0), ("eta", 0.01)]),
        case(&[white, ("roughness", 1.0), ("flatness", 1.0)]),
        case(&[("clearcoat", 1.0), ("clearcoat_gloss", 0.5), ("spec_tint", 0.5)]),
        case(&[white, ("spec_trans", 1.0), ("roughness", 0.6)]),
        case(&[("spec_trans", 0.5), ("metallic", 0.3), ("eta", 0.7), ("roughness", 0.7)]),
    ]
}

pub(super) fn principled_thin<T: Scalar>() -> Vec<Case<T>> {
    let case = |changed: &Changed| {
        let mut p = PrincipledThinParameters::<T>::default();
        for &(name, value) in changed {
            *thin_field(&mut p, name) = shared::<T>(value);
        }
        Case::new(text(changed), valid(PrincipledThin::new(p)))
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
