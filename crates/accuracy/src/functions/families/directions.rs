//! Pairs of directions under a material.

use etendue_brdf::Bsdf;
use etendue_math::quadrature::gauss_legendre;
use etendue_math::{Real, Spectrum, Vec3, Vector3};
use std::rc::Rc;

use crate::functions::domain::{Domain, Probe};
use crate::functions::variant::Variant;

/// Viewer and light, and the number of a material.
///
/// In `f64`: rounded to `f32`, the directions would not have length 1. Variants in `f32` are given the nearest ones, as they
/// are in a renderer.
#[derive(Clone, Copy)]
pub(super) struct Pair {
    pub(super) case: usize,
    pub(super) wo: [f64; 3],
    pub(super) wi: [f64; 3],
}

impl Pair {
    pub(super) fn new(case: usize, wo: [f64; 3], wi: [f64; 3]) -> Self {
        Self { case, wo, wi }
    }

    /// Both directions in a precision.
    pub(super) fn vectors<T: Real>(&self) -> [Vec3<T>; 2] {
        [self.wo, self.wi].map(|w| {
            let [x, y, z] = w.map(T::lit);
            Vec3::<T>::new(x, y, z)
        })
    }

    /// Polar angles and the azimuth between the directions, in degrees.
    pub(super) fn words(&self) -> String {
        let polar = |[x, y, z]: [f64; 3]| Real::atan2((x * x + y * y).sqrt(), z).to_degrees();
        let [o, i] = [self.wo, self.wi];
        let cross = o[0] * i[1] - o[1] * i[0];
        let phi = Real::atan2(cross.abs(), o[0] * i[0] + o[1] * i[1]).to_degrees();
        format!("θo {:.0}°, θi {:.0}°, Δφ {phi:.0}°", polar(o), polar(i))
    }
}

/// The direction at a polar angle and an azimuth, in degrees.
pub(super) fn direction(theta: f64, phi: f64) -> [f64; 3] {
    let ((sin, cos), (y, x)) = (Real::sin_cos(theta.to_radians()), Real::sin_cos(phi.to_radians()));
    [sin * x, sin * y, cos]
}

/// All pairs of these polar angles at these azimuths between them.
pub(super) fn pairs(case: usize, polar: &[f64], azimuths: &[f64]) -> Vec<Pair> {
    let mut all = Vec::new();
    for &o in polar {
        for &i in polar {
            for &phi in azimuths {
                all.push(Pair::new(case, direction(o, 0.0), direction(i, phi)));
            }
        }
    }
    all
}

/// The directional albedo of a material seen at a polar angle: `N` cosines by `N` azimuths on one side of the plane of
/// incidence, which is one of symmetry.
pub(super) fn albedo_probe<const N: usize>(case: usize, material: &str, theta: f64) -> Probe<Pair> {
    let mut nodes = Vec::with_capacity(N * N);
    let wo = direction(theta, 0.0);
    for (t, w) in gauss_legendre::<f64, N>() {
        // cos θ = t (2 − t) crowds the nodes at the normal, where lobes are narrow.
        let z = t * (2.0 - t);
        let sin = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
        for i in 0..N {
            let phi = f64::PI * (i as f64 + 0.5) / N as f64;
            let (y, x) = Real::sin_cos(phi);
            let weight = w * 2.0 * (1.0 - t) * z * 2.0 * f64::PI / N as f64;
            nodes.push((Pair::new(case, wo, [sin * x, sin * y, z]), weight));
        }
    }
    Probe { place: format!("{material}, θo {theta:.0}°"), nodes }
}

/// The value of a model per material.
pub(super) fn models<B>(name: &'static str, domain: &Rc<Domain<Pair>>, models: Vec<B>) -> Variant
where
    B: Bsdf + 'static,
{
    Variant::new(
        name,
        domain,
        |pair| (pair.case, pair.vectors::<<B::Color as Spectrum>::Real>()),
        move |&(case, [wo, wi])| models[case].eval(wo, wi),
    )
}
