//! Which parameters of which model are audited.
//!
//! Adding a model: a function that lists its cases, and a line in [`models`].

use etendue_brdf::registry::{MODELS, ModelInfo};
use etendue_brdf::{
    Alpha, BeckmannLambda, Bsdf, ComplexIor, Conductor, Dielectric, Distribution,
    InternalReflectance, InternalScattering, Ior, Lambert, Mask, Masking, Microfacets, Null,
    Opacity, OrenNayar, OrenNayarQualitative, ParameterError, Plastic, PlasticInterface,
    Reflectance, RoughConductor, RoughDielectric, RoughPlastic, Sigma, SmoothConductor,
    SmoothDielectric, ThinDielectric, TransmittanceTable, TwoSided,
};

use crate::scalar::{Scalar, shared};
use crate::subject::{Case, Width};

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
        of("lambert", lambert, lambert),
        of("oren-nayar", oren_nayar, oren_nayar),
        of("oren-nayar-qualitative", oren_nayar_qualitative, oren_nayar_qualitative),
        of("smooth-conductor", smooth_conductor, smooth_conductor),
        of("rough-conductor", rough_conductor, rough_conductor),
        of("conductor", conductor, conductor),
        of("smooth-dielectric", smooth_dielectric, smooth_dielectric),
        of("thin-dielectric", thin_dielectric, thin_dielectric),
        of("rough-dielectric", rough_dielectric, rough_dielectric),
        of("dielectric", dielectric, dielectric),
        of("null", null, null),
        of("plastic", plastic, plastic),
        of("rough-plastic", rough_plastic, rough_plastic),
        of("mask", mask, mask),
        of("two-sided", two_sided, two_sided),
    ]
}

impl ModelCases {
    /// The model's entry in the registry, if it has one.
    pub fn info(&self) -> Option<&'static ModelInfo> {
        MODELS.iter().find(|info| info.name == self.name)
    }
}

/// Every parameter below is written out here and lies in its domain.
fn valid<P>(parameter: Result<P, ParameterError>) -> P {
    parameter.expect("a parameter in its domain")
}

fn reflectance<T: Scalar>(x: f64) -> Reflectance<T> {
    valid(Reflectance::new(shared::<T>(x)))
}

fn alpha<T: Scalar>(x: f64) -> Alpha<T> {
    valid(Alpha::new(shared::<T>(x)))
}

fn ior<T: Scalar>(x: f64) -> Ior<T> {
    valid(Ior::new(shared::<T>(x)))
}

fn complex<T: Scalar>([eta, k]: [f64; 2]) -> ComplexIor<T> {
    valid(ComplexIor::new(shared::<T>(eta), shared::<T>(k)))
}

fn opacity<T: Scalar>(x: f64) -> Opacity<T> {
    valid(Opacity::new(shared::<T>(x)))
}

const BECKMANN: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Exact };

/// Rough surfaces from a needle to a slab: distribution, widths, masking.
const SURFACES: [(&str, Distribution, [f64; 2], Masking); 10] = [
    ("ggx α 2e-8", Distribution::Ggx, [2e-8; 2], Masking::HeightCorrelated),
    ("ggx α 1e-4", Distribution::Ggx, [1e-4; 2], Masking::HeightCorrelated),
    ("ggx α 0.02", Distribution::Ggx, [0.02; 2], Masking::HeightCorrelated),
    ("ggx α 0.3", Distribution::Ggx, [0.3; 2], Masking::HeightCorrelated),
    ("ggx α 1, separable", Distribution::Ggx, [1.0; 2], Masking::Separable),
    ("ggx α 0.1 × 0.5", Distribution::Ggx, [0.1, 0.5], Masking::HeightCorrelated),
    ("beckmann α 2e-8", BECKMANN, [2e-8; 2], Masking::HeightCorrelated),
    ("beckmann α 0.1", BECKMANN, [0.1; 2], Masking::Separable),
    ("beckmann α 0.6 × 0.2", BECKMANN, [0.6, 0.2], Masking::HeightCorrelated),
    (
        "beckmann α 0.3, Walter's fit",
        Distribution::Beckmann { lambda: BeckmannLambda::Walter },
        [0.3; 2],
        Masking::Separable,
    ),
];
/// A lobe of slopes up to α; see [`Width`].
fn width<T: Scalar>(alpha: f64) -> Width {
    if alpha < T::EPSILON.to_f64() {
        Width::Needle
    } else if alpha < 1e-3 {
        Width::Narrow
    } else {
        Width::Wide
    }
}

