//! The edge of total internal reflection.

use etendue_brdf::fresnel::{dielectric, refract};
use etendue_math::glam::Vec3;

use super::{HardCase, decades};
use crate::measure::{Outcome, Worst};

/// Fresnel and refraction that test different expressions disagree about whether a ray passes.
pub(super) const CASE: HardCase = HardCase {
    name: "critical angle ± ulps",
    function: "fresnel::refract",
    sound: || sweep(|w, eta| refract(w, eta).is_some()),
    naive: || sweep(by_sine),
};

/// Wherever Fresnel's F leaves something to transmit there must be a direction for it, or energy is
/// lost. (The converse is no error: just outside the edge F may round to 1.)
fn sweep(passes: fn(Vec3, f32) -> bool) -> Outcome {
    let mut worst = Worst::default();
    for eta in decades(-1.0, -1e-4, 400) {
        let mut c = ((1.0 - eta) * (1.0 + eta)).sqrt();
        for _ in 0..8 {
            c = c.next_down();
        }
        for _ in 0..16 {
            let w = Vec3::new(((1.0 - c) * (1.0 + c)).sqrt(), 0.0, c);
            let lost = dielectric(c, eta) < 1.0 && !passes(w, eta);
            worst.observe(f64::from(u8::from(lost)), || format!("η {eta:?}, cos {c:?}"));
            c = c.next_up();
        }
    }
    worst.within(0.0, "violations")
}

fn by_sine(w: Vec3, eta: f32) -> bool {
    (1.0 - w.z * w.z) / (eta * eta) < 1.0
}
