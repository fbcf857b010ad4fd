//! Masking and shadowing of microfacets after Smith.

use std::rc::Rc;

use etendue_brdf::microfacet::{beckmann, ggx};
use etendue_brdf::{Alpha, Distribution, Masking, Microfacets};
use etendue_math::quadrature::{Adaptive, gauss_legendre};
use etendue_math::{Real, Vec3, Vector3};

use super::directions::direction;
use crate::functions::domain::{Domain, Probe, linear, narrow};
use crate::functions::family::{ErrorKind, FamilyInfo, Setup};
use crate::functions::reference::{DoubleDouble, Effort};
use crate::functions::variant::{Scalar, Variant};

pub(super) const GGX: FamilyInfo =
    FamilyInfo { name: "smith-ggx", title: "Smith's masking, GGX", build: ggx_family };

pub(super) const BECKMANN: FamilyInfo = FamilyInfo {
    name: "smith-beckmann",
    title: "Smith's masking, Beckmann",
    build: beckmann_family,
};

const ALPHAS: [f64; 6] = [0.05, 0.1, 0.2, 0.4, 0.7, 1.0];

/// Cosines of viewer and light, and the width of isotropic facets.
#[derive(Clone, Copy)]
struct Point {
    cos_o: f64,
    cos_i: f64,
    alpha: f64,
}

/// The direction in the plane y = 0 with this cosine, its sine in the precision asked for.
fn tilted<T: Real>(cos: f64) -> Vec3<T> {
    let cos = T::lit(cos);
    Vec3::<T>::new(((T::ONE - cos) * (T::ONE + cos)).sqrt(), T::ZERO, cos)
}

fn ggx_family(effort: Effort) -> Setup {
    let cosines: Vec<f64> = linear([0.02, 1.0], effort.choose(16, 5)).map(narrow).collect();
    let mut points = Vec::new();
    for alpha in ALPHAS.map(narrow) {
        for &cos_o in &cosines {
            points.extend(cosines.iter().map(|&cos_i| Point { cos_o, cos_i, alpha }));
        }
    }
    let probes = [0.2, 0.4, 0.7, 1.0].into_iter();
    let probes = probes.flat_map(|alpha| [0.0, 40.0, 80.0].map(|theta| furnace(alpha, theta)));
    let domain = Rc::new(Domain {
        words: "α 0.05, 0.1, 0.2, 0.4, 0.7 and 1; cosines of viewer and light from 0.02 to 1"
            .to_owned(),
        points,
        place: |p: &Point| {
            format!("α {:.2}, cos θo {:.2}, cos θi {:.2}", p.alpha, p.cos_o, p.cos_i)
        },
        probes: probes.collect(),
    });
    Setup {
        quantity: "visibility V = G2/(4 cos θo cos θi)",
        judged_by: ErrorKind::RmsRelative,
        variants: ggx_forms::<f64>(&domain).into_iter().chain(ggx_forms::<f32>(&domain)).collect(),
        // A dozen roundings of positive terms.
        bound: 1e-15,
        ground: Box::new(Rc::clone(&domain)),
        reference: "the height-correlated form in arithmetic of 106 bits: what a random walk on Smith's surface does in its \
                    first step",
        compute: domain.reference(height_correlated),
        prose: vec![
            "The separable form is another model, of facets that are masked and shadowed independently; its error is its \
             distance from the height-correlated one. Energies are albedos of a surface that reflects everything at every \
             facet.",
        ],
        advice: "The height-correlated form: it is exact for Smith's surface and costs little more than the separable \
                 one, whose use is to agree with renderers that have it. Hammon's fit has no root and takes a fraction \
                 of the time; it darkens smooth surfaces at grazing, and that shows in their energy. Schlick's fit \
                 imitates the separable form and adds its own error to that form's.",
    }
}

fn ggx_forms<T: Scalar>(domain: &Rc<Domain<Point>>) -> Vec<Variant> {
    let smith = |name, masking| {
        let prepare = move |p: &Point| {
            let alpha = Alpha::clamped(T::lit(p.alpha));
            let facets = Microfacets::new(Distribution::Ggx, alpha, alpha, masking);
            (facets, tilted::<T>(p.cos_o), tilted::<T>(p.cos_i))
        };
        let visibility = |(facets, wo, wi): &(Microfacets<T>, _, _)| facets.visibility(*wo, *wi);
        Variant::new(name, domain, prepare, visibility)
    };
    let scalars = |p: &Point| [p.cos_o, p.cos_i, p.alpha].map(T::lit);
    vec![
        smith("height-correlated", Masking::HeightCorrelated),
        smith("separable", Masking::Separable),
        Variant::new("Hammon's fit", domain, scalars, |&[o, i, alpha]: &[T; 3]| {
            ggx::visibility_hammon(o, i, alpha)
        }),
        Variant::new("Schlick's fit", domain, scalars, |&[o, i, alpha]: &[T; 3]| {
            ggx::visibility_schlick(o, i, alpha)
        }),
    ]
}

