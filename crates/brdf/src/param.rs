//! Validated parameters: what a constructor has checked, evaluation need not.

use core::error::Error;
use core::fmt;

use etendue_math::{Real, Spectrum};

/// A parameter outside its domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterError {
    /// Name of the parameter.
    pub parameter: &'static str,
    /// What was given.
    pub given: Given,
    /// What is accepted, in words.
    pub domain: &'static str,
}

/// What a constructor was given and refuses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Given {
    /// A number, of the first offending channel for colours.
    Number(f64),
    /// One of several choices, by its name.
    Choice(&'static str),
}

impl ParameterError {
    /// A number outside its domain.
    pub(crate) fn number<T: Real>(parameter: &'static str, x: T, domain: &'static str) -> Self {
        Self { parameter, given: Given::Number(x.to_f64()), domain }
    }

    /// A choice that does not go with the others.
    pub(crate) const fn choice(
        parameter: &'static str,
        choice: &'static str,
        domain: &'static str,
    ) -> Self {
        Self { parameter, given: Given::Choice(choice), domain }
    }

    /// The same, said of a parameter of another name.
    pub(crate) fn named(self, parameter: &'static str) -> Self {
        Self { parameter, ..self }
    }
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is {}, but must be {}", self.parameter, self.given, self.domain)
    }
}

impl fmt::Display for Given {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(x) => x.fmt(f),
            Self::Choice(name) => f.write_str(name),
        }
    }
}

impl Error for ParameterError {}

/// `x` when it lies in `[low, high]`; NaN does not. −0 becomes 0.
pub(crate) fn within<T: Real>(
    parameter: &'static str,
    x: T,
    [low, high]: [f64; 2],
    domain: &'static str,
) -> Result<T, ParameterError> {
    if x >= T::lit(low) && x <= T::lit(high) {
        Ok(positive_zero(x))
    } else {
        Err(ParameterError::number(parameter, x, domain))
    }
}

/// `x` moved into `[low, high]`; NaN becomes `low`.
#[inline]
pub(crate) fn clamped<T: Real>(x: T, [low, high]: [f64; 2]) -> T {
    x.clamp_to(T::lit(low), T::lit(high))
}

/// `color` when all its channels lie in `[low, high]`; −0 becomes 0.
fn each_within<C: Spectrum>(
    parameter: &'static str,
    color: C,
    range: [f64; 2],
    domain: &'static str,
) -> Result<C, ParameterError> {
    for i in 0..C::CHANNELS {
        within(parameter, color.channel(i), range, domain)?;
    }
    Ok(color.map(positive_zero))
}

/// 0 for −0, which is in every domain that begins with 0: a quotient by it would be −∞ where the limit is ∞.
fn positive_zero<T: Real>(x: T) -> T {
    x + T::ZERO
}

/// `x` when it is finite and not negative; NaN is not.
pub(crate) fn not_negative<T: Real>(parameter: &'static str, x: T) -> Result<T, ParameterError> {
    within(parameter, x, [0.0, T::MAX.to_f64()], NOT_NEGATIVE)
}

const NOT_NEGATIVE: &str = "finite and not negative";

/// Width parameter α of a microfacet distribution, dimensionless; never its square root.
///
/// Domain `[1e-8, 1e4]`. Below, the lobe is narrower than the rounding of a unit `f32` vector and
/// the surface is a mirror: choose the delta model, as [`Conductor`](crate::Conductor),
/// [`Dielectric`](crate::Dielectric), [`AnyPlastic`](crate::AnyPlastic) and [`AnyCoupled`](crate::AnyCoupled) do.
///
/// # Examples
/// ```
/// use etendue_brdf::Alpha;
/// assert_eq!(Alpha::new(0.25_f32)?.value(), 0.25);
/// assert!(Alpha::new(f32::NAN).is_err());
/// assert!(Alpha::new(0.0_f32).is_err());
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Alpha<T>(T);

impl<T: Real> Alpha<T> {
    /// The smallest α that is a rough surface and the largest accepted one.
    pub const RANGE: [f64; 2] = [1e-8, 1e4];

    /// Checks α.
    ///
    /// # Errors
    /// [`ParameterError`] outside `[1e-8, 1e4]`.
    pub fn new(alpha: T) -> Result<Self, ParameterError> {
        within("alpha", alpha, Self::RANGE, "in [1e-8, 1e4]").map(Self)
    }

