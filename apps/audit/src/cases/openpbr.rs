//! OpenPBR's surface.

use etendue_brdf::{OpenPbr, OpenPbrParameters};
use etendue_math::{Real, Spectrum};

use super::parameters::{Changed, changed_text, valid};
use crate::scalar::{Scalar, shared};
use crate::subject::{Case, Width};

pub(super) fn open_pbr<T: Scalar>() -> Vec<Case<T>> {
    let case = |changed: &Changed| {
        let mut p = OpenPbrParameters::<T>::default();
        for &(name, value) in changed {
            *field(&mut p, name) = shared::<T>(value);
        }
        Case::new(changed_text(changed), valid(OpenPbr::new(p)))
    };
    let (white, metal) = (("base_color", 1.0), ("base_metalness", 1.0));
    let coat = [("coat_weight", 1.0), ("coat_roughness", 0.5)];
    let fuzz = [("fuzz_weight", 1.0), ("fuzz_roughness", 0.3)];
    vec![
        case(&[]),
        case(&[white, ("specular_roughness", 0.6), ("base_diffuse_roughness", 1.0)]),
        case(&[white, ("specular_roughness", 1.0), ("specular_weight", 20.0)]),
        case(&[("specular_weight", 0.0), ("base_diffuse_roughness", 0.5)]),
        case(&[white, metal, ("specular_roughness", 1.0), ("specular_roughness_anisotropy", 0.7)]),
        case(&[metal, ("specular_color", 0.3), ("specular_roughness", 0.5)]),
        // Mirrors: of coat, of base, of both with nothing else.
        case(&[white, ("coat_weight", 1.0), ("coat_color", 0.5), ("specular_roughness", 0.5)]),
        case(&[white, ("specular_roughness", 0.0), ("specular_ior", 1.000_01)]),
        case(&[metal, ("specular_roughness", 0.0), ("coat_weight", 1.0), ("coat_ior", 2.0)]),
        case(&[white, metal, ("specular_roughness", 0.6), coat[0], coat[1]]),
        case(&[white, ("specular_roughness", 0.6), coat[0], coat[1], ("coat_color", 0.0)]),
        case(&[white, ("specular_roughness", 0.6), fuzz[0], fuzz[1], coat[0], coat[1]]),
        case(&[("base_weight", 0.0), ("specular_weight", 0.0), fuzz[0], ("fuzz_roughness", 0.0)]),
        case(&[
            ("base_metalness", 0.4),
            ("specular_color", 0.7),
            ("specular_roughness", 0.4),
            ("specular_roughness_anisotropy", 0.3),
            ("coat_weight", 0.5),
            ("coat_color", 0.6),
            ("coat_roughness", 0.4),
            ("coat_roughness_anisotropy", 0.4),
            ("coat_darkening", 0.5),
            ("fuzz_weight", 0.5),
            ("fuzz_color", 0.8),
        ]),
        case(&[("specular_roughness", 0.01), coat[0], ("coat_roughness", 0.01)])
            .of_width(Width::Narrow),
    ]
}

fn field<'a, T: Real + Spectrum<Real = T>>(
    p: &'a mut OpenPbrParameters<T>,
    name: &str,
) -> &'a mut T {
    match name {
        "base_weight" => &mut p.base_weight,
        "base_color" => &mut p.base_color,
        "base_diffuse_roughness" => &mut p.base_diffuse_roughness,
        "base_metalness" => &mut p.base_metalness,
        "specular_weight" => &mut p.specular_weight,
        "specular_color" => &mut p.specular_color,
        "specular_roughness" => &mut p.specular_roughness,
        "specular_roughness_anisotropy" => &mut p.specular_roughness_anisotropy,
        "specular_ior" => &mut p.specular_ior,
        "coat_weight" => &mut p.coat_weight,
        "coat_color" => &mut p.coat_color,
        "coat_roughness" => &mut p.coat_roughness,
        "coat_roughness_anisotropy" => &mut p.coat_roughness_anisotropy,
        "coat_ior" => &mut p.coat_ior,
        "coat_darkening" => &mut p.coat_darkening,
        "fuzz_weight" => &mut p.fuzz_weight,
        "fuzz_color" => &mut p.fuzz_color,
        "fuzz_roughness" => &mut p.fuzz_roughness,
        _ => unreachable!("no parameter {name}"),
    }
}
