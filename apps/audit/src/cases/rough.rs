//! Surfaces of microfacets.

use etendue_brdf::{
    ComplexIor, Conductor, Dielectric, Distribution, Masking, RoughConductor, RoughDielectric,
};

use super::parameters::{METALS, as_published, complex, facets, ior, on_surfaces, valid};
use super::textbook;
use crate::scalar::{Scalar, shared};
use crate::subject::{Case, Width};

pub(super) fn rough_conductor<T: Scalar>() -> Vec<Case<T>> {
    let mirror = |facets| RoughConductor::new(ComplexIor::perfect(), facets);
    let gold = |facets| RoughConductor::new(complex::<T>(METALS[1].1), facets);
    let gold_index = METALS[1].1.map(shared::<f64>);
    let white = as_published(on_surfaces(", perfect mirror", mirror), |facets, wo, wi| {
        facets.reflection(|_| 1.0, wo, wi)
    });
    let golden = as_published(on_surfaces(", gold", gold), move |facets, wo, wi| {
        facets.reflection(|cos| textbook::conductor(cos, gold_index), wo, wi)
    });
    let mut cases: Vec<_> = white.chain(golden).collect();
    // The only closed form of a rough albedo: 1 − ln 2.
    let widest = facets::<T>(Distribution::Ggx, [1.0; 2], Masking::HeightCorrelated);
    cases.push(Case::new("ggx α 1, perfect mirror", mirror(widest)).published(&[(0.0, 0.306_853)]));
    cases
}

pub(super) fn conductor<T: Scalar>() -> Vec<Case<T>> {
    let case = |a: f64| {
        let widths = [shared::<T>(a); 2];
        let gold = complex::<T>(METALS[0].1);
        let model = valid(Conductor::new(gold, Distribution::Ggx, widths, Masking::default()));
        Case::new(format!("ggx α {a}, gold"), model)
    };
    vec![case(0.0), case(0.3)]
}

pub(super) fn rough_dielectric<T: Scalar>() -> Vec<Case<T>> {
    let model = |eta: f64| move |facets| valid(RoughDielectric::<T>::new(ior::<T>(eta), facets));
    let glass = on_surfaces(", η 1.5", model(1.5));
    let mut cases: Vec<_> =
        as_published(glass, |facets, wo, wi| facets.dielectric(1.5, wo, wi)).collect();
    for eta in [0.4, 1.001, 2.4, 4.0] {
        let surface = facets::<T>(Distribution::Ggx, [0.4; 2], Masking::HeightCorrelated);
        let facets = textbook::Facets {
            distribution: Distribution::Ggx,
            widths: [shared::<f64>(0.4); 2],
            masking: Masking::HeightCorrelated,
        };
        let index = shared::<f64>(eta);
        cases.push(
            Case::new(format!("ggx α 0.4, η {eta}"), model(eta)(surface))
                .textbook(move |wo, wi| facets.dielectric(index, wo, wi)),
        );
    }
    // All but the whole lobe goes straight through, into a cone of 1e-6 · α.
    for eta in [0.999_999, 1.000_001] {
        let surface = facets::<T>(Distribution::Ggx, [0.4; 2], Masking::HeightCorrelated);
        cases.push(
            Case::new(format!("ggx α 0.4, η {eta}"), model(eta)(surface)).of_width(Width::Narrow),
        );
    }
    cases
}

pub(super) fn dielectric<T: Scalar>() -> Vec<Case<T>> {
    let case = |eta: f64, a: f64| {
        let widths = [shared::<T>(a); 2];
        let model =
            Dielectric::<T>::new(ior::<T>(eta), Distribution::Ggx, widths, Masking::default());
        Case::new(format!("ggx α {a}, η {eta}"), valid(model))
    };
    vec![case(1.0, 0.3).lossless(), case(1.5, 0.0).lossless(), case(1.5, 0.3)]
}
