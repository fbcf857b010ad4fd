//! Light trapped between a dielectric interface and the diffuse base below it.

use etendue_math::{Real, Spectrum};

/// How the diffuse base of a plastic reacts to light the interface sends back to it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InternalScattering {
    /// `ρ / (1 − F_in)`: colours keep their hue; exact for a white base only.
    #[default]
    Linear,
    /// `ρ / (1 − ρ F_in)`: every reflection multiplies by ρ again; colours darken and saturate.
    NonLinear,
}

impl InternalScattering {
    /// The base's reflectance with all internal reflections summed, as seen through the interface.
    ///
    /// `internal` is F_in, the average reflectance of the interface for diffuse light from below.
    #[inline]
    pub(crate) fn base<C: Spectrum>(self, diffuse: C, internal: C::Real) -> C {
        let one = <C::Real as Real>::ONE;
        match self {
            Self::Linear => diffuse.scale(one / (one - internal)),
            Self::NonLinear => diffuse.map(|rho| rho / (one - rho * internal)),
        }
    }
}

/// Which number stands for the average internal reflectance F_in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InternalReflectance {
    /// The integral, by quadrature.
    #[default]
    Exact,
    /// What Mitsuba computes, so that pictures agree: the fit of
    /// [`dielectric_average_fit`](crate::fresnel::dielectric_average_fit) for the smooth interface
    /// (0.6 % off), an unweighted mean over 64 cosines for the rough one (1.5 % off).
    Mitsuba,
}

/// Probability of the specular lobe among specular and diffuse.
///
/// ```text
/// p = F s / (F s + (1 − F)(1 − s)),  s = mean(ks) / (mean(ks) + mean(kd))
/// ```
///
/// 0 where both lobes are black.
#[inline]
pub(crate) fn specular_probability<T: Real>(reflectance: T, transmittance: T, share: T) -> T {
    let specular = reflectance * share;
    let sum = specular + transmittance * (T::ONE - share);
    if sum > T::ZERO { specular / sum } else { T::ZERO }
}

/// The share `s` of [`specular_probability`].
#[inline]
pub(crate) fn specular_share<C: Spectrum>(specular: C, diffuse: C) -> C::Real {
    let sum = specular.mean() + diffuse.mean();
    if sum > C::Real::ZERO { specular.mean() / sum } else { C::Real::ZERO }
}
