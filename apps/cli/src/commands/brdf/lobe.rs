//! What of a model can be drawn: its lobe in the plane of incidence, its albedo, its retro-reflection.

use etendue_brdf::quadrature::adaptive_albedo;
use etendue_brdf::{Bsdf, Density};
use etendue_math::Real;
use etendue_math::glam::DVec3;

/// A model of one channel.
pub(super) type Model = dyn Bsdf<Color = f64>;

/// A direction of its own, and the share of the light that goes there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct DeltaLobe {
    /// Signed angle to the normal in the plane of incidence, degrees.
    pub(super) angle: f64,
    pub(super) share: f64,
}

/// `f |cos θi|` over the plane of incidence for one viewer.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Lobe {
    /// Signed angle of `wi` to the normal in degrees, and the value in sr⁻¹.
    pub(super) points: Vec<[f64; 2]>,
    pub(super) deltas: Vec<DeltaLobe>,
}

/// The direction in the plane of incidence with a signed angle to the normal; viewers have negative ones.
fn direction(degrees: f64) -> DVec3 {
    let (sin, cos) = Real::sin_cos(degrees.to_radians());
    DVec3::new(sin, 0.0, cos)
}

/// The lobe for a viewer at `degrees` from the normal.
pub(super) fn lobe(model: &Model, degrees: f64) -> Lobe {
    let wo = direction(-degrees);
    let end = if model.lobes().transmission { 180.0 } else { 90.0 };
    // A coarse pass finds the peaks, a fine one draws them: narrow lobes are a fraction of a degree wide.
    let value = |angle: f64| {
        let wi = direction(angle);
        model.eval(wo, wi) * wi.z.abs()
    };
    let coarse = even(-end, end, (4.0 * end) as usize);
    let mut angles = coarse.clone();
    let mut peaks = vec![degrees];
    peaks.extend(coarse.windows(3).filter_map(|w| {
        let [a, b, c] = [w[0], w[1], w[2]].map(value);
        (b > a && b >= c).then_some(w[1])
    }));
    for peak in peaks {
        angles.extend(even((peak - 2.0).max(-end), (peak + 2.0).min(end), 400));
    }
    angles.sort_by(f64::total_cmp);
    let points = angles.into_iter().map(|angle| [angle, value(angle)]).collect();
    Lobe { points, deltas: deltas(model, wo) }
}

/// `n + 1` evenly spaced numbers.
fn even(low: f64, high: f64, n: usize) -> Vec<f64> {
    (0..=n).map(|i| low + (high - low) * i as f64 / n as f64).collect()
}

/// Draws that look for delta lobes; one chosen with less than their reciprocal probability may be missed.
const DRAWS: usize = 256;

/// The delta lobes, as shares of the flux: refraction without its factor `1/η²`.
fn deltas(model: &Model, wo: DVec3) -> Vec<DeltaLobe> {
    let mut found: Vec<DeltaLobe> = Vec::new();
    for i in 0..DRAWS {
        let u = (i as f64 + 0.5) / DRAWS as f64;
        let Some(sample) = model.sample(wo, u, [0.5, 0.5]) else { continue };
        let Density::Delta(probability) = sample.density else { continue };
        let angle = Real::atan2(sample.wi.x, sample.wi.z).to_degrees();
        if found.iter().all(|lobe| (lobe.angle - angle).abs() > 1e-9) {
            let share = sample.weight * probability * sample.eta * sample.eta;
            found.push(DeltaLobe { angle, share });
        }
    }
    found
}

/// The angles at which curves over the viewer's angle are computed, in degrees: denser towards grazing.
fn viewers() -> Vec<f64> {
    even(0.0, 1.0, 30).into_iter().map(|t| 89.9 * t * (2.0 - t)).collect()
}

/// Directional albedo over the viewer's angle in degrees, delta lobes and both sides included.
pub(super) fn albedo(model: &Model) -> Vec<[f64; 2]> {
    let at = |degrees: f64| {
        let wo = direction(-degrees);
        // A line on a picture is some thousandths wide.
        let sides = adaptive_albedo(model, wo, 1e-4);
        let delta: f64 = deltas(model, wo).iter().map(|lobe| lobe.share).sum();
        sides.reflected + sides.transmitted + delta
    };
    viewers().into_iter().map(|degrees| [degrees, at(degrees)]).collect()
}

/// `f(w, w) cos θ` over the angle of `w` in degrees.
pub(super) fn retro_reflection(model: &Model) -> Vec<[f64; 2]> {
    even(0.0, 89.9, 360)
        .into_iter()
        .map(|degrees| {
            let w = direction(-degrees);
            [degrees, model.eval(w, w) * w.z]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::specification::Specification;
    use super::*;

    fn model(text: &str) -> Box<Model> {
        text.parse::<Specification>().unwrap().build().unwrap()
    }

    #[test]
    fn glass_has_two_delta_lobes_that_share_the_light() {
        let lobe = lobe(&*model("smooth-dielectric:eta=1.5"), 30.0);
        let [refracted, mirror] = match lobe.deltas[..] {
            [a, b] if a.angle > b.angle => [a, b],
            [a, b] => [b, a],
            _ => panic!("{:?}", lobe.deltas),
        };
        assert!((mirror.angle - 30.0).abs() < 1e-9);
        // sin 30° / 1.5 = 1/3, seen on the other side of the surface.
        let below = 180.0 - Real::asin(1.0_f64 / 3.0).to_degrees();
        assert!((refracted.angle - below).abs() < 1e-9, "{refracted:?}");
        assert!((mirror.share + refracted.share - 1.0).abs() < 1e-12);
        assert!(lobe.points.iter().all(|point| point[1] == 0.0));
    }

    #[test]
    fn albedos_include_mirror_and_matte_term() {
        for [_, albedo] in albedo(&*model("coupled:r0=0.04,rm=1")) {
            assert!((albedo - 1.0).abs() < 1e-3, "{albedo}");
        }
    }

    #[test]
    fn a_lobe_is_drawn_around_its_mirror_direction() {
        let metal = "rough-conductor:alpha=0.01,eta=0.2,k=4";
        let lobe = lobe(&*model(metal), 40.0);
        let peak = lobe.points.iter().copied().reduce(|a, b| if b[1] > a[1] { b } else { a });
        // The peak lies within the width of the lobe, 2 α in radians, of the mirror direction.
        assert!((peak.unwrap()[0] - 40.0).abs() < 1.2);
        assert!(lobe.points.windows(2).all(|pair| pair[0][0] <= pair[1][0]));
        assert!(retro_reflection(&*model(metal)).iter().all(|point| point[1] >= 0.0));
    }
}
