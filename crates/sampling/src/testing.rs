//! Statistics and geometry shared by the tests of this crate.

use etendue_math::{Real, glam::DVec3};

use crate::{Decision, Dimension, Independent, Sampler};

/// Deviation of Pearson's χ² from its mean, in standard deviations. Cells that expect fewer than 5
/// are pooled.
pub(crate) fn chi_squared_deviation(observed: &[f64], expected: &[f64]) -> f64 {
    let (mut sum, mut cells, mut pooled) = (0.0, 0.0, (0.0, 0.0));
    for (&o, &e) in observed.iter().zip(expected) {
        if e < 5.0 {
            pooled = (pooled.0 + o, pooled.1 + e);
        } else {
            sum += (o - e).sqr() / e;
            cells += 1.0;
        }
    }
    if pooled.1 >= 5.0 {
        sum += (pooled.0 - pooled.1).sqr() / pooled.1;
        cells += 1.0;
    } else {
        // Too few for a cell: they may not be many.
        assert!(pooled.0 < 25.0, "{} samples where {} are expected", pooled.0, pooled.1);
    }
    let freedom: f64 = cells - 1.0;
    (sum - freedom) / (2.0 * freedom).sqrt()
}

/// Pearson's correlation coefficient of two sequences of uniform numbers.
pub(crate) fn correlation(n: u64, a: impl Fn(u64) -> f64, b: impl Fn(u64) -> f64) -> f64 {
    (0..n).map(|i| (a(i) - 0.5) * (b(i) - 0.5)).sum::<f64>() * 12.0 / n as f64
}

/// `n` fixed random points of the square.
pub(crate) fn uniforms<T: Real>(n: u64) -> impl Iterator<Item = [T; 2]> {
    (0..n).map(|i| Independent::at(0x5eed, [0, 0], i).sample_2d(Dimension::camera(Decision::Film)))
}

const ROWS: usize = 12;
const COLUMNS: usize = 24;
/// Points per side of a cell at which the density is averaged.
const SUBDIVISION: usize = 24;

/// Compares the samples of a map onto the sphere of directions with its density: χ² on a grid in
/// (cos θ, φ), and the integral of the density, which must be 1.
///
/// An interpreter would take hours over these statistics: it finds a density wherever samples fall.
pub(crate) fn check_density_on_sphere(map: impl Fn([f64; 2]) -> DVec3, pdf: impl Fn(DVec3) -> f64) {
    const N: u64 = 20_000;
    if cfg!(miri) {
        assert!(uniforms(16).all(|u| pdf(map(u)) > 0.0));
        return;
    }
    let mut observed = [0.0; ROWS * COLUMNS];
    for u in uniforms(N) {
        let w = map(u);
        // Directions are unit vectors within rounding of a few operations.
        assert!((w.length_squared() - 1.0).abs() < 16.0 * f64::EPSILON, "{w}");
        let turn = Real::atan2(w.y, w.x) / (2.0 * f64::PI);
        let row = ((w.z + 1.0) * 0.5 * ROWS as f64) as usize;
        let column = (turn.rem_euclid(1.0) * COLUMNS as f64) as usize;
        observed[row.min(ROWS - 1) * COLUMNS + column.min(COLUMNS - 1)] += 1.0;
    }
    let mut expected = [0.0; ROWS * COLUMNS];
    let fine = [ROWS * SUBDIVISION, COLUMNS * SUBDIVISION];
    for i in 0..fine[0] {
        let z = 2.0 * (i as f64 + 0.5) / fine[0] as f64 - 1.0;
        let s = (1.0 - z * z).sqrt();
        for j in 0..fine[1] {
            let phi = 2.0 * f64::PI * (j as f64 + 0.5) / fine[1] as f64;
            let density = pdf(DVec3::new(s * Real::cos(phi), s * Real::sin(phi), z));
            let solid_angle = 4.0 * f64::PI / (fine[0] * fine[1]) as f64;
            expected[i / SUBDIVISION * COLUMNS + j / SUBDIVISION] +=
                N as f64 * density * solid_angle;
        }
    }
    let integral = expected.iter().sum::<f64>() / N as f64;
    // The midpoint rule on 288 × 576 points; an edge of the support costs up to 1 % of small
    // shapes.
    assert!((integral - 1.0).abs() < 0.01, "the density integrates to {integral}");
    let z = chi_squared_deviation(&observed, &expected);
    // 5 standard deviations, with a fixed seed.
    assert!(z < 5.0, "χ² is {z} standard deviations above its mean");
}

/// Compares a density with the Jacobian of its map by central differences, sharper than any χ².
///
/// ```text
/// pdf(map(u)) · |∂map/∂u₀ × ∂map/∂u₁| = 1
/// ```
pub(crate) fn check_jacobian(map: impl Fn([f64; 2]) -> DVec3, pdf: impl Fn(DVec3) -> f64) {
    const STEP: f64 = 1e-5;
    for [a, b] in uniforms::<f64>(if cfg!(miri) { 8 } else { 200 }) {
        // Away from the edges of the square, where maps may have kinks and infinite slopes.
        let [a, b] = [0.02 + 0.96 * a, 0.02 + 0.96 * b];
        // The diagonals are kinks of the concentric map and of the triangle's.
        if (a - b).abs() < 0.001 || (a + b - 1.0).abs() < 0.001 {
            continue;
        }
        let along_a = (map([a + STEP, b]) - map([a - STEP, b])) / (2.0 * STEP);
        let along_b = (map([a, b + STEP]) - map([a, b - STEP])) / (2.0 * STEP);
        let product = pdf(map([a, b])) * along_a.cross(along_b).length();
        // Differences of second order: error of about STEP² f'''/6, f''' below 1e3 at 0.02 from an
        // edge, and rounding of ε/STEP = 2e-11.
        assert!((product - 1.0).abs() < 1e-5, "[{a}, {b}]: {product}");
    }
}

/// Checks that the inverse undoes the map, to an absolute error in u.
pub(crate) fn check_inverse<T: Real, P>(
    map: impl Fn([T; 2]) -> P,
    inverse: impl Fn(P) -> [T; 2],
    tolerance: f64,
) {
    for u in uniforms::<T>(if cfg!(miri) { 16 } else { 1000 }) {
        let back = inverse(map(u));
        for (u, back) in u.into_iter().zip(back) {
            let error = (u.to_f64() - back.to_f64()).abs();
            assert!(error <= tolerance, "{u} comes back as {back}, error {error:e}");
            assert!(back >= T::ZERO && back < T::ONE, "{back} is no uniform number");
        }
    }
}