    /// α moved into the domain; NaN becomes the smallest: for values read from textures.
    #[inline]
    pub fn clamped(alpha: T) -> Self {
        Self(alpha.clamp_to(T::lit(Self::RANGE[0]), T::lit(Self::RANGE[1])))
    }

    /// The number.
    #[inline(always)]
    pub fn value(self) -> T {
        self.0
    }
}

/// Relative index of refraction η = n(below) / n(above), dimensionless. Domain `[1e-4, 1e4]`.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Ior<T>(T);

impl<T: Real> Ior<T> {
    /// Checks a relative index.
    ///
    /// # Errors
    /// [`ParameterError`] outside `[1e-4, 1e4]`.
    pub fn new(eta: T) -> Result<Self, ParameterError> {
        within("eta", eta, [1e-4, 1e4], "in [1e-4, 1e4]").map(Self)
    }

    /// The relative index of the medium below, `interior`, and the one above, `exterior`.
    ///
    /// # Errors
    /// [`ParameterError`] where one of the two, or their ratio, lies outside `[1e-4, 1e4]`.
    pub fn from_media(interior: T, exterior: T) -> Result<Self, ParameterError> {
        let interior = within("interior index", interior, [1e-4, 1e4], "in [1e-4, 1e4]")?;
        let exterior = within("exterior index", exterior, [1e-4, 1e4], "in [1e-4, 1e4]")?;
        Self::new(interior / exterior)
    }

    /// The number.
    #[inline(always)]
    pub fn value(self) -> T {
        self.0
    }

    /// Both media have the same index: the interface is invisible.
    #[inline(always)]
    pub fn is_matched(self) -> bool {
        self.0 == T::ONE
    }
}

/// Complex relative index of refraction η + ik of a conductor, per channel, in `[0, 1e4]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComplexIor<C> {
    eta: C,
    k: C,
}

impl<C: Spectrum> ComplexIor<C> {
    /// Checks the real part and the extinction coefficient.
    ///
    /// # Errors
    /// [`ParameterError`] where a channel of either lies outside `[0, 1e4]`.
    pub fn new(eta: C, k: C) -> Result<Self, ParameterError> {
        let checked = |name, x| each_within(name, x, [0.0, 1e4], "in [0, 1e4]");
        Ok(Self { eta: checked("eta", eta)?, k: checked("k", k)? })
    }

    /// Both parts moved into the domain, NaN to 0: for values read from textures.
    #[inline]
    pub fn clamped(eta: C, k: C) -> Self {
        let clamp = |c: C| c.map(|x| x.clamp_to(C::Real::ZERO, C::Real::lit(1e4)));
        Self { eta: clamp(eta), k: clamp(k) }
    }

    /// The index whose Fresnel reflectance is 1 at every angle: η + ik = i, the perfect mirror.
    pub fn perfect() -> Self {
        Self { eta: C::black(), k: C::white() }
    }

    /// Real part η.
    #[inline(always)]
    pub fn eta(self) -> C {
        self.eta
    }

    /// Extinction coefficient k.
    #[inline(always)]
    pub fn k(self) -> C {
        self.k
    }
}

/// A reflectance, transmittance or scale factor per channel. Domain `[0, 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflectance<C>(C);

impl<C: Spectrum> Reflectance<C> {
    /// Checks every channel.
    ///
    /// # Errors
    /// [`ParameterError`] where a channel lies outside `[0, 1]`.
    pub fn new(reflectance: C) -> Result<Self, ParameterError> {
        each_within("reflectance", reflectance, [0.0, 1.0], "in [0, 1]").map(Self)
    }

    /// Every channel moved into `[0, 1]`, NaN to 0: for values read from textures.
    #[inline]
    pub fn clamped(reflectance: C) -> Self {
        Self(reflectance.map(|c| c.clamp_to(C::Real::ZERO, C::Real::ONE)))
    }

    /// 1 in every channel.
    #[inline]
    pub fn white() -> Self {
        Self(C::white())
    }

    /// The colour.
    #[inline(always)]
    pub fn value(self) -> C {
        self.0
    }
}

/// Standard deviation σ of the facets' slope angle, in radians. Domain: finite, not negative.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Sigma<T>(T);

impl<T: Real> Sigma<T> {
    /// Checks σ.
    ///
    /// # Errors
    /// [`ParameterError`] where σ is negative, infinite or NaN.
    pub fn new(sigma: T) -> Result<Self, ParameterError> {
        not_negative("sigma", sigma).map(Self)
    }

