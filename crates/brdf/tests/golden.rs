//! Every row of exact values, in both precisions; see `golden/README.md` for the conventions.

#[path = "golden/bound.rs"]
mod bound;

use std::fs;
use std::path::Path;

use etendue_brdf::fresnel;
use etendue_brdf::{
    Absorption, Alpha, AshikhminShirley, AshikhminShirleySampling, BeckmannLambda, Bsdf, Burley,
    ComplexIor, Coupled, CoupledInterface, DiffuseTransmitter, Distribution, Eon, EonAlbedo,
    Exponent, Ior, Lambert, LayeredFresnel, LayeredLinear, Masking, Microfacets, MirrorOverMatte,
    OrenNayar, OrenNayarFujii, OrenNayarQualitative, Phong, PhongHalfVectors, Reflectance,
    RoughConductor, RoughDielectric, Roughness, Sigma,
};
use etendue_math::{Real, Spectrum, Vec3, Vector3};
use etendue_sampling::warp::cosine_hemisphere;
use serde_json::Value;

use bound::{HARD, LEAST, TYPICAL, ulp32};

/// What is left of these bounds in `f64`: its ε is 2⁻²⁹ = 1.9e-9 of that of `f32`, so 1e-6 allows
/// 500 times as many roundings and no constant of `f32` precision.
const F64_SHARE: f64 = 1e-6;

enum Answer {
    Value(f64),
    /// The density where the row's one is comparable.
    Bsdf {
        f: f64,
        pdf: Option<f64>,
    },
    Direction([f64; 3]),
    Sample {
        direction: [f64; 3],
        pdf: f64,
    },
    TotalReflection,
}

/// A vector in `f64`, exact.
fn widen<V: Vector3>(w: V) -> [f64; 3] {
    [w.x(), w.y(), w.z()].map(Real::to_f64)
}

/// An input: a number, or one of the strings that stand for what JSON lacks.
///
/// Inputs are exact in `f32`; rounding to it undoes serde_json's last-bit errors in `f64`, which the
/// square root at the critical angle would amplify.
fn number<T: Real>(value: &Value) -> Option<T> {
    let x = match value.as_str() {
        Some("NaN") => f64::NAN,
        Some("Infinity") => f64::INFINITY,
        Some(_) => return None,
        None => value.as_f64()?,
    };
    Some(T::lit(f64::from(x as f32)))
}

struct Row<'a>(&'a Value);

