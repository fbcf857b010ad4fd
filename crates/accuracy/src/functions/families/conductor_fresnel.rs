//! Reflectance of metals.

use std::rc::Rc;

use etendue_brdf::Reflectance;
use etendue_brdf::fresnel::{
    F82Tint, artistic_from_conductor, conductor, conductor_from_artistic, conductor_textbook,
    schlick,
};
use etendue_math::quadrature::gauss_legendre;

use super::metals::{metals, reflectance};
use crate::functions::domain::{Domain, Probe, linear, narrow};
use crate::functions::family::{ErrorKind, FamilyInfo, Setup};
use crate::functions::reference::Effort;
use crate::functions::variant::{Scalar, Variant};

pub(super) const INFO: FamilyInfo =
    FamilyInfo { name: "conductor-fresnel", title: "Conductor Fresnel reflectance", build };

/// Cosine of incidence and complex index.
#[derive(Clone, Copy)]
struct Point {
    cos: f64,
    eta: f64,
    k: f64,
}

fn build(effort: Effort) -> Setup {
    let metals = metals(effort);
    let point = |cos: f64, [eta, k]: [f64; 2]| Point { cos: narrow(cos), eta, k };
    let cosines: Vec<f64> = linear([0.01, 1.0], effort.choose(34, 8)).collect();
    // 2 ∫ F c dc
    let average = |[eta, k]: [f64; 2]| Probe {
        place: format!("η {eta:.3}, k {k:.2}"),
        nodes: gauss_legendre::<f64, 24>().map(|(c, w)| (point(c, [eta, k]), 2.0 * w * c)).to_vec(),
    };
    let domain = Rc::new(Domain {
        words: format!("{}; cos θ from 0.01 to 1", super::metals::WORDS),
        points: metals.iter().flat_map(|&m| cosines.iter().map(move |&c| point(c, m))).collect(),
        place: |p: &Point| format!("cos θ = {:.3}, η {:.3}, k {:.2}", p.cos, p.eta, p.k),
        probes: metals.iter().copied().map(average).collect(),
    });
    Setup {
        quantity: "unpolarised reflectance F(cos θ, η + ik)",
        judged_by: ErrorKind::RmsRelative,
        variants: forms::<f64>(&domain).into_iter().chain(forms::<f32>(&domain)).collect(),
        // The textbook's equations in 106 bits; some ten roundings.
        bound: 1e-15,
        ground: Box::new(Rc::clone(&domain)),
        reference: "the textbook's equations in arithmetic of 106 bits",
        compute: domain.reference(|p: &Point| reflectance(p.cos, [p.eta, p.k])),
        prose: vec![
            "Schlick's polynomial is given the reflectance at normal incidence, F82 that and the one at 82°. The artistic form \
             is the exact one, of an index that is computed from reflectivity and edge tint at every evaluation; where η is \
             smaller than its parametrisation reaches, the tint is limited to 1.",
        ],
        advice: "A metal that is known by its index: the exact form; the textbook's saves time and loses a digit for \
                 good mirrors, and more for dielectrics, which are conductors as well. A metal that is known by its \
                 colours: F82, which costs hardly more than Schlick's polynomial and keeps the dip before grazing that \
                 metals have and Schlick's polynomial lacks. Reflectivity and edge tint are for people who choose \
                 colours: convert them to an index once per material, not at every evaluation.",
    }
}

fn forms<T: Scalar>(domain: &Rc<Domain<Point>>) -> Vec<Variant> {
    let prepare = |p: &Point| [p.cos, p.eta, p.k].map(T::lit);
    let normal = |p: &Point| conductor(T::ONE, T::lit(p.eta), T::lit(p.k));
    let edge = |p: &Point| conductor(T::lit(1.0 / 7.0), T::lit(p.eta), T::lit(p.k));
    let f82 = move |p: &Point| {
        let [f0, f82] = [normal(p), edge(p)].map(Reflectance::clamped);
        (T::lit(p.cos), F82Tint::from_f82(f0, f82))
    };
    let artistic = |p: &Point| {
        let [r, g] = artistic_from_conductor(T::lit(p.eta), T::lit(p.k));
        [T::lit(p.cos), r, g.min(T::ONE)]
    };
    vec![
        Variant::new("stable", domain, prepare, |&[c, eta, k]: &[T; 3]| conductor(c, eta, k)),
        Variant::new("textbook", domain, prepare, |&[c, eta, k]: &[T; 3]| {
            conductor_textbook(c, eta, k)
        }),
        Variant::new("artistic", domain, artistic, |&[c, r, g]: &[T; 3]| {
            let [eta, k] = conductor_from_artistic(r, g);
            conductor(c, eta, k)
        }),
        Variant::new("F82", domain, f82, |(c, f82): &(T, F82Tint<T>)| f82.reflectance(*c)),
        Variant::new(
            "Schlick",
            domain,
            move |p: &Point| [T::lit(p.cos), normal(p)],
            |&[c, f0]: &[T; 2]| schlick(f0, c),
        ),
    ]
}
