//! Thin slab near grazing, R → 1.

use etendue_brdf::{Bsdf, Density, Ior, ThinDielectric, fresnel};
use etendue_math::glam::Vec3;

use super::{HardCase, decades, relative};
use crate::measure::{Outcome, Worst};

const ETA: f32 = 1.5;

/// `R + T²R/(1 − R²)` divides one cancelled number by another.
pub(super) const CASE: HardCase = HardCase {
    name: "transmission near grazing",
    function: "ThinDielectric",
    problem: "1 − (R + T²R/(1 − R²)) divides one cancelled number by another",
    remedy: "(1 − R)/(1 + R)",
    sound: || sweep(transmitted),
    naive: || sweep(by_series),
};

/// Transmittance against `(1 − R)/(1 + R)` in `f64`, for the R of one face that `f32` has: what
/// rounding R costs is a matter of its own. Bound: 1e-6 relative.
fn sweep(form: fn(f32) -> f32) -> Outcome {
    let mut worst = Worst::default();
    for c in decades(-5.0, 0.0, 200) {
        let r = f64::from(fresnel::dielectric(c, ETA));
        let error = relative(form(c), (1.0 - r) / (1.0 + r));
        worst.observe(error, || format!("cos {c:?}"));
    }
    worst.within(1e-6, "relative")
}

fn transmitted(c: f32) -> f32 {
    let Ok(eta) = Ior::new(ETA) else { return f32::NAN };
    let wo = Vec3::new(((1.0 - c) * (1.0 + c)).sqrt(), 0.0, c);
    // The lobes share the unit interval: the straight one is at one of its ends.
    [0.0, 1.0 - f32::EPSILON]
        .into_iter()
        .filter_map(|u| ThinDielectric::<f32>::new(eta).sample(wo, u, [0.5; 2]))
        .find(|s| s.wi.z < 0.0)
        .map_or(f32::NAN, |s| match s.density {
            Density::Delta(p) => s.weight * p,
            Density::Continuous(_) => f32::NAN,
        })
}

fn by_series(c: f32) -> f32 {
    let r = fresnel::dielectric(c, ETA);
    let t = 1.0 - r;
    1.0 - (r + t * t * r / (1.0 - r * r))
}
