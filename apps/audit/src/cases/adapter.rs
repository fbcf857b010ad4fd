//! Models made of other models.

use etendue_brdf::{
    Blend, Distribution, Lambert, Mask, Masking, RoughConductor, RoughDielectric, SmoothConductor,
    SmoothDielectric, TwoSided,
};

use super::parameters::{METALS, complex, facets, ior, opacity, reflectance, valid};
use crate::scalar::Scalar;
use crate::subject::Case;

pub(super) fn blend<T: Scalar>() -> Vec<Case<T>> {
    let diffuse = Lambert::new(reflectance::<T>(0.5));
    let rough = facets::<T>(Distribution::Ggx, [0.3; 2], Masking::HeightCorrelated);
    let metal = RoughConductor::new(complex::<T>(METALS[0].1), rough);
    let mirror = SmoothConductor::new(complex::<T>(METALS[0].1));
    let glass = valid(RoughDielectric::<T>::new(ior::<T>(1.5), rough));
    let painted = |w: f64| {
        let model = Blend::new(diffuse, metal, opacity::<T>(w));
        Case::new(format!("lambert, rough-conductor, weight {w}"), model)
    };
    vec![
        painted(0.0),
        painted(1e-6),
        painted(0.4),
        painted(1.0),
        Case::new(
            "lambert, smooth-conductor, weight 0.3",
            Blend::new(diffuse, mirror, opacity::<T>(0.3)),
        ),
        Case::new(
            "smooth-conductor, smooth-dielectric, weight 0.6",
            Blend::new(mirror, SmoothDielectric::<T>::new(ior::<T>(1.5)), opacity::<T>(0.6)),
        ),
        Case::new(
            "rough-dielectric, lambert, weight 0.25",
            Blend::new(glass, diffuse, opacity::<T>(0.25)),
        ),
    ]
}

pub(super) fn mask<T: Scalar>() -> Vec<Case<T>> {
    let diffuse = |a: f64| {
        let model = Mask::new(Lambert::new(reflectance::<T>(0.5)), opacity::<T>(a));
        Case::new(format!("opacity {a} over lambert"), model)
    };
    let glass = Mask::new(SmoothDielectric::<T>::new(ior::<T>(1.5)), opacity::<T>(0.3));
    vec![
        diffuse(0.0).lossless(),
        diffuse(1e-6),
        diffuse(0.6),
        diffuse(1.0),
        Case::new("opacity 0.3 over smooth-dielectric", glass).lossless(),
    ]
}

pub(super) fn two_sided<T: Scalar>() -> Vec<Case<T>> {
    let diffuse = Lambert::new(reflectance::<T>(0.5));
    let surface = facets::<T>(Distribution::Ggx, [0.3; 2], Masking::HeightCorrelated);
    let metal = RoughConductor::new(complex::<T>(METALS[0].1), surface);
    let dark = Lambert::new(reflectance::<T>(0.2));
    vec![
        Case::new("lambert", TwoSided::same(diffuse)),
        Case::new("lambert, a darker one behind", TwoSided::new(diffuse, dark)),
        Case::new("rough-conductor, lambert behind", TwoSided::new(metal, diffuse)),
    ]
}
