//! Colour spaces of ꟻLIP.

use etendue_math::Real;
use etendue_math::glam::{DMat3, DVec3};

/// Linear Rec. 709 to XYZ, from exact chromaticities of primaries and of white, by rows.
const TO_XYZ: [[f64; 3]; 3] = [
    [10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0],
    [2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0],
    [1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0],
];

/// XYZ of white.
const WHITE: [f64; 3] = [row_sum(TO_XYZ[0]), row_sum(TO_XYZ[1]), row_sum(TO_XYZ[2])];

const fn row_sum([a, b, c]: [f64; 3]) -> f64 {
    a + b + c
}

/// Y, Cx, Cz: a linear form of L*a*b*, in which the eye's contrast sensitivity is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Opponent {
    pub(super) y: f64,
    /// Red against green.
    pub(super) cx: f64,
    /// Yellow against blue.
    pub(super) cz: f64,
}

impl Opponent {
    /// Of linear Rec. 709.
    pub(super) fn of(rgb: [f64; 3]) -> Self {
        let [x, y, z] = relative_to_white(rgb);
        Self { y: 116.0 * y - 16.0, cx: 500.0 * (x - y), cz: 200.0 * (y - z) }
    }
}

/// Linear Rec. 709 of an opponent colour; outside `[0, 1]` for what a screen cannot show.
pub(super) fn linear_of(colour: Opponent) -> [f64; 3] {
    let y = (colour.y + 16.0) / 116.0;
    let relative = [y + colour.cx / 500.0, y, y - colour.cz / 200.0];
    let xyz = DVec3::new(relative[0] * WHITE[0], relative[1] * WHITE[1], relative[2] * WHITE[2]);
    (to_xyz().inverse() * xyz).to_array()
}

/// L*a*b* of linear Rec. 709 with its chroma scaled by lightness: colours are less different in the dark.
pub(super) fn hunt_lab(rgb: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = relative_to_white(rgb).map(|t| {
        const DELTA: f64 = 6.0 / 29.0;
        if t > DELTA * DELTA * DELTA {
            Real::powf(t, 1.0 / 3.0)
        } else {
            t / (3.0 * DELTA * DELTA) + 4.0 / 29.0
        }
    });
    let lightness = 116.0 * y - 16.0;
    let hunt = 0.01 * lightness;
    [lightness, hunt * 500.0 * (x - y), hunt * 200.0 * (y - z)]
}

/// City block distance of lightness from the Euclidean one of chroma: for large differences.
pub(super) fn hyab([l1, a1, b1]: [f64; 3], [l2, a2, b2]: [f64; 3]) -> f64 {
    // What a screen shows differs by hundreds in each: far from where squares overflow.
    (l1 - l2).abs() + ((a1 - a2).sqr() + (b1 - b2).sqr()).sqrt()
}

fn to_xyz() -> DMat3 {
    DMat3::from_cols_array_2d(&TO_XYZ).transpose()
}

fn relative_to_white(rgb: [f64; 3]) -> [f64; 3] {
    let xyz = to_xyz() * DVec3::from(rgb);
    [xyz.x / WHITE[0], xyz.y / WHITE[1], xyz.z / WHITE[2]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_and_black_are_neutral_and_opponent_colours_can_be_undone() {
        let [l, a, b] = hunt_lab([1.0; 3]);
        // Roundings of a handful of operations on 100.
        assert!((l - 100.0).abs() < 1e-12 && a.abs() < 1e-12 && b.abs() < 1e-12);
        assert!(hunt_lab([0.0; 3]).iter().all(|x| x.abs() < 1e-12));
        let rgb = [0.2, 0.7, 0.1];
        let back = linear_of(Opponent::of(rgb));
        assert!(rgb.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-14), "{back:?}");
    }
}
