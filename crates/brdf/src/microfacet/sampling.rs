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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::directional_albedo;
    use crate::{Alpha, BeckmannLambda, Bsdf, ComplexIor, Masking, RoughConductor};
    use etendue_math::glam::DVec3;

    const BECKMANN: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Exact };

    fn mirror(distribution: Distribution, x: f64, y: f64) -> RoughConductor<f64> {
        let [x, y] = [x, y].map(|a| Alpha::new(a).unwrap());
        let facets = Microfacets::new(distribution, x, y, Masking::HeightCorrelated);
        RoughConductor::new(ComplexIor::perfect(), facets)
    }

    /// Mean weight of a grid of samples, and the share of them that are lost.
    fn estimate<S: NormalSampling<f64>>(model: RoughConductor<f64>, wo: DVec3) -> [f64; 2] {
        const SIDE: u32 = 128;
        let model = model.sampled_by::<S>().unwrap();
        let (mut sum, mut lost) = (0.0, 0.0);
        for k in 0..SIDE * SIDE {
            let u = [k % SIDE, k / SIDE].map(|i| (f64::from(i) + 0.5) / f64::from(SIDE));
            match model.sample(wo, 0.0, u) {
                Some(sample) => sum += sample.weight,
                None => lost += 1.0,
            }
        }
        [sum, lost].map(|x| x / f64::from(SIDE * SIDE))
    }

    #[test]
    fn every_strategy_estimates_the_same_albedo_and_bounded_caps_lose_least() {
        for (x, y) in [(0.5, 0.5), (0.3, 0.8), (1.0, 1.0)] {
            let model = mirror(Distribution::Ggx, x, y);
            for cos in [1.0, 0.6, 0.2_f64] {
                let wo = DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
                let want = directional_albedo::<_, 96>(&model, wo);
                let estimates = [
                    estimate::<AllNormals>(model, wo),
                    estimate::<ProjectedDisk>(model, wo),
                    estimate::<VisibleNormals>(model, wo),
                    estimate::<BoundedCaps>(model, wo),
                ];
                // 128² points: a lobe cut at the horizon, and for all normals a factor 1/hz.
                for ([got, _], tolerance) in estimates.into_iter().zip([3e-2, 5e-3, 5e-3, 5e-3]) {
                    assert!((got - want).abs() < tolerance, "{x} {y} {cos} {estimates:?} {want}");
                }
                let lost = estimates.map(|[_, lost]| lost);
                assert!(lost[3] <= lost[2] && lost[2] <= lost[0], "{x} {y} {cos} {lost:?}");
            }
        }
    }

    #[test]
    fn a_strategy_that_does_not_exist_for_beckmann_is_refused() {
        let model = mirror(BECKMANN, 0.3, 0.3);
        assert!(model.sampled_by::<AllNormals>().is_ok());
        assert!(model.sampled_by::<VisibleNormals>().is_ok());
        assert!(model.sampled_by::<ProjectedDisk>().is_err());
        assert!(model.sampled_by::<BoundedCaps>().is_err());
    }
}
