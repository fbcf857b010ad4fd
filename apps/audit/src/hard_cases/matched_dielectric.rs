//! A rough dielectric without an index: η = 1.

use etendue_brdf::{Bsdf, Density, Dielectric, Distribution, Ior, Masking, Microfacets};
use etendue_math::glam::Vec3;

use super::HardCase;
use crate::generators::{from_angles, uniforms};
use crate::measure::{Outcome, Worst};

/// For matched media the half vector of refraction `wo + η wi` of the straight direction is the zero vector:
/// the general code normalises it and gives NaN. The interface is a pass-through, chosen at construction.
pub(super) const CASE: HardCase = HardCase {
    name: "matched indices, rough",
    function: "Dielectric",
    problem: "wo + η wi is the zero vector for the straight direction: NaN",
    remedy: "the pass-through, chosen at construction",
    sound: || sweep(pass_through),
    naive: || sweep(by_half_vector),
};

/// Whatever the roughness, light goes straight on with weight 1. The figure is the deviation of
/// `|wi + wo|` or of the weight; none is allowed.
fn sweep(deviation: fn(Vec3, f32, [f32; 3]) -> f32) -> Outcome {
    let mut worst = Worst::default();
    for alpha in [0.0_f32, 1e-8, 1e-3, 0.3, 1.0] {
        for (i, z) in [1.0, 0.9, 0.5, 0.01, 1e-6, -0.01, -0.7, -1.0].into_iter().enumerate() {
            let wo = from_angles::<f32>(z, 0.7);
            for j in 0..50 {
                let u = uniforms::<f32>(601 + i as u64, j);
                let figure = f64::from(deviation(wo, alpha, u));
                worst.observe(figure, || format!("wo {wo:?}, α {alpha:?}, u {u:?}"));
            }
        }
    }
    worst.within(0.0, "deviation")
}

fn pass_through(wo: Vec3, alpha: f32, [u_lobe, a, b]: [f32; 3]) -> f32 {
    let Ok(eta) = Ior::new(1.0) else { return f32::NAN };
    let model =
        Dielectric::<f32>::new(eta, Distribution::Ggx, [alpha; 2], Masking::HeightCorrelated);
    let Some(sample) = model.ok().and_then(|m| m.sample(wo, u_lobe, [a, b])) else {
        return f32::NAN;
    };
    let certain = if sample.density == Density::Delta(1.0) { 0.0 } else { 1.0 };
    (sample.wi + wo).length() + (sample.weight - 1.0).abs() + (sample.eta - 1.0).abs() + certain
}

/// Refraction at a visible normal with the half vector recomputed from the pair, as evaluation must.
fn by_half_vector(wo: Vec3, alpha: f32, [_, a, b]: [f32; 3]) -> f32 {
    const ETA: f32 = 1.0;
    let Ok(alpha) = etendue_brdf::Alpha::new(alpha.max(1e-8)) else { return f32::NAN };
    let up = if wo.z < 0.0 { -wo } else { wo };
    let Some(h) = Microfacets::ggx(alpha).sample_visible_normal(up, [a, b]) else {
        return f32::NAN;
    };
    let cos = up.dot(h);
    let cos_t = (1.0 - (1.0 - cos * cos) / (ETA * ETA)).max(0.0).sqrt();
    let wi = h * (cos / ETA - cos_t) - up / ETA;
    let half = up + wi * ETA;
    (half / half.length()).dot(h).abs() - 1.0
}
