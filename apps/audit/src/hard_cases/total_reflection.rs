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
    sound: || sweep(|w, eta| disagree(w, eta) || misjudged(w, eta) || nothing_drawn(w, eta)),
    // Fresnel leaves something to transmit, but refraction finds no direction for it.
    naive: || sweep(|w, eta| dielectric(w.z, eta) < 1.0 && !passes_by_sine(w, eta)),
};

/// Seen from the denser side within 16 ulp of the critical cosine, and from the other within a hair of
/// grazing, `refract` finds a direction exactly where exact arithmetic says that light passes and
/// the reflectance is below 1, and every draw of the model has a direction: one without is lost
/// energy, a black pixel. None is tolerated.
fn sweep(lost: fn(Vec3, f32) -> bool) -> Outcome {
    let mut worst = Worst::default();
    let mut look = |c: f32, eta: f32| {
        let w = Vec3::new(((1.0 - c) * (1.0 + c)).sqrt(), 0.0, c);
        worst.observe(f64::from(u8::from(lost(w, eta))), || format!("η {eta:?}, cos {c:?}"));
    };
    for eta in decades(-1.0, -1e-4, 4000) {
        let mut c = ((1.0 - eta) * (1.0 + eta)).sqrt();
        for _ in 0..16 {
            c = c.next_down();
        }
        for _ in 0..=32 {
            look(c, eta);
            c = c.next_up();
        }
    }
    for eta in decades(1e-4, 1.0, 40) {
        for c in decades(-30.0, -2.0, 60) {
            look(c, eta);
        }
    }
    worst.within(0.0, "violations")
}

fn disagree(w: Vec3, eta: f32) -> bool {
    (dielectric(w.z, eta) == 1.0) != refract(w, eta).is_none()
}

/// The decision is not that of exact arithmetic: the products of two `f32` are exact in `f64`, and
/// their sum within 1e-15.
fn misjudged(w: Vec3, eta: f32) -> bool {
    let [c, eta64] = [w.z, eta].map(f64::from);
    let radicand = (eta64 * eta64 - 1.0) + c * c;
    radicand.abs() > 1e-14 && refract(w, eta).is_some() != (radicand > 0.0)
}

fn nothing_drawn(w: Vec3, eta: f32) -> bool {
    let Ok(eta) = Ior::new(eta) else { return true };
    let model = SmoothDielectric::<f32>::new(eta);
    [0.0, 0.5, 0.999, 1.0 - f32::EPSILON].iter().any(|&u| model.sample(w, u, [0.5; 2]).is_none())
}

fn passes_by_sine(w: Vec3, eta: f32) -> bool {
    (1.0 - w.z * w.z) / (eta * eta) < 1.0
}
