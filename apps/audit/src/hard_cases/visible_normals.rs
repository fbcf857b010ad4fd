//! Visible normals seen from a grazing direction.

use etendue_brdf::microfacet::ggx;
use etendue_math::{Real, glam::Vec3};

use super::{HardCase, decades};
use crate::generators::uniforms;
use crate::measure::{Outcome, Worst};

/// The sine of the cap from `1 − z²` cancels where the cap's edge is near a pole.
pub(super) const CASE: HardCase = HardCase {
    name: "grazing visible normals",
    function: "ggx::sample_visible_normal",
    problem: "√(1 − z²) of the spherical cap cancels near its poles",
    remedy: "t = u (1 + Vz), sin² = t (2 − t)",
    sound: || sweep(|wo, a, u| ggx::sample_visible_normal::<f32>(wo, a, a, u)),
    naive: || sweep(|wo, a, u| Some(cap_from_cosine(wo, a, u))),
};

/// Normals in `f32` against `f64` for the same numbers, on the scale of α and the normal's own
/// slope. Bound: 2e-5; the small square roots of numbers close to 1 magnify rounding a hundredfold.
fn sweep(form: fn(Vec3, f32, [f32; 2]) -> Option<Vec3>) -> Outcome {
    let mut worst = Worst::default();
    for alpha in decades(-4.0, 0.0, 9) {
        for (i, z) in decades(-7.0, 0.0, 40).enumerate() {
            for j in 0..50 {
                let [a, b, _] = uniforms::<f32>(91 + i as u64, j);
                // Half of the points crowd at the edge u → 0 of the cap.
                let u = [a, if j % 2 == 0 { b } else { b * 1e-6 }];
                let wo = Vec3::new(((1.0 - z) * (1.0 + z)).sqrt(), 0.0, z);
                let wide = f64::from(alpha);
                let exact =
                    ggx::sample_visible_normal::<f64>(wo.as_dvec3(), wide, wide, u.map(f64::from));
                let error = match (form(wo, alpha, u), exact) {
                    (Some(h), Some(e)) => {
                        (h.as_dvec3() - e).truncate().length() / (wide + e.truncate().length())
                    }
                    _ => f64::INFINITY,
                };
                worst.observe(error, || format!("wo {wo:?}, α {alpha:?}, u {u:?}"));
            }
        }
    }
    worst.within(2e-5, "relative")
}

fn cap_from_cosine(wo: Vec3, alpha: f32, u: [f32; 2]) -> Vec3 {
    let v = Vec3::new(alpha * wo.x, alpha * wo.y, wo.z).normalize();
    let z = (1.0 - u[1]) * (1.0 + v.z) - v.z;
    let (sin_phi, cos_phi) = Real::sin_cos(2.0 * f32::PI * u[0]);
    let r = (1.0 - z * z).max(0.0).sqrt();
    let h = Vec3::new(r * cos_phi, r * sin_phi, z) + v;
    Vec3::new(alpha * h.x, alpha * h.y, h.z.max(0.0)).normalize()
}
