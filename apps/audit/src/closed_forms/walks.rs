//! Random walks between facets.

use etendue_brdf::microfacet::facet_loss;
use etendue_brdf::microfacet::walk::{ConductorWalk, DielectricWalk, Walked};
use etendue_brdf::{
    Alpha, BeckmannLambda, Bsdf, ComplexIor, Distribution, Ior, Masking, Microfacets,
    ParameterError, RoughConductor, RoughDielectric,
};
use etendue_math::quadrature::gauss_legendre;
use etendue_math::{Real, Vec3, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use super::ClosedForm;
use super::random::{ERRORS, Mean, numbers, paths};
use crate::budget::Budget;
use crate::generators::from_angles;
use crate::measure::{Outcome, Worst};
use crate::scalar::{Scalar, shared, widen};

/// Between white facets nothing is lost, whatever the way.
pub(super) const FURNACE: ClosedForm = ClosedForm {
    function: "ConductorWalk",
    name: "white path by path",
    single: furnace::<f32>,
    double: furnace::<f64>,
};

/// Paths that leave after one facet carry the albedo of single scattering.
pub(super) const CONDUCTOR: ClosedForm = ClosedForm {
    function: "ConductorWalk",
    name: "first order is single scattering",
    single: conductor::<f32>,
    double: conductor::<f64>,
};

/// Values are reciprocal in the mean, of first order those of single scattering, and integrate to what the
/// paths carry.
pub(super) const VALUES: ClosedForm = ClosedForm {
    function: "ConductorWalk",
    name: "values",
    single: values::<f32>,
    double: values::<f64>,
};

/// All light leaves on one side or the other. What does after one facet is reflected as by the model of single
/// scattering, and refracted with joint masking of the two sides in place of its product form.
pub(super) const DIELECTRIC: ClosedForm = ClosedForm {
    function: "DielectricWalk",
    name: "first order is single scattering",
    single: dielectric::<f32>,
    double: dielectric::<f64>,
};

/// The étendue of what goes in is that of what comes out: of diffuse light on either side, with all orders of
/// scattering, the share transmitted downwards is η² times the share transmitted upwards.
pub(super) const ETENDUE: ClosedForm = ClosedForm {
    function: "DielectricWalk",
    name: "étendue",
    single: etendue::<f32>,
    double: etendue::<f64>,
};

const BECKMANN: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Exact };

fn facets<T: Scalar>(distribution: Distribution, alpha: f64) -> Microfacets<T> {
    let alpha = Alpha::clamped(shared::<T>(alpha));
    Microfacets::new(distribution, alpha, alpha, Masking::HeightCorrelated)
}

/// Bound: 4 ε per facet.
fn furnace<T: Scalar>(budget: Budget) -> Outcome {
    let mut worst = Worst::default();
    for distribution in [Distribution::Ggx, BECKMANN] {
        for (alpha, cos) in [(1.0, 1.0), (1.0, 0.05), (0.1, 0.3), (1e-3, 1e-2)] {
            let walk = ConductorWalk::<T>::new(ComplexIor::perfect(), facets(distribution, alpha));
            let (wo, mut next) = (from_angles::<T>(cos, 0.4), numbers(301));
            for _ in 0..budget.draws {
                let path = walk.sample(wo, &mut next);
                let error = path.map_or(f64::INFINITY, |p| {
                    let facets = f64::from(p.order.max(1)) * T::EPSILON.to_f64();
                    (p.weight.to_f64() - 1.0).abs() / facets
                });
                worst.observe(error, || format!("{distribution:?} α {alpha}, cos {cos}: {path:?}"));
            }
        }
    }
    worst.within(4.0, "ε per facet")
}

fn weight<T: Scalar>(path: Option<Walked<T>>) -> f64 {
    path.map_or(0.0, |path| path.weight.to_f64())
}

fn conductor<T: Scalar>(budget: Budget) -> Outcome {
    let mut worst = Worst::default();
    let paths = paths(budget);
    for distribution in [Distribution::Ggx, BECKMANN] {
        for (alpha, cos) in [(1.0, 1.0), (1.0, 0.2), (0.5, 0.6)] {
            let surface = facets::<T>(distribution, alpha);
            let walk = ConductorWalk::<T>::new(ComplexIor::perfect(), surface).with_max_order(1);
            let (wo, mut next) = (from_angles::<T>(cos, 0.4), numbers(302));
            let mean = Mean::of(paths, || weight(walk.sample(wo, &mut next)));
            let want = 1.0 - facet_loss(&facets::<f64>(distribution, alpha), cos);
            // α is shared, but the direction rounded, and the loss good to 1e-5.
            worst.observe(mean.deviation(want, 1e-5), || {
                format!("{distribution:?} α {alpha}, cos {cos}: {mean}, not {want}")
            });
        }
    }
    worst.within(ERRORS, "standard errors")
}

