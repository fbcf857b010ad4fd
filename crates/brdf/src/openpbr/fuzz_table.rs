//! Masking and directional albedo of fuzz, tabulated.

use etendue_math::quadrature::gauss_legendre;
use etendue_math::{Real, Vec3};

use super::fuzz::{FuzzShape, ndf};
use crate::direction::half_vector;
use crate::microfacet::CosineRow;

/// Projected area and directional albedo of the fibres' normals
/// `D(h) = (2 + n) sinⁿ θ / 2π`, `n = 1/roughness`.
///
/// ```text
/// σ(μ) = ∫ D(h) max(0, w·h) dh,   E(μ) = ∫ D(h) V(wo, wi) cos θi dωi
/// entries  σ and 1 − E
/// rows     roughness rᵢ = 0.1 + 0.9 (i/15)²
/// columns  √μ = j/31
/// ```
///
/// linear between nodes. σ is what Smith's masking is made of (see [`microfacet`](crate::microfacet)); E is that of
/// the interpolated σ.
///
/// 4 KB, linked only where used.
///
/// # Precision
/// σ within 3e-3 and E within 2e-3 of the integrals.
///
/// # Source
/// `cargo run --release -p etendue-brdf --example generate_albedo_tables fuzz` writes `fuzz_data.rs`.
#[derive(Clone, Debug, PartialEq)]
pub struct FuzzTable {
    area: [[f32; Self::COLUMNS]; Self::ROWS],
    passed: [[f32; Self::COLUMNS]; Self::ROWS],
}

include!("fuzz_data.rs");

/// The least roughness: fibres of exponent 10.
pub(super) const LEAST_ROUGHNESS: f64 = 0.1;

impl FuzzTable {
    /// Nodes over the roughness.
    pub const ROWS: usize = 16;
    /// Nodes over the angle.
    pub const COLUMNS: usize = CosineRow::<f32>::NODES;

    /// Computes the table: seconds.
    pub fn generate() -> Self {
        let areas: [CosineRow<f64>; Self::ROWS] = core::array::from_fn(|i| {
            CosineRow::of(|mu| projected_area(1.0 / Self::roughness(i), mu))
        });
        let narrow = |row: CosineRow<f64>| row.0.map(|x| x as f32);
        Self {
            area: areas.map(narrow),
            passed: core::array::from_fn(|i| {
                let shape = FuzzShape::of_area(1.0 / Self::roughness(i), areas[i]);
                // The error of the quadrature is 1e-4 at grazing angles, where E is 1.
                narrow(CosineRow::of(|mu| (1.0 - albedo(&shape, mu)).max(0.0)))
            }),
        }
    }

    /// The projected areas σ, and `1 − E`, row by row.
    pub fn data(&self) -> [&[[f32; Self::COLUMNS]; Self::ROWS]; 2] {
        [&self.area, &self.passed]
    }

    /// Roughness of row `i`.
    fn roughness(i: usize) -> f64 {
        LEAST_ROUGHNESS + (1.0 - LEAST_ROUGHNESS) * Real::sqr(i as f64 / (Self::ROWS - 1) as f64)
    }

    /// The rows `[σ, 1 − E]` of a roughness in `[0.1, 1]`.
    pub(super) fn rows<T: Real>(&self, roughness: T) -> [CosineRow<T>; 2] {
        let least = T::lit(LEAST_ROUGHNESS);
        let place = ((roughness - least) / (T::ONE - least)).clamp_to(T::ZERO, T::ONE);
        let place = place.sqrt() * T::lit((Self::ROWS - 1) as f64);
        let i = (place.to_f64() as usize).min(Self::ROWS - 2);
        let [low, high] = [i, i + 1].map(|i| T::lit(Self::roughness(i)));
        let t = (roughness - low) / (high - low);
        [&self.area, &self.passed].map(|part| {
            CosineRow(core::array::from_fn(|j| {
                let [low, high] = [i, i + 1].map(|i| T::lit(part[i][j].into()));
                low * (T::ONE - t) + high * t
            }))
        })
    }
}

