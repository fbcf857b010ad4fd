//! Reflectance of an interface between dielectrics.

use std::rc::Rc;

use etendue_brdf::fresnel::{
    dielectric, dielectric_textbook, f0_from_ior, schlick, schlick_gaussian, schlick_powf,
};
use etendue_math::quadrature::gauss_legendre;

use crate::functions::domain::{Domain, Probe, linear, logarithmic, narrow};
use crate::functions::family::{ErrorKind, FamilyInfo, Setup};
use crate::functions::reference::{DoubleDouble, Effort};
use crate::functions::variant::{Scalar, Variant};

/// Glass, water, plastics, gems.
pub(super) const USUAL: FamilyInfo = FamilyInfo {
    name: "dielectric-fresnel",
    title: "Dielectric Fresnel reflectance",
    build: |effort| {
        let count = effort.choose(24, 5);
        build(
            effort,
            "η from 1.2 to 3, seen from the thinner side; cos θ from 0.01 to 1",
            &linear([1.2, 3.0], count).collect::<Vec<_>>(),
            Schlick::Yes,
            vec![
                "Schlick's polynomial is another function, not a rounding of this one: in single and in double precision its error is \
                 the same, orders of magnitude above that of the equations. Its three forms differ in cost, and the Gaussian \
                 a little in value.",
            ],
            "Where a picture should be right, the equations: at oblique angles Schlick's polynomial errs by a good part of the \
             value, most for small indices. Where a root and two quotients are too much, Schlick's polynomial by products: a \
             general power and the Gaussian buy nothing on a processor on which three products cost next to nothing. For these \
             indices the textbook's form is as good as the stable one; for indices near 1 see the next table.",
        )
    },
};

/// Nearly the same medium on both sides.
pub(super) const MATCHED: FamilyInfo = FamilyInfo {
    name: "dielectric-fresnel-matched",
    title: "Dielectric Fresnel reflectance, nearly matched indices",
    build: |effort| {
        let count = effort.choose(24, 5);
        build(
            effort,
            "η − 1 from 1e-6 to 0.1, by its logarithm, seen from the thinner side; cos θ from 0.01 to 1",
            &logarithmic([1e-6, 0.1], count).map(|excess| 1.0 + excess).collect::<Vec<_>>(),
            Schlick::No,
            vec![
                "Water in ice, glass in oil, the layers of a coating: the reflectance is the square of a small number, \
                 and the textbook form takes it from a difference of numbers near 1.",
            ],
            "The stable form: the textbook's takes less time, but keeps only the first digits in single precision and \
             half of them in double. Schlick's polynomial is left out: for these indices it is off by orders of \
             magnitude.",
        )
    },
};

/// Cosine of incidence and index.
#[derive(Clone, Copy)]
struct Point {
    cos: f64,
    eta: f64,
}

/// Whether Schlick's polynomial is among the variants.
#[derive(Clone, Copy, PartialEq)]
enum Schlick {
    Yes,
    No,
}

fn build(
    effort: Effort,
    words: &str,
    indices: &[f64],
    schlick: Schlick,
    prose: Vec<&'static str>,
    advice: &'static str,
) -> Setup {
    let cosines: Vec<f64> = linear([0.01, 1.0], effort.choose(100, 12)).collect();
    let point = |cos: f64, eta: f64| Point { cos: narrow(cos), eta: narrow(eta) };
    let points = indices.iter().flat_map(|&eta| cosines.iter().map(move |&c| point(c, eta)));
    // The mean over the hemisphere, 2 ∫ F c dc with c = t², where F has a root's kink at grazing.
    let average = |eta: f64| Probe {
        place: format!("η − 1 = {:.3e}", narrow(eta) - 1.0),
        nodes: gauss_legendre::<f64, 48>()
            .map(|(t, w)| (point(t * t, eta), 4.0 * w * t * t * t))
            .to_vec(),
    };
    let domain = Rc::new(Domain {
        words: words.to_owned(),
        points: points.collect(),
        place: |p| format!("cos θ = {:.3}, η − 1 = {:.3e}", p.cos, p.eta - 1.0),
        probes: indices.iter().copied().map(average).collect(),
    });
    let mut variants = exact_forms::<f64>(&domain);
    variants.extend(exact_forms::<f32>(&domain));
    if schlick == Schlick::Yes {
        variants.extend(schlick_forms::<f64>(&domain));
        variants.extend(schlick_forms::<f32>(&domain));
    }
    Setup {
        quantity: "unpolarised reflectance F(cos θ, η)",
        judged_by: ErrorKind::RmsRelative,
        variants,
        // The inputs are exact: what is left are roundings, amplified fourfold towards Brewster's angle of one polarisation.
        bound: 1e-15,
        ground: Box::new(Rc::clone(&domain)),
        reference: "the textbook's equations in arithmetic of 106 bits",
        compute: domain.reference(|p| textbook(p.cos, p.eta)),
        prose,
        advice,
    }
}

/// The stable form and the textbook's.
fn exact_forms<T: Scalar>(domain: &Rc<Domain<Point>>) -> Vec<Variant> {
    let prepare = |p: &Point| [T::lit(p.cos), T::lit(p.eta)];
    vec![
        Variant::new("stable", domain, prepare, |&[c, eta]: &[T; 2]| dielectric(c, eta)),
        Variant::new("textbook", domain, prepare, |&[c, eta]: &[T; 2]| dielectric_textbook(c, eta)),
    ]
}

/// Schlick's polynomial, given the reflectance at normal incidence.
fn schlick_forms<T: Scalar>(domain: &Rc<Domain<Point>>) -> Vec<Variant> {
    let prepare = |p: &Point| [T::lit(p.cos), f0_from_ior(T::lit(p.eta))];
    vec![
        Variant::new("Schlick by products", domain, prepare, |&[c, f0]: &[T; 2]| schlick(f0, c)),
        Variant::new("Schlick by powf", domain, prepare, |&[c, f0]: &[T; 2]| schlick_powf(f0, c)),
        Variant::new("Schlick by Gaussian", domain, prepare, |&[c, f0]: &[T; 2]| {
            schlick_gaussian(f0, c)
        }),
    ]
}

/// Snell and Fresnel as printed, without total reflection.
pub(super) fn textbook(cos: f64, eta: f64) -> f64 {
    reflectance(cos.into(), eta.into()).to_f64()
}

/// The same of numbers of that precision.
pub(super) fn reflectance(c: DoubleDouble, eta: DoubleDouble) -> DoubleDouble {
    let one = DoubleDouble::from(1.0);
    let t = (one - (one - c.sqr()) / eta.sqr()).sqrt();
    let rs = (c - eta * t) / (c + eta * t);
    let rp = (eta * c - t) / (eta * c + t);
    (rs.sqr() + rp.sqr()) * 0.5.into()
}
