//! The edge of total internal reflection.

use etendue_brdf::fresnel::{dielectric, refract};
use etendue_brdf::{Bsdf, Ior, SmoothDielectric};
use etendue_math::glam::Vec3;

use super::{HardCase, decades};
use crate::measure::{Outcome, Worst};

/// Fresnel and refraction that test different expressions disagree about whether a ray passes.
pub(super) const CASE: HardCase = HardCase {
    name: "critical angle ± ulps",
    function: "fresnel::refract",
    problem: "reflectance and refraction disagree about whether light passes: samples are lost",
    remedy: "one radicand, in twice the precision near 0, decides for both",
    sound: || sweep(|w, eta| disagree(w, eta) || nothing_drawn(w, eta)),
    // Fresnel leaves something to transmit, but refraction finds no direction for it.
    naive: || sweep(|w, eta| dielectric(w.z, eta) < 1.0 && !passes_by_sine(w, eta)),
};

/// Seen from the denser side within 16 ulp of the critical cosine, `refract` finds no direction
/// exactly where the reflectance is 1, and every draw of the model has a direction: one without is
/// lost energy, a black pixel. None is tolerated.
fn sweep(lost: fn(Vec3, f32) -> bool) -> Outcome {
    let mut worst = Worst::default();
    for eta in decades(-1.0, -1e-4, 4000) {
        let mut c = ((1.0 - eta) * (1.0 + eta)).sqrt();
        for _ in 0..16 {
            c = c.next_down();
        }
        for _ in 0..=32 {
            let w = Vec3::new(((1.0 - c) * (1.0 + c)).sqrt(), 0.0, c);
            worst.observe(f64::from(u8::from(lost(w, eta))), || format!("η {eta:?}, cos {c:?}"));
            c = c.next_up();
        }
    }
    worst.within(0.0, "violations")
}

fn disagree(w: Vec3, eta: f32) -> bool {
    (dielectric(w.z, eta) == 1.0) != refract(w, eta).is_none()
}

fn nothing_drawn(w: Vec3, eta: f32) -> bool {
    let Ok(eta) = Ior::new(eta) else { return true };
    let model = SmoothDielectric::<f32>::new(eta);
    [0.0, 0.5, 0.999, 1.0 - f32::EPSILON].iter().any(|&u| model.sample(w, u, [0.5; 2]).is_none())
}

fn passes_by_sine(w: Vec3, eta: f32) -> bool {
    (1.0 - w.z * w.z) / (eta * eta) < 1.0
}
