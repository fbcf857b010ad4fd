//! Published formulas read literally, in `f64`: what the models must agree with where nothing is hard.
//!
//! Angles by `acos`, tangents of angles, quotients that cancel: the forms of the papers, not the
//! forms in use, so that a wrong constant cannot stand in both.

pub(crate) mod principled;

use core::f64::consts::PI;

use etendue_brdf::microfacet::FacetLoss;
use etendue_brdf::{BeckmannLambda, Distribution, Masking, Microfacets, ParameterError};
use etendue_math::Real;

type Direction = [f64; 3];

fn dot(a: Direction, b: Direction) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn normalized(w: Direction) -> Direction {
    let length = dot(w, w).sqrt();
    w.map(|x| x / length)
}

fn both_above(wo: Direction, wi: Direction) -> bool {
    wo[2] > 0.0 && wi[2] > 0.0
}

fn cos_azimuth(wo: Direction, wi: Direction) -> f64 {
    Real::cos(Real::atan2(wo[1], wo[0]) - Real::atan2(wi[1], wi[0]))
}

/// Lambert.
pub(crate) fn lambert(rho: f64, wo: Direction, wi: Direction) -> f64 {
    if both_above(wo, wi) { rho / PI } else { 0.0 }
}

/// Oren and Nayar 1994, eqs. 27 to 29, limited to f ≥ 0.
pub(crate) fn oren_nayar(rho: f64, sigma: f64, wo: Direction, wi: Direction) -> f64 {
    if !both_above(wo, wi) {
        return 0.0;
    }
    let (to, ti) = (Real::acos(wo[2]), Real::acos(wi[2]));
    let (alpha, beta, cos_phi) = (to.max(ti), to.min(ti), cos_azimuth(wo, wi));
    let s2 = sigma * sigma;
    let c1 = 1.0 - 0.5 * s2 / (s2 + 0.33);
    let lift = if cos_phi >= 0.0 { 0.0 } else { Real::powi(2.0 * beta / PI, 3) };
    let c2 = 0.45 * s2 / (s2 + 0.09) * (Real::sin(alpha) - lift);
    let c3 = 0.125 * s2 / (s2 + 0.09) * Real::powi(4.0 * alpha * beta / (PI * PI), 2);
    let c4 = 0.17 * s2 / (s2 + 0.13);
    let f1 = rho / PI
        * (c1
            + cos_phi * c2 * Real::tan(beta)
            + (1.0 - cos_phi.abs()) * c3 * Real::tan(0.5 * (alpha + beta)));
    let f2 = c4 * rho * rho / PI * (1.0 - cos_phi * Real::powi(2.0 * beta / PI, 2));
    (f1 + f2).max(0.0)
}

/// Oren and Nayar 1994, eq. 30.
pub(crate) fn oren_nayar_qualitative(rho: f64, sigma: f64, wo: Direction, wi: Direction) -> f64 {
    if !both_above(wo, wi) {
        return 0.0;
    }
    let (to, ti) = (Real::acos(wo[2]), Real::acos(wi[2]));
    let s2 = sigma * sigma;
    let (a, b) = (1.0 - 0.5 * s2 / (s2 + 0.33), 0.45 * s2 / (s2 + 0.09));
    let lobe = cos_azimuth(wo, wi).max(0.0) * Real::sin(to.max(ti)) * Real::tan(to.min(ti));
    rho / PI * (a + b * lobe)
}

/// Fujii's improved form of Oren and Nayar, with σ as roughness, normalised at normal incidence.
pub(crate) fn fujii(rho: f64, roughness: f64, wo: Direction, wi: Direction) -> f64 {
    if !both_above(wo, wi) {
        return 0.0;
    }
    let a = 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * PI)) * roughness);
    let s = dot(wo, wi) - wo[2] * wi[2];
    let t = if s > 0.0 { wo[2].max(wi[2]) } else { 1.0 };
    rho / PI * a * (1.0 + roughness * s / t)
}

/// Portsmouth, Kutz and Hill 2025 with the exact albedo.
pub(crate) fn eon(rho: f64, roughness: f64, wo: Direction, wi: Direction) -> f64 {
    if !both_above(wo, wi) {
        return 0.0;
    }
    let a = 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * PI)) * roughness);
    let b = roughness * a;
    let albedo = |cos: f64| {
        let (theta, sin) = (Real::acos(cos), (1.0 - cos * cos).sqrt());
        let g = sin * (theta - sin * cos) + 2.0 / 3.0 * (sin / cos * (1.0 - sin * sin * sin) - sin);
        a + b / PI * g
    };
    let average = a + b * (2.0 / 3.0 - 28.0 / (15.0 * PI));
    let multiple = rho * rho * average / (1.0 - rho * (1.0 - average)) / PI;
    let lost = (1.0 - albedo(wo[2])) * (1.0 - albedo(wi[2]));
    fujii(rho, roughness, wo, wi) + multiple * lost / (1.0 - average).max(1e-300)
}

