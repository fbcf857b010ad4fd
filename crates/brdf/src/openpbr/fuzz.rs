//! Fuzz: fibres that stand up from the surface.

use etendue_math::{Real, Spectrum, Vec3, Vector3};

use super::fuzz_table::{FuzzTable, LEAST_ROUGHNESS};
use crate::microfacet::{CosineRow, Place};

/// The lobe of fibres, and how much of the light passes between them.
///
/// ```text
/// f = fuzz_weight fuzz_color D(h) V(wo, wi),   D(h) = (2 + n) sinⁿ θh / 2π,   n = 1/roughness
/// V = 1 / (4 (cos θi σo + cos θo σi − cos θi cos θo)),   σ from a FuzzTable
/// t(μ) = 1 − fuzz_weight E(μ),  E likewise
/// ```
///
/// A roughness below 0.1 counts as 0.1.
///
/// # Source
/// A. C. Estevez and C. Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH 2017 course, eq. 2. Departure:
/// Smith's masking with the distribution's own projected area instead of the published fit of Λ, with which the lobe
/// has no bound along the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fuzz<C: Spectrum> {
    shape: FuzzShape<C::Real>,
    /// `fuzz_weight fuzz_color`
    color: C,
    /// Mean of `fuzz_color`.
    tint: C::Real,
    /// t
    through: CosineRow<C::Real>,
}

/// The lobe of white fibres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FuzzShape<T> {
    exponent: T,
    area: CosineRow<T>,
}

impl<C: Spectrum> Fuzz<C> {
    /// Fibres of the given weight, colour and roughness, all in `[0, 1]`; `None` where there are none.
    pub(super) fn new(weight: C::Real, color: C, roughness: C::Real) -> Option<Self> {
        if !(weight > C::Real::ZERO) {
            return None;
        }
        let roughness = roughness.max(C::Real::lit(LEAST_ROUGHNESS));
        let [area, passed] = FuzzTable::CHARLIE.rows(roughness);
        Some(Self {
            shape: FuzzShape::of_area(C::Real::ONE / roughness, area),
            color: color.scale(weight),
            tint: color.mean(),
            through: passed.covering(weight),
        })
    }

    /// Value for a pair above the surface with half vector `h`.
    #[inline]
    pub(super) fn value(&self, wo: Vec3<C::Real>, wi: Vec3<C::Real>, h: Vec3<C::Real>) -> C {
        self.color.scale(self.shape.value(wo, wi, h))
    }

    /// t, what passes of light at an angle.
    #[inline]
    pub(super) fn through(&self) -> &CosineRow<C::Real> {
        &self.through
    }

    /// Mean albedo of the lobe at an angle.
    #[inline]
    pub(super) fn albedo(&self, place: Place<C::Real>) -> C::Real {
        // As much as does not pass, times the colour.
        (C::Real::ONE - self.through.at(place)) * self.tint
    }
}

impl<T: Real> FuzzShape<T> {
    /// Fibres of exponent `n` with these projected areas.
    pub(super) fn of_area(exponent: T, area: CosineRow<T>) -> Self {
        Self { exponent, area }
    }

    /// `D V`
    #[inline]
    pub(super) fn value(&self, wo: Vec3<T>, wi: Vec3<T>, h: Vec3<T>) -> T {
        let [area_o, area_i] = [wo, wi].map(|w| self.area.at(Place::of(w.z())));
        // σ ≥ cos, of the interpolated σ too: nothing cancels.
        let area = wi.z() * area_o + wo.z() * (area_i - wi.z());
        let visibility = if area > T::ZERO { T::lit(0.25) / area } else { T::ZERO };
        (ndf(h, self.exponent) * visibility).min(T::MAX)
    }
}

/// `D(h) = (2 + n) sinⁿ θ / 2π` of the fibres' normals.
#[inline]
pub(super) fn ndf<T: Real>(h: Vec3<T>, n: T) -> T {
    let squared = h.x() * h.x() + h.y() * h.y();
    (T::TWO + n) * (T::HALF * T::FRAC_1_PI) * squared.powf(T::HALF * n)
}
