//! Vanishing roughness.

use etendue_brdf::{
    Bsdf, ComplexIor, Conductor, Density, Dielectric, Distribution, Ior, Masking, Sample,
    SmoothConductor, SmoothDielectric,
};
use etendue_math::glam::Vec3;

use super::HardCase;
use crate::generators::{from_angles, uniforms};
use crate::measure::{Outcome, Worst};

const GOLD: [f32; 2] = [0.143, 3.983];
const GLASS: f32 = 1.5;

/// Roughness 0 in the formula of a rough metal divides by α²: NaN, or black where somebody guarded the
/// division. It must be the mirror.
pub(super) const CONDUCTOR: HardCase = HardCase {
    name: "roughness 0 is the mirror",
    function: "Conductor",
    problem: "roughness 0 divides by α²: NaN, or black where that is guarded",
    remedy: "the mirror, chosen at construction",
    sound: || sweep(metal, mirror),
    naive: || sweep(|wo, _| rough_formula(wo), mirror),
};

/// The same for glass: reflection and refraction with their probabilities.
pub(super) const DIELECTRIC: HardCase = HardCase {
    name: "roughness 0 is smooth glass",
    function: "Dielectric",
    problem: "roughness 0 divides by α²: NaN, or black where that is guarded",
    remedy: "smooth glass, chosen at construction",
    sound: || sweep(glass, smooth_glass),
    naive: || sweep(|wo, _| rough_formula(wo), smooth_glass),
};

type Draw = fn(Vec3, [f32; 3]) -> Option<Sample<f32>>;

/// Every sample must have the bits of the delta model's, for the same uniforms.
fn sweep(limit: Draw, delta: Draw) -> Outcome {
    let mut worst = Worst::default();
    for (i, z) in [1.0, 0.9, 0.5, 0.1, 1e-3, 1e-6, -0.4].into_iter().enumerate() {
        let wo = from_angles::<f32>(z, 0.7);
        for j in 0..100 {
            let u = uniforms::<f32>(701 + i as u64, j);
            let (got, want) = (limit(wo, u), delta(wo, u));
            worst.observe(f64::from(u8::from(got != want)), || {
                format!("wo {wo:?}, u {u:?}: {got:?} instead of {want:?}")
            });
        }
    }
    worst.within(0.0, "differences")
}

fn metal(wo: Vec3, [lobe, a, b]: [f32; 3]) -> Option<Sample<f32>> {
    let index = ComplexIor::new(GOLD[0], GOLD[1]).ok()?;
    let model = Conductor::new(index, Distribution::Ggx, [0.0; 2], Masking::default()).ok()?;
    model.sample(wo, lobe, [a, b])
}

fn mirror(wo: Vec3, [lobe, a, b]: [f32; 3]) -> Option<Sample<f32>> {
    SmoothConductor::new(ComplexIor::new(GOLD[0], GOLD[1]).ok()?).sample(wo, lobe, [a, b])
}

fn glass(wo: Vec3, [lobe, a, b]: [f32; 3]) -> Option<Sample<f32>> {
    let eta = Ior::new(GLASS).ok()?;
    let model =
        Dielectric::<f32>::new(eta, Distribution::Ggx, [0.0; 2], Masking::default()).ok()?;
    model.sample(wo, lobe, [a, b])
}

fn smooth_glass(wo: Vec3, [lobe, a, b]: [f32; 3]) -> Option<Sample<f32>> {
    SmoothDielectric::<f32>::new(Ior::new(GLASS).ok()?).sample(wo, lobe, [a, b])
}

/// GGX at α = 0: the only visible normal is n, its density `α²/(π (…)²)` is 0/0.
fn rough_formula(wo: Vec3) -> Option<Sample<f32>> {
    let (alpha, cos_h) = (0.0_f32, 1.0_f32);
    let squared = alpha * alpha;
    let d = (cos_h * cos_h) * (squared - 1.0) + 1.0;
    let pdf = squared / (core::f32::consts::PI * d * d);
    // NaN fails this test, as it does in code that guards a division.
    (pdf > 0.0).then(|| Sample {
        wi: Vec3::new(-wo.x, -wo.y, wo.z),
        weight: 1.0,
        density: Density::Continuous(pdf),
        eta: 1.0,
    })
}
