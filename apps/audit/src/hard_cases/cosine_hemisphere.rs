//! Cosine-weighted directions near the horizon.

use etendue_math::{Real, glam::Vec3};
use etendue_sampling::warp::cosine_hemisphere;

use super::{HardCase, decades, relative};
use crate::measure::{Outcome, Worst};

/// `√(1 − x² − y²)` of rounded coordinates is all rounding near the horizon.
pub(super) const CASE: HardCase = HardCase {
    name: "near the horizon",
    function: "cosine_hemisphere",
    problem: "√(1 − x² − y²) of rounded coordinates is rounding alone at the horizon",
    remedy: "1 − r² from the uniforms, where it is exact, before the root",
    sound: || sweep(cosine_hemisphere::from_square::<f32>),
    naive: || sweep(lifted_from_disk),
};

/// Cosines in `f32` against `f64` for the same uniforms, 1e-6 relative. The rim of the square, of
/// both its sides, is the horizon.
fn sweep(form: fn([f32; 2]) -> Vec3) -> Outcome {
    let mut worst = Worst::default();
    for d in decades(-6.0, -0.5, 100) {
        for along in [0.1_f32, 0.45, 0.7] {
            for u in [[d, along], [1.0 - d, along], [along, d], [along, 1.0 - d]] {
                let want = cosine_hemisphere::from_square::<f64>(u.map(f64::from)).z;
                worst.observe(relative(form(u).z, want), || format!("u {u:?}"));
            }
        }
    }
    worst.within(1e-6, "relative")
}

fn lifted_from_disk(u: [f32; 2]) -> Vec3 {
    let (a, b) = (2.0 * u[0] - 1.0, 2.0 * u[1] - 1.0);
    if a == 0.0 && b == 0.0 {
        return Vec3::Z;
    }
    let quarter = 0.25 * f32::PI;
    let (r, phi) =
        if a.abs() > b.abs() { (a, quarter * b / a) } else { (b, 2.0 * quarter - quarter * a / b) };
    let (sin, cos) = Real::sin_cos(phi);
    let (x, y) = (r * cos, r * sin);
    Vec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt())
}
