//! The interface of coupled models: one Fresnel term for both shares.

use etendue_math::{Real, Spectrum};

use crate::fresnel::{
    dielectric, dielectric_average_transmittance, dielectric_transmittance, schlick,
    schlick_of_versine, schlick_transmittance,
};
use crate::registry::ParameterInfo;
use crate::registry::parameter::named;
use crate::{Ior, ParameterError, Reflectance};

/// What a [`Coupled`](crate::Coupled) surface reflects at its interface, and the matte term that goes with it:
/// computed once per material.
///
/// ```text
/// matte(θo, θi) = k (1 − F(θo)) (1 − F(θi)),   k = 1 / (π (1 − F_avg))
/// ```
///
/// so that `F(θ) + ∫ matte cos θi dωi = 1` for every θ. One F in both shares: a mirror by the exact F over a
/// matte term by Schlick's gains up to 2.3 % of energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoupledInterface<C: Spectrum> {
    fresnel: Fresnel<C>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Fresnel<C: Spectrum> {
    Schlick {
        r0: C,
    },
    Dielectric {
        eta: C::Real,
        /// `k = 1 / (π T_avg)`
        normalisation: C::Real,
    },
}

impl<C: Spectrum> CoupledInterface<C> {
    /// By Schlick's approximation with reflectance `r0` at normal incidence: `k = 21 / (20 π (1 − R0))`.
    #[inline]
    pub fn schlick(r0: Reflectance<C>) -> Self {
        Self { fresnel: Fresnel::Schlick { r0: r0.value() } }
    }

    /// By the exact Fresnel reflectance of a dielectric with relative index `eta`: `k = 1 / (π (1 − F_avg))`.
    ///
    /// 48 evaluations for F_avg.
    ///
    /// # Errors
    /// [`ParameterError`] for an index below 1: a coat that is thinner than the air outside would reflect
    /// everything beyond its critical angle and leave its base black there.
    pub fn dielectric(eta: Ior<C::Real>) -> Result<Self, ParameterError> {
        let eta = eta.value();
        if eta < C::Real::ONE {
            return Err(ParameterError::number("eta", eta, "in [1, 1e4]"));
        }
        let normalisation = C::Real::FRAC_1_PI / dielectric_average_transmittance(eta);
        Ok(Self { fresnel: Fresnel::Dielectric { eta, normalisation } })
    }

    /// F, per channel in `[0, 1]`.
    #[inline(always)]
    pub(super) fn reflectance(&self, cos: C::Real) -> C {
        match self.fresnel {
            Fresnel::Schlick { r0 } => schlick(r0, cos),
            Fresnel::Dielectric { eta, .. } => C::splat(dielectric(cos, eta)),
        }
    }

    /// F at a facet, of the cosine to it and of `versine = 1 − cos`, which two directions near each other know to
    /// more digits: their `(1 − cos)⁵` would have none left.
    #[inline(always)]
    pub(super) fn facet_reflectance(&self, cos: C::Real, versine: C::Real) -> C {
        match self.fresnel {
            Fresnel::Schlick { r0 } => schlick_of_versine(r0, versine.min(C::Real::ONE)),
            Fresnel::Dielectric { eta, .. } => C::splat(dielectric(cos, eta)),
        }
    }

    /// `1 − F` to its own last digits.
    #[inline(always)]
    pub(super) fn transmittance(&self, cos: C::Real) -> C {
        match self.fresnel {
            Fresnel::Schlick { r0 } => schlick_transmittance(r0, cos),
            Fresnel::Dielectric { eta, .. } => C::splat(dielectric_transmittance(cos, eta)),
        }
    }

    /// The matte term of a white base, in sr⁻¹.
    #[inline(always)]
    pub(super) fn matte(&self, cos_o: C::Real, cos_i: C::Real) -> C {
        match self.fresnel {
            // k (1 − R0)² with one factor cancelled: 0, not 0/0, at R0 = 1.
            Fresnel::Schlick { r0 } => {
                let black = C::black();
                let [q_o, q_i] = [cos_o, cos_i].map(|c| schlick_transmittance(black, c));
                let factor = C::Real::lit(21.0 / 20.0) * C::Real::FRAC_1_PI;
                (q_o * q_i).zip(r0, |q, r| factor * (C::Real::ONE - r) * q)
            }
            Fresnel::Dielectric { eta, normalisation } => {
                let [t_o, t_i] = [cos_o, cos_i].map(|c| dielectric_transmittance(c, eta));
                C::splat((normalisation * t_o) * t_i)
            }
        }
    }
}

/// The interface as registry entries list it.
pub(super) const PARAMETER: ParameterInfo =
    named("r0", "each channel in [0, 1] (Schlick); or instead eta in [1, 1e4] (exact dielectric)");
/// The base likewise.
pub(super) const MATTE: ParameterInfo = named("rm", "each channel in [0, 1]");
