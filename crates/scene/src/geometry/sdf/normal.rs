//! Normals that are continuous from voxel to voxel.

use etendue_math::glam::DVec3;
use etendue_math::{Real, Vector3};

use super::samples::SdfSamples;

/// The gradients of the eight voxels around the sample next to a point, each normalised, blended by the place of the
/// point between their middles; in the space of the unit cube, not of unit length.
///
/// Each gradient is made of the differences across its voxel at the place of the point along the other axes. Voxels
/// below the grid do not count; for those above it the field goes on as at its end.
///
/// * `p`: in units of the grid, from 0 to `size − 1`.
///
/// # Source
/// Hansson-Söderlund, Evans, Akenine-Möller, "Ray Tracing of Signed Distance Function Grids", JCGT 11(3), 2022; at the
/// border as in Mitsuba 3, `src/shapes/sdfgrid.cpp`.
pub(super) fn smooth(samples: &SdfSamples, p: DVec3) -> DVec3 {
    let mut cell = [0_i64; 3];
    let mut place = [0.0; 3];
    // Of the blend: at the lower voxel, at the upper one.
    let mut weights = [[0.0; 2]; 3];
    for axis in 0..3 {
        let x = p[axis];
        let last = i64::from(samples.size()[axis]) - 2;
        cell[axis] = (Real::floor(x) as i64).clamp(0, last);
        place[axis] = x - cell[axis] as f64;
        let lower = Real::floor(x + 0.5) - 1.0;
        let upper = if lower < 0.0 { 1.0 } else { x - lower - 0.5 };
        weights[axis] = [1.0 - upper, upper];
    }
    let mut differences = [[0.0; 2]; 3];
    for axis in 0..3 {
        let value = |offset: i64| plane(samples, axis, cell, place, cell[axis] + offset);
        let (here, next) = (value(0), value(1));
        let cells = f64::from(samples.size()[axis] - 1);
        // The cell of the point is the upper voxel in its lower half, or at the end of the grid.
        let is_upper = cell[axis] as f64 != Real::floor(p[axis] + 0.5) - 1.0;
        differences[axis] =
            if is_upper { [here - value(-1), next - here] } else { [next - here, value(2) - next] }
                .map(|difference| difference * cells);
    }
    let mut sum = DVec3::ZERO;
    for i in 0..8 {
        let pick = |pairs: &[[f64; 2]; 3]| {
            DVec3::new(pairs[0][i & 1], pairs[1][i >> 1 & 1], pairs[2][i >> 2])
        };
        let [gradient, weight] = [pick(&differences), pick(&weights)];
        if let Some(unit) = Vector3::try_normalize(gradient) {
            sum += unit * (weight.x * weight.y * weight.z);
        }
    }
    sum
}

/// The field on the plane of samples `along` of an axis, at the place in the cell along the others.
fn plane(samples: &SdfSamples, axis: usize, cell: [i64; 3], place: [f64; 3], along: i64) -> f64 {
    let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
    let value = |i: i64, j: i64| {
        let mut at = cell;
        at[axis] = along;
        at[b] += i;
        at[c] += j;
        let size = samples.size();
        samples.value([0, 1, 2].map(|k| at[k].clamp(0, i64::from(size[k]) - 1) as u32))
    };
    let row = |j| value(0, j) * (1.0 - place[b]) + value(1, j) * place[b];
    row(0) * (1.0 - place[c]) + row(1) * place[c]
}
