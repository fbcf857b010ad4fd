//! Beer–Lambert absorption inside a medium.

use etendue_math::{Real, Spectrum};

use crate::param::not_negative;
use crate::{OpticalDepth, ParameterError, Reflectance};

/// Absorption coefficient σa of a medium per channel, in the inverse of the unit of length.
/// Domain: finite, not negative.
///
/// What a path through a medium loses is decided by where it entered and left, not by the surface it leaves
/// through: the coefficient belongs to the medium, and its owner multiplies by
/// [`transmittance`](Self::transmittance) for every segment inside.
///
/// # Source
/// A. Beer 1852, J. H. Lambert 1760 (P. Bouguer 1729).
///
/// # Examples
/// ```
/// use etendue_brdf::{Absorption, Reflectance};
/// // Green glass: 80 % of green and 40 % of the rest pass through 2 units of it.
/// let color = etendue_math::Rgb::new(0.4_f64, 0.8, 0.4);
/// let glass = Absorption::from_transmittance(Reflectance::new(color)?, 2.0)?;
/// assert!((glass.transmittance(4.0).g - 0.64).abs() < 1e-15);
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Absorption<C>(C);

impl<C: Spectrum> Absorption<C> {
    /// Checks every channel.
    ///
    /// # Errors
    /// [`ParameterError`] where a channel is negative, infinite or NaN.
    pub fn new(sigma_a: C) -> Result<Self, ParameterError> {
        for i in 0..C::CHANNELS {
            not_negative("sigma_a", sigma_a.channel(i))?;
        }
        Ok(Self(sigma_a))
    }

    /// The medium of which `distance` lets the given colour pass.
    ///
    /// ```text
    /// σa = −ln(T) / d
    /// ```
    ///
    /// # Errors
    /// [`ParameterError`] where the distance is not positive and finite, where a channel of the colour is 0
    /// (nothing passes a finite coefficient), or where the coefficient would not be finite.
    pub fn from_transmittance(
        transmittance: Reflectance<C>,
        distance: C::Real,
    ) -> Result<Self, ParameterError> {
        if !(distance > C::Real::ZERO && distance < C::Real::INFINITY) {
            return Err(ParameterError::number("distance", distance, "positive and finite"));
        }
        let color = transmittance.value();
        for i in 0..C::CHANNELS {
            if color.channel(i) == C::Real::ZERO {
                let value = color.channel(i);
                return Err(ParameterError::number("transmittance", value, "above 0"));
            }
        }
        Self::new(color.map(|t| -t.ln() / distance))
    }

    /// A medium that absorbs nothing.
    pub fn none() -> Self {
        Self(C::black())
    }

    /// σa.
    #[inline(always)]
    pub fn value(self) -> C {
        self.0
    }

    /// Optical depth `τ = σa d` of a layer of thickness `distance`.
    ///
    /// # Errors
    /// [`ParameterError`] where the thickness is negative, infinite or NaN, or τ is not finite.
    pub fn depth(self, distance: C::Real) -> Result<OpticalDepth<C>, ParameterError> {
        OpticalDepth::new(self.0.scale(not_negative("distance", distance)?))
    }

    /// The share of light left after `distance`, per channel in `[0, 1]`.
    ///
    /// ```text
    /// T = exp(−σa d)
    /// ```
    ///
    /// * `distance`: d, finite and not negative, in the unit of length; 0 is returned outside.
    ///
    /// # Precision
    /// 1 ulp of the exponential and half an ulp of the product, which it amplifies by σa d. Underflows to 0.
    #[inline]
    pub fn transmittance(self, distance: C::Real) -> C {
        if !(distance >= C::Real::ZERO && distance < C::Real::INFINITY) {
            return C::black();
        }
        self.0.map(|sigma| (-(sigma * distance)).exp())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::Rgb;

    #[test]
    fn segments_multiply() {
        let medium = Absorption::new(Rgb::new(0.0_f64, 0.5, 3.0)).unwrap();
        let (whole, parts) =
            (medium.transmittance(3.0), medium.transmittance(1.0) * medium.transmittance(2.0));
        for i in 0..3 {
            // Exponents up to 9, rounded once.
            let relative = parts.channel(i) / whole.channel(i) - 1.0;
            assert!(relative.abs() < 1e-14, "{i} {relative}");
        }
        assert_eq!(whole.r, 1.0);
    }

    #[test]
    fn the_colour_at_a_distance_is_the_one_asked_for() {
        let color = Reflectance::new(Rgb::new(1.0, 0.25, 1e-6)).unwrap();
        let passed = Absorption::from_transmittance(color, 0.3).unwrap().transmittance(0.3);
        for i in 0..3 {
            let (got, want) = (passed.channel(i), color.value().channel(i));
            assert!((got / want - 1.0).abs() < 1e-14, "{got} {want}");
        }
    }

    #[test]
    fn a_layer_passes_what_the_path_through_it_does() {
        let medium = Absorption::new(0.7_f64).unwrap();
        let layer = medium.depth(2.0).unwrap();
        // One rounding of the exponent more.
        assert!((layer.transmittance(0.5) / medium.transmittance(4.0) - 1.0).abs() < 1e-15);
        assert!((layer.absorptance(0.5) + layer.transmittance(0.5) - 1.0).abs() < 1e-15);
        let thin = Absorption::new(1e-6_f32).unwrap().depth(1e-6).unwrap();
        assert!((thin.absorptance(1.0) / 1e-12 - 1.0).abs() < 1e-6);
    }

    #[test]
    fn nonsense_is_an_error_or_black() {
        for bad in [f64::NAN, f64::INFINITY, -1.0] {
            assert!(Absorption::new(bad).is_err());
            assert_eq!(Absorption::new(1.0).unwrap().transmittance(bad), 0.0);
            assert!(Absorption::new(1.0).unwrap().depth(bad).is_err());
            assert!(Absorption::from_transmittance(Reflectance::clamped(0.5), bad).is_err());
        }
        assert!(Absorption::from_transmittance(Reflectance::clamped(0.0), 1.0).is_err());
        assert!(Absorption::from_transmittance(Reflectance::clamped(0.5_f32), 1e-40).is_err());
        assert!(Absorption::new(f32::MAX).unwrap().depth(2.0).is_err());
        assert_eq!(Absorption::<f32>::none().transmittance(f32::MAX), 1.0);
        assert_eq!(Absorption::new(f32::MAX).unwrap().transmittance(f32::MAX), 0.0);
    }
}
