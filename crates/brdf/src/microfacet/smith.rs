//! A rough surface: distribution, widths and masking put together.

use etendue_math::{Real, Vec3, Vector3};

use super::{BeckmannLambda, Distribution, beckmann, ggx};
use crate::Alpha;

/// How shadowing and masking are combined into G2.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Masking {
    /// `G2 = 1 / (1 + Λi + Λo)`: facets of the same height are seen by both directions.
    #[default]
    HeightCorrelated,
    /// `G2 = G1(wi) G1(wo)`: independent; darker, and the older convention (Walter 2007, Mitsuba).
    Separable,
}

/// A microfacet surface in the local frame.
///
/// Directions below the surface count as their mirror images: transmission masks with them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Microfacets<T> {
    distribution: Distribution,
    masking: Masking,
    alpha_x: T,
    alpha_y: T,
}

impl<T: Real> Microfacets<T> {
    /// A surface with width `alpha_x` along the first and `alpha_y` along the second tangent.
    #[inline]
    pub fn new(
        distribution: Distribution,
        alpha_x: Alpha<T>,
        alpha_y: Alpha<T>,
        masking: Masking,
    ) -> Self {
        Self { distribution, masking, alpha_x: alpha_x.value(), alpha_y: alpha_y.value() }
    }

    /// Height-correlated GGX facets with the same width in every direction.
    #[inline]
    pub fn ggx(alpha: Alpha<T>) -> Self {
        Self::new(Distribution::Ggx, alpha, alpha, Masking::HeightCorrelated)
    }

    /// The same surface in double precision.
    pub(crate) fn in_double(&self) -> Microfacets<f64> {
        let [alpha_x, alpha_y] = self.widths().map(T::to_f64);
        Microfacets { distribution: self.distribution, masking: self.masking, alpha_x, alpha_y }
    }

    /// Distribution of the facets' normals.
    #[inline(always)]
    pub fn distribution(&self) -> Distribution {
        self.distribution
    }

    /// How shadowing and masking are combined.
    #[inline(always)]
    pub fn masking(&self) -> Masking {
        self.masking
    }

    /// The widths `[αx, αy]`.
    #[inline(always)]
    pub fn widths(&self) -> [T; 2] {
        [self.alpha_x, self.alpha_y]
    }

    /// Density of facet normals D(h); see [`ggx::ndf`] and [`beckmann::ndf`].
    #[inline]
    pub fn ndf(&self, h: Vec3<T>) -> T {
        match self.distribution {
            Distribution::Ggx => ggx::ndf(h, self.alpha_x, self.alpha_y),
            Distribution::Beckmann { .. } => beckmann::ndf(h, self.alpha_x, self.alpha_y),
        }
    }

    /// Smith's Λ of a direction, 0 where it is undefined (`w.z = 0`).
    #[inline]
    pub fn lambda(&self, w: Vec3<T>) -> T {
        let w = upright(w);
        if !(w.z() > T::ZERO) {
            return T::ZERO;
        }
        match self.distribution {
            Distribution::Ggx => ggx::lambda(w, self.alpha_x, self.alpha_y),
            Distribution::Beckmann { lambda: BeckmannLambda::Exact } => {
                beckmann::lambda(w, self.alpha_x, self.alpha_y)
            }
            Distribution::Beckmann { lambda: BeckmannLambda::Walter } => {
                self.masking_area(w) / w.z() - T::ONE
            }
        }
    }

    /// Projected area σ(w) of the visible facets, exact: what normalises their density.
    #[inline]
    pub fn projected_area(&self, w: Vec3<T>) -> T {
        let w = upright(w);
        match self.distribution {
            Distribution::Ggx => ggx::projected_area(w, self.alpha_x, self.alpha_y),
            Distribution::Beckmann { .. } => {
                beckmann::projected_area(w, self.alpha_x, self.alpha_y)
            }
        }
    }

    /// `cos θ / G1(w)`, which is σ(w) except where a fit of G1 was asked for.
    #[inline(always)]
    fn masking_area(&self, w: Vec3<T>) -> T {
        match self.distribution {
            Distribution::Beckmann { lambda: BeckmannLambda::Walter } => {
                beckmann::projected_area_walter(upright(w), self.alpha_x, self.alpha_y)
            }
            _ => self.projected_area(w),
        }
    }

