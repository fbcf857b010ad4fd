//! The albedo that EON compensates with, at grazing.

use etendue_brdf::{Roughness, fon};
use etendue_math::Real;

use super::{HardCase, decades};
use crate::measure::{Outcome, Worst};

/// `(S/μ)(1 − S³)` is 0/0 at μ = 0, and `1 − E` the difference of numbers that are equal there.
pub(super) const CASE: HardCase = HardCase {
    name: "EON albedo, μ → 0",
    function: "fon::albedo_deficit",
    problem: "(S/μ)(1 − S³) is 0/0 at μ = 0, and 1 − E cancels there",
    remedy: "S μ (1 + S + S²)/(1 + S), the deficit by itself",
    sound: || sweep(|mu| Roughness::new(1.0).map_or(f32::NAN, |r| fon::albedo_deficit(mu, r))),
    naive: || sweep(published),
};

/// `1 − E(μ)` for r = 1 in `f32`, relative; 8 ulp. At μ = 0 it is 0.
///
/// The reference is the power series in μ below 1/30, where the published form would cancel in `f64` too, and that form
/// above.
fn sweep(form: fn(f32) -> f32) -> Outcome {
    let mut worst = Worst::default();
    for mu in decades(-30.0, 0.0, 400).chain([0.0]) {
        let error = (f64::from(form(mu)) - exact(mu.into())).abs() / exact(mu.into()).max(1e-37);
        worst.observe(error, || format!("μ {mu:?}"));
    }
    worst.within(8.0 * f64::from(f32::EPSILON), "relative")
}

fn normal() -> f64 {
    1.0 / (1.5 - 2.0 / (3.0 * f64::PI))
}

fn exact(mu: f64) -> f64 {
    if mu >= 1.0 / 30.0 {
        return published64(mu);
    }
    // π/2 − 2/3 − G = μ + (π/4 − 1/3) μ² − 7/12 μ³ + (π/16 − 1/12) μ⁴ − 11/120 μ⁵ + …, to 2e-12
    let pi = f64::PI;
    let coefficients = [
        1.0,
        pi / 4.0 - 1.0 / 3.0,
        -7.0 / 12.0,
        pi / 16.0 - 1.0 / 12.0,
        -11.0 / 120.0,
        pi / 32.0 - 1.0 / 24.0,
        -337.0 / 6720.0,
    ];
    let series = coefficients.iter().rev().fold(0.0, |sum, c| c + mu * sum) * mu;
    normal() * series / f64::PI
}

/// The published form read literally.
macro_rules! literal {
    ($mu:expr, $float:ident) => {{
        let (mu, pi): ($float, $float) = ($mu, core::$float::consts::PI);
        let a = 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * pi)));
        let s = (1.0 - mu * mu).sqrt();
        let g = s * (Real::acos(mu) - s * mu) + 2.0 / 3.0 * ((s / mu) * (1.0 - s * s * s) - s);
        1.0 - a * (1.0 + g / pi)
    }};
}

fn published(mu: f32) -> f32 {
    literal!(mu, f32)
}

fn published64(mu: f64) -> f64 {
    literal!(mu, f64)
}