fn height_correlated(p: &Point) -> f64 {
    let [one, half, four] = [1.0, 0.5, 4.0].map(DoubleDouble::from);
    let [o, i, alpha] = [p.cos_o, p.cos_i, p.alpha].map(DoubleDouble::from);
    let lambda = |c: DoubleDouble| {
        let tan2 = (one - c.sqr()) / c.sqr();
        half * ((one + alpha.sqr() * tan2).sqrt() - one)
    };
    (one / (four * o * i * (one + lambda(o) + lambda(i)))).to_f64()
}

/// The albedo at a polar angle of facets that reflect everything: `∫ D(h) V cos θi dωi`.
fn furnace(alpha: f64, theta: f64) -> Probe<Point> {
    const NODES: usize = 64;
    let [x, y, z] = direction(theta, 0.0);
    let wo = Vec3::<f64>::new(x, y, z);
    let node = |(t, w): (f64, f64)| {
        let cos_i = t * (2.0 - t);
        let sin = ((1.0 - cos_i) * (1.0 + cos_i)).sqrt();
        // The mean of D over azimuths.
        let d: f64 = (0..2 * NODES)
            .map(|i| {
                let (y, x) = Real::sin_cos(f64::PI * (i as f64 + 0.5) / (2 * NODES) as f64);
                let wi = Vec3::<f64>::new(sin * x, sin * y, cos_i);
                ggx::ndf::<f64>((wo + wi).normalize(), alpha, alpha) / (2 * NODES) as f64
            })
            .sum();
        let weight = w * 2.0 * (1.0 - t) * cos_i * 2.0 * f64::PI * d;
        (Point { cos_o: z, cos_i, alpha }, weight)
    };
    let place = format!("α {alpha}, θo {theta:.0}°");
    Probe { place, nodes: gauss_legendre::<f64, NODES>().map(node).to_vec() }
}

/// Cosine and width.
type View = [f64; 2];

fn beckmann_family(effort: Effort) -> Setup {
    let cosines: Vec<f64> = linear([0.01, 1.0], effort.choose(100, 8)).map(narrow).collect();
    let alphas = ALPHAS.map(narrow);
    let domain = Rc::new(Domain {
        words: "α 0.05, 0.1, 0.2, 0.4, 0.7 and 1; cos θ from 0.01 to 1".to_owned(),
        points: alphas.iter().flat_map(|&a| cosines.iter().map(move |&c| [c, a])).collect(),
        place: |[cos, alpha]: &View| format!("α {alpha:.2}, cos θ {cos:.2}"),
        probes: Vec::new(),
    });
    Setup {
        quantity: "projected area σ = cos θ/G1 of the visible facets",
        judged_by: ErrorKind::RmsRelative,
        variants: beckmann_forms::<f64>(&domain)
            .into_iter()
            .chain(beckmann_forms::<f32>(&domain))
            .collect(),
        // The reference's own rule is good to a few 1e-15.
        bound: 1e-14,
        ground: Box::new(Rc::clone(&domain)),
        reference: "the integral over slopes that defines it, by adaptive quadrature",
        compute: domain.reference(projected_area),
        prose: vec![
            "The exact form has an error function and an exponential, Walter's fit a quotient.",
        ],
        advice: "The exact form where the sampler draws visible normals, whose density it normalises: a fit would bias nothing \
                 but weights would no longer cancel. Walter's fit to agree with renderers that use it, or where its error, \
                 small against that of measured roughness, is bought back in time.",
    }
}

fn beckmann_forms<T: Scalar>(domain: &Rc<Domain<View>>) -> Vec<Variant> {
    let prepare = |&[cos, alpha]: &View| (tilted::<T>(cos), T::lit(alpha));
    vec![
        Variant::new("exact", domain, prepare, |&(w, a)| beckmann::projected_area::<T>(w, a, a)),
        Variant::new("Walter's fit", domain, prepare, |&(w, a)| {
            beckmann::projected_area_walter::<T>(w, a, a)
        }),
    ]
}

/// `∫ (cos θ − p sin θ)⁺ exp(−p²/α²)/(α √π) dp` over the slopes p along the direction.
fn projected_area(&[cos, alpha]: &View) -> f64 {
    let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
    // In units of α; eight leave e⁻⁶⁴ out.
    let last = if sin > 0.0 { (cos / (alpha * sin)).min(8.0) } else { 8.0 };
    let mut integrand = |q: f64| (cos - alpha * q * sin) * Real::exp(-q * q);
    let rule = Adaptive::<f64, 16>::new(30);
    rule.integrate([-8.0, last], 1e-15, &mut integrand) / f64::PI.sqrt()
}