impl Row<'_> {
    fn parameter<T: Real>(&self, name: &str) -> Option<T> {
        number(&self.0["params"][name])
    }

    fn cosine<T: Real>(&self) -> Option<T> {
        number::<T>(&self.0["cos_theta_i"]).filter(|c| c.is_finite())
    }

    fn coordinates<T: Real>(&self, name: &str) -> Option<Vec3<T>> {
        let [x, y, z] = [0, 1, 2].map(|i| number::<T>(&self.0[name][i]));
        Some(Vec3::<T>::new(x?, y?, z?))
    }

    /// The unit vector along the given coordinates, whatever their scale; `None` if there is none.
    ///
    /// Coordinates that are those of a unit vector but for their rounding stay as they are: rounding them
    /// once more would move the half vector of nearly opposite directions.
    fn direction<T: Real>(&self, name: &str) -> Option<Vec3<T>> {
        let w = self.coordinates::<T>(name)?;
        // A rounding of each coordinate moves the squared length by up to √3 ε.
        if T::excess_of_squares(w.x(), w.y(), w.z()).abs() < T::TWO * T::EPSILON {
            return Some(w);
        }
        (w / w.x().abs().max(w.y().abs()).max(w.z().abs())).try_normalize()
    }

    fn facets<T: Real>(&self, distribution: &str, masking: Masking) -> Option<Microfacets<T>> {
        let distribution = match distribution {
            "ggx" => Distribution::Ggx,
            _ => Distribution::Beckmann { lambda: BeckmannLambda::Exact },
        };
        let isotropic = self.parameter("alpha");
        let width = |name| Alpha::new(isotropic.or_else(|| self.parameter(name))?).ok();
        Some(Microfacets::new(distribution, width("alpha_x")?, width("alpha_y")?, masking))
    }

    /// Uniforms in the domain of a warp.
    fn uniforms<T: Real>(&self) -> Option<[T; 2]> {
        let u = [number::<T>(&self.0["xi"][0])?, number::<T>(&self.0["xi"][1])?];
        u.iter().all(|&u| u >= T::ZERO && u < T::ONE).then_some(u)
    }

    fn bsdf<B: Bsdf>(&self, model: &B) -> Option<Answer> {
        let wi = self.direction::<<B::Color as Spectrum>::Real>("wi")?;
        let wo = self.direction::<<B::Color as Spectrum>::Real>("wo")?;
        let (f, pdf) = model.eval_pdf(wo, wi);
        Some(Answer::Bsdf { f: f.channel(0).to_f64(), pdf: Some(pdf.to_f64()) })
    }

    /// A model with a mirror: the rows give the density within the matte term. Where the sampler never chooses
    /// that, because it is black, there is none to compare.
    fn matte<M: MirrorOverMatte>(&self, model: &M) -> Option<Answer> {
        let answer = self.bsdf(model)?;
        let wo = self.direction::<<M::Color as Spectrum>::Real>("wo")?;
        let probability = model.matte_probability(wo.z()).to_f64();
        Some(match answer {
            Answer::Bsdf { f, pdf } => {
                let within = pdf.filter(|_| probability > 0.0).map(|pdf| pdf / probability);
                Answer::Bsdf { f, pdf: within }
            }
            other => other,
        })
    }

    /// What the crate says to this row, or `None` where it refuses the input.
    fn answer<T: Real + Spectrum<Real = T>>(&self, file: &str) -> Option<Answer> {
        let value = |x: T| Some(Answer::Value(x.to_f64()));
        let albedo = || Reflectance::new(self.parameter::<T>("albedo")?).ok();
        let reflectance = |name| Reflectance::new(self.parameter::<T>(name)?).ok();
        let roughness = || Roughness::new(self.parameter::<T>("roughness")?).ok();
        let exponent = |name| Exponent::new(self.parameter::<T>(name)?).ok();
        let sigma = || Sigma::new(self.parameter::<T>("sigma")?).ok();
        let eta = || Ior::new(self.parameter::<T>("eta")?).ok();
        if let Some((function, distribution)) = file
            .rsplit_once('-')
            .filter(|(name, _)| name.starts_with("ndf") || name.starts_with("smith"))
        {
            let facets = self.facets::<T>(distribution, Masking::HeightCorrelated)?;
            return value(match function {
                "ndf" => facets.ndf(self.direction::<T>("h")?),
                "smith-lambda" => facets.lambda(self.direction::<T>("w")?),
                "smith-g1" => facets.g1(self.direction::<T>("w")?),
                _ => facets.g2(self.direction::<T>("wo")?, self.direction::<T>("wi")?),
            });
        }
        match file {
            "lambert" => self.bsdf(&Lambert::new(albedo()?)),
            "oren-nayar" => self.bsdf(&OrenNayar::new(albedo()?, sigma()?)),
            "oren-nayar-qualitative" => self.bsdf(&OrenNayarQualitative::new(albedo()?, sigma()?)),
            "oren-nayar-fujii" => self.bsdf(&OrenNayarFujii::new(albedo()?, roughness()?)),
            "eon" => self.bsdf(&Eon::new(albedo()?, roughness()?)),
            "eon-approx" => {
                let model = Eon::new(albedo()?, roughness()?);
                self.bsdf(&model.with_albedo(EonAlbedo::Approximate))
            }
            "burley" => self.bsdf(&Burley::new(reflectance("base_color")?, roughness()?)),
            "diffuse-transmitter" => {
                let [r, t] = ["reflectance", "transmittance"].map(reflectance);
                self.bsdf(&DiffuseTransmitter::new(r?, t?).ok()?)
            }
            "phong" => {
                let [kd, ks] = ["kd", "ks"].map(reflectance);
                self.bsdf(&Phong::new(kd?, ks?, exponent("exponent")?).ok()?)
            }
            "ashikhmin-shirley" => {
                let [rs, rd] = ["rs", "rd"].map(reflectance);
                let model = AshikhminShirley::new(exponent("nu")?, exponent("nv")?, rs?, rd?);
                self.bsdf(&model.with_sampling(AshikhminShirleySampling::Specular))
            }
            "sample-ashikhmin-shirley-half" => {
                let lobe = PhongHalfVectors::new(exponent("nu")?, exponent("nv")?);
                let (h, pdf) = lobe.sample(self.uniforms::<T>()?);
                Some(Answer::Sample { direction: widen(h), pdf: pdf.to_f64() })
            }
            "sample-cosine-hemisphere" => {
                let w = cosine_hemisphere::from_square_polar(self.uniforms::<T>()?);
                let pdf = cosine_hemisphere::pdf::<T>(w).to_f64();
                Some(Answer::Sample { direction: widen(w), pdf })
            }
            "fresnel-dielectric" => value(fresnel::dielectric(self.cosine()?, eta()?.value())),
            "fresnel-conductor" => {
                let ior =
                    ComplexIor::new(self.parameter::<T>("eta")?, self.parameter("k")?).ok()?;
                value(fresnel::conductor(self.cosine()?, ior.eta(), ior.k()))
            }
            "fresnel-schlick" => {
                let f0 = Reflectance::new(self.parameter::<T>("f0")?).ok()?;
                value(fresnel::schlick(f0.value(), self.cosine()?))
            }
            "f0-from-ior" => value(fresnel::f0_from_ior(eta()?.value())),
            "refract" => {
                // Normalising in T would cost the digits that the critical angle needs.
                let (w, eta) = (self.coordinates::<T>("wi")?, eta()?);
                Some(
                    fresnel::refract(w, eta.value())
                        .map_or(Answer::TotalReflection, |t| Answer::Direction(widen(t))),
                )
            }
            "rough-conductor" => {
                let ior =
                    ComplexIor::new(self.parameter::<T>("eta")?, self.parameter("k")?).ok()?;
                let facets = self.facets(self.distribution(), Masking::HeightCorrelated)?;
                self.bsdf(&RoughConductor::new(ior, facets))
            }
            "rough-dielectric" => {
                let (interior, exterior) = (self.parameter("ior_int")?, self.parameter("ior_ext")?);
                let eta = Ior::from_media(interior, exterior).ok()?;
                let facets = self.facets::<T>(self.distribution(), Masking::Separable)?;
                self.bsdf(&RoughDielectric::<T>::new(eta, facets).ok()?)
            }
            "beer-lambert" => {
                let medium = Absorption::new(self.parameter::<T>("sigma_a")?).ok()?;
                value(medium.transmittance(self.parameter("distance")?))
            }
            "layered-linear" => {
                self.matte(&LayeredLinear::new(reflectance("rd")?, reflectance("rs")?).ok()?)
            }
            "layered-fresnel" => {
                self.matte(&LayeredFresnel::new(reflectance("r0")?, reflectance("rd")?))
            }
            "coupled" => {
                let interface = CoupledInterface::schlick(reflectance("r0")?);
                self.matte(&Coupled::new(interface, reflectance("rm")?))
            }
            _ => panic!("no model for {file}"),
        }
    }

    fn distribution(&self) -> &str {
        self.0["params"]["distribution"].as_str().unwrap_or_default()
    }
}

