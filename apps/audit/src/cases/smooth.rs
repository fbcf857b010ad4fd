//! Surfaces without roughness.

use etendue_brdf::{
    AbsorbingSlab, ComplexIor, Null, OpticalDepth, SmoothConductor, SmoothDielectric,
    ThinDielectric,
};

use super::parameters::{METALS, complex, ior, valid};
use crate::scalar::{Scalar, shared};
use crate::subject::Case;

/// Relative indices: next to 1 on either side, common glass from both sides, and the extremes.
const INDICES: [f64; 7] = [0.4, 0.666_666_7, 0.999_999, 1.000_001, 1.5, 2.4, 4.0];

pub(super) fn smooth_conductor<T: Scalar>() -> Vec<Case<T>> {
    METALS
        .iter()
        .map(|&(name, index)| Case::new(name, SmoothConductor::new(complex::<T>(index))))
        .chain(
            [Case::new("perfect mirror", SmoothConductor::new(ComplexIor::perfect())).lossless()],
        )
        .collect()
}

pub(super) fn smooth_dielectric<T: Scalar>() -> Vec<Case<T>> {
    INDICES
        .iter()
        .map(|&eta| {
            Case::new(format!("η {eta}"), SmoothDielectric::<T>::new(ior::<T>(eta))).lossless()
        })
        .collect()
}

pub(super) fn thin_dielectric<T: Scalar>() -> Vec<Case<T>> {
    INDICES
        .iter()
        .map(|&eta| {
            Case::new(format!("η {eta}"), ThinDielectric::<T>::new(ior::<T>(eta))).lossless()
        })
        .collect()
}

pub(super) fn absorbing_slab<T: Scalar>() -> Vec<Case<T>> {
    let case = |eta: f64, depth: f64| {
        let tau = valid(OpticalDepth::new(shared::<T>(depth)));
        let model = AbsorbingSlab::<T>::new(ior::<T>(eta), tau);
        Case::new(format!("η {eta}, optical depth {depth}"), model)
    };
    let mut cases: Vec<_> = INDICES.iter().map(|&eta| case(eta, 0.5)).collect();
    cases.extend([0.0, 1e-6, 100.0].map(|depth| case(1.5, depth)));
    cases
}

pub(super) fn null<T: Scalar>() -> Vec<Case<T>> {
    vec![Case::new("", Null::<T>::new()).lossless()]
}
