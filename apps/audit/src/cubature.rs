//! Adaptive integration over rectangles of the sphere.

use core::array;

use etendue_math::Real;
use etendue_math::quadrature::gauss_legendre;

/// A rectangle in `(z, φ)`, where solid angle is area: `dω = dz dφ`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Range of the cosine to the normal.
    pub z: [f64; 2],
    /// Range of the azimuth in radians.
    pub phi: [f64; 2],
}

impl Cell {
    /// The upper (`z ≥ 0`) and the lower half of the sphere.
    pub const HEMISPHERES: [Self; 2] = [
        Self { z: [0.0, 1.0], phi: [0.0, 2.0 * f64::PI] },
        Self { z: [-1.0, 0.0], phi: [0.0, 2.0 * f64::PI] },
    ];

    fn quarters(self) -> [Self; 4] {
        let z = 0.5 * (self.z[0] + self.z[1]);
        let phi = 0.5 * (self.phi[0] + self.phi[1]);
        let ([z0, z1], [p0, p1]) = (self.z, self.phi);
        [
            Self { z: [z0, z], phi: [p0, phi] },
            Self { z: [z, z1], phi: [p0, phi] },
            Self { z: [z0, z], phi: [phi, p1] },
            Self { z: [z, z1], phi: [phi, p1] },
        ]
    }
}

/// An integral and an estimate of its error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Integral {
    /// The value.
    pub value: f64,
    /// Sum over all accepted cells of the change that the last refinement made: in practice far
    /// above the true error, since refinement raises the accuracy by orders of magnitude.
    pub error: f64,
}

impl core::ops::AddAssign for Integral {
    fn add_assign(&mut self, o: Self) {
        self.value += o.value;
        self.error += o.error;
    }
}

impl core::iter::Sum for Integral {
    fn sum<I: Iterator<Item = Self>>(iter: I) -> Self {
        iter.fold(Self::default(), |mut a, b| {
            a += b;
            a
        })
    }
}

const POINTS: usize = 5;
/// Twelve halvings make cells 4096 times smaller per axis; the partition has already zoomed in.
const MAX_DEPTH: u32 = 12;
/// A cell is quartered at least three times: its first estimates may agree because both miss a ridge, and then
/// 0.7 % of a GGX lobe of width 0.02 seen from a cosine of 0.01 is lost.
const MIN_DEPTH: u32 = 3;

/// A product Gauss–Legendre rule, refined by quartering.
#[derive(Clone, Copy, Debug)]
pub struct Cubature {
    rule: [(f64, f64); POINTS],
}

impl Default for Cubature {
    fn default() -> Self {
        Self { rule: gauss_legendre() }
    }
}

impl Cubature {
    /// `∫ f dω` over a cell, of several quantities at the same points; `f` takes a unit direction.
    ///
    /// ```text
    /// accept Σ quarters when |Σ quarters − whole| ≤ tolerance for each quantity, else refine each with tolerance/2
    /// ```
    ///
    /// Halving (not quartering) the tolerance suits integrands whose error sits along a curve.
    pub fn integrate<const N: usize>(
        &self,
        cell: Cell,
        tolerance: f64,
        f: &impl Fn([f64; 3]) -> [f64; N],
    ) -> [Integral; N] {
        self.refine(cell, self.whole(cell, f), tolerance, MAX_DEPTH, f)
    }

    fn refine<const N: usize>(
        &self,
        cell: Cell,
        whole: [f64; N],
        tolerance: f64,
        depth: u32,
        f: &impl Fn([f64; 3]) -> [f64; N],
    ) -> [Integral; N] {
        let quarters = cell.quarters().map(|q| (q, self.whole(q, f)));
        let refined = array::from_fn(|n| {
            let value: f64 = quarters.iter().map(|q| q.1[n]).sum();
            Integral { value, error: (value - whole[n]).abs() }
        });
        let deep = depth <= MAX_DEPTH - (MIN_DEPTH - 1);
        // NaN compares false and would refine without end were it not for the depth.
        let accurate = refined.iter().all(|i| i.error <= tolerance);
        if (accurate && deep) || depth == 0 || refined.iter().any(|i| i.value.is_nan()) {
            return refined;
        }
        let parts = quarters.map(|(q, whole)| self.refine(q, whole, 0.5 * tolerance, depth - 1, f));
        array::from_fn(|n| parts.iter().map(|part| part[n]).sum())
    }

    fn whole<const N: usize>(&self, cell: Cell, f: &impl Fn([f64; 3]) -> [f64; N]) -> [f64; N] {
        let (dz, dphi) = (cell.z[1] - cell.z[0], cell.phi[1] - cell.phi[0]);
        let mut sum = [0.0; N];
        for (x, wz) in self.rule {
            let z = cell.z[0] + dz * x;
            let sin = ((1.0 - z) * (1.0 + z)).sqrt();
            for (y, wphi) in self.rule {
                let (s, c) = Real::sin_cos(cell.phi[0] + dphi * y);
                let values = f([sin * c, sin * s, z]);
                for (sum, value) in sum.iter_mut().zip(values) {
                    *sum += wz * wphi * value;
                }
            }
        }
        sum.map(|sum| sum * dz * dphi)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sphere(f: impl Fn([f64; 3]) -> f64) -> Integral {
        let rule = Cubature::default();
        Cell::HEMISPHERES.iter().flat_map(|&c| rule.integrate(c, 1e-9, &|w| [f(w)])).sum()
    }

    #[test]
    fn moments_of_the_sphere_are_exact() {
        // Polynomials in z and low harmonics in φ: the rule is exact but for its tolerance.
        for (f, want) in [
            ((|_| 1.0) as fn([f64; 3]) -> f64, 4.0 * f64::PI),
            (|w| w[2], 0.0),
            (|w| w[0] * w[0], 4.0 / 3.0 * f64::PI),
        ] {
            assert!((sphere(f).value - want).abs() < 1e-8);
        }
    }

    #[test]
    fn the_error_estimate_covers_the_error_of_a_narrow_lobe() {
        // cosⁿ about z, n = 200: 2π/(n+1). (What the first points all miss is for the partition.)
        let got = sphere(|w| if w[2] > 0.0 { Real::powi(w[2], 200) } else { 0.0 });
        let error = (got.value - 2.0 * f64::PI / 201.0).abs();
        assert!(error <= got.error.max(1e-12), "{error} {}", got.error);
    }
}