/// The condition-scaled error of a number, in ulps of `f32`; infinite for a broken one.
fn scaled_error(got: f64, exact: f64, condition: &Value) -> f64 {
    if !got.is_finite() || (got < 0.0 && exact >= 0.0) {
        return f64::INFINITY;
    }
    if exact == 0.0 {
        return if got.abs() <= LEAST { 0.0 } else { f64::INFINITY };
    }
    if exact < 0.0 && got == 0.0 {
        return 0.0;
    }
    let condition = condition[1].as_f64().unwrap_or(0.0);
    if condition > 1e5 {
        return 0.0;
    }
    (got - exact).abs() / ulp32(exact) / (1.0 + condition)
}

/// The worst of a row's errors.
fn row_error(row: &Value, answer: Option<&Answer>) -> f64 {
    match answer {
        Some(&Answer::Value(x)) => scaled_error(x, row["value"].as_f64().unwrap(), &row["cond"]),
        Some(&Answer::Bsdf { f, pdf }) => {
            let f = scaled_error(f, row["f"].as_f64().unwrap(), &row["cond"]);
            let density = pdf.zip(row["pdf"].as_f64());
            density.map_or(f, |(pdf, exact)| f.max(scaled_error(pdf, exact, &row["cond"])))
        }
        Some(Answer::TotalReflection) if row["tir"].as_bool() == Some(true) => 0.0,
        None | Some(Answer::TotalReflection) => f64::INFINITY,
        Some(&Answer::Direction(got)) => direction_error(row, got),
        Some(&Answer::Sample { direction, pdf }) => {
            let exact = row["pdf"].as_f64().unwrap();
            direction_error(row, direction).max(scaled_error(pdf, exact, &row["cond"]))
        }
    }
}

