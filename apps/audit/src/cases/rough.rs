//! Surfaces of microfacets.

use etendue_brdf::microfacet::{AllNormals, BoundedCaps, NormalSampling, ProjectedDisk};
use etendue_brdf::{
    Bsdf, ComplexIor, Conductor, Dielectric, Distribution, KullaContyConductor,
    KullaContyDielectric, Masking, Microfacets, ParameterError, RoughConductor, RoughDielectric,
    TurquinConductor,
};

use super::parameters::{
    BECKMANN, METALS, SURFACES, as_published, complex, facets, ior, on_surfaces, valid, width,
};
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
    cases.extend(sampled_by::<T, AllNormals>("all normals"));
    cases.extend(sampled_by::<T, ProjectedDisk>("projected disk"));
    cases.extend(sampled_by::<T, BoundedCaps>("bounded caps"));
    // The only closed form of a rough albedo: 1 − ln 2.
    let widest = facets::<T>(Distribution::Ggx, [1.0; 2], Masking::HeightCorrelated);
    cases.push(Case::new("ggx α 1, perfect mirror", mirror(widest)).published(&[(0.0, 0.306_853)]));
    cases
}

/// A perfect mirror on every surface that a sampling strategy exists for.
fn sampled_by<T: Scalar, S: NormalSampling<T>>(strategy: &str) -> Vec<Case<T>> {
    SURFACES
        .iter()
        .filter(|surface| S::supports(surface.1))
        .map(|&(name, distribution, widths, masking)| {
            let surface = facets::<T>(distribution, widths, masking);
            let model = RoughConductor::<T>::new(ComplexIor::perfect(), surface);
            Case::new(format!("{name}, perfect mirror, {strategy}"), valid(model.sampled_by::<S>()))
                .of_width(width::<T>(widths[0]))
        })
        .collect()
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

/// Surfaces that have a table of what single scattering loses, from nearly smooth to the widest.
const TABULATED: [(&str, Distribution, f64, Masking); 7] = [
    ("ggx α 2e-8", Distribution::Ggx, 2e-8, Masking::HeightCorrelated),
    ("ggx α 0.02", Distribution::Ggx, 0.02, Masking::HeightCorrelated),
    ("ggx α 0.3", Distribution::Ggx, 0.3, Masking::HeightCorrelated),
    ("ggx α 1", Distribution::Ggx, 1.0, Masking::HeightCorrelated),
    ("ggx α 0.7, separable", Distribution::Ggx, 0.7, Masking::Separable),
    ("beckmann α 0.47", BECKMANN, 0.47, Masking::HeightCorrelated),
    ("beckmann α 1", BECKMANN, 1.0, Masking::HeightCorrelated),
];

/// Every tabulated surface as a perfect mirror, and as gold in blue light.
///
/// The literal form has the table in it, which the function `FacetLoss` answers for.
fn compensated<T: Scalar, B: Bsdf<Color = T> + Send + Sync + 'static>(
    model: impl Fn(ComplexIor<T>, Microfacets<T>) -> Result<B, ParameterError>,
    literal: fn(&textbook::Compensated, [f64; 3], [f64; 3]) -> f64,
) -> Vec<Case<T>> {
    let metals = [("perfect mirror", [0.0, 1.0]), ("gold", METALS[1].1)];
    let case = |&(name, distribution, a, masking): &(_, _, _, _), (metal, index): (_, [f64; 2])| {
        let bsdf = valid(model(complex::<T>(index), facets::<T>(distribution, [a; 2], masking)));
        let case = Case::new(format!("{name}, {metal}"), bsdf).of_width(width::<T>(a));
        if a < 1e-3 {
            return case;
        }
        let surface = facets::<f64>(distribution, [a; 2], masking);
        let facets = textbook::Facets { distribution, widths: [shared::<f64>(a); 2], masking };
        let index = index.map(shared::<f64>);
        let printed = valid(textbook::Compensated::new(facets, index, &surface));
        case.textbook(move |wo, wi| literal(&printed, wo, wi))
    };
    TABULATED.iter().flat_map(|surface| metals.map(|metal| case(surface, metal))).collect()
}

pub(super) fn kulla_conty<T: Scalar>() -> Vec<Case<T>> {
    let mut cases = compensated(KullaContyConductor::<T>::new, textbook::Compensated::kulla_conty);
    // The white furnace: nothing is lost at the widest lobe.
    let widest = facets::<T>(Distribution::Ggx, [1.0; 2], Masking::HeightCorrelated);
    let mirror = valid(KullaContyConductor::<T>::new(ComplexIor::perfect(), widest));
    cases.push(white_furnace(mirror));
    cases
}

pub(super) fn turquin<T: Scalar>() -> Vec<Case<T>> {
    let mut cases = compensated(TurquinConductor::<T>::new, textbook::Compensated::turquin);
    let widest = facets::<T>(Distribution::Ggx, [1.0; 2], Masking::HeightCorrelated);
    let mirror = valid(TurquinConductor::<T>::new(ComplexIor::perfect(), widest));
    cases.push(white_furnace(mirror));
    cases
}

/// The widest perfect mirror: nothing is lost but for linear interpolation in the table, which misses up to
/// 3e-4 between its outermost columns.
fn white_furnace<T: Scalar>(mirror: impl Bsdf<Color = T> + Send + Sync + 'static) -> Case<T> {
    let case = Case::new("ggx α 1, white furnace", mirror);
    case.lossless_within(3e-4).published(WHITE_FURNACE)
}

/// Angles in rad and the albedo there.
const WHITE_FURNACE: &[(f64, f64)] = &[(0.0, 1.0), (0.8, 1.0), (1.3, 1.0)];

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

pub(super) fn kulla_conty_dielectric<T: Scalar>() -> Vec<Case<T>> {
    let case = |distribution, a: f64, masking, eta: f64| {
        let surface = facets::<T>(distribution, [a; 2], masking);
        let model = valid(KullaContyDielectric::<T>::new(ior::<T>(eta), surface));
        Case::new(format!("{distribution:?} α {a}, {masking:?}, η {eta}"), model)
            .of_width(width::<T>(a))
    };
    let (ggx, correlated) = (Distribution::Ggx, Masking::HeightCorrelated);
    vec![
        case(ggx, 2e-8, correlated, 1.5),
        case(ggx, 0.3, correlated, 1.5),
        case(ggx, 1.0, correlated, 1.5),
        case(ggx, 0.4, correlated, 0.4),
        case(ggx, 0.7, Masking::Separable, 2.4),
        case(BECKMANN, 0.6, correlated, 1.33),
    ]
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
