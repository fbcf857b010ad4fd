//! Functions by name.

use alloc::vec::Vec;

use etendue_math::{Real, Spectrum, Vec3};
use etendue_sampling::warp::cosine_hemisphere;

use super::phong::exponent;
use super::{NamedError, Parameters, Reader};
use crate::microfacet::{BeckmannLambda, Distribution, Masking, Microfacets};
use crate::{Absorption, Alpha, ComplexIor, Ior, PhongHalfVectors, Reflectance, fresnel};

/// What a function returns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Output<T: Real> {
    /// A number.
    Number(T),
    /// A direction, or `None` under total reflection.
    Direction(Option<Vec3<T>>),
    /// A sampled direction and its density per steradian.
    Sample {
        /// The direction.
        direction: Vec3<T>,
        /// Its density.
        pdf: T,
    },
}

/// A function's name and inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FunctionInfo {
    /// Its name.
    pub name: &'static str,
    /// Names of its inputs.
    pub inputs: &'static [&'static str],
}

/// How one function is evaluated.
struct Entry<T: Real> {
    info: FunctionInfo,
    evaluate: fn(&Reader) -> Result<Output<T>, NamedError>,
}

const WIDTHS_AND_H: &[&str] = &["alpha_x", "alpha_y", "alpha", "h"];
const WIDTHS_AND_W: &[&str] = &["alpha_x", "alpha_y", "alpha", "w"];
const WIDTHS_AND_PAIR: &[&str] = &["alpha_x", "alpha_y", "alpha", "wi", "wo"];

/// Every function; a new one is an entry here.
fn entries<T: Real + Spectrum<Real = T>>() -> Vec<Entry<T>> {
    type Evaluate<T> = fn(&Reader) -> Result<Output<T>, NamedError>;
    let of = |name, inputs, evaluate: Evaluate<T>| Entry {
        info: FunctionInfo { name, inputs },
        evaluate,
    };
    [
        of("beer-lambert", &["sigma_a", "distance"], |r| {
            let medium = r.checked("sigma_a", Absorption::new(r.number::<T>("sigma_a")?))?;
            let valid = |x: T| x >= T::ZERO && x < T::INFINITY;
            let distance = r.within("distance", "finite and not negative", valid)?;
            Ok(Output::Number(medium.transmittance(distance)))
        }),
        of("f0-from-ior", &["eta"], |r| Ok(Output::Number(fresnel::f0_from_ior(index::<T>(r)?)))),
        of("fresnel-conductor", &["eta", "k", "cos_theta_i"], |r| {
            let ior: ComplexIor<T> = r.complex_ior()?;
            Ok(Output::Number(fresnel::conductor(cosine(r)?, ior.eta(), ior.k())))
        }),
        of("fresnel-dielectric", &["eta", "cos_theta_i"], |r| {
            Ok(Output::Number(fresnel::dielectric(cosine(r)?, index::<T>(r)?)))
        }),
        of("fresnel-schlick", &["f0", "cos_theta_i"], |r| {
            let f0: Reflectance<T> = r.reflectance("f0")?;
            Ok(Output::Number(fresnel::schlick(f0.value(), cosine(r)?)))
        }),
        of("ndf-beckmann", WIDTHS_AND_H, |r| ndf(r, BECKMANN)),
        of("ndf-ggx", WIDTHS_AND_H, |r| ndf(r, Distribution::Ggx)),
        of("refract", &["eta", "wi"], |r| {
            // Not normalised first: that would cost the digits that the critical angle needs.
            let w = r.vector::<T>("wi")?;
            r.direction::<T>("wi")?;
            Ok(Output::Direction(fresnel::refract(w, index(r)?)))
        }),
        of("sample-ashikhmin-shirley-half", &["nu", "nv", "xi"], |r| {
            let lobe = PhongHalfVectors::<T>::new(exponent(r, "nu")?, exponent(r, "nv")?);
            let (direction, pdf) = lobe.sample(uniforms(r)?);
            Ok(Output::Sample { direction, pdf })
        }),
        of("sample-cosine-hemisphere", &["xi"], |r| {
            let direction = cosine_hemisphere::from_square_polar(uniforms::<T>(r)?);
            Ok(Output::Sample { direction, pdf: cosine_hemisphere::pdf::<T>(direction) })
        }),
        of("smith-g1-beckmann", WIDTHS_AND_W, |r| g1(r, BECKMANN)),
        of("smith-g1-ggx", WIDTHS_AND_W, |r| g1(r, Distribution::Ggx)),
        of("smith-g2-beckmann", WIDTHS_AND_PAIR, |r| g2(r, BECKMANN)),
        of("smith-g2-ggx", WIDTHS_AND_PAIR, |r| g2(r, Distribution::Ggx)),
        of("smith-lambda-beckmann", WIDTHS_AND_W, |r| lambda(r, BECKMANN)),
        of("smith-lambda-ggx", WIDTHS_AND_W, |r| lambda(r, Distribution::Ggx)),
    ]
    .into()
}