/// The condition-scaled distance from the exact direction, in ulps of 1.
fn direction_error(row: &Value, got: [f64; 3]) -> f64 {
    let Some(exact) = row["value"].as_array() else { return f64::INFINITY };
    let squared: f64 = got.iter().zip(exact).map(|(g, e)| Real::sqr(g - e.as_f64().unwrap())).sum();
    let condition = row["cond"][1].as_f64().unwrap_or(0.0);
    squared.sqrt() / ulp32(1.0) / (1.0 + condition)
}

/// Whether an answer is one a caller outside the domain may get.
fn is_acceptable(row: &Value, answer: Option<&Answer>) -> bool {
    let (got, pdf) = match answer {
        // Directions and total reflection of invalid input are vectors or nothing: never wrong here.
        None | Some(Answer::Direction(_) | Answer::TotalReflection) => return true,
        Some(&Answer::Sample { direction, pdf }) => {
            let unit = direction.iter().map(|c| c * c).sum::<f64>();
            return (unit - 1.0).abs() < 1e-6 && pdf.is_finite() && pdf >= 0.0;
        }
        Some(&Answer::Value(x)) => (x, 0.0),
        Some(&Answer::Bsdf { f, pdf }) => (f, pdf.unwrap_or(0.0)),
    };
    let valid = |x: f64| x.is_finite() && x >= 0.0;
    let near =
        |exact: &Value| exact.as_f64().is_none_or(|e| (got - e).abs() <= 1e-3 * e.abs() + 1e-44);
    valid(got)
        && valid(pdf)
        && match row["expect"].as_str().unwrap() {
            "zero" | "zero-or-error" | "reject" => got == 0.0,
            "zero-or-flipped" => got == 0.0 || near(&row["f_flipped"]),
            "value-or-error" => near(if row["fn"].is_string() { &row["value"] } else { &row["f"] }),
            "no-nan" => true,
            other => panic!("unknown expectation {other}"),
        }
}

/// Checks all files in one precision and names every row that misses its bound.
fn check<T: Real + Spectrum<Real = T>>(share: f64) {
    let mut misses = Vec::new();
    let mut rows = 0;
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "jsonl") {
            continue;
        }
        let file = path.file_stem().unwrap().to_str().unwrap();
        // An interpreter takes every sixteenth row.
        let step = if cfg!(miri) { 16 } else { 1 };
        for line in fs::read_to_string(&path).unwrap().lines().step_by(step) {
            let row: Value = serde_json::from_str(line).unwrap();
            let answer = Row(&row).answer::<T>(file);
            rows += 1;
            let stratum = row["stratum"].as_str().unwrap();
            if stratum == "ood" {
                if !is_acceptable(&row, answer.as_ref()) {
                    misses.push(format!("{} {}: {}", row["id"], row["tag"], row["expect"]));
                }
                continue;
            }
            let bound = share * if stratum == "typical" { TYPICAL } else { HARD };
            let error = row_error(&row, answer.as_ref());
            if error > bound {
                misses.push(format!("{} {}: {error:.3e} > {bound:.1e}", row["id"], row["tag"]));
            }
        }
    }
    assert!(rows > if cfg!(miri) { 430 } else { 7000 }, "only {rows} rows were found");
    assert!(misses.is_empty(), "of {rows} rows these miss their bound:\n{}", misses.join("\n"));
}

#[test]
fn every_row_holds_in_single_precision() {
    check::<f32>(1.0);
}

#[test]
fn every_row_holds_in_double_precision() {
    check::<f64>(F64_SHARE);
}