    /// Masking of one direction, `G1(w) = cos θ / σ(w)` in `[0, 1]`.
    #[inline]
    pub fn g1(&self, w: Vec3<T>) -> T {
        let area = self.masking_area(w);
        if area > T::ZERO { w.z().abs() / area } else { T::ZERO }
    }

    /// Joint masking and shadowing `G2(wo, wi)` in `[0, 1]`.
    #[inline]
    pub fn g2(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        T::lit(4.0) * wo.z().abs() * wi.z().abs() * self.visibility(wo, wi)
    }

    /// `V = G2(wo, wi) / (4 |cos θo cos θi|)`; see the [module](super) for the form. 0 where both
    /// cosines vanish.
    #[inline(always)]
    pub fn visibility(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        let (area_o, area_i) = (self.masking_area(wo), self.masking_area(wi));
        let area = match self.masking {
            Masking::Separable => area_o * area_i,
            Masking::HeightCorrelated => {
                let (o, i) = (wo.z().abs(), wi.z().abs());
                // σ ≥ cos: the bracket is not negative, and nothing cancels.
                o * area_i + i * (area_o - o)
            }
        };
        // Bounded: for directions far from unit length the product of areas is subnormal.
        if area > T::ZERO { (T::ONE / (T::lit(4.0) * area)).min(T::MAX) } else { T::ZERO }
    }

    /// `G2(wo, wi) / G1(wo)` with the exact G1: the weight of a visible normal drawn for `wo`.
    #[inline]
    pub fn weight(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.weight_of_area(wo, wi, self.projected_area(wo))
    }

    /// `4 cos θi A V`: the weight of a reflection at a normal drawn with density `D(h) (wo·h) / A`.
    #[inline]
    pub fn weight_of_area(&self, wo: Vec3<T>, wi: Vec3<T>, area: T) -> T {
        T::lit(4.0) * wi.z().abs() * area * self.visibility(wo, wi)
    }

    /// A facet normal visible from `wo` (above the surface); see [`ggx::sample_visible_normal`] and
    /// [`beckmann::sample_visible_normal`].
    #[inline(always)]
    pub fn sample_visible_normal(&self, wo: Vec3<T>, u: [T; 2]) -> Option<Vec3<T>> {
        match self.distribution {
            Distribution::Ggx => ggx::sample_visible_normal(wo, self.alpha_x, self.alpha_y, u),
            Distribution::Beckmann { .. } => {
                beckmann::sample_visible_normal(wo, self.alpha_x, self.alpha_y, u)
            }
        }
    }
}

