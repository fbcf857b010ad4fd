//! What single scattering loses: the integral and its table.

use etendue_brdf::microfacet::{FacetLoss, facet_loss};
use etendue_brdf::{Alpha, BeckmannLambda, Distribution, Masking, Microfacets};
use etendue_math::quadrature::gauss_legendre;
use etendue_math::{Real, Vec3, Vector3};

use super::ClosedForm;
use crate::budget::Budget;
use crate::generators::from_angles;
use crate::measure::{Outcome, Worst};
use crate::scalar::{Scalar, shared};

/// The mean weight of visible normals, and `ln 2` where that is known.
pub(super) const INTEGRAL: ClosedForm = ClosedForm {
    function: "microfacet::facet_loss",
    name: "what samples lose",
    single: integral::<f32>,
    double: integral::<f64>,
};

/// The table at and between its nodes.
pub(super) const TABLE: ClosedForm = ClosedForm {
    function: "microfacet::FacetLoss",
    name: "is the integral",
    single: table::<f32>,
    double: table::<f64>,
};

/// `2 ∫ l(μ) μ dμ`.
pub(super) const AVERAGE: ClosedForm = ClosedForm {
    function: "microfacet::FacetLoss",
    name: "average is the integral",
    single: average::<f32>,
    double: average::<f64>,
};

const BECKMANN: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Exact };
const SURFACES: [(Distribution, Masking, f64); 3] = [
    (Distribution::Ggx, Masking::HeightCorrelated, 1e-3),
    (Distribution::Ggx, Masking::Separable, 1e-3),
    (BECKMANN, Masking::HeightCorrelated, 4e-3),
];
const WIDTHS: [f64; 5] = [0.03, 0.17, 0.47, 0.8, 1.0];
const COSINES: [f64; 6] = [1.0, 0.83, 0.5, 0.21, 0.06, 0.01];

fn facets<T: Scalar>(distribution: Distribution, masking: Masking, alpha: f64) -> Microfacets<T> {
    let alpha = Alpha::clamped(shared::<T>(alpha));
    Microfacets::new(distribution, alpha, alpha, masking)
}

/// Bound: 2e-3; 128 × 128 midpoints in the uniforms have the horizon to resolve.
fn integral<T: Scalar>(_: Budget) -> Outcome {
    const SIDE: u32 = 128;
    let mut worst = Worst::default();
    let node = |i: u32| T::lit((f64::from(i) + 0.5) / f64::from(SIDE));
    for (distribution, masking, _) in SURFACES {
        for (alpha, cos) in [(0.3, 0.6), (0.7, 0.2), (1.0, 0.9)] {
            let surface = facets::<T>(distribution, masking, alpha);
            let wo: Vec3<T> = from_angles::<T>(cos, 0.4);
            let value = |u| {
                let h: Vec3<T> = surface.sample_visible_normal(wo, u)?;
                let wi = h * (T::TWO * wo.dot(h)) - wo;
                (wi.z() > T::ZERO).then(|| surface.weight(wo, wi).to_f64())
            };
            let nodes = (0..SIDE * SIDE).map(|i| [node(i / SIDE), node(i % SIDE)]);
            let sum: f64 = nodes.map(|u| value(u).unwrap_or(0.0)).sum();
            let want = 1.0 - sum / f64::from(SIDE * SIDE);
            let error = facet_loss(&surface, T::lit(cos)).to_f64() - want;
            worst.observe(error.abs(), || format!("{distribution:?} α {alpha}, cos {cos}: {want}"));
        }
    }
    let widest = facets::<T>(Distribution::Ggx, Masking::HeightCorrelated, 1.0);
    let error = facet_loss(&widest, T::ONE).to_f64() - core::f64::consts::LN_2;
    worst.observe(error.abs(), || "GGX α 1, normal incidence: ln 2".to_owned());
    worst.within(2e-3, "of 1")
}

/// Bound: what the table promises, 1e-3 for GGX and 4e-3 for Beckmann facets, as shares of it.
fn table<T: Scalar>(_: Budget) -> Outcome {
    let mut worst = Worst::default();
    for (distribution, masking, promised) in SURFACES {
        for alpha in WIDTHS {
            let exact = facets::<f64>(distribution, masking, alpha);
            let Ok(loss) = FacetLoss::new(&facets::<T>(distribution, masking, alpha)) else {
                return worst.within(0.0, "");
            };
            for cos in COSINES.map(shared::<T>) {
                let error = loss.at(cos).to_f64() - facet_loss(&exact, cos.to_f64());
                worst.observe(error.abs() / promised, || {
                    format!("{distribution:?}, {masking:?}, α {alpha}, cos {cos:?}")
                });
            }
        }
    }
    worst.within(1.0, "of the promised bound")
}

/// Bound: 1e-2 relative, linear interpolation of the average between its 64 widths; by panels that shrink
/// towards grazing, where the loss lives for small α.
fn average<T: Scalar>(_: Budget) -> Outcome {
    let mut worst = Worst::default();
    for (distribution, masking, _) in SURFACES {
        for alpha in WIDTHS {
            let Ok(loss) = FacetLoss::new(&facets::<T>(distribution, masking, alpha)) else {
                return worst.within(0.0, "");
            };
            let mut sum = 0.0;
            for k in 0..30 {
                let [start, end] = [k + 1, k].map(|k| Real::powf(0.7, f64::from(k)));
                for (t, weight) in gauss_legendre::<f64, 16>() {
                    let mu = start + (end - start) * t;
                    sum += weight * (end - start) * 2.0 * mu * loss.at(T::lit(mu)).to_f64();
                }
            }
            let error = (loss.average().to_f64() / sum - 1.0).abs();
            worst.observe(error, || format!("{distribution:?}, {masking:?}, α {alpha}: {sum}"));
        }
    }
    worst.within(1e-2, "relative")
}
