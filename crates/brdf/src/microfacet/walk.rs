//! Light followed from facet to facet: the reference of everything that scatters more than once.
//!
//! A random walk on the microsurface that Smith's model describes, with no approximation beyond it. A ray
//! is a direction and a height; heights enter through their distribution function `c = C1(height)`
//! alone, so that the walk, and with it the scattering function, is the same for uniform, Gaussian or any
//! other heights. With the random number u in `(0, 1]` the next facet lies at
//!
//! ```text
//! downwards   c' = c u^(|cos θ| / σ(−w))
//! upwards     c' = c u^(−1 / Λ(w)),  and the ray leaves where c' ≥ 1
//! ```
//!
//! There it meets a normal visible from `−w`, with density `D(h) (v·h)⁺ / σ(v)`, `v = −w` on either
//! side of the horizon, `σ(v) = |cos θ| Λ(−v)` below it.
//!
//! # Source
//! E. Heitz, J. Hanika, E. d'Eon and C. Dachsbacher, "Multiple-Scattering Microfacet BSDFs with the Smith
//! Model", SIGGRAPH 2016, algorithms 1 to 3.

mod conductor;
mod dielectric;

pub use conductor::ConductorWalk;
pub use dielectric::DielectricWalk;

use etendue_math::{Real, Spectrum, Vec3, Vector3};

use super::Microfacets;

/// Facets a path meets at most, unless another limit is set. With α = 1 and F = 1 a path meets two to three.
const MAX_ORDER: u32 = 1024;

/// A path that has left the microsurface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walked<C: Spectrum> {
    /// Direction it left in, pointing away from the surface.
    pub wi: Vec3<C::Real>,
    /// `f |cos θi| / pdf`: the product of what every facet reflected, and `1/η²` where it was refracted.
    pub weight: C,
    /// η of the medium of `wi` relative to that of `wo`: 1 unless the path was transmitted.
    pub eta: C::Real,
    /// How many facets it met.
    pub order: u32,
}

/// The height `c = C1` of the next facet on a ray from height `c` along `w`, or `None` where the ray leaves.
///
/// `u`: uniform in `[0, 1)`.
fn next_height<T: Real>(facets: &Microfacets<T>, w: Vec3<T>, c: T, u: T) -> Option<T> {
    let log = (T::ONE - u).ln();
    if w.z() > T::ZERO {
        let lambda = facets.lambda(w);
        let next = if lambda > T::ZERO { c * (-log / lambda).exp() } else { T::INFINITY };
        (next < T::ONE).then_some(next)
    } else {
        let next = c * (-w.z() / facets.projected_area(w) * log).exp();
        // From a height of 0 no ray would ever leave.
        Some(next.max(T::MIN_POSITIVE))
    }
}

/// Probability of leaving from height `c` along `w`: `c^Λ(w)`, 0 below the horizon.
fn escape<T: Real>(facets: &Microfacets<T>, w: Vec3<T>, c: T) -> T {
    if w.z() > T::ZERO { (facets.lambda(w) * c.ln()).exp() } else { T::ZERO }
}

/// Projected area σ(v) of the facets seen from `v`, which may lie below the horizon.
fn visible_area<T: Real>(facets: &Microfacets<T>, v: Vec3<T>) -> T {
    if v.z() < T::ZERO { -v.z() * facets.lambda(v) } else { facets.projected_area(v) }
}
