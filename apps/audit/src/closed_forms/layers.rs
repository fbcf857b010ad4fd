//! The reference of layered models.

use etendue_brdf::{
    Alpha, Bsdf, ComplexIor, InternalReflectance, InternalScattering, Ior, Lambert, Microfacets,
    Null, OpticalDepth, ParameterError, Plastic, PlasticInterface, Reflectance, RoughConductor,
    RoughDielectric, SmoothDielectric, StochasticLayers,
};
use etendue_math::{Real, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use super::ClosedForm;
use super::random::{ERRORS, Mean, numbers, paths};
use crate::budget::Budget;
use crate::generators::from_angles;
use crate::measure::{Outcome, Worst};
use crate::scalar::{Scalar, shared};

/// Clear glass over paint is plastic with non-linear scattering.
pub(super) const PLASTIC: ClosedForm = ClosedForm {
    function: "StochasticLayers",
    name: "glass over paint is plastic",
    single: |budget| judged(plastic::<f32>(budget)),
    double: |budget| judged(plastic::<f64>(budget)),
};

/// Under nothing but an absorbing medium the base is seen through it twice.
pub(super) const ABSORPTION: ClosedForm = ClosedForm {
    function: "StochasticLayers",
    name: "absorption is Beer's law",
    single: |budget| judged(absorption::<f32>(budget)),
    double: |budget| judged(absorption::<f64>(budget)),
};

/// Rough layers are reciprocal, and samples follow values.
pub(super) const ROUGH: ClosedForm = ClosedForm {
    function: "StochasticLayers",
    name: "rough layers",
    single: |budget| judged(rough::<f32>(budget)),
    double: |budget| judged(rough::<f64>(budget)),
};

fn judged(worst: Result<Worst, ParameterError>) -> Outcome {
    worst.unwrap_or_default().within(ERRORS, "standard errors")
}

/// Cosine and azimuth.
const WO: (f64, f64) = (0.8, 0.0);
const WI: (f64, f64) = (0.5, 1.9);

fn plastic<T: Scalar>(budget: Budget) -> Result<Worst, ParameterError> {
    let mut worst = Worst::default();
    let [wo, wi] = [WO, WI].map(|(z, phi)| from_angles::<T>(z, phi));
    let eta = Ior::new(shared::<T>(1.5))?;
    let interface = PlasticInterface::new(eta, InternalReflectance::Exact);
    for rho in [0.3, 1.0] {
        let paint = Reflectance::new(shared::<T>(rho))?;
        let glass = SmoothDielectric::<T>::new(eta);
        let layers = StochasticLayers::new(glass, Lambert::new(paint), OpticalDepth::clear());
        let model = Plastic::new(interface, paint, InternalScattering::NonLinear);
        let mut next = numbers::<T>(311);
        let value = Mean::of(paths(budget), || layers.eval(wo, wi, &mut next).to_f64());
        let energy = Mean::of(paths(budget), || {
            layers.sample(wo, &mut next).map_or(0.0, |(_, weight)| weight.to_f64())
        });
        let albedo = model.albedo(wo).map_or(f64::NAN, Real::to_f64);
        for (what, mean, want) in
            [("value", value, model.eval(wo, wi).to_f64()), ("albedo", energy, albedo)]
        {
            worst.observe(mean.deviation(want, 1e-5 * want), || {
                format!("{what}, ρ {rho}: {mean}, not {want}")
            });
        }
    }
    Ok(worst)
}

fn absorption<T: Scalar>(budget: Budget) -> Result<Worst, ParameterError> {
    let mut worst = Worst::default();
    let [wo, wi] = [WO, WI].map(|(z, phi)| from_angles::<T>(z, phi));
    let tau = 0.4;
    let paint = Lambert::new(Reflectance::new(T::HALF)?);
    let layers =
        StochasticLayers::new(Null::<T>::new(), paint, OpticalDepth::new(shared::<T>(tau))?);
    let mut next = numbers::<T>(312);
    let value = Mean::of(budget.draws, || layers.eval(wo, wi, &mut next).to_f64());
    let tau = shared::<f64>(tau);
    let want = 0.5 * f64::FRAC_1_PI * Real::exp(-tau / WO.0 - tau / WI.0);
    worst.observe(value.deviation(want, 1e-5 * want), || format!("{value}, not {want}"));
    // Paths go the same way back and forth: 2 ∫ ½ exp(−τ/o − τ/i) i di.
    let energy = Mean::of(paths(budget), || {
        layers.sample(wo, &mut next).map_or(0.0, |(_, weight)| weight.to_f64())
    });
    let passed = crate::cases::textbook::cosine_average(|c| Real::exp(-tau / c));
    let want = 0.5 * Real::exp(-tau / WO.0) * passed;
    worst.observe(energy.deviation(want, 1e-5), || format!("albedo {energy}, not {want}"));
    Ok(worst)
}

/// Widths of interface and base: either may be the one whose samples find the other's light.
const WIDTHS: [[f64; 2]; 2] = [[0.3, 0.5], [0.6, 0.15]];

fn rough<T: Scalar>(budget: Budget) -> Result<Worst, ParameterError> {
    let mut worst = Worst::default();
    let [wo, wi] = [WO, WI].map(|(z, phi)| from_angles::<T>(z, phi));
    for widths in WIDTHS {
        let [interface, base] = widths.map(|a| Microfacets::ggx(Alpha::clamped(shared::<T>(a))));
        let top = RoughDielectric::<T>::new(Ior::new(shared::<T>(1.5))?, interface)?;
        let metal = ComplexIor::new(shared::<T>(1.4), shared::<T>(1.6))?;
        let depth = OpticalDepth::new(shared::<T>(0.5))?;
        let layers = StochasticLayers::new(top, RoughConductor::new(metal, base), depth);
        let (mut next, paths) = (numbers::<T>(313), 4 * paths(budget));
        let there = Mean::of(paths, || layers.eval(wo, wi, &mut next).to_f64());
        let back = Mean::of(paths, || layers.eval(wi, wo, &mut next).to_f64());
        worst.observe(there.difference(back), || format!("α {widths:?}: {there}, back {back}"));
        // What goes into a half of the hemisphere, once by samples and once by values.
        let sampled = Mean::of(paths, || {
            let inside = layers.sample(wo, &mut next).filter(|(w, _)| w.x() < T::ZERO);
            inside.map_or(0.0, |(_, weight)| weight.to_f64())
        });
        let valued = Mean::of(paths, || {
            let w = cosine_hemisphere::from_square([next(), next()]);
            if w.x() < T::ZERO { f64::PI * layers.eval(wo, w, &mut next).to_f64() } else { 0.0 }
        });
        worst.observe(sampled.difference(valued), || {
            format!("α {widths:?}: samples {sampled}, values {valued}")
        });
    }
    Ok(worst)
}
