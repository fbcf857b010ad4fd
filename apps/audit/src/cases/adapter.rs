//! Models made of other models.

use etendue_brdf::{
    Distribution, Lambert, Mask, Masking, RoughConductor, SmoothDielectric, TwoSided,
};

use super::parameters::{METALS, complex, facets, ior, opacity, reflectance};
use crate::scalar::Scalar;
use crate::subject::Case;

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
    vec![
        Case::new("lambert", TwoSided::same(diffuse)),
        Case::new("rough-conductor, lambert behind", TwoSided::new(metal, diffuse)),
    ]
}
