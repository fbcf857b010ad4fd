//! Transmittance of a rough interface between the nodes of its table.

use etendue_brdf::fresnel::{dielectric_transmittance, refract_about};
use etendue_brdf::{
    Alpha, Distribution, InternalReflectance, Ior, Masking, Microfacets, TransmittanceTable,
};
use etendue_math::glam::DVec3;

use super::HardCase;
use crate::measure::{Outcome, Worst};

const ETA: f64 = 1.5;
const ALPHA: f64 = 0.5;

/// A table read at its nearest node has steps, which show in smooth shading.
pub(super) const CASE: HardCase = HardCase {
    name: "between nodes",
    function: "TransmittanceTable",
    problem: "a table read at the node below is off by its slope times a step",
    remedy: "linear interpolation between the two nodes",
    sound: || sweep(|cos| cos),
    naive: || sweep(|cos| (cos * 63.0).floor() / 63.0),
};

/// The table in `f32` at a cosine that `look_up` makes of the true one, against the integral by 64 × 64
/// midpoints in the uniforms of the visible normals. Bound: 1e-3; the curvature of T is 4 at most from
/// cos θ = 0.1 on, which steps of 1/63 turn into 1.3e-4, and the midpoint rule has an edge to resolve.
fn sweep(look_up: fn(f64) -> f64) -> Outcome {
    let mut worst = Worst::default();
    let (Ok(eta), Ok(alpha)) = (Ior::new(ETA as f32), Alpha::new(ALPHA as f32)) else {
        return worst.within(0.0, "");
    };
    let masking = Masking::HeightCorrelated;
    let exact = InternalReflectance::Exact;
    let table = TransmittanceTable::new(eta, Distribution::Ggx, alpha, masking, exact);
    for i in 0..40 {
        let cos = 0.1 + 0.9 * (f64::from(i) + 0.5) / 40.0;
        let error = f64::from(table.transmittance(look_up(cos) as f32)) - transmitted(cos);
        worst.observe(error.abs(), || format!("cos {cos:?}"));
    }
    worst.within(1e-3, "of 1")
}

fn transmitted(cos: f64) -> f64 {
    const N: u32 = 64;
    let Ok(alpha) = Alpha::new(ALPHA) else { return f64::NAN };
    let facets = Microfacets::ggx(alpha);
    let wo = DVec3::new(((1.0 - cos) * (1.0 + cos)).sqrt(), 0.0, cos);
    let node = |i: u32| (f64::from(i) + 0.5) / f64::from(N);
    let value = |u: [f64; 2]| {
        let h = facets.sample_visible_normal(wo, u)?;
        let wt = refract_about(wo, h, ETA).filter(|w| w.z < 0.0)?;
        Some(dielectric_transmittance(wo.dot(h), ETA) * facets.weight(wo, wt))
    };
    let sum: f64 = (0..N * N).map(|i| value([node(i / N), node(i % N)]).unwrap_or(0.0)).sum();
    sum / f64::from(N * N)
}