/// Shirley et al. 1997 with Schlick's Fresnel term: the matte part.
pub(crate) fn coupled(r0: f64, rm: f64, wo: Direction, wi: Direction) -> f64 {
    if !both_above(wo, wi) {
        return 0.0;
    }
    let lost = |w: Direction| (1.0 - r0) * (1.0 - Real::powi(1.0 - w[2], 5));
    if r0 < 1.0 { 21.0 / (20.0 * PI * (1.0 - r0)) * rm * lost(wo) * lost(wi) } else { 0.0 }
}

/// Fresnel's equations, Snell's law for the cosine of the refracted ray.
pub(crate) fn dielectric(cos: f64, eta: f64) -> f64 {
    let sin2_t = (1.0 - cos * cos) / (eta * eta);
    if sin2_t >= 1.0 {
        return 1.0;
    }
    let cos_t = (1.0 - sin2_t).sqrt();
    let rs = (cos - eta * cos_t) / (cos + eta * cos_t);
    let rp = (eta * cos - cos_t) / (eta * cos + cos_t);
    0.5 * (rs * rs + rp * rp)
}

/// Fresnel's equations with the complex index η + ik.
pub(crate) fn conductor(cos: f64, [eta, k]: [f64; 2]) -> f64 {
    let (sin2, eta2, k2) = (1.0 - cos * cos, eta * eta, k * k);
    let t0 = eta2 - k2 - sin2;
    let a2b2 = (t0 * t0 + 4.0 * eta2 * k2).sqrt();
    let a = (0.5 * (a2b2 + t0)).max(0.0).sqrt();
    let rs = (a2b2 + cos * cos - 2.0 * a * cos) / (a2b2 + cos * cos + 2.0 * a * cos);
    let (t3, t4) = (cos * cos * a2b2 + sin2 * sin2, 2.0 * a * cos * sin2);
    0.5 * (rs + rs * (t3 - t4) / (t3 + t4))
}

/// A microfacet surface as the papers write it.
#[derive(Clone, Copy)]
pub(crate) struct Facets {
    pub(crate) distribution: Distribution,
    pub(crate) widths: [f64; 2],
    pub(crate) masking: Masking,
}

impl Facets {
    /// `((cos φ/αx)² + (sin φ/αy)²) tan²θ` and its companion `√((αx cos φ)² + (αy sin φ)²) tan θ`.
    fn tangents(&self, w: Direction) -> [f64; 2] {
        let ([x, y, z], [ax, ay]) = (w, self.widths);
        [
            Real::sqr(x / (ax * z)) + Real::sqr(y / (ay * z)),
            Real::sqr(ax * x / z) + Real::sqr(ay * y / z),
        ]
    }

    fn d(&self, h: Direction) -> f64 {
        let (e, cos4) = (self.tangents(h)[0], Real::powi(h[2], 4));
        let area = PI * self.widths[0] * self.widths[1] * cos4;
        match self.distribution {
            Distribution::Ggx => 1.0 / (area * Real::sqr(1.0 + e)),
            Distribution::Beckmann { .. } => Real::exp(-e) / area,
        }
    }

    /// Smith's Λ; of Walter's fit that which its G1 stands for.
    fn lambda(&self, w: Direction) -> f64 {
        let t2 = self.tangents(w)[1];
        let a = 1.0 / t2.sqrt();
        match self.distribution {
            Distribution::Ggx => 0.5 * ((1.0 + t2).sqrt() - 1.0),
            Distribution::Beckmann { lambda: BeckmannLambda::Exact } => {
                0.5 * (Real::exp(-a * a) / (a * PI.sqrt()) - (1.0 - Real::erf(a)))
            }
            Distribution::Beckmann { lambda: BeckmannLambda::Walter } if a >= 1.6 => 0.0,
            Distribution::Beckmann { lambda: BeckmannLambda::Walter } => {
                (1.0 + 2.276 * a + 2.577 * a * a) / (3.535 * a + 2.181 * a * a) - 1.0
            }
        }
    }

    fn g(&self, wo: Direction, wi: Direction) -> f64 {
        let (o, i) = (self.lambda(wo), self.lambda(wi));
        match self.masking {
            Masking::HeightCorrelated => 1.0 / (1.0 + o + i),
            Masking::Separable => 1.0 / ((1.0 + o) * (1.0 + i)),
        }
    }

