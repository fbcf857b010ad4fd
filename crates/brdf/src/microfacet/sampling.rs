//! How facet normals are drawn for reflection: strategies side by side.
//!
//! Each strategy is a type without data, chosen when a model's type is written: nothing is decided per
//! sample. All of them draw `h` with density `D(h) (wo·h) / A`, so that one number A says everything:
//!
//! ```text
//! pdf(h) = D(h) (wo·h) / A,  pdf(wi) = D(h) / (4 A),  weight = F 4 cos θi A V
//! ```
//!
//! | strategy | A | GGX | Beckmann |
//! | --- | --- | --- | --- |
//! | [`AllNormals`] | `(wo·h) / hz` | yes | yes |
//! | [`VisibleNormals`] | `σ(wo)` | by spherical caps | slopes by Newton's method |
//! | [`ProjectedDisk`] | `σ(wo)` | yes | no |
//! | [`BoundedCaps`] | `½ (k z + …) ≤ σ(wo)` | yes | no |

use core::fmt::Debug;

use etendue_math::{Real, Vec3, Vector3};

use super::{Distribution, Microfacets, beckmann, ggx};

/// A way of drawing facet normals for a view direction above the surface; see the [module](self).
pub trait NormalSampling<T: Real>: Copy + Debug + PartialEq + Send + Sync + 'static {
    /// Whether the strategy exists for a distribution; a model refuses it at construction otherwise.
    fn supports(distribution: Distribution) -> bool;

    /// Draws a normal for `wo`, a unit vector above the surface, from two uniforms in `[0, 1)`. `None` where
    /// the drawn facet cannot be seen from `wo`, or vectors underflow.
    fn sample(facets: &Microfacets<T>, wo: Vec3<T>, u: [T; 2]) -> Option<Vec3<T>>;

    /// A, the area that the strategy's density is divided by. `cos` is `wo·h`, positive.
    fn area(facets: &Microfacets<T>, wo: Vec3<T>, h: Vec3<T>, cos: T) -> T;
}

/// Normals of all facets, density `D(h) hz`: visible or not.
///
/// For comparison: facets that face away from `wo` are lost, and weights `G2 (wo·h) / (cos θo hz)` have no
/// bound at grazing angles.
///
/// # Source
/// B. Walter et al., EGSR 2007, section 5.3.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AllNormals;

/// Normals of the facets that `wo` sees, density `D(h) (wo·h) / σ(wo)`; weights `G2/G1 ≤ 1`.
///
/// See [`ggx::sample_visible_normal`] and [`beckmann::sample_visible_normal`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VisibleNormals;

/// The density of [`VisibleNormals`] through the projected hemisphere, the map of 2018; GGX.
///
/// Each map carries the strata of low-discrepancy points over in its own way; densities and weights are
/// the same. See [`ggx::sample_visible_normal_by_disk`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ProjectedDisk;

/// Visible normals without most of those whose reflection falls below the surface; GGX.
///
/// Fewer samples are lost; see [`ggx::sample_bounded_normal`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoundedCaps;

impl<T: Real> NormalSampling<T> for AllNormals {
    #[inline(always)]
    fn supports(_: Distribution) -> bool {
        true
    }
    #[inline(always)]
    fn sample(facets: &Microfacets<T>, wo: Vec3<T>, u: [T; 2]) -> Option<Vec3<T>> {
        let [x, y] = facets.widths();
        let h = match facets.distribution() {
            Distribution::Ggx => ggx::sample_normal(x, y, u),
            Distribution::Beckmann { .. } => beckmann::sample_normal(x, y, u),
        };
        h.filter(|&h| wo.dot(h) > T::ZERO)
    }
    #[inline(always)]
    fn area(_: &Microfacets<T>, _: Vec3<T>, h: Vec3<T>, cos: T) -> T {
        cos / h.z()
    }
}

impl<T: Real> NormalSampling<T> for VisibleNormals {
    #[inline(always)]
    fn supports(_: Distribution) -> bool {
        true
    }
    #[inline(always)]
    fn sample(facets: &Microfacets<T>, wo: Vec3<T>, u: [T; 2]) -> Option<Vec3<T>> {
        facets.sample_visible_normal(wo, u)
    }
    #[inline(always)]
    fn area(facets: &Microfacets<T>, wo: Vec3<T>, _: Vec3<T>, _: T) -> T {
        facets.projected_area(wo)
    }
}

impl<T: Real> NormalSampling<T> for ProjectedDisk {
    #[inline(always)]
    fn supports(distribution: Distribution) -> bool {
        distribution == Distribution::Ggx
    }
    #[inline(always)]
    fn sample(facets: &Microfacets<T>, wo: Vec3<T>, u: [T; 2]) -> Option<Vec3<T>> {
        let [x, y] = facets.widths();
        ggx::sample_visible_normal_by_disk(wo, x, y, u)
    }
    #[inline(always)]
    fn area(facets: &Microfacets<T>, wo: Vec3<T>, _: Vec3<T>, _: T) -> T {
        facets.projected_area(wo)
    }
}

impl<T: Real> NormalSampling<T> for BoundedCaps {
    #[inline(always)]
    fn supports(distribution: Distribution) -> bool {
        distribution == Distribution::Ggx
    }
    #[inline(always)]
    fn sample(facets: &Microfacets<T>, wo: Vec3<T>, u: [T; 2]) -> Option<Vec3<T>> {
        let [x, y] = facets.widths();
        ggx::sample_bounded_normal(wo, x, y, u)
    }
    #[inline(always)]
    fn area(facets: &Microfacets<T>, wo: Vec3<T>, _: Vec3<T>, _: T) -> T {
        let [x, y] = facets.widths();
        ggx::bounded_area(wo, x, y)
    }
}