fn facets<T: Scalar>(
    distribution: Distribution,
    [x, y]: [f64; 2],
    masking: Masking,
) -> Microfacets<T> {
    Microfacets::new(distribution, alpha::<T>(x), alpha::<T>(y), masking)
}

/// One case per surface, with what `model` makes of it.
fn on_surfaces<T: Scalar, B: Bsdf<Color = T> + Send + Sync + 'static>(
    parameters: &str,
    model: impl Fn(Microfacets<T>) -> B,
) -> Vec<Case<T>> {
    SURFACES
        .iter()
        .map(|&(name, distribution, widths, masking)| {
            let bsdf = model(facets::<T>(distribution, widths, masking));
            Case::new(format!("{name}{parameters}"), bsdf).of_width(width::<T>(widths[0]))
        })
        .collect()
}

fn lambert<T: Scalar>() -> Vec<Case<T>> {
    let case = |rho| Case::new(format!("albedo {rho}"), Lambert::new(reflectance::<T>(rho)));
    vec![case(0.0), case(0.5), case(1.0).published(&[(0.01, 1.0), (1.56, 1.0)])]
}

fn oren_nayar<T: Scalar>() -> Vec<Case<T>> {
    let case = |rho, sigma: f64| {
        let model = OrenNayar::new(reflectance::<T>(rho), valid(Sigma::new(shared::<T>(sigma))));
        Case::new(format!("albedo {rho}, σ {sigma}"), model)
    };
    vec![
        case(0.0, 0.3),
        case(0.5, 0.0),
        case(0.2, 1.5),
        case(1.0, 1e-3),
        case(1.0, 0.3).published(&[
            (0.01, 0.962),
            (0.8, 0.971),
            (1.3, 1.004),
            (1.5, 1.032),
            (1.56, 1.046),
        ]),
        case(1.0, 0.5).published(&[(0.01, 0.896), (0.8, 0.909), (1.3, 0.958), (1.56, 1.020)]),
        case(1.0, 1.0).published(&[(0.01, 0.775), (0.8, 0.790), (1.3, 0.852), (1.56, 0.929)]),
    ]
}

fn oren_nayar_qualitative<T: Scalar>() -> Vec<Case<T>> {
    let case = |rho, sigma: f64| {
        let sigma_checked = valid(Sigma::new(shared::<T>(sigma)));
        let model = OrenNayarQualitative::new(reflectance::<T>(rho), sigma_checked);
        Case::new(format!("albedo {rho}, σ {sigma}"), model)
    };
    vec![
        case(0.0, 0.3),
        case(0.5, 0.0),
        case(1.0, 0.3).published(&[
            (0.01, 0.893),
            (0.8, 0.939),
            (1.3, 0.983),
            (1.5, 1.000),
            (1.56, 1.005),
        ]),
        case(1.0, 1.0).published(&[
            (0.01, 0.625),
            (0.8, 0.709),
            (1.3, 0.789),
            (1.5, 0.821),
            (1.56, 0.829),
        ]),
    ]
}

/// Gold in red and in blue light, a perfect mirror, and an index that all but vanishes.
const METALS: [(&str, [f64; 2]); 4] = [
    ("gold, red", [0.143, 3.983]),
    ("gold, blue", [1.442, 1.603]),
    ("perfect mirror", [0.0, 1.0]),
    ("η 1 + 1e-6, k 0", [1.000_001, 0.0]),
];

fn smooth_conductor<T: Scalar>() -> Vec<Case<T>> {
    METALS
        .iter()
        .map(|&(name, index)| Case::new(name, SmoothConductor::new(complex::<T>(index))))
        .collect()
}

fn rough_conductor<T: Scalar>() -> Vec<Case<T>> {
    let mirror = |facets| RoughConductor::new(ComplexIor::perfect(), facets);
    let gold = |facets| RoughConductor::new(complex::<T>(METALS[1].1), facets);
    let mut cases = on_surfaces(", perfect mirror", mirror);
    cases.extend(on_surfaces(", gold", gold));
    // The only closed form of a rough albedo: 1 − ln 2.
    let widest = facets::<T>(Distribution::Ggx, [1.0; 2], Masking::HeightCorrelated);
    cases.push(Case::new("ggx α 1, perfect mirror", mirror(widest)).published(&[(0.0, 0.306_853)]));
    cases
}

