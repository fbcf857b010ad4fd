//! The energy balance of coupled matte and specular reflection.

use etendue_brdf::fresnel::{dielectric, f0_from_ior};
use etendue_brdf::{Coupled, CoupledInterface, Ior, MirrorOverMatte, Reflectance};
use etendue_math::quadrature::gauss_legendre;

use super::{HardCase, decades};
use crate::measure::{Outcome, Worst};

/// A mirror by the exact Fresnel term over a matte term normalised for Schlick's approximation gains up to
/// 2.3 % of energy: one F must stand in both shares.
pub(super) const CASE: HardCase = HardCase {
    name: "mirror and matte sum to 1",
    function: "Coupled",
    problem: "exact Fresnel in the mirror over a matte term for Schlick's gains up to 2.3 % of energy",
    remedy: "one F in both shares, k = 1/(π (1 − F_avg))",
    sound: || sweep(|eta, c| [exact(eta, c), schlick(eta, c)]),
    naive: || sweep(|eta, c| [mixed(eta, c); 2]),
};

/// `F(θ) + ∫ matte cos θi dωi = 1` for a white base, at every angle and index. Bound: 2e-6, the rounding of the
/// `f32` values summed by 96 Gauss–Legendre nodes in `cos θ = t²`.
fn sweep(sums: fn(f32, f32) -> [f64; 2]) -> Outcome {
    let mut worst = Worst::default();
    for eta in [1.0, 1.000_001, 1.1, 1.5, 2.4, 10.0, 1e3] {
        for c in decades(-6.0, 0.0, 50) {
            for sum in sums(eta, c) {
                worst.observe((sum - 1.0).abs(), || format!("η {eta:?}, cos {c:?}"));
            }
        }
    }
    worst.within(2e-6, "of 1")
}

fn exact(eta: f32, c: f32) -> f64 {
    let interface = Ior::new(eta).and_then(CoupledInterface::dielectric);
    let model = interface.map(|i| Coupled::<f32>::new(i, Reflectance::white()));
    model.map_or(f64::NAN, |m| f64::from(m.mirror(c)) + matte(&m, c))
}

fn white_schlick(eta: f32) -> Coupled<f32> {
    let r0 = Reflectance::clamped(f0_from_ior(eta));
    Coupled::new(CoupledInterface::schlick(r0), Reflectance::white())
}

fn schlick(eta: f32, c: f32) -> f64 {
    let model = white_schlick(eta);
    f64::from(model.mirror(c)) + matte(&model, c)
}

fn mixed(eta: f32, c: f32) -> f64 {
    f64::from(dielectric(c, eta)) + matte(&white_schlick(eta), c)
}

fn matte(model: &Coupled<f32>, c: f32) -> f64 {
    gauss_legendre::<f64, 96>()
        .iter()
        .map(|&(t, w)| (t * t, w * 4.0 * core::f64::consts::PI * t * t * t))
        .map(|(cos, weight)| weight * f64::from(model.matte(c, cos as f32)))
        .sum()
}
