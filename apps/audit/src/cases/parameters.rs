//! Parameters that the cases of several families share.

use etendue_brdf::{
    Alpha, BeckmannLambda, Bsdf, ComplexIor, Distribution, Ior, Masking, Microfacets, Opacity,
    ParameterError, Reflectance,
};

use super::textbook::Facets;
use crate::scalar::{Scalar, shared};
use crate::subject::{Case, Width};

/// Every parameter below is written out here and lies in its domain.
pub(super) fn valid<P>(parameter: Result<P, ParameterError>) -> P {
    parameter.expect("a parameter in its domain")
}

/// Parameters changed from their defaults, by name.
pub(super) type Changed = [(&'static str, f64)];

/// They as the report prints them.
pub(super) fn changed_text(changed: &Changed) -> String {
    if changed.is_empty() {
        return "defaults".into();
    }
    changed.iter().map(|(name, value)| format!("{name} {value}")).collect::<Vec<_>>().join(", ")
}

pub(super) fn reflectance<T: Scalar>(x: f64) -> Reflectance<T> {
    valid(Reflectance::new(shared::<T>(x)))
}

pub(super) fn alpha<T: Scalar>(x: f64) -> Alpha<T> {
    valid(Alpha::new(shared::<T>(x)))
}

pub(super) fn ior<T: Scalar>(x: f64) -> Ior<T> {
    valid(Ior::new(shared::<T>(x)))
}

pub(super) fn complex<T: Scalar>([eta, k]: [f64; 2]) -> ComplexIor<T> {
    valid(ComplexIor::new(shared::<T>(eta), shared::<T>(k)))
}

pub(super) fn opacity<T: Scalar>(x: f64) -> Opacity<T> {
    valid(Opacity::new(shared::<T>(x)))
}

/// Gold in red and in blue light, a perfect mirror, and an index that all but vanishes.
pub(super) const METALS: [(&str, [f64; 2]); 4] = [
    ("gold, red", [0.143, 3.983]),
    ("gold, blue", [1.442, 1.603]),
    ("perfect mirror", [0.0, 1.0]),
    ("η 1 + 1e-6, k 0", [1.000_001, 0.0]),
];

pub(super) const BECKMANN: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Exact };

/// Rough surfaces from a needle to a slab: distribution, widths, masking.
pub(super) const SURFACES: [(&str, Distribution, [f64; 2], Masking); 10] = [
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
pub(super) fn width<T: Scalar>(alpha: f64) -> Width {
    if alpha < T::EPSILON.to_f64() {
        Width::Needle
    } else if alpha < 1e-3 {
        Width::Narrow
    } else {
        Width::Wide
    }
}

pub(super) fn facets<T: Scalar>(
    distribution: Distribution,
    [x, y]: [f64; 2],
    masking: Masking,
) -> Microfacets<T> {
    Microfacets::new(distribution, alpha::<T>(x), alpha::<T>(y), masking)
}

/// A rough surface by itself.
pub struct Surface<T> {
    /// Its parameters, as the report prints them.
    pub name: &'static str,
    /// The surface.
    pub facets: Microfacets<T>,
    /// Its distribution.
    pub distribution: Distribution,
    /// How masking and shadowing are combined.
    pub masking: Masking,
    /// Its widths αx and αy.
    pub widths: [f64; 2],
    /// How its lobe compares with what can be resolved.
    pub width: Width,
}

/// The rough surfaces that models are audited with.
pub fn surfaces<T: Scalar>() -> Vec<Surface<T>> {
    SURFACES
        .iter()
        .map(|&(name, distribution, widths, masking)| Surface {
            name,
            facets: facets::<T>(distribution, widths, masking),
            distribution,
            masking,
            widths: widths.map(|a| shared::<T>(a).to_f64()),
            width: width::<T>(widths[0]),
        })
        .collect()
}

/// One case per surface, with what `model` makes of it.
pub(super) fn on_surfaces<T: Scalar, B: Bsdf<Color = T> + Send + Sync + 'static>(
    parameters: &str,
    model: impl Fn(Microfacets<T>) -> B,
) -> Vec<Case<T>> {
    surfaces::<T>()
        .into_iter()
        .map(|s| Case::new(format!("{}{parameters}", s.name), model(s.facets)).of_width(s.width))
        .collect()
}

/// The cases of [`on_surfaces`] with the formula that they stand for. Literal forms lose their digits
/// together with the width of the lobe: the narrowest surfaces go without.
pub(super) fn as_published<T: Scalar>(
    cases: Vec<Case<T>>,
    formula: impl Fn(Facets, [f64; 3], [f64; 3]) -> f64 + Copy + Send + Sync + 'static,
) -> impl Iterator<Item = Case<T>> {
    cases.into_iter().zip(surfaces::<T>()).map(move |(case, surface)| {
        let Surface { distribution, widths, masking, .. } = surface;
        if widths[0] < 1e-3 {
            return case;
        }
        let facets = Facets { distribution, widths, masking };
        case.textbook(move |wo, wi| formula(facets, wo, wi))
    })
}