const BECKMANN: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Exact };

/// The names of all functions and of their inputs, in alphabetical order.
pub fn functions() -> Vec<FunctionInfo> {
    entries::<f64>().into_iter().map(|entry| entry.info).collect()
}

/// The function `name` of these inputs.
///
/// Directions may have any length but 0. G2 is height-correlated, Beckmann's Λ the exact one.
///
/// # Errors
/// [`NamedError`] for an unknown name, and for inputs that are unknown, missing, of the wrong kind or
/// outside their domain.
///
/// # Examples
/// ```
/// use etendue_brdf::named::{Output, Parameters, function};
/// let inputs = Parameters::new().with_number("eta", 1.5);
/// assert_eq!(function::<f64>("f0-from-ior", &inputs)?, Output::Number(0.2_f64 * 0.2));
/// # Ok::<(), etendue_brdf::named::NamedError>(())
/// ```
pub fn function<T: Real + Spectrum<Real = T>>(
    name: &str,
    inputs: &Parameters,
) -> Result<Output<T>, NamedError> {
    let entries = entries::<T>();
    let Some(entry) = entries.iter().find(|entry| entry.info.name == name) else {
        let known = entries.iter().map(|entry| entry.info.name).collect();
        return Err(NamedError::Unknown { name: name.into(), known });
    };
    let known = entry.info.inputs.iter().copied();
    (entry.evaluate)(&Reader::new(entry.info.name, inputs, known)?)
}

fn index<T: Real>(reader: &Reader) -> Result<T, NamedError> {
    reader.ior::<T>().map(Ior::value)
}

fn cosine<T: Real>(reader: &Reader) -> Result<T, NamedError> {
    reader.within("cos_theta_i", "finite", Real::is_finite)
}

fn uniforms<T: Real>(reader: &Reader) -> Result<[T; 2], NamedError> {
    let xi = reader.numbers::<T, 2>("xi")?;
    for x in xi {
        if !(x >= T::ZERO && x < T::ONE) {
            let error = crate::ParameterError::number("xi", x, "in [0, 1)");
            return Err(NamedError::Domain { of: reader.of, error });
        }
    }
    Ok(xi)
}

fn facets<T: Real>(
    reader: &Reader,
    distribution: Distribution,
) -> Result<Microfacets<T>, NamedError> {
    let [x, y] = reader.widths::<T>()?;
    let (x, y) =
        (reader.checked("alpha_x", Alpha::new(x))?, reader.checked("alpha_y", Alpha::new(y))?);
    Ok(Microfacets::new(distribution, x, y, Masking::HeightCorrelated))
}

fn ndf<T: Real>(reader: &Reader, distribution: Distribution) -> Result<Output<T>, NamedError> {
    Ok(Output::Number(facets(reader, distribution)?.ndf(reader.direction::<T>("h")?)))
}

fn lambda<T: Real>(reader: &Reader, distribution: Distribution) -> Result<Output<T>, NamedError> {
    Ok(Output::Number(facets(reader, distribution)?.lambda(reader.direction::<T>("w")?)))
}

fn g1<T: Real>(reader: &Reader, distribution: Distribution) -> Result<Output<T>, NamedError> {
    Ok(Output::Number(facets(reader, distribution)?.g1(reader.direction::<T>("w")?)))
}

fn g2<T: Real>(reader: &Reader, distribution: Distribution) -> Result<Output<T>, NamedError> {
    let (wo, wi) = (reader.direction::<T>("wo")?, reader.direction::<T>("wi")?);
    Ok(Output::Number(facets(reader, distribution)?.g2(wo, wi)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    #[test]
    fn functions_are_in_order_and_every_input_of_theirs_is_looked_at() {
        let all = functions();
        assert!(all.windows(2).all(|pair| pair[0].name < pair[1].name));
        for info in all {
            for &input in info.inputs {
                let mut inputs = Parameters::new();
                for &other in info.inputs {
                    match other {
                        "h" | "w" | "wi" | "wo" => {
                            inputs = inputs.with_numbers(other, &[0.0, 0.6, 0.8]);
                        }
                        "xi" => inputs = inputs.with_numbers(other, &[0.25, 0.5]),
                        // Both widths, or the one that stands for both.
                        "alpha" if input != "alpha" => {}
                        _ => inputs = inputs.with_number(other, 0.5),
                    }
                }
                assert!(function::<f32>(info.name, &inputs).is_ok(), "{}", info.name);
                let error = function::<f32>(info.name, &inputs.with_word(input, "?")).unwrap_err();
                assert!(error.to_string().contains(input), "{error}");
            }
        }
    }

    #[test]
    fn uniforms_outside_the_square_are_refused() {
        for xi in [[1.0, 0.5], [0.5, -0.1], [f64::NAN, 0.5]] {
            let inputs = Parameters::new().with_numbers("xi", &xi);
            assert!(function::<f64>("sample-cosine-hemisphere", &inputs).is_err());
        }
    }
}
