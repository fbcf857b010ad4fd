//! Unit directions.

use etendue_math::{Real, Vec3};

use crate::generators::uniforms;
use crate::scalar::{narrow, widen};

/// The unit direction of cosine `z` to the normal and azimuth `phi`, correct to rounding.
pub fn from_angles<T: Real>(z: f64, phi: f64) -> Vec3<T> {
    let sin = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
    let (s, c) = Real::sin_cos(phi);
    narrow::<T>([sin * c, sin * s, z])
}

/// View directions for checks that look at few of them: normal, oblique and near grazing first,
/// from above and below, then a deterministic mixture.
pub fn viewers<T: Real>(count: usize) -> Vec<Vec3<T>> {
    const FIRST: [(f64, f64); 6] =
        [(0.8, 0.7), (-0.6, 4.0), (0.15, 2.5), (1.0, 0.0), (0.5, 5.5), (-0.1, 1.0)];
    let mixture = (0..).map(|i| {
        let [a, b, _] = uniforms::<f64>(11, i);
        (2.0 * a - 1.0, 2.0 * f64::PI * b)
    });
    FIRST.into_iter().chain(mixture).take(count).map(|(z, phi)| from_angles::<T>(z, phi)).collect()
}

/// The directions of [`pair`] as unit vectors of either precision.
pub fn unit_pair<T: Real>(stream: u64, index: u64) -> [Vec3<T>; 2] {
    pair(stream, index).map(|w| {
        let w = narrow::<f64>(widen::<f32>(w));
        narrow::<T>(widen::<f64>(w / w.length()))
    })
}

/// A pair of directions for pointwise laws, exactly representable in `f32`, of length 1 to its
/// rounding.
///
/// Cosines are uniform or log-uniform down to 1e-7, on either side; azimuths are free or one of the
/// differences 0, π/2, π; one pair in eight mirrors the other direction within 10⁻¹…10⁻⁶.
pub fn pair(stream: u64, index: u64) -> [Vec3<f32>; 2] {
    let [kind, a, b] = uniforms::<f64>(mix(stream, 0), index);
    let [c, phi, dphi] = uniforms::<f64>(mix(stream, 1), index);
    let kind = (kind * 64.0) as u32;
    let phi = 2.0 * f64::PI * phi;
    let wo = [cosine(a, kind & 1), phi];
    let other = match kind >> 3 {
        0 => {
            let nearness = Real::powf(10.0, -1.0 - 5.0 * b);
            [
                Real::clamp_to(wo[0] + nearness * (c - 0.5), -1.0, 1.0),
                phi + f64::PI + nearness * dphi,
            ]
        }
        1 => [cosine(b, (kind >> 1) & 1), phi + (dphi * 4.0).floor() * 0.5 * f64::PI],
        _ => [cosine(b, (kind >> 1) & 1), phi + 2.0 * f64::PI * dphi],
    };
    // Three pairs in four stay above the surface, the rest are on either side.
    let flips = if kind & 4 == 0 { [c < 0.25, dphi < 0.5] } else { [false, false] };
    let place = |[z, phi]: [f64; 2], flip: bool| from_angles::<f32>(if flip { -z } else { z }, phi);
    [place(wo, flips[0]), place(other, flips[1])]
}

fn mix(stream: u64, part: u64) -> u64 {
    2 * stream + part + 1000
}

fn cosine(u: f64, grazing: u32) -> f64 {
    if grazing == 1 { Real::powf(10.0, -7.0 * u) } else { 1.0 - u }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_unit_vectors_and_reach_grazing_and_both_sides() {
        let pairs: Vec<_> = (0..10_000).flat_map(|i| pair(3, i)).collect();
        // Three components rounded to f32 once each.
        assert!(pairs.iter().all(|w| (w.length() - 1.0).abs() < 2e-7));
        assert!(pairs.iter().any(|w| w.z > 0.0 && w.z < 1e-6));
        assert!(pairs.iter().any(|w| w.z < 0.0));
    }

    #[test]
    fn viewers_come_from_both_sides() {
        let all = viewers::<f64>(9);
        assert_eq!(all.len(), 9);
        assert!(all.iter().any(|w| w.z < 0.0) && all.iter().any(|w| w.z == 1.0));
    }
}