fn values<T: Scalar>(budget: Budget) -> Outcome {
    let mut worst = Worst::default();
    let paths = paths(budget);
    let gold = ComplexIor::clamped(shared::<T>(1.442), shared::<T>(1.603));
    let pairs = [((0.8, 0.0), (0.6, 2.5)), ((0.3, 0.0), (0.4, 3.0)), ((0.5, 0.0), (0.9, 0.7))];
    for (a, b) in pairs {
        let [wo, wi] = [a, b].map(|(z, phi)| from_angles::<T>(z, phi));
        for distribution in [Distribution::Ggx, BECKMANN] {
            let surface = facets::<T>(distribution, 0.7);
            let (walk, mut next) = (ConductorWalk::new(gold, surface), numbers(303));
            let first = walk.with_max_order(1);
            let mean = Mean::of(paths, || first.eval(wo, wi, &mut next).to_f64());
            let want = RoughConductor::new(gold, surface).eval(wo, wi).to_f64();
            worst.observe(mean.deviation(want, 1e-5 * want), || {
                format!("first order, wo {a:?}, wi {b:?}, {distribution:?}: {mean}, not {want}")
            });
            let there = Mean::of(paths, || walk.eval(wo, wi, &mut next).to_f64());
            let back = Mean::of(paths, || walk.eval(wi, wo, &mut next).to_f64());
            worst.observe(there.difference(back), || {
                format!("wo {a:?}, wi {b:?}, {distribution:?}: {there}, back {back}")
            });
        }
        // ∫ f cos dω with wi uniform in the hemisphere, and the energy of the paths: of gold, and where most
        // paths meet more than one facet.
        for (metal, alpha) in [(gold, 1.0), (ComplexIor::perfect(), 2.0)] {
            let walk = ConductorWalk::new(metal, facets(Distribution::Ggx, alpha));
            let mut next = numbers(304);
            let integral = Mean::of(2 * paths, || {
                let [z, phi] = [next(), next()].map(Real::to_f64);
                let wi = from_angles::<T>(z, 2.0 * f64::PI * phi);
                2.0 * f64::PI * z * walk.eval(wo, wi, &mut next).to_f64()
            });
            let energy = Mean::of(2 * paths, || weight(walk.sample(wo, &mut next)));
            worst.observe(integral.difference(energy), || {
                format!("wo {a:?}, α {alpha}: integral {integral}, paths {energy}")
            });
        }
    }
    worst.within(ERRORS, "standard errors")
}

fn dielectric<T: Scalar>(budget: Budget) -> Outcome {
    let mut worst = Worst::default();
    for (alpha, eta, cos) in
        [(1.0, 1.5, 0.7), (0.3, 1.5, -0.6), (0.6, 0.5, 0.9), (0.6, 2.4, -0.9), (1.0, 1.5, 0.1)]
    {
        let Ok(figures) = glass::<T>(alpha, eta, cos, budget) else {
            return worst.within(0.0, "");
        };
        for (what, figure) in figures {
            worst.observe(figure, || format!("{what}, α {alpha}, η {eta}, cos {cos}"));
        }
    }
    worst.within(ERRORS, "standard errors")
}

fn etendue<T: Scalar>(budget: Budget) -> Outcome {
    let mut worst = Worst::default();
    for (alpha, eta) in [(1.0, 1.5), (0.4, 2.4), (0.8, 0.6)] {
        let surface = facets::<T>(Distribution::Ggx, alpha);
        let walk = Ior::new(shared::<T>(eta)).and_then(|index| DielectricWalk::new(index, surface));
        let Ok(walk) = walk else { return worst.within(0.0, "") };
        let mut next = numbers::<T>(306);
        let mut across = |from_above: bool, scale: f64| {
            Mean::of(2 * paths(budget), || {
                let w = cosine_hemisphere::from_square([next(), next()]);
                let wo = if from_above { w } else { w.flip_z() };
                let path = walk.sample(wo, &mut next);
                if path.is_some_and(|p| p.wi.z() * wo.z() < T::ZERO) { scale } else { 0.0 }
            })
        };
        let eta = shared::<f64>(eta);
        let (down, up) = (across(true, 1.0), across(false, eta * eta));
        worst.observe(down.difference(up), || {
            format!("α {alpha}, η {eta}: downwards {down}, upwards η² · share {up}")
        });
    }
    worst.within(ERRORS, "standard errors")
}

