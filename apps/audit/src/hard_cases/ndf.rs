//! Facet distributions, small α.

use etendue_brdf::microfacet::{beckmann, ggx};
use etendue_math::{Real, glam::Vec3};

use super::{HardCase, decades, relative};
use crate::measure::{Outcome, Worst};

/// In terms of the cosine alone `1 + (α² − 1) cos²` cancels: 12 % at α = 1e-3, infinite at 1e-4.
pub(super) const GGX: HardCase = HardCase {
    name: "ggx, small α",
    function: "ggx::ndf",
    problem: "1 + (α² − 1) cos² of a rounded cosine: 12 % off at α = 1e-3, a division by 0 at 1e-4",
    remedy: "(hx/αx)² + (hy/αy)² + hz² of the half vector",
    sound: || sweep(|h, a| ggx::ndf(h, a, a), ggx_exact, 1e-6),
    naive: || sweep(ggx_of_cosine, ggx_exact, 1e-6),
};

/// `tan² = (1 − cos²)/cos²` of a rounded cosine has lost the tangent altogether.
pub(super) const BECKMANN: HardCase = HardCase {
    name: "beckmann, small α",
    function: "beckmann::ndf",
    problem: "tan² = (1 − cos²)/cos² of a rounded cosine has no digit left",
    remedy: "(hx/αx)² + (hy/αy)² over hz² of the half vector",
    sound: || sweep(|h, a| beckmann::ndf(h, a, a), beckmann_exact, 4e-6),
    naive: || sweep(beckmann_of_cosine, beckmann_exact, 4e-6),
};

/// Half vectors at up to four widths from the normal.
///
/// Bounds: some eight ulp for GGX, a rational function; for Beckmann the exponent, up to 16,
/// multiplies the rounding of its argument.
fn sweep(form: fn(Vec3, f32) -> f32, exact: fn([f64; 3], f64) -> f64, bound: f64) -> Outcome {
    let mut worst = Worst::default();
    for alpha in decades(-7.9, -0.1, 60) {
        for widths in decades(-3.0, 0.6, 40) {
            let slope = f64::from(alpha * widths);
            let z = 1.0 / (1.0 + slope * slope).sqrt();
            let (sin, cos) = Real::sin_cos(0.9);
            let h = Vec3::new((slope * z * cos) as f32, (slope * z * sin) as f32, z as f32);
            let want = exact([h.x.into(), h.y.into(), h.z.into()], alpha.into());
            worst.observe(relative(form(h, alpha), want), || format!("α {alpha:?}, h {h:?}"));
        }
    }
    worst.within(bound, "relative")
}

fn ggx_exact([x, y, z]: [f64; 3], alpha: f64) -> f64 {
    let cos2 = z * z;
    let t = 1.0 + (x * x + y * y) / cos2 / (alpha * alpha);
    1.0 / (f64::PI * alpha * alpha * cos2 * cos2 * t * t)
}

fn ggx_of_cosine(h: Vec3, alpha: f32) -> f32 {
    let a2 = alpha * alpha;
    let d = 1.0 + (a2 - 1.0) * h.z * h.z;
    a2 / (f32::PI * d * d)
}

fn beckmann_exact([x, y, z]: [f64; 3], alpha: f64) -> f64 {
    let (a2, cos2) = (alpha * alpha, z * z);
    Real::exp(-(x * x + y * y) / cos2 / a2) / (f64::PI * a2 * cos2 * cos2)
}

fn beckmann_of_cosine(h: Vec3, alpha: f32) -> f32 {
    let (a2, cos2) = (alpha * alpha, h.z * h.z);
    Real::exp((cos2 - 1.0) / (cos2 * a2)) / (f32::PI * a2 * cos2 * cos2)
}
