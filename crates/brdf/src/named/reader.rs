//! Parameters as a constructor asks for them: typed and checked.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use etendue_math::{Real, Spectrum, Vec3, Vector3};

use super::{NamedError, Parameters, Value, build};
use crate::{
    Alpha, BeckmannLambda, Bsdf, ComplexIor, Distribution, Ior, Masking, Microfacets,
    ParameterError, Reflectance,
};

/// The parameters of one model or function, `of`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reader<'a> {
    pub(super) of: &'static str,
    pub(super) parameters: &'a Parameters,
}

impl<'a> Reader<'a> {
    /// The parameters of `of`, none of which lies outside `known`.
    pub(super) fn new(
        of: &'static str,
        parameters: &'a Parameters,
        known: impl Iterator<Item = &'static str>,
    ) -> Result<Self, NamedError> {
        let known: Vec<_> = known.collect();
        match parameters.names().find(|name| !known.contains(name)) {
            None => Ok(Self { of, parameters }),
            Some(name) => Err(NamedError::UnknownParameter { of, parameter: name.into(), known }),
        }
    }

    /// Whichever of two names is given, the first where neither is.
    pub(super) fn either(&self, name: &'static str, synonym: &'static str) -> &'static str {
        if self.parameters.get(name).is_none() && self.has(synonym) { synonym } else { name }
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.parameters.get(name).is_some()
    }

    /// Attaches this model and the name it was asked under to what a parameter type has to say.
    pub(super) fn checked<P>(
        &self,
        name: &'static str,
        outcome: Result<P, ParameterError>,
    ) -> Result<P, NamedError> {
        let of = self.of;
        outcome.map_err(|e| NamedError::Domain { of, error: e.named(name) })
    }

    /// Attaches this model to what a constructor has to say about several parameters together.
    pub(super) fn constructed<P>(
        &self,
        outcome: Result<P, ParameterError>,
    ) -> Result<P, NamedError> {
        outcome.map_err(|error| NamedError::Domain { of: self.of, error })
    }

    fn kind(&self, parameter: &'static str, expected: impl Into<String>) -> NamedError {
        NamedError::Kind { of: self.of, parameter, expected: expected.into() }
    }

    fn value(&self, parameter: &'static str) -> Result<&'a Value, NamedError> {
        self.parameters.get(parameter).ok_or(NamedError::Missing { of: self.of, parameter })
    }

    pub(super) fn number<T: Real>(&self, name: &'static str) -> Result<T, NamedError> {
        match self.value(name)? {
            Value::Number(x) => Ok(T::lit(*x)),
            _ => Err(self.kind(name, "a number")),
        }
    }

    /// Exactly `N` numbers.
    pub(super) fn numbers<T: Real, const N: usize>(
        &self,
        name: &'static str,
    ) -> Result<[T; N], NamedError> {
        match self.value(name)? {
            Value::Numbers(x) if x.len() == N => Ok(core::array::from_fn(|i| T::lit(x[i]))),
            _ => Err(self.kind(name, format!("{N} numbers"))),
        }
    }

    /// Three coordinates, not normalised.
    pub(super) fn vector<T: Real>(&self, name: &'static str) -> Result<Vec3<T>, NamedError> {
        let [x, y, z] = self.numbers(name)?;
        Ok(Vec3::<T>::new(x, y, z))
    }

    /// The unit vector along three coordinates.
    pub(super) fn direction<T: Real>(&self, name: &'static str) -> Result<Vec3<T>, NamedError> {
        unit::<T>(self.vector::<T>(name)?).ok_or_else(|| self.kind(name, DIRECTION))
    }

    /// A number with a domain of its own.
    pub(super) fn within<T: Real>(
        &self,
        name: &'static str,
        domain: &'static str,
        is_valid: impl Fn(T) -> bool,
    ) -> Result<T, NamedError> {
        let x = self.number::<T>(name)?;
        let error = || ParameterError::number(name, x, domain);
        self.checked(name, if is_valid(x) { Ok(x) } else { Err(error()) })
    }

    /// What is given replaces the default, of models that have defaults.
    pub(super) fn replace<T: Real>(
        &self,
        fields: &mut [(&'static str, &mut T)],
    ) -> Result<(), NamedError> {
        for (name, field) in fields {
            if self.has(name) {
                **field = self.number(name)?;
            }
        }
        Ok(())
    }

    /// The same for colours.
    pub(super) fn replace_colors<C: Spectrum>(
        &self,
        fields: &mut [(&'static str, &mut C)],
    ) -> Result<(), NamedError> {
        for (name, field) in fields {
            if self.has(name) {
                **field = self.color(name)?;
            }
        }
        Ok(())
    }

    /// A colour: one number for all channels, or three.
    pub(super) fn color<C: Spectrum>(&self, name: &'static str) -> Result<C, NamedError> {
        match self.value(name)? {
            Value::Number(x) => Ok(C::splat(C::Real::lit(*x))),
            Value::Numbers(x) if C::CHANNELS == 3 && x.len() == 3 => {
                let mut channels = x.iter();
                Ok(C::black().map(|c| channels.next().map_or(c, |&x| C::Real::lit(x))))
            }
            _ if C::CHANNELS == 3 => Err(self.kind(name, "a number or three numbers")),
            _ => Err(self.kind(name, "a number")),
        }
    }

    /// One of several words; the first where nothing is given.
    pub(super) fn choice<P: Copy>(
        &self,
        name: &'static str,
        choices: &[(&str, P)],
    ) -> Result<P, NamedError> {
        let word = match self.parameters.get(name) {
            None => return Ok(choices[0].1),
            Some(Value::Word(word)) => word.as_str(),
            Some(_) => "",
        };
        choices.iter().find(|(known, _)| *known == word).map(|(_, choice)| *choice).ok_or_else(
            || {
                let known: Vec<_> = choices.iter().map(|(known, _)| *known).collect();
                self.kind(name, format!("one of {}", known.join(", ")))
            },
        )
    }

    pub(super) fn reflectance<C: Spectrum>(
        &self,
        name: &'static str,
    ) -> Result<Reflectance<C>, NamedError> {
        self.checked(name, Reflectance::new(self.color(name)?))
    }

    /// A factor that is 1 unless given.
    pub(super) fn factor<C: Spectrum>(
        &self,
        name: &'static str,
    ) -> Result<Reflectance<C>, NamedError> {
        if self.has(name) { self.reflectance(name) } else { Ok(Reflectance::white()) }
    }

    /// The factors of reflection and transmission.
    pub(super) fn factors<C: Spectrum>(
        &self,
    ) -> Result<(Reflectance<C>, Reflectance<C>), NamedError> {
        Ok((self.factor("specular_reflectance")?, self.factor("specular_transmittance")?))
    }

    /// The relative index `eta`, or the quotient of `ior_int` below and `ior_ext` above.
    pub(super) fn ior<T: Real>(&self) -> Result<Ior<T>, NamedError> {
        if self.has("eta") || !(self.has("ior_int") || self.has("ior_ext")) {
            return self.checked("eta", Ior::new(self.number("eta")?));
        }
        let (interior, exterior) = (self.number("ior_int")?, self.number("ior_ext")?);
        self.constructed(Ior::from_media(interior, exterior))
    }

    pub(super) fn complex_ior<C: Spectrum>(&self) -> Result<ComplexIor<C>, NamedError> {
        let (eta, k) = (self.color("eta")?, self.color("k")?);
        self.constructed(ComplexIor::new(eta, k))
    }

    pub(super) fn distribution(&self) -> Result<Distribution, NamedError> {
        let beckmann = |lambda| Distribution::Beckmann { lambda };
        self.choice(
            "distribution",
            &[
                ("ggx", Distribution::Ggx),
                ("beckmann", beckmann(BeckmannLambda::Exact)),
                ("beckmann-walter", beckmann(BeckmannLambda::Walter)),
            ],
        )
    }

    /// The form of G2, `default` unless another one is asked for.
    pub(super) fn masking(&self, default: Masking) -> Result<Masking, NamedError> {
        let mut choices =
            [("height-correlated", Masking::HeightCorrelated), ("separable", Masking::Separable)];
        if default == Masking::Separable {
            choices.reverse();
        }
        self.choice("masking", &choices)
    }

    /// `alpha`, or `alpha_x` and `alpha_y`; not yet checked, since 0 is a mirror for some models.
    pub(super) fn widths<T: Real>(&self) -> Result<[T; 2], NamedError> {
        if self.has("alpha") {
            return Ok([self.number("alpha")?; 2]);
        }
        Ok([self.number("alpha_x")?, self.number("alpha_y")?])
    }

    pub(super) fn microfacets<T: Real>(
        &self,
        masking: Masking,
    ) -> Result<Microfacets<T>, NamedError> {
        let [x, y] = self.widths()?;
        let (name_x, name_y) = (self.either("alpha_x", "alpha"), self.either("alpha_y", "alpha"));
        let x = self.checked(name_x, Alpha::new(x))?;
        let y = self.checked(name_y, Alpha::new(y))?;
        Ok(Microfacets::new(self.distribution()?, x, y, self.masking(masking)?))
    }

    /// A model inside this one.
    pub(super) fn model<C: Spectrum>(
        &self,
        name: &'static str,
    ) -> Result<Box<dyn Bsdf<Color = C>>, NamedError> {
        match self.value(name)? {
            Value::Model(inner) => build(&inner.model, &inner.parameters),
            Value::Word(model) => build(model, &Parameters::new()),
            _ => Err(self.kind(name, "a model")),
        }
    }
}

pub(super) const DIRECTION: &str = "three finite numbers, not all 0";

/// The unit vector along `w`, whatever its length; `None` where it is zero or not finite.
///
/// Coordinates that are those of a unit vector but for their rounding stay as they are: rounding them
/// once more would turn the half vector of nearly opposite directions.
pub(super) fn unit<T: Real>(w: Vec3<T>) -> Option<Vec3<T>> {
    // A rounding of each coordinate moves the squared length by up to √3 ε.
    if T::excess_of_squares(w.x(), w.y(), w.z()).abs() < T::TWO * T::EPSILON {
        return Some(w);
    }
    (w / w.x().abs().max(w.y().abs()).max(w.z().abs())).try_normalize()
}