    /// σ moved into the domain, NaN to 0: for values read from textures.
    #[inline]
    pub fn clamped(sigma: T) -> Self {
        Self(sigma.clamp_to(T::ZERO, T::MAX))
    }

    /// The number.
    #[inline(always)]
    pub fn value(self) -> T {
        self.0
    }
}

/// Roughness of a diffuse surface, from Lambertian to maximally rough, dimensionless. Domain `[0, 1]`.
///
/// What it stands for (a slope, a width, a retro-reflection) is for the model to say.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Roughness<T>(T);

impl<T: Real> Roughness<T> {
    /// Checks a roughness.
    ///
    /// # Errors
    /// [`ParameterError`] outside `[0, 1]`.
    pub fn new(roughness: T) -> Result<Self, ParameterError> {
        within("roughness", roughness, [0.0, 1.0], "in [0, 1]").map(Self)
    }

    /// The roughness moved into `[0, 1]`, NaN to 0: for values read from textures.
    #[inline]
    pub fn clamped(roughness: T) -> Self {
        Self(roughness.clamp_to(T::ZERO, T::ONE))
    }

    /// The number.
    #[inline(always)]
    pub fn value(self) -> T {
        self.0
    }
}

/// Exponent n of a cosine lobe of the Phong family, dimensionless. Domain `[0, 1e12]`.
///
/// The lobe is `√(2/n)` wide. At the upper end that is 1.4e-6 rad, a dozen spacings of a unit `f32`
/// vector: narrower ones are a mirror, for which there are delta models.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Exponent<T>(T);

impl<T: Real> Exponent<T> {
    /// The exponents of the flattest and of the narrowest lobe.
    pub const RANGE: [f64; 2] = [0.0, 1e12];

    /// Checks an exponent.
    ///
    /// # Errors
    /// [`ParameterError`] outside `[0, 1e12]`.
    pub fn new(exponent: T) -> Result<Self, ParameterError> {
        within("exponent", exponent, Self::RANGE, "in [0, 1e12]").map(Self)
    }

    /// The exponent moved into the domain, NaN to 0: for values read from textures.
    #[inline]
    pub fn clamped(exponent: T) -> Self {
        Self(exponent.clamp_to(T::ZERO, T::lit(Self::RANGE[1])))
    }

    /// The number.
    #[inline(always)]
    pub fn value(self) -> T {
        self.0
    }
}

/// Checks that two shares of the same light do not exceed it together, in any channel.
///
/// The sum is rounded: shares that add up to 1 in decimal pass, whatever their last bits are.
pub(crate) fn at_most_all_together<C: Spectrum>(
    parameter: &'static str,
    a: Reflectance<C>,
    b: Reflectance<C>,
) -> Result<(), ParameterError> {
    each_within(parameter, a.value() + b.value(), [0.0, 1.0], "at most 1").map(|_| ())
}

/// Two shares of the same light, both made smaller by one factor where they exceed it together in a channel: for values
/// read from textures.
pub(crate) fn scaled_to_all_together<C: Spectrum>(
    a: Reflectance<C>,
    b: Reflectance<C>,
) -> [Reflectance<C>; 2] {
    let most = (a.value() + b.value()).max_channel();
    if most > C::Real::ONE {
        [a, b].map(|share| Reflectance::clamped(share.value().map(|c| c / most)))
    } else {
        [a, b]
    }
}

/// Opacity, the share of light that meets the surface at all. Domain `[0, 1]`.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Opacity<T>(T);

impl<T: Real> Opacity<T> {
    /// Checks an opacity.
    ///
    /// # Errors
    /// [`ParameterError`] outside `[0, 1]`.
    pub fn new(opacity: T) -> Result<Self, ParameterError> {
        within("opacity", opacity, [0.0, 1.0], "in [0, 1]").map(Self)
    }

    /// The opacity moved into `[0, 1]`, NaN to 0: for values read from textures.
    #[inline]
    pub fn clamped(opacity: T) -> Self {
        Self(opacity.clamp_to(T::ZERO, T::ONE))
    }

    /// The number.
    #[inline(always)]
    pub fn value(self) -> T {
        self.0
    }
}

/// Optical depth τ = σa d of a layer crossed perpendicularly, per channel. Domain: finite, not
/// negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpticalDepth<C>(C);

