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
    #[inline]
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
    #[inline]
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
        if area > T::ZERO { T::ONE / (T::lit(4.0) * area) } else { T::ZERO }
    }

    /// `G2(wo, wi) / G1(wo)` with the exact G1: the weight of a visible normal drawn for `wo`.
    #[inline]
    pub fn weight(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        T::lit(4.0) * wi.z().abs() * self.projected_area(wo) * self.visibility(wo, wi)
    }

    /// A facet normal visible from `wo` (above the surface); see [`ggx::sample_visible_normal`] and
    /// [`beckmann::sample_visible_normal`].
    #[inline]
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
