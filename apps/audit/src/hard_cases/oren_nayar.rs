//! Full Oren–Nayar at double grazing and at normal incidence.

use etendue_brdf::{Bsdf, OrenNayar, Reflectance, Sigma};
use etendue_math::{Real, glam::Vec3};

use super::{HardCase, decades};
use crate::generators::from_angles;
use crate::measure::{Outcome, Worst};

const SIGMA: f32 = 0.75;

/// Angles by acos and their tangents lose every digit at grazing; the azimuth of a direction along
/// the normal is 0/0.
pub(super) const CASE: HardCase = HardCase {
    name: "grazing and normal pairs",
    function: "OrenNayar",
    problem: "angles by acos lose their digits at grazing, the azimuth of the normal is 0/0",
    remedy: "tan β = sin β/cos β, tan((α + β)/2) = (sin α + sin β)/(cos α + cos β), angles from the smaller of sine and cosine",
    sound: || sweep(stable),
    naive: || sweep(|wo, wi| textbook(wo, wi, SIGMA)),
};

/// Bound: 3e-6 relative to the larger of f and 1/π. Where light and viewer graze on opposite sides
/// terms of the size of 1/π cancel, and the value is bounded by them, not by itself.
fn sweep(form: fn(Vec3, Vec3) -> f32) -> Outcome {
    let mut worst = Worst::default();
    let cosines: Vec<f32> = decades(-5.0, 0.0, 21).collect();
    for &z in &cosines {
        for &other in &cosines {
            for azimuth in [0.0, 0.5, 1.6, 2.5, f64::PI] {
                let wo = from_angles::<f32>(z.into(), 0.4);
                let wi = from_angles::<f32>(other.into(), 0.4 + azimuth);
                let want = textbook64(wo, wi);
                let error = (f64::from(form(wo, wi)) - want).abs() / want.max(f64::FRAC_1_PI);
                worst.observe(error, || format!("wo {wo:?}, wi {wi:?}"));
            }
        }
    }
    worst.within(3e-6, "relative")
}

fn stable(wo: Vec3, wi: Vec3) -> f32 {
    let Ok(sigma) = Sigma::new(SIGMA) else { return f32::NAN };
    OrenNayar::new(Reflectance::<f32>::white(), sigma).eval(wo, wi)
}

/// The published formula read literally, ρ = 1.
macro_rules! textbook {
    ($wo:expr, $wi:expr, $sigma:expr, $float:ident, $limit:expr) => {{
        let (wo, wi, s2) = ($wo, $wi, $sigma * $sigma);
        let pi = core::$float::consts::PI;
        let (ti, to) = (Real::acos(wi.z), Real::acos(wo.z));
        let (alpha, beta) = (ti.max(to), ti.min(to));
        let (a, b) = (wi.truncate().normalize(), wo.truncate().normalize());
        let cos_phi: $float = $limit(a.dot(b));
        let c1 = 1.0 - 0.5 * s2 / (s2 + 0.33);
        let lift = if cos_phi >= 0.0 { 0.0 } else { Real::powi(2.0 * beta / pi, 3) };
        let c2 = 0.45 * s2 / (s2 + 0.09) * (Real::sin(alpha) - lift);
        let c3 = 0.125 * s2 / (s2 + 0.09) * Real::powi(4.0 * alpha * beta / (pi * pi), 2);
        let c4 = 0.17 * s2 / (s2 + 0.13);
        let f1 = c1
            + c2 * cos_phi * Real::tan(beta)
            + c3 * (1.0 - cos_phi.abs()) * Real::tan(0.5 * (alpha + beta));
        let f2 = c4 * (1.0 - cos_phi * Real::powi(2.0 * beta / pi, 2));
        ((f1 + f2) / pi).max(0.0)
    }};
}

fn textbook(wo: Vec3, wi: Vec3, sigma: f32) -> f32 {
    let literal: f32 = textbook!(wo, wi, sigma, f32, |x| x);
    // `max` would turn NaN into 0: along the normal there is nothing to normalise.
    if wo.truncate().length() == 0.0 || wi.truncate().length() == 0.0 { f32::NAN } else { literal }
}

/// In `f64` the literal form keeps ten digits at these angles; along the normal the azimuth, which
/// is then without effect, is put to 0.
fn textbook64(wo: Vec3, wi: Vec3) -> f64 {
    let unit = |w: Vec3| w.as_dvec3().normalize();
    textbook!(unit(wo), unit(wi), f64::from(SIGMA), f64, |x: f64| if x.is_nan() {
        0.0
    } else {
        Real::clamp_to(x, -1.0, 1.0)
    })
}