impl<C: Spectrum> OpticalDepth<C> {
    /// Checks every channel.
    ///
    /// # Errors
    /// [`ParameterError`] where a channel is negative, infinite or NaN.
    pub fn new(depth: C) -> Result<Self, ParameterError> {
        each_within("optical depth", depth, [0.0, C::Real::MAX.to_f64()], NOT_NEGATIVE).map(Self)
    }

    /// A layer that absorbs nothing.
    #[inline]
    pub fn clear() -> Self {
        Self(C::black())
    }

    /// Transmittance `exp(−τ / |cos θ|)` of a slanted crossing, in `[0, 1]`; 0 where an absorbing layer
    /// is crossed along itself (`cos θ = 0`).
    #[inline]
    pub fn transmittance(self, cos: C::Real) -> C {
        self.0.map(|tau| if tau > C::Real::ZERO { (-tau / cos.abs()).exp() } else { C::Real::ONE })
    }

    /// `1 − exp(−τ / |cos θ|)`, without the cancellation in thin layers.
    #[inline]
    pub fn absorptance(self, cos: C::Real) -> C {
        let zero = C::Real::ZERO;
        self.0.map(|tau| if tau > zero { -(-tau / cos.abs()).exp_m1() } else { zero })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;
    use etendue_math::Rgb;

    #[test]
    fn every_type_refuses_nan_and_infinity() {
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0] {
            assert!(Alpha::new(x).is_err());
            assert!(Ior::new(x).is_err());
            assert!(ComplexIor::new(x, 1.0).is_err() && ComplexIor::new(1.0, x).is_err());
            assert!(Reflectance::new(x).is_err());
            assert!(Sigma::new(x).is_err());
            assert!(Opacity::new(x).is_err());
            assert!(Roughness::new(x).is_err());
            assert!(Exponent::new(x).is_err());
        }
    }

    #[test]
    fn zero_has_no_sign() {
        let positive = |x: f64| assert!(x == 0.0 && x.is_sign_positive(), "{x:?}");
        positive(ComplexIor::new(-0.0, 1.0).unwrap().eta());
        positive(ComplexIor::new(1.0, -0.0).unwrap().k());
        positive(Reflectance::new(-0.0).unwrap().value());
        positive(Reflectance::clamped(-0.0).value());
        positive(Sigma::new(-0.0).unwrap().value());
        positive(Sigma::clamped(-0.0).value());
        positive(Opacity::new(-0.0).unwrap().value());
        positive(Opacity::clamped(-0.0).value());
        positive(Roughness::new(-0.0).unwrap().value());
        positive(Roughness::clamped(-0.0).value());
        positive(Exponent::new(-0.0).unwrap().value());
        positive(Exponent::clamped(-0.0).value());
        positive(OpticalDepth::new(-0.0).unwrap().0);
    }

    #[test]
    fn clamping_is_total() {
        assert_eq!(
            Reflectance::clamped(Rgb::new(f32::NAN, 2.0, -1.0)).value(),
            Rgb::new(0.0, 1.0, 0.0)
        );
        assert_eq!(Alpha::clamped(f32::NAN).value(), 1e-8);
        assert_eq!(Opacity::clamped(f64::INFINITY).value(), 1.0);
        assert_eq!(Roughness::clamped(f32::NAN).value(), 0.0);
        assert_eq!(Exponent::clamped(f32::INFINITY).value(), 1e12);
    }

    #[test]
    fn shares_that_are_1_together_in_decimal_are_accepted_and_no_more() {
        let check = |a: f32, b: f32| {
            let [a, b] = [a, b].map(|x| Reflectance::new(x).unwrap());
            at_most_all_together("sum", a, b)
        };
        for i in 0..=1000 {
            assert!(check(i as f32 / 1000.0, (1000 - i) as f32 / 1000.0).is_ok(), "{i}");
        }
        assert!(check(0.5, 0.500_000_2).is_err());
    }

    #[test]
    fn an_error_names_parameter_value_and_domain() {
        let text = Reflectance::new(Rgb::new(0.5_f64, 1.5, 0.5)).unwrap_err().to_string();
        assert_eq!(text, "reflectance is 1.5, but must be in [0, 1]");
        let text = ParameterError::choice("masking", "separable", "height-correlated").to_string();
        assert_eq!(text, "masking is separable, but must be height-correlated");
    }
}
