//! Visible normals seen from a grazing direction.

use etendue_brdf::microfacet::ggx;
use etendue_math::Real;
use etendue_math::glam::{DVec3, Vec3};

use super::{HardCase, decades};
use crate::generators::uniforms;
use crate::measure::{Outcome, Worst};

/// The sine of the cap from `1 − z²` cancels where the cap's edge is near a pole.
pub(super) const CAP: HardCase = HardCase {
    name: "grazing visible normals",
    function: "ggx::sample_visible_normal",
    problem: "√(1 − z²) of the spherical cap cancels near its poles",
    remedy: "t = u (1 + Vz), sin² = t (2 − t)",
    sound: || sweep(ggx::sample_visible_normal::<f32>, ggx::sample_visible_normal::<f64>),
    naive: || sweep(cap_from_cosine, ggx::sample_visible_normal::<f64>),
};

/// `√(1 − t₁² − t₂²)` cancels at the rim of the disk, and the height of the normal with it.
pub(super) const DISK: HardCase = HardCase {
    name: "grazing visible normals, projected disk",
    function: "ggx::sample_visible_normal_by_disk",
    problem: "√(1 − t₁² − t₂²) cancels at the rim of the disk, and the height of the normal with it",
    remedy: "the distance to the rim from the uniforms, products in place of differences",
    sound: || {
        sweep(ggx::sample_visible_normal_by_disk::<f32>, ggx::sample_visible_normal_by_disk::<f64>)
    },
    naive: || sweep(disk_as_printed, ggx::sample_visible_normal_by_disk::<f64>),
};

/// `z = (1 − u)(1 + b) − b` and `√(1 − z²)` cancel as in the plain cap, and `vz + z` at the pole.
pub(super) const BOUNDED_CAP: HardCase = HardCase {
    name: "grazing visible normals, bounded cap",
    function: "ggx::sample_bounded_normal",
    problem: "(1 − u)(1 + b) − b and √(1 − z²) cancel as in the plain cap, and vz + z at the pole",
    remedy: "t = u (1 + b), sin² = t (2 − t), sums of what is not negative",
    sound: || sweep(ggx::sample_bounded_normal::<f32>, ggx::sample_bounded_normal::<f64>),
    naive: || sweep(bounded_cap_as_printed, ggx::sample_bounded_normal::<f64>),
};

type Sampler<V, T> = fn(V, T, T, [T; 2]) -> Option<V>;

/// Normals in `f32` against `f64` for the same numbers, on the scale of α and the normal's own
/// slope. Bound: 2e-5; the small square roots of numbers close to 1 magnify rounding a hundredfold.
fn sweep(form: Sampler<Vec3, f32>, reference: Sampler<DVec3, f64>) -> Outcome {
    let mut worst = Worst::default();
    for alpha in decades(-8.0, 0.0, 17) {
        for (i, z) in decades(-7.0, 0.0, 40).enumerate() {
            for j in 0..50 {
                let [a, b, _] = uniforms::<f32>(91 + i as u64, j);
                // Half of the points crowd at the edge u → 0 of the cap.
                let u = [a, if j % 2 == 0 { b } else { b * 1e-6 }];
                let wo = Vec3::new(((1.0 - z) * (1.0 + z)).sqrt(), 0.0, z);
                let wide = f64::from(alpha);
                let exact = reference(wo.as_dvec3(), wide, wide, u.map(f64::from));
                let error = match (form(wo, alpha, alpha, u), exact) {
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

fn cap_from_cosine(wo: Vec3, x: f32, y: f32, u: [f32; 2]) -> Option<Vec3> {
    let v = Vec3::new(x * wo.x, y * wo.y, wo.z).normalize();
    cap_above(v, v.z, x, y, u)
}

fn bounded_cap_as_printed(wo: Vec3, x: f32, y: f32, u: [f32; 2]) -> Option<Vec3> {
    let v = Vec3::new(x * wo.x, y * wo.y, wo.z).normalize();
    let a = x.min(y).min(1.0);
    let s = 1.0 + wo.truncate().length();
    let k = (1.0 - a * a) * s * s / (s * s + a * a * wo.z * wo.z);
    cap_above(v, k * v.z, x, y, u)
}

/// The cap of directions above `−b`, with its sine from its cosine.
fn cap_above(v: Vec3, b: f32, x: f32, y: f32, u: [f32; 2]) -> Option<Vec3> {
    let z = (1.0 - u[1]) * (1.0 + b) - b;
    let (sin_phi, cos_phi) = Real::sin_cos(2.0 * f32::PI * u[0]);
    let r = (1.0 - z * z).max(0.0).sqrt();
    let h = Vec3::new(r * cos_phi, r * sin_phi, z) + v;
    Vec3::new(x * h.x, y * h.y, h.z.max(0.0)).try_normalize()
}

/// Listing 1 of Heitz 2018.
fn disk_as_printed(wo: Vec3, x: f32, y: f32, u: [f32; 2]) -> Option<Vec3> {
    let v = Vec3::new(x * wo.x, y * wo.y, wo.z).normalize();
    let l2 = v.x * v.x + v.y * v.y;
    let t1_axis = if l2 > 0.0 { Vec3::new(-v.y, v.x, 0.0) / l2.sqrt() } else { Vec3::Y };
    let t2_axis = v.cross(t1_axis);
    let (sin_phi, cos_phi) = Real::sin_cos(2.0 * f32::PI * u[0]);
    let (t1, t2) = (u[1].sqrt() * cos_phi, u[1].sqrt() * sin_phi);
    let s = 0.5 * (1.0 + v.z);
    let t2 = (1.0 - s) * (1.0 - t1 * t1).sqrt() + s * t2;
    let n = t1_axis * t1 + t2_axis * t2 + v * (1.0 - t1 * t1 - t2 * t2).max(0.0).sqrt();
    Vec3::new(x * n.x, y * n.y, n.z.max(0.0)).try_normalize()
}
