//! A base under an interface.

use etendue_brdf::{
    AnyCoupled, AnyPlastic, Coupled, CoupledInterface, Distribution, InternalReflectance,
    InternalScattering, LayeredFresnel, LayeredLinear, Masking, Plastic, PlasticInterface,
    PlasticSurface, RoughCoupled, RoughPlastic, TransmittanceTable,
};

use etendue_math::Real;

use super::parameters::{
    BECKMANN, alpha, as_published, facets, ior, on_surfaces, reflectance, valid,
};
use super::textbook;
use crate::scalar::{Scalar, shared};
use crate::subject::{Case, Width};

fn interface<T: Scalar>(eta: f64) -> PlasticInterface<T> {
    PlasticInterface::new(ior::<T>(eta), InternalReflectance::Exact)
}

pub(super) fn plastic<T: Scalar>() -> Vec<Case<T>> {
    let case = |rho: f64, eta: f64, scattering| {
        let model = Plastic::new(interface::<T>(eta), reflectance::<T>(rho), scattering);
        let [r, n] = [rho, eta].map(shared::<f64>);
        let base = match scattering {
            InternalScattering::Linear => textbook::linear_base(r, n),
            InternalScattering::NonLinear => textbook::non_linear_base(r, n),
        };
        Case::new(format!("albedo {rho}, η {eta}, {scattering:?}"), model)
            .textbook(move |wo, wi| textbook::plastic(base, n, wo, wi))
    };
    vec![
        case(0.0, 1.5, InternalScattering::Linear),
        case(0.5, 1.5, InternalScattering::Linear),
        case(0.5, 1.5, InternalScattering::NonLinear),
        case(1.0, 1.5, InternalScattering::Linear).lossless(),
        case(1.0, 1.000_001, InternalScattering::NonLinear).lossless(),
        case(1.0, 4.0, InternalScattering::NonLinear).lossless(),
    ]
}

pub(super) fn rough_plastic<T: Scalar>() -> Vec<Case<T>> {
    let case = |rho: f64, eta: f64, distribution, a: f64, scattering| {
        let table = TransmittanceTable::new(
            ior::<T>(eta),
            distribution,
            alpha::<T>(a),
            Masking::HeightCorrelated,
            InternalReflectance::Exact,
        );
        // Models borrow their table; a few kilobytes per case live as long as the audit.
        let table = Box::leak(Box::new(table));
        let model = RoughPlastic::new(table, reflectance::<T>(rho), scattering);
        Case::new(format!("albedo {rho}, η {eta}, {distribution:?} α {a}, {scattering:?}"), model)
    };
    vec![
        case(0.0, 1.5, Distribution::Ggx, 0.3, InternalScattering::Linear),
        case(0.5, 1.5, Distribution::Ggx, 0.1, InternalScattering::NonLinear),
        case(1.0, 1.5, BECKMANN, 0.3, InternalScattering::Linear),
        case(1.0, 2.4, Distribution::Ggx, 1.0, InternalScattering::NonLinear),
    ]
}

pub(super) fn any_plastic<T: Scalar>() -> Vec<Case<T>> {
    let case = |a: f64| {
        let (eta, width) = (ior::<T>(1.5), shared::<T>(a));
        let (masking, internal) = (Masking::HeightCorrelated, InternalReflectance::Exact);
        let surface = PlasticSurface::new(eta, Distribution::Ggx, width, masking, internal);
        let surface = Box::leak(Box::new(valid(surface)));
        let model = AnyPlastic::new(surface, reflectance::<T>(0.5), InternalScattering::NonLinear);
        Case::new(format!("ggx α {a}, η 1.5, albedo 0.5"), model)
    };
    vec![case(0.0), case(0.3)]
}

pub(super) fn any_coupled<T: Scalar>() -> Vec<Case<T>> {
    let case = |a: f64| {
        let ceramic = CoupledInterface::schlick(reflectance::<T>(0.04));
        let (widths, masking) = ([shared::<T>(a); 2], Masking::HeightCorrelated);
        let rm = reflectance::<T>(0.7);
        let model = AnyCoupled::new(ceramic, Distribution::Ggx, widths, masking, rm);
        Case::new(format!("ggx α {a}, Schlick R0 0.04, rm 0.7"), valid(model))
    };
    vec![case(0.0), case(0.3)]
}

pub(super) fn layered_linear<T: Scalar>() -> Vec<Case<T>> {
    let case = |rd: f64, rs: f64| {
        let model = valid(LayeredLinear::new(reflectance::<T>(rd), reflectance::<T>(rs)));
        Case::new(format!("rd {rd}, rs {rs}"), model)
    };
    vec![
        case(0.5, 0.25),
        case(0.0, 0.0),
        case(0.0, 1.0).lossless(),
        case(1.0, 0.0).lossless(),
        case(0.999_999, 1e-6),
        case(1e-6, 0.5).published(&[(0.3, 0.5)]),
    ]
}

