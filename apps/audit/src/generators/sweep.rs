//! Pairs of directions by the hundred million.

use etendue_math::{Real, Vec3, Vector3};

use crate::generators::uniforms;
use crate::scalar::narrow;

const POOL: usize = 1024;

/// Pools of elevations, azimuths and distances of which pairs of directions are put together.
///
/// A transcendental function per pair would cost more than the models that are swept: each is
/// evaluated once per entry of a pool, and pairs combine entries by the bits of a hash. Every block
/// of a sweep has pools of its own.
pub struct SweepPairs {
    /// `(cos θ, sin θ)`: half uniform in the cosine, a quarter log-uniform in either of the two
    /// down to 1e-7; the normal itself is among them.
    elevations: Vec<[f64; 2]>,
    azimuths: Vec<[f64; 2]>,
    /// Log-uniform from 1e-8 to 1.
    distances: Vec<f64>,
}

/// A pair of directions, exact in `f32` and of length 1 to its rounding.
pub struct SweepPair {
    /// Viewer.
    pub wo: Vec3<f32>,
    /// Light.
    pub wi: Vec3<f32>,
    /// The light's direction is better drawn by the model's own sampler: one pair in four.
    pub sampled: bool,
}

impl SweepPairs {
    /// The pools of a block.
    pub fn new(block: u64) -> Self {
        let log = |u: f64, decades: f64| Real::powf(10.0, -decades * u);
        let numbers = || (0..POOL as u64).map(|k| (k, uniforms::<f64>(STREAM + block, k)));
        let elevations = numbers().map(|(k, [u, ..])| {
            // The small one of sine and cosine is given, the large one follows from it.
            let c = if k % 4 < 2 { log(u, 7.0) } else { u };
            let s = ((1.0 - c) * (1.0 + c)).sqrt();
            match k {
                0 => [1.0, 0.0],
                _ if k % 4 == 0 => [s, c],
                _ => [c, s],
            }
        });
        let azimuths = numbers().map(|(_, [_, v, _])| {
            let (sin, cos) = Real::sin_cos(2.0 * f64::PI * v);
            [cos, sin]
        });
        Self {
            elevations: elevations.collect(),
            azimuths: azimuths.collect(),
            distances: numbers().map(|(_, [.., w])| log(w, 8.0)).collect(),
        }
    }

    /// The pair that belongs to 64 random bits.
    ///
    /// Azimuths differ freely, by 0, π or ±π/2 or nearly so; or the light is near the viewer or near
    /// its mirror image, at a distance from 1e-8 to 1. Three pairs in eight have one or both
    /// directions below the surface.
    #[inline]
    pub fn pair(&self, bits: u64) -> SweepPair {
        let part = |i: u32| (bits >> (10 * i)) as usize % POOL;
        let elevation = self.elevations[part(0)];
        let other = self.elevations[part(1)];
        let azimuth = self.azimuths[part(2)];
        let free = self.azimuths[part(3)];
        let distance = self.distances[part(4)];
        let (relation, flips, quarter) = (bits >> 50 & 15, bits >> 54 & 7, bits >> 57 & 3);

        let wo = place(elevation, azimuth);
        let near = |[x, y, z]: [f64; 3]| {
            let [a, b, c] = place(other, free);
            let moved = [x + distance * a, y + distance * b, z + distance * c];
            let length = (moved[0] * moved[0] + moved[1] * moved[1] + moved[2] * moved[2]).sqrt();
            moved.map(|x| x / length)
        };
        let wi = match relation {
            0..=3 => place(other, free),
            4..=6 => place(other, turned(azimuth, quarter)),
            7 => {
                let [cos, sin] = turned(azimuth, quarter);
                let [x, y, _] = near([cos, sin, 0.0]);
                let length = (x * x + y * y).sqrt();
                place(other, if length > 0.0 { [x / length, y / length] } else { [cos, sin] })
            }
            8..=9 => near(wo),
            _ => near([-wo[0], -wo[1], wo[2]]),
        };
        let (down_o, down_i) = (flips == 6 || flips == 7, flips == 5 || flips == 7);
        let turn = |w: [f64; 3], down: bool| {
            let w = narrow::<f32>(w);
            if down { w.flip_z() } else { w }
        };
        SweepPair { wo: turn(wo, down_o), wi: turn(wi, down_i), sampled: relation >= 12 }
    }
}

const STREAM: u64 = 0x0073_7765_6570_0000;

fn place([cos, sin]: [f64; 2], [x, y]: [f64; 2]) -> [f64; 3] {
    [sin * x, sin * y, cos]
}

/// An azimuth turned by a number of quarters, exactly.
fn turned([x, y]: [f64; 2], quarters: u64) -> [f64; 2] {
    match quarters {
        0 => [x, y],
        1 => [-y, x],
        2 => [-x, -y],
        _ => [y, -x],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::mix_u64;

    #[test]
    fn pairs_are_unit_vectors_and_reach_every_corner_of_the_hostile_domain() {
        let pairs = SweepPairs::new(3);
        let all: Vec<_> = (0..200_000).map(|i| pairs.pair(mix_u64(7, i))).collect();
        let unit = |w: Vec3<f32>| (w.as_dvec3().length() - 1.0).abs() < 2e-7;
        assert!(all.iter().all(|p| unit(p.wo) && unit(p.wi)));
        let met = |what: &str, test: &dyn Fn(&SweepPair) -> bool| {
            assert!(all.iter().filter(|p| test(p)).count() > 100, "{what}");
        };
        met("grazing", &|p| p.wo.z > 0.0 && p.wo.z < 1e-6);
        met("near the normal", &|p| p.wo.z > 0.0 && p.wo.truncate().length() < 1e-6);
        met("both grazing", &|p| p.wo.z.abs() < 1e-4 && p.wi.z.abs() < 1e-4);
        met("close together", &|p| (p.wo - p.wi).length() < 1e-5);
        met("close to the mirror", &|p| (p.wo - p.wi.flip_z() * -1.0).length() < 1e-5);
        met("across", &|p| p.wo.z * p.wi.z < 0.0);
        met("both below", &|p| p.wo.z < 0.0 && p.wi.z < 0.0);
        met("at a right angle", &|p| {
            let [a, b] = [p.wo, p.wi].map(|w| w.truncate().normalize_or_zero());
            a.dot(b).abs() < 1e-6 && a.length() > 0.5 && b.length() > 0.5
        });
        met("sampled", &|p| p.sampled);
    }
}
