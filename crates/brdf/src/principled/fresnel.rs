//! Reflectances that blend glass, tinted glass and metal.

use etendue_math::{Real, Spectrum};

use crate::fresnel::{RelativeIndex, f0_from_ior};

/// Schlick's weight `(1 − c)⁵` with `c` the cosine on the side of the thinner medium: that of
/// refraction where η ≤ 1, 0 under total internal reflection.
#[inline]
pub(super) fn schlick_weight<T: Real>(index: RelativeIndex<T>, cos: T) -> T {
    let eta = index.eta();
    let c = if eta > T::ONE {
        cos
    } else {
        index.scaled_cos_t(cos).map_or(T::ZERO, |g| (g / eta).min(T::ONE))
    };
    fifth_power(c)
}

/// `(1 − c)⁵` with `1 − c` limited to `[0, 1]`.
#[inline]
pub(super) fn fifth_power<T: Real>(c: T) -> T {
    let m = (T::ONE - c).clamp_to(T::ZERO, T::ONE);
    (m * m) * (m * m) * m
}

/// A colour divided by its luminance; white for black.
pub(super) fn tint<C: Spectrum>(color: C) -> C {
    let luminance = color.luminance();
    if luminance > C::Real::ZERO { color.map(|c| c / luminance) } else { C::white() }
}

/// Reflectance of a facet as a blend of the exact dielectric one and Schlick's with two colours.
///
/// ```text
/// F = (1 − m)(1 − t) F_dielectric + m S(base) + (1 − m) t S(tint(base) F0),   S(c) = c + (1 − c) w
/// ```
///
/// with metallic m, spec_tint t and `w` of [`schlick_weight`]. `tint(base) F0` may exceed 1 for saturated
/// colours, and F with it, as in Mitsuba.
///
/// # Source
/// Mitsuba 3, principledhelpers.h, `principled_fresnel` and `thin_fresnel` (m = 0).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BlendedFresnel<C: Spectrum> {
    dielectric: C::Real,
    /// What does not depend on the angle.
    constant: C,
    /// Factor of the weight w.
    slope: C,
}

impl<C: Spectrum> BlendedFresnel<C> {
    /// `metallic`, `spec_tint` in `[0, 1]`, `eta` a valid index.
    pub(super) fn new(base: C, metallic: C::Real, spec_tint: C::Real, eta: C::Real) -> Self {
        let one = <C::Real as Real>::ONE;
        let tinted = (one - metallic) * spec_tint;
        let f0 = tint(base).scale(f0_from_ior(eta));
        let constant = base.scale(metallic) + f0.scale(tinted);
        Self {
            dielectric: (one - metallic) * (one - spec_tint),
            constant,
            slope: base.map(|c| (one - c) * metallic) + f0.map(|c| (one - c) * tinted),
        }
    }

    /// F at `cos = wo·h`, given the exact dielectric reflectance there.
    #[inline]
    pub(super) fn reflectance(
        &self,
        index: RelativeIndex<C::Real>,
        cos: C::Real,
        dielectric: C::Real,
    ) -> C {
        let weight = schlick_weight(index, cos);
        let exact = self.dielectric * dielectric;
        // Not negative: rounding may leave −ε where F0 > 1 meets w = 1.
        self.constant.zip(self.slope, |a, b| (exact + (a + b * weight)).max(C::Real::ZERO))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::Rgb;

    #[test]
    fn a_metal_starts_at_its_colour_and_ends_white() {
        let base = Rgb::new(0.9_f64, 0.5, 0.1);
        let (fresnel, index) =
            (BlendedFresnel::new(base, 1.0, 0.7, 1.5), RelativeIndex::from_above(1.5));
        assert_eq!(fresnel.reflectance(index, 1.0, 0.04), base);
        let grazing = fresnel.reflectance(index, 0.0, 1.0);
        // Two roundings of numbers below 1.
        assert!(grazing.to_array().iter().all(|c| (c - 1.0).abs() < 1e-15), "{grazing:?}");
    }

    #[test]
    fn without_metal_and_tint_the_exact_reflectance_is_left() {
        let fresnel = BlendedFresnel::new(0.3_f64, 0.0, 0.0, 1.5);
        assert_eq!(fresnel.reflectance(RelativeIndex::from_above(1.5), 0.4, 0.123), 0.123);
    }
}