    /// Cook and Torrance 1982, Walter et al. 2007, eq. 20.
    pub(crate) fn reflection(
        &self,
        fresnel: impl Fn(f64) -> f64,
        wo: Direction,
        wi: Direction,
    ) -> f64 {
        if !both_above(wo, wi) {
            return 0.0;
        }
        let h = normalized([wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]]);
        fresnel(dot(wo, h)) * self.d(h) * self.g(wo, wi) / (4.0 * wo[2] * wi[2])
    }

    /// Walter et al. 2007, eqs. 20 and 21; radiance leaves towards `wo`.
    pub(crate) fn dielectric(&self, eta: f64, wo: Direction, wi: Direction) -> f64 {
        // The media of wo and of wi.
        let index = |w: Direction| if w[2] > 0.0 { 1.0 } else { eta };
        let (no, ni) = (index(wo), index(wi));
        let below = eta / (no * no); // n(other side) / n(side of wo)
        let up = |w: Direction| [w[0], w[1], w[2].abs()];
        if wo[2] * wi[2] > 0.0 {
            return self.reflection(|c| dielectric(c, below), up(wo), up(wi));
        }
        let h = normalized([0, 1, 2].map(|k| -(no * wo[k] + ni * wi[k])));
        let (oh, ih) = (dot(wo, h), dot(wi, h));
        let facet = if h[2] < 0.0 { h.map(|x| -x) } else { h };
        if dot(wo, facet) * wo[2] <= 0.0 || dot(wi, facet) * wi[2] <= 0.0 {
            return 0.0;
        }
        let jacobian = no * no / Real::sqr(ni * ih + no * oh);
        (ih * oh / (wi[2] * wo[2])).abs()
            * jacobian
            * (1.0 - dielectric(oh.abs(), below))
            * self.g(up(wo), up(wi))
            * self.d(facet)
    }
}

/// A rough metal and what its facets lose, for compensations of it.
pub(crate) struct Compensated {
    facets: Facets,
    index: [f64; 2],
    average_reflectance: f64,
    loss: FacetLoss<f64>,
}

impl Compensated {
    pub(crate) fn new(
        facets: Facets,
        index: [f64; 2],
        surface: &Microfacets<f64>,
    ) -> Result<Self, ParameterError> {
        let average_reflectance = cosine_average(|c| conductor(c, index));
        let loss = FacetLoss::new(surface)?;
        Ok(Self { facets, index, average_reflectance, loss })
    }

    fn single(&self, wo: Direction, wi: Direction) -> f64 {
        self.facets.reflection(|cos| conductor(cos, self.index), wo, wi)
    }

    /// Kulla and Conty 2017, with the square of the average reflectance.
    pub(crate) fn kulla_conty(&self, wo: Direction, wi: Direction) -> f64 {
        if !both_above(wo, wi) {
            return 0.0;
        }
        let (f, e) = (self.average_reflectance, 1.0 - self.loss.average());
        let color = f * f * e / (1.0 - f * (1.0 - e));
        let lost = self.loss.at(wo[2]) * self.loss.at(wi[2]);
        self.single(wo, wi) + color * lost / (PI * (1.0 - e))
    }

    /// Turquin 2019, eq. 16.
    pub(crate) fn turquin(&self, wo: Direction, wi: Direction) -> f64 {
        let e = 1.0 - self.loss.at(wo[2]);
        (1.0 + conductor(1.0, self.index) * (1.0 - e) / e) * self.single(wo, wi)
    }
}

/// `2 ∫ f(c) c dc`, by the midpoint rule in `c = t²`, where reflectances from below the thinner medium have a
/// root at 0.
pub(crate) fn cosine_average(f: impl Fn(f64) -> f64) -> f64 {
    stretched_average(0.0, f)
}

fn stretched_average(start: f64, f: impl Fn(f64) -> f64) -> f64 {
    const N: u32 = 20_000;
    let length = 1.0 - start;
    let node = |i: u32| (f64::from(i) + 0.5) / f64::from(N);
    let points = (0..N).map(|i| (start + length * node(i) * node(i), node(i)));
    points.map(|(c, t)| f(c) * 2.0 * c * 2.0 * t * length / f64::from(N)).sum()
}

/// The average internal reflectance, on either side of the critical cosine.
fn internal_average(eta: f64) -> f64 {
    let critical = (1.0 - 1.0 / (eta * eta)).max(0.0).sqrt();
    stretched_average(critical, |c| dielectric(c, 1.0 / eta)) + critical * critical
}

/// The diffuse part of a smooth plastic, for an albedo of the base with its internal reflections.
pub(crate) fn plastic(base: f64, eta: f64, wo: Direction, wi: Direction) -> f64 {
    if !both_above(wo, wi) {
        return 0.0;
    }
    base * (1.0 - dielectric(wo[2], eta)) * (1.0 - dielectric(wi[2], eta)) / (PI * eta * eta)
}

/// `ρ/(1 − F)`, the reflections between base and interface summed as if the base were white.
pub(crate) fn linear_base(rho: f64, eta: f64) -> f64 {
    rho / (1.0 - internal_average(eta))
}

/// `ρ/(1 − ρF)`, every reflection by the base absorbing anew.
pub(crate) fn non_linear_base(rho: f64, eta: f64) -> f64 {
    rho / (1.0 - rho * internal_average(eta))
}