/// `w`, or its mirror image when it points below the surface.
#[inline(always)]
fn upright<V: Vector3>(w: V) -> V {
    if w.z() < V::Scalar::ZERO { w.flip_z() } else { w }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::glam::DVec3;
    use etendue_math::quadrature::gauss_legendre;

    const EXACT: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Exact };
    const WALTER: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Walter };

    fn facets(distribution: Distribution, x: f64, y: f64, masking: Masking) -> Microfacets<f64> {
        Microfacets::new(distribution, Alpha::new(x).unwrap(), Alpha::new(y).unwrap(), masking)
    }

    fn polar(cos: f64, phi: f64) -> DVec3 {
        let sin = (1.0 - cos * cos).sqrt();
        DVec3::new(sin * Real::cos(phi), sin * Real::sin(phi), cos)
    }

    /// `∫ D(h) g(h) dh` over the upper hemisphere.
    fn integrate(facets: &Microfacets<f64>, g: impl Fn(DVec3) -> DVec3) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for (t, w) in gauss_legendre::<f64, 96>() {
            for i in 0..192 {
                // cos θ = 1 − t² crowds the nodes around the normal.
                let h = polar(1.0 - t * t, f64::PI * (f64::from(i) + 0.5) / 96.0);
                sum += g(h) * (facets.ndf(h) * w * 2.0 * t * f64::PI / 96.0);
            }
        }
        sum
    }

    #[test]
    fn the_facets_cover_the_mean_surface_and_the_visible_ones_their_projected_area() {
        for distribution in [Distribution::Ggx, EXACT] {
            let facets = facets(distribution, 0.3, 0.6, Masking::Separable);
            let covered = integrate(&facets, |h| DVec3::splat(h.z)).x;
            assert!((covered - 1.0).abs() < 1e-5, "{distribution:?} {covered}");
            for cos in [1.0, 0.6, 0.2] {
                let w = polar(cos, 0.7);
                let seen = integrate(&facets, |h| DVec3::splat(w.dot(h).max(0.0))).x;
                // The kink of max(w·h, 0) limits the rule.
                assert!((seen - facets.projected_area(w)).abs() < 1e-4, "{distribution:?} {cos}");
            }
        }
    }

    #[test]
    fn sampled_normals_have_the_moments_of_the_visible_ones() {
        for distribution in [Distribution::Ggx, EXACT] {
            let facets = facets(distribution, 0.3, 0.6, Masking::Separable);
            for cos in [1.0, 0.6, 0.2] {
                let w = polar(cos, 0.7);
                let area = facets.projected_area(w);
                // First moments, and second ones of the same vector.
                for moment in [|h: DVec3| h, |h: DVec3| h * h] {
                    let want = integrate(&facets, |h| moment(h) * (w.dot(h).max(0.0) / area));
                    let mut mean = DVec3::ZERO;
                    for i in 0..128 {
                        for j in 0..128 {
                            let u = [(f64::from(i) + 0.5) / 128.0, (f64::from(j) + 0.5) / 128.0];
                            let h = facets.sample_visible_normal(w, u).unwrap();
                            mean += moment(h) / 16384.0;
                        }
                    }
                    // Midpoint rule on 128² points of a map with steep corners.
                    assert!((mean - want).length() < 1e-3, "{distribution:?} {cos} {mean} {want}");
                }
            }
        }
    }

    #[test]
    fn masking_stays_within_zero_and_one_and_joint_masking_is_darker_when_separable() {
        for cos in [1.0, 0.5, 1e-2, 1e-5, 1e-9] {
            let (a, b) = (polar(cos, 0.3), polar(0.4, 2.0));
            for distribution in [Distribution::Ggx, EXACT, WALTER] {
                let joint = |masking| facets(distribution, 0.4, 0.4, masking).g2(a, b);
                let (high, low) = (joint(Masking::HeightCorrelated), joint(Masking::Separable));
                assert!(low <= high * (1.0 + 1e-14) && low >= 0.0 && high <= 1.0 + 1e-14);
                let g1 = facets(distribution, 0.4, 0.4, Masking::Separable).g1(a);
                assert!((0.0..=1.0 + 1e-14).contains(&g1), "{distribution:?} {cos} {g1}");
            }
        }
    }

    #[test]
    fn walters_fit_is_as_good_as_it_says() {
        for i in 1..=200 {
            let w = polar(f64::from(i) / 200.0, 0.0);
            let g1 = |distribution| facets(distribution, 0.5, 0.5, Masking::Separable).g1(w);
            assert!((g1(WALTER) / g1(EXACT) - 1.0).abs() < 3.6e-3, "{i}");
        }
    }

    #[test]
    fn a_narrow_lobe_keeps_its_digits_in_single_precision() {
        use etendue_math::glam::Vec3 as Vec3f;
        for alpha in [1e-2_f32, 1e-4, 1e-6, 1e-8] {
            let h = Vec3f::new(alpha * 0.7, alpha * 0.4, 1.0);
            let wide = h.as_dvec3();
            let a = f64::from(alpha);
            for (narrow, exact) in [
                (ggx::ndf::<f32>(h, alpha, alpha), ggx::ndf::<f64>(wide, a, a)),
                (beckmann::ndf::<f32>(h, alpha, alpha), beckmann::ndf::<f64>(wide, a, a)),
            ] {
                // A dozen roundings.
                assert!((f64::from(narrow) / exact - 1.0).abs() < 12.0 * f64::from(f32::EPSILON));
            }
        }
    }
}
