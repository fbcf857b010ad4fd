//! Half vectors of Ashikhmin and Shirley's model, large exponents.

use etendue_brdf::{Exponent, PhongHalfVectors};
use etendue_math::Real;
use etendue_math::glam::{DVec3, Vec3};

use super::{HardCase, decades, relative};
use crate::generators::uniforms;
use crate::measure::{Outcome, Worst};

/// `hz^(… / (1 − hz²))` raises a cosine that rounds to 1, with an exponent that is 0/0.
pub(super) const EVAL: HardCase = HardCase {
    name: "large exponents",
    function: "PhongHalfVectors::pdf",
    problem: "hz^(…/(1 − hz²)) of a cosine that rounds to 1: 6e-2 off at n = 1e6, 0/0 at h = n",
    remedy: "s² = hx² + hy², exp(½ e log1p(−s²)) with e = (nu hx² + nv hy²)/s²",
    sound: || eval_sweep(|lobe, _, h| lobe.pdf(h)),
    naive: || eval_sweep(|_, n, h| power_of_cosine(n, h)),
};

/// `(1 − ξ)^(1/(n + 1))` takes few values near 1, and the sine taken from it fewer.
pub(super) const POLAR: HardCase = HardCase {
    name: "large exponents, polar angle",
    function: "PhongHalfVectors::sample",
    problem: "(1 − ξ)^(1/(n + 1)) has few values near 1: 17 directions of 20 000 at n = 1e7",
    remedy: "sin θ = √(−expm1(2 log1p(−ξ)/(n + 1)))",
    sound: || polar_sweep(|lobe, _, u| lobe.sample([0.0, u]).0.x),
    naive: || polar_sweep(|_, n, u| sine_of_cosine(n, u)),
};

/// The tangent of a right angle is −2.3e7 in `f32`: the half vector jumps to another quadrant.
pub(super) const AZIMUTH: HardCase = HardCase {
    name: "ends of the quadrants",
    function: "PhongHalfVectors::sample",
    problem: "tan(π/2) is −2.3e7 in f32: half vectors jump to another quadrant",
    remedy: "(cos φ, sin φ) ∝ (√(nv + 1) cos 2πξ, √(nu + 1) sin 2πξ)",
    sound: || azimuth_sweep(|lobe, _, u| lobe.sample([u, 0.5]).0),
    naive: || azimuth_sweep(|_, n, u| arc_tangent(n, u)),
};

/// Exponents along x and y, and the lobe.
fn lobe<T: Real>([nu, nv]: [f32; 2]) -> Option<PhongHalfVectors<T>> {
    let exponent = |n: f32| Exponent::new(T::lit(n.into())).ok();
    Some(PhongHalfVectors::new(exponent(nu)?, exponent(nv)?))
}

/// Densities at half vectors from the normal to four widths from it, `f32` against the power of the sine in `f64` for
/// the same numbers, for exponents from 10 to 1e6. Bound: 1.3e-6, some ten ulp.
fn eval_sweep(form: fn(&PhongHalfVectors<f32>, [f32; 2], Vec3) -> f32) -> Outcome {
    let mut worst = Worst::default();
    for nu in decades(1.0, 6.0, 21) {
        for ratio in [1.0, 0.1] {
            let n = [nu, nu * ratio];
            let Some(narrow) = lobe::<f32>(n) else { continue };
            for widths in decades(-3.0, 0.6, 40).chain([0.0]) {
                let slope = f64::from(widths) / f64::from(nu).sqrt();
                let z = 1.0 / (1.0 + slope * slope).sqrt();
                let (sin, cos) = Real::sin_cos(0.9);
                let h = Vec3::new((slope * z * cos) as f32, (slope * z * sin) as f32, z as f32);
                let want = power_of_sine(n.map(f64::from), h.as_dvec3());
                worst.observe(relative(form(&narrow, n, h), want), || format!("n {n:?}, h {h:?}"));
            }
        }
    }
    worst.within(1.3e-6, "relative")
}