pub(super) fn layered_fresnel<T: Scalar>() -> Vec<Case<T>> {
    let case = |r0: f64, rd: f64| {
        let model = LayeredFresnel::new(reflectance::<T>(r0), reflectance::<T>(rd));
        Case::new(format!("R0 {r0}, rd {rd}"), model)
    };
    vec![
        case(0.04, 0.5),
        case(0.0, 0.0),
        case(1.0, 1.0),
        case(0.999_999, 1.0),
        // Gains for a viewer near grazing: Rf(θ) + rd (1 − R0) 20/21.
        case(0.04, 1.0).published(&[(0.01, 0.954), (0.8, 0.957), (1.3, 1.157), (1.56, 1.864)]),
        case(0.0, 1.0).published(&[(0.01, 0.952), (1.56, 1.900)]),
    ]
}

/// Interfaces at both ends of their domains and common ones between.
fn interfaces<T: Scalar>() -> Vec<(String, CoupledInterface<T>)> {
    let schlick = [0.0, 0.04, 0.5, 0.999_999, 1.0]
        .map(|r0| (format!("Schlick R0 {r0}"), CoupledInterface::schlick(reflectance::<T>(r0))));
    let exact = [1.0, 1.000_001, 1.5, 100.0].map(|eta| {
        (format!("dielectric η {eta}"), valid(CoupledInterface::dielectric(ior::<T>(eta))))
    });
    schlick.into_iter().chain(exact).collect()
}

pub(super) fn coupled<T: Scalar>() -> Vec<Case<T>> {
    let mut cases = Vec::new();
    for (name, interface) in interfaces::<T>() {
        for rm in [0.0, 0.5, 1.0] {
            let model = Coupled::new(interface, reflectance::<T>(rm));
            let case = schlick_textbook(Case::new(format!("{name}, rm {rm}"), model), &name, rm);
            // White is white at every angle.
            let white: &[(f64, f64)] = &[(0.0, 1.0), (0.8, 1.0), (1.3, 1.0), (1.56, 1.0)];
            cases.push(if rm == 1.0 { case.lossless().published(white) } else { case });
        }
    }
    cases
}

/// The published matte part, which the paper gives for Schlick's interface.
fn schlick_textbook<T: Scalar>(case: Case<T>, name: &str, rm: f64) -> Case<T> {
    match name.strip_prefix("Schlick R0 ").and_then(|r0| r0.parse().ok()) {
        Some(r0) => {
            let [r0, rm] = [r0, rm].map(shared::<f64>);
            case.textbook(move |wo, wi| textbook::coupled(r0, rm, wo, wi))
        }
        None => case,
    }
}

pub(super) fn rough_coupled<T: Scalar>() -> Vec<Case<T>> {
    let ceramic = CoupledInterface::schlick(reflectance::<T>(0.04));
    let model = |facets| RoughCoupled::new(ceramic, facets, reflectance::<T>(0.7));
    let [r0, rm] = [0.04, 0.7].map(shared::<f64>);
    let cases = on_surfaces(", Schlick R0 0.04, rm 0.7", model);
    let mut cases: Vec<_> = as_published(cases, move |facets, wo, wi| {
        let schlick = |cos: f64| r0 + (1.0 - r0) * Real::powi(1.0 - cos, 5);
        facets.reflection(schlick, wo, wi) + textbook::coupled(r0, rm, wo, wi)
    })
    .collect();
    // Half of the samples shape cells for the matte term: the Gaussian that the horizon cuts off at cos θ = 0.15
    // is left to cells of which cubature misses 1.4 % without noticing (a product rule of 700 × 1400 nodes does not).
    for case in &mut cases {
        if case.parameters.starts_with("beckmann α 0.1") {
            case.width = Width::Narrow;
        }
    }
    // White bases at the widths that gain most.
    let black = CoupledInterface::schlick(reflectance::<T>(0.0));
    let gain = |distribution, a: f64| {
        let surface = facets::<T>(distribution, [a; 2], Masking::HeightCorrelated);
        let model = RoughCoupled::new(black, surface, reflectance::<T>(1.0));
        Case::new(format!("{distribution:?} α {a}, Schlick R0 0, rm 1"), model)
    };
    cases.push(gain(Distribution::Ggx, 0.15).published(&[(0.863_21, 1.0025)]));
    cases.push(gain(BECKMANN, 0.2).published(&[(0.927_3, 1.0053)]));
    // An extreme index near its Brewster angle, to which the facets do not keep.
    let extreme = valid(CoupledInterface::dielectric(ior::<T>(100.0)));
    let surface = facets::<T>(Distribution::Ggx, [0.5; 2], Masking::HeightCorrelated);
    let model = RoughCoupled::new(extreme, surface, reflectance::<T>(1.0));
    let case = Case::new("ggx α 0.5, dielectric η 100, rm 1", model);
    cases.push(case.published(&[(1.561_547, 1.418)]));
    let surface = facets::<T>(Distribution::Ggx, [0.2; 2], Masking::HeightCorrelated);
    for (name, interface) in interfaces::<T>() {
        for rm in [0.0, 1.0] {
            let model = RoughCoupled::new(interface, surface, reflectance::<T>(rm));
            cases.push(Case::new(format!("ggx α 0.2, {name}, rm {rm}"), model));
        }
    }
    cases
}
