//! Coat: an absorbing dielectric layer.

use etendue_math::{Real, Spectrum, Vec3, Vector3};

use super::OpenPbrParameters;
use super::interface::{Interface, facets};
use crate::fresnel::{dielectric_average_fit, f0_from_ior};
use crate::microfacet::{CosineRow, Place};
use crate::{Microfacets, OpticalDepth, ParameterError};

/// The coat's own reflection, and what becomes of light that passes it.
///
/// ```text
/// f = coat_weight D F V
/// t(μ) = 1 − coat_weight E(μ)
/// a(o, i) = 1 − coat_weight (1 − coat_color^((1/μo' + 1/μi')/2)),   μ' = √(1 − (1 − μ²)/η²)
/// ```
///
/// # Source
/// OpenPBR 1.1, "Coat" and "View-dependent absorption".
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Coat<C: Spectrum> {
    weight: C::Real,
    interface: Interface<C::Real>,
    /// `None` for a mirror.
    facets: Option<Microfacets<C::Real>>,
    /// t
    through: CosineRow<C::Real>,
    /// `−½ ln coat_color`
    depth: OpticalDepth<C>,
}

impl<C: Spectrum> Coat<C> {
    /// `None` where there is no coat.
    pub(super) fn new(p: &OpenPbrParameters<C>) -> Result<Option<Self>, ParameterError> {
        if !(p.coat_weight > C::Real::ZERO) {
            return Ok(None);
        }
        let facets = facets(p.coat_roughness, p.coat_roughness_anisotropy)?;
        let interface = Interface::of_excess(p.coat_ior - C::Real::ONE);
        let passed = interface.passed(p.coat_roughness, facets.is_none());
        // Finite for black, which it makes black.
        let depth =
            p.coat_color.map(|c| (-C::Real::HALF * c.ln()).clamp_to(C::Real::ZERO, C::Real::MAX));
        Ok(Some(Self {
            weight: p.coat_weight,
            interface,
            facets,
            through: passed.covering(p.coat_weight),
            depth: OpticalDepth::new(depth)?,
        }))
    }

    /// Facets; `None` for a mirror.
    #[inline]
    pub(super) fn facets(&self) -> Option<&Microfacets<C::Real>> {
        self.facets.as_ref()
    }

    /// `coat_weight F(c)`
    #[inline]
    pub(super) fn reflectance(&self, cos: C::Real) -> C::Real {
        self.weight * self.interface.reflectance(cos)
    }

    /// t, what passes of light at an angle, but for absorption.
    #[inline]
    pub(super) fn through(&self) -> &CosineRow<C::Real> {
        &self.through
    }

    /// The albedo of the coat's reflection at an angle.
    #[inline]
    pub(super) fn albedo(&self, place: Place<C::Real>) -> C::Real {
        C::Real::ONE - self.through.at(place)
    }

    /// a, what absorption leaves of light that comes in along `wi` and goes out along `wo`.
    #[inline]
    pub(super) fn absorption(&self, wo: Vec3<C::Real>, wi: Vec3<C::Real>) -> C {
        let passed = [wo, wi]
            .map(|w| self.depth.transmittance(self.interface.cos_inside(w.z().min(C::Real::ONE))));
        (passed[0] * passed[1]).map(|t| (C::Real::ONE - self.weight) + self.weight * t)
    }
}

/// The factor by which light that the coat sends back to a base of albedo `base` darkens it.
///
/// ```text
/// Δ = (1 − K) / (1 − E_b K),   K = lerp(F0, 1 − (1 − F_avg)/η², r_b)
/// factor = lerp(1, Δ, coat_weight coat_darkening)
/// ```
///
/// with `roughness` r_b, that of the base as a whole. F_avg by [`dielectric_average_fit`].
///
/// # Source
/// OpenPBR 1.1, "Darkening". Departure: the K of a smooth base is F0, that of a view along the normal, for which the
/// darkening is defined; by the view's own angle it would not be reciprocal.
pub(super) fn darkening<C: Spectrum>(p: &OpenPbrParameters<C>, base: C, roughness: C::Real) -> C {
    let one = C::Real::ONE;
    let eta = p.coat_ior;
    let smooth = one - f0_from_ior(eta);
    let rough = (one - dielectric_average_fit(eta).max(C::Real::ZERO)) / (eta * eta);
    // 1 − K, which is positive: nothing cancels in 1 − E_b K = (1 − K) + K (1 − E_b).
    let leaving = smooth + (rough - smooth) * roughness;
    let share = p.coat_weight * p.coat_darkening;
    base.map(|e| {
        let delta = leaving / (leaving + (one - leaving) * (one - e).max(C::Real::ZERO));
        (one - share) + share * delta
    })
}