/// `cosᵉ θ = (1 − sin² θ)^(e/2)` with the sine from the tangent plane, of a vector of any length.
fn power_of_sine([nu, nv]: [f64; 2], h: DVec3) -> f64 {
    let (x2, y2) = (h.x * h.x, h.y * h.y);
    let s2 = x2 + y2;
    let exponent = if s2 > 0.0 { (nu * x2 + nv * y2) / s2 } else { 0.0 };
    let power = Real::exp(0.5 * exponent * Real::ln_1p(-s2 / (s2 + h.z * h.z)));
    ((nu + 1.0) * (nv + 1.0)).sqrt() / (2.0 * f64::PI) * power
}

fn power_of_cosine([nu, nv]: [f32; 2], h: Vec3) -> f32 {
    let exponent = (nu * h.x * h.x + nv * h.y * h.y) / (1.0 - h.z * h.z);
    ((nu + 1.0) * (nv + 1.0)).sqrt() / (2.0 * f32::PI) * Real::powf(h.z, exponent)
}

/// Sines of the polar angle, `f32` against the inversion in `f64`; 1e-6 relative, some eight ulp.
fn polar_sweep(form: fn(&PhongHalfVectors<f32>, f32, f32) -> f32) -> Outcome {
    let mut worst = Worst::default();
    for n in decades(0.0, 7.0, 29) {
        let Some(lobe) = lobe::<f32>([n, n]) else { continue };
        for i in 0..200 {
            let u = uniforms::<f32>(95, i)[0];
            let exponent = 2.0 / (f64::from(n) + 1.0);
            let want = (-Real::exp_m1(exponent * Real::ln_1p(-f64::from(u)))).sqrt();
            worst.observe(relative(form(&lobe, n, u), want), || format!("n {n:?}, u {u:?}"));
        }
    }
    worst.within(1e-6, "relative")
}

fn sine_of_cosine(n: f32, u: f32) -> f32 {
    let cos = Real::powf(1.0 - u, 1.0 / (n + 1.0));
    (1.0 - cos * cos).sqrt()
}

/// Azimuths at and around the quadrants' ends, against their direction in `f64`: distance of unit vectors in the
/// plane. Bound: 1e-6, some eight ulp.
fn azimuth_sweep(form: fn(&PhongHalfVectors<f32>, [f32; 2], f32) -> Vec3) -> Outcome {
    let mut worst = Worst::default();
    for n in [[1.0, 1.0], [10.0, 1e4], [1e6, 1.0], [0.0, 1e6]] {
        let Some(lobe) = lobe::<f32>(n) else { continue };
        for end in [0.0, 0.25, 0.5, 0.75, 1.0_f32] {
            for step in decades(-7.5, -2.0, 40).chain([0.0]) {
                for u in [end - step, end + step] {
                    if !(0.0..1.0).contains(&u) {
                        continue;
                    }
                    let (sin, cos) = Real::sin_cos(2.0 * f64::PI * f64::from(u));
                    let [nu, nv] = n.map(|n: f32| (f64::from(n) + 1.0).sqrt());
                    let want = etendue_math::glam::DVec2::new(nv * cos, nu * sin).normalize();
                    let got = form(&lobe, n, u).as_dvec3().truncate().normalize();
                    worst.observe((got - want).length(), || format!("n {n:?}, u {u:?}"));
                }
            }
        }
    }
    worst.within(1e-6, "of 1")
}

/// One arc tangent for all four quadrants, as the paper's formula invites to.
fn arc_tangent([nu, nv]: [f32; 2], u: f32) -> Vec3 {
    let stretch = ((nu + 1.0) / (nv + 1.0)).sqrt();
    let quadrant = |v: f32| Real::atan(stretch * Real::tan(0.5 * f32::PI * v));
    let phi = if u < 0.25 {
        quadrant(4.0 * u)
    } else if u < 0.5 {
        f32::PI - quadrant(4.0 * (0.5 - u))
    } else if u < 0.75 {
        f32::PI + quadrant(4.0 * (u - 0.5))
    } else {
        2.0 * f32::PI - quadrant(4.0 * (1.0 - u))
    };
    let (sin, cos) = Real::sin_cos(phi);
    Vec3::new(cos, sin, 0.0)
}