fn conductor<T: Scalar>() -> Vec<Case<T>> {
    let case = |a: f64| {
        let widths = [shared::<T>(a); 2];
        let gold = complex::<T>(METALS[0].1);
        let model = valid(Conductor::new(gold, Distribution::Ggx, widths, Masking::default()));
        Case::new(format!("ggx α {a}, gold"), model)
    };
    vec![case(0.0), case(0.3)]
}

/// Relative indices: next to 1 on either side, common glass from both sides, and the extremes.
const INDICES: [f64; 7] = [0.4, 0.666_666_7, 0.999_999, 1.000_001, 1.5, 2.4, 4.0];

fn smooth_dielectric<T: Scalar>() -> Vec<Case<T>> {
    INDICES
        .iter()
        .map(|&eta| Case::new(format!("η {eta}"), SmoothDielectric::<T>::new(ior::<T>(eta))))
        .collect()
}

fn thin_dielectric<T: Scalar>() -> Vec<Case<T>> {
    INDICES
        .iter()
        .map(|&eta| Case::new(format!("η {eta}"), ThinDielectric::<T>::new(ior::<T>(eta))))
        .collect()
}

fn rough_dielectric<T: Scalar>() -> Vec<Case<T>> {
    let model = |eta: f64| move |facets| valid(RoughDielectric::<T>::new(ior::<T>(eta), facets));
    let mut cases = on_surfaces(", η 1.5", model(1.5));
    for eta in [0.4, 1.001, 2.4, 4.0] {
        let surface = facets::<T>(Distribution::Ggx, [0.4; 2], Masking::HeightCorrelated);
        cases.push(Case::new(format!("ggx α 0.4, η {eta}"), model(eta)(surface)));
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

fn dielectric<T: Scalar>() -> Vec<Case<T>> {
    let case = |eta: f64, a: f64| {
        let widths = [shared::<T>(a); 2];
        let model =
            Dielectric::<T>::new(ior::<T>(eta), Distribution::Ggx, widths, Masking::default());
        Case::new(format!("ggx α {a}, η {eta}"), valid(model))
    };
    vec![case(1.0, 0.3), case(1.5, 0.0), case(1.5, 0.3)]
}

fn null<T: Scalar>() -> Vec<Case<T>> {
    vec![Case::new("", Null::<T>::new())]
}

fn interface<T: Scalar>(eta: f64) -> PlasticInterface<T> {
    PlasticInterface::new(ior::<T>(eta), InternalReflectance::Exact)
}

fn plastic<T: Scalar>() -> Vec<Case<T>> {
    let case = |rho: f64, eta: f64, scattering| {
        let model = Plastic::new(interface::<T>(eta), reflectance::<T>(rho), scattering);
        Case::new(format!("albedo {rho}, η {eta}, {scattering:?}"), model)
    };
    vec![
        case(0.0, 1.5, InternalScattering::Linear),
        case(0.5, 1.5, InternalScattering::Linear),
        case(0.5, 1.5, InternalScattering::NonLinear),
        case(1.0, 1.5, InternalScattering::Linear),
        case(1.0, 1.000_001, InternalScattering::NonLinear),
        case(1.0, 4.0, InternalScattering::NonLinear),
    ]
}

fn rough_plastic<T: Scalar>() -> Vec<Case<T>> {
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

fn mask<T: Scalar>() -> Vec<Case<T>> {
    let diffuse = |a: f64| {
        let model = Mask::new(Lambert::new(reflectance::<T>(0.5)), opacity::<T>(a));
        Case::new(format!("opacity {a} over lambert"), model)
    };
    let glass = Mask::new(SmoothDielectric::<T>::new(ior::<T>(1.5)), opacity::<T>(0.3));
    vec![
        diffuse(0.0),
        diffuse(1e-6),
        diffuse(0.6),
        diffuse(1.0),
        Case::new("opacity 0.3 over smooth-dielectric", glass),
    ]
}

fn two_sided<T: Scalar>() -> Vec<Case<T>> {
    let diffuse = Lambert::new(reflectance::<T>(0.5));
    let surface = facets::<T>(Distribution::Ggx, [0.3; 2], Masking::HeightCorrelated);
    let metal = RoughConductor::new(complex::<T>(METALS[0].1), surface);
    vec![
        Case::new("lambert", TwoSided::same(diffuse)),
        Case::new("rough-conductor, lambert behind", TwoSided::new(metal, diffuse)),
    ]
}