/// σ by quadrature over θ; the integral over φ in closed form.
fn projected_area(n: f64, mu: f64) -> f64 {
    let sin = ((1.0 - mu) * (1.0 + mu)).safe_sqrt();
    // Normals steeper than this are hidden at some azimuths.
    let edge = Real::atan2(mu, sin);
    let mut sum = 0.0;
    for (start, end) in [(0.0, edge), (edge, f64::PI * 0.5)] {
        for (t, weight) in gauss_legendre::<f64, 96>() {
            let theta = start + (end - start) * t;
            let (s, c) = Real::sin_cos(theta);
            let (a, b) = (mu * c, sin * s);
            let seen = if a >= b {
                f64::PI * a
            } else {
                a * Real::acos(-a / b) + ((b - a) * (b + a)).safe_sqrt()
            };
            let h = Vec3::<f64>::new(s, 0.0, c);
            sum += weight * (end - start) * 2.0 * seen * s * ndf(h, n);
        }
    }
    sum
}

/// E by quadrature; the nodes crowd where a grazing view has its light come from.
fn albedo(shape: &FuzzShape<f64>, mu: f64) -> f64 {
    let mu = mu.max(1e-9);
    let wo = Vec3::<f64>::new(((1.0 - mu) * (1.0 + mu)).safe_sqrt(), 0.0, mu);
    let mut sum = 0.0;
    for (t, weight) in gauss_legendre::<f64, 96>() {
        // cos θ = t⁴
        let z = Real::powi(t, 4);
        let s = ((1.0 - z) * (1.0 + z)).safe_sqrt();
        let weight = weight * 4.0 * Real::powi(t, 3) * z * f64::PI / 96.0;
        for k in 0..192 {
            let (sin_phi, cos_phi) = Real::sin_cos(f64::PI * (f64::from(k) + 0.5) / 96.0);
            let wi = Vec3::<f64>::new(s * cos_phi, s * sin_phi, z);
            sum += weight * half_vector(wo, wi).map_or(0.0, |(h, _)| shape.value(wo, wi, h));
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::microfacet::Place;

    #[test]
    fn entries_are_what_the_generator_computes() {
        for (i, j) in [(0, 0), (3, 31), (8, 5), (15, 20)] {
            let n = 1.0 / FuzzTable::roughness(i);
            let want = projected_area(n, CosineRow::<f64>::node(j));
            // One rounding to f32, and the float functions of another backend.
            assert!((f64::from(FuzzTable::CHARLIE.area[i][j]) - want).abs() < 3e-7, "{i} {j}");
        }
    }

    #[test]
    fn the_facets_cover_the_mean_surface_and_hide_nothing_from_above() {
        for row in &FuzzTable::CHARLIE.area {
            assert!((row[FuzzTable::COLUMNS - 1] - 1.0).abs() < 1e-6, "{row:?}");
        }
    }

    #[test]
    fn the_interpolation_is_as_good_as_it_says() {
        let mut worst = [0.0_f64; 2];
        for roughness in [0.1, 0.101, 0.12, 0.17, 0.3, 0.5, 0.77, 1.0] {
            let [area, passed] = FuzzTable::CHARLIE.rows(roughness);
            let n = 1.0 / roughness;
            let exact = CosineRow::of(|mu| projected_area(n, mu));
            let shape = FuzzShape::of_area(n, exact);
            for k in 0..25 {
                let mu = Real::sqr(f64::from(k) / 24.0);
                let place = Place::of(mu);
                let errors = [
                    area.at(place) - projected_area(n, mu),
                    passed.at(place) - (1.0 - albedo(&shape, mu)),
                ];
                for (worst, error) in worst.iter_mut().zip(errors) {
                    *worst = worst.max(error.abs());
                }
            }
        }
        assert!(worst[0] < 3e-3 && worst[1] < 2e-3, "{worst:?}");
    }
}