/// What of a path is compared: the energy of both sides and where it goes on the far one.
const FIGURES: [&str; 4] = ["reflected", "transmitted", "tangent", "height"];

fn figures<T: Scalar>(wo_z: f64, wi: [f64; 3], weight: T, eta: T) -> [f64; 4] {
    let weight = weight.to_f64();
    if wi[2] * wo_z > 0.0 {
        [weight, 0.0, 0.0, 0.0]
    } else {
        let energy = weight * Real::sqr(eta.to_f64());
        [0.0, energy, energy * wi[0], energy * wi[2]]
    }
}

/// Masking across the surface, `B(1 + Λo, 1 + Λi)` (Heitz et al. 2016, eq. 26), over the `1/(1 + Λo + Λi)` of the
/// model, with Euler's integral `B(1 + x, 1 + y) = ∫ tˣ (1 − t)ʸ dt`.
fn masked_across<T: Scalar>(facets: &Microfacets<T>, wo: Vec3<T>, wi: Vec3<T>) -> f64 {
    let [x, y] = [wo, wi].map(|w| facets.lambda(w).to_f64());
    let integrand = |(s, weight): (f64, f64)| {
        // t = s² (3 − 2s): no infinite slope at either end.
        let t = s * s * (3.0 - 2.0 * s);
        weight * 6.0 * s * (1.0 - s) * Real::powf(t, x) * Real::powf(1.0 - t, y)
    };
    gauss_legendre::<f64, 16>().map(integrand).iter().sum::<f64>() * (1.0 + x + y)
}

fn glass<T: Scalar>(
    alpha: f64,
    eta: f64,
    cos: f64,
    budget: Budget,
) -> Result<[(&'static str, f64); 5], ParameterError> {
    let (eta, surface) = (Ior::new(shared::<T>(eta))?, facets::<T>(Distribution::Ggx, alpha));
    let walk = DielectricWalk::new(eta, surface)?;
    let single = RoughDielectric::<T>::new(eta, surface)?;
    let (wo, paths) = (from_angles::<T>(cos, 0.0), paths(budget));
    let (mut first, mut model) = ([Mean::default(); 4], [Mean::default(); 4]);
    let (mut lost, mut next) = (0.0_f64, numbers::<T>(305));
    for _ in 0..paths {
        // Refraction scales radiance by 1/η²; with that undone every path is white, unless rounding
        // has left it between the facets.
        let whole = walk.sample(wo, &mut next);
        let energy = whole.map_or(0.0, |p| (p.weight * p.eta * p.eta).to_f64());
        let across = whole.is_some_and(|p| (p.wi.z() * wo.z() < T::ZERO) != (p.eta == T::ONE));
        lost += if across { 0.0_f64.max(1.0 - energy) } else { 1.0 };
        let path = walk.with_max_order(1).sample(wo, &mut next);
        let of_path = path
            .filter(|p| p.order == 1)
            .map_or([0.0; 4], |p| figures(cos, widen::<T>(p.wi), p.weight, p.eta));
        let sample = single.sample(wo, next(), [next(), next()]);
        let of_sample = sample.map_or([0.0; 4], |s| {
            let across = s.wi.z() * wo.z() < T::ZERO;
            let masked = if across { masked_across(&surface, wo, s.wi) } else { 1.0 };
            figures(cos, widen::<T>(s.wi), s.weight, s.eta).map(|x| x * masked)
        });
        for k in 0..4 {
            first[k].add(of_path[k]);
            model[k].add(of_sample[k]);
        }
    }
    let difference = |k: usize| (FIGURES[k], first[k].difference(model[k]));
    // One path in ten thousand may be lost to rounding.
    let lost = ("of all paths", 1e4 * ERRORS * lost / paths as f64);
    Ok([difference(0), difference(1), difference(2), difference(3), lost])
}
