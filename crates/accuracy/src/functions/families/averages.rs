//! Reflectances averaged over the hemisphere.

use std::rc::Rc;

use etendue_brdf::Reflectance;
use etendue_brdf::fresnel::{
    F82Tint, artistic_from_conductor, conductor, conductor_average, conductor_average_fit,
    dielectric_average, dielectric_average_fit, dielectric_average_quotient_fit, f0_from_ior,
    schlick_average,
};
use etendue_math::quadrature::gauss_legendre;

use super::metals::{metals, reflectance};
use crate::functions::domain::{Domain, linear, narrow};
use crate::functions::family::{ErrorKind, FamilyInfo, Setup};
use crate::functions::reference::{DoubleDouble, Effort};
use crate::functions::variant::{Scalar, Variant};

pub(super) const OUTSIDE: FamilyInfo = FamilyInfo {
    name: "dielectric-average",
    title: "Average dielectric reflectance, light from the thinner side",
    build: |effort| {
        dielectric_family(
            Side::Outside,
            effort,
            "η from 1.1 to 3",
            "Once per material, the quadrature. Where an index changes from point to point, the polynomial fit; the \
             quotient is for those who count every instruction, and the average of Schlick's polynomial for models whose \
             reflectance is Schlick's polynomial as well: in them it is exact.",
        )
    },
};

pub(super) const INSIDE: FamilyInfo = FamilyInfo {
    name: "dielectric-average-inside",
    title: "Average dielectric reflectance, light from the denser side",
    build: |effort| {
        dielectric_family(
            Side::Inside,
            effort,
            "1/η from 1.1 to 3",
            "Once per material, the quadrature. For a look-up at every point, the polynomial fit up to the indices of \
             glass, the cubic beyond: the first leaves its digits where 1/η exceeds 2.",
        )
    },
};

pub(super) const CONDUCTOR: FamilyInfo = FamilyInfo {
    name: "conductor-average",
    title: "Average conductor reflectance",
    build: conductor_family,
};

#[derive(Clone, Copy, PartialEq)]
enum Side {
    Outside,
    Inside,
}

const QUANTITY: &str = "2 ∫₀¹ F(c) c dc";

fn dielectric_family(side: Side, effort: Effort, words: &str, advice: &'static str) -> Setup {
    let index = move |n: f64| match side {
        Side::Outside => narrow(n),
        Side::Inside => narrow(1.0 / n),
    };
    let domain = Rc::new(Domain {
        words: words.to_owned(),
        points: linear([1.1, 3.0], effort.choose(60, 8)).map(index).collect(),
        place: |eta: &f64| format!("η {eta:.3}"),
        probes: Vec::new(),
    });
    Setup {
        quantity: QUANTITY,
        judged_by: ErrorKind::RmsRelative,
        variants: dielectric_forms::<f64>(&domain, side)
            .into_iter()
            .chain(dielectric_forms::<f32>(&domain, side))
            .collect(),
        // What the audit allows the quadrature.
        bound: 1e-10,
        ground: Box::new(Rc::clone(&domain)),
        reference: "the closed form of Walsh (1926) in arithmetic of 106 bits",
        compute: domain.reference(|&eta| exact(eta)),
        prose: vec![
            "The quadrature computes in double precision whatever the type of its argument.",
        ],
        advice,
    }
}

fn dielectric_forms<T: Scalar>(domain: &Rc<Domain<f64>>, side: Side) -> Vec<Variant> {
    let prepare = |eta: &f64| T::lit(*eta);
    let mut all = vec![
        Variant::new("quadrature", domain, prepare, |&eta: &T| dielectric_average(eta)),
        Variant::new("polynomial fit", domain, prepare, |&eta: &T| dielectric_average_fit(eta)),
        Variant::new(
            if side == Side::Outside { "quotient fit" } else { "cubic fit" },
            domain,
            prepare,
            |&eta: &T| dielectric_average_quotient_fit(eta),
        ),
    ];
    if side == Side::Outside {
        let f0 = |eta: &f64| f0_from_ior(T::lit(*eta));
        all.push(Variant::new("Schlick's average", domain, f0, |&f0: &T| schlick_average(f0)));
    }
    all
}

/// Walsh's closed form for an index above 1; for light from the other side by `1 − F_avg(1/n) = (1 − F_avg(n))/n²`.
fn exact(eta: f64) -> f64 {
    let number = DoubleDouble::from;
    let given = number(eta);
    if eta < 1.0 {
        let n = number(1.0) / given;
        return (number(1.0) - (number(1.0) - average_reflectance(n)) * given.sqr()).to_f64();
    }
    average_reflectance(given).to_f64()
}

/// F_avg of an index n above 1.
pub(super) fn average_reflectance(n: DoubleDouble) -> DoubleDouble {
    let number = DoubleDouble::from;
    let [one, two] = [1.0, 2.0].map(number);
    let (n2, n4) = (n.sqr(), n.powi(4));
    let (plus, minus) = (n2 + one, n2 - one);
    number(0.5)
        + (n - one) * (number(3.0) * n + one) / (number(6.0) * (n + one).sqr())
        + n2 * minus.sqr() / plus.powi(3) * ((n - one) / (n + one)).ln()
        - two * n.powi(3) * (n2 + two * n - one) / (plus * (n4 - one))
        + number(8.0) * n4 * (n4 + one) / (plus * (n4 - one).sqr()) * n.ln()
}

fn conductor_family(effort: Effort) -> Setup {
    let domain = Rc::new(Domain {
        words: super::metals::WORDS.to_owned(),
        points: metals(effort),
        place: |[eta, k]: &[f64; 2]| format!("η {eta:.3}, k {k:.2}"),
        probes: Vec::new(),
    });
    let rule = gauss_legendre::<f64, 96>();
    // c = t², where F is steepest.
    let term = |index, (t, w): (f64, f64)| 4.0 * w * t * t * t * reflectance(t * t, index);
    let average = move |&index: &[f64; 2]| rule.iter().map(|&node| term(index, node)).sum();
    Setup {
        quantity: QUANTITY,
        judged_by: ErrorKind::RmsRelative,
        variants: conductor_forms::<f64>(&domain)
            .into_iter()
            .chain(conductor_forms::<f32>(&domain))
            .collect(),
        // What the model's documentation promises for metals.
        bound: 1e-12,
        ground: Box::new(Rc::clone(&domain)),
        reference: "quadrature with twice as many nodes, of the textbook's equations in arithmetic of 106 bits",
        compute: domain.reference(average),
        prose: vec![
            "The fit is given reflectivity and edge tint, limited to 1, Schlick's average the reflectance at normal incidence, \
             that of F82 also the one at 82°.",
        ],
        advice: "Once per material, the quadrature. The average of F82 goes with F82, of which it is the exact \
                 integral; the fit goes with edge tints, Schlick's average with Schlick's polynomial. As \
                 approximations of real metals the first two are as good as each other, and the third is half as good.",
    }
}

fn conductor_forms<T: Scalar>(domain: &Rc<Domain<[f64; 2]>>) -> Vec<Variant> {
    let index = |index: &[f64; 2]| index.map(T::lit);
    let normal = move |i: &[f64; 2]| {
        let [eta, k] = index(i);
        conductor(T::ONE, eta, k)
    };
    let f82 = move |i: &[f64; 2]| {
        let [eta, k] = index(i);
        let edge = conductor(T::lit(1.0 / 7.0), eta, k);
        let [f0, f82] = [normal(i), edge].map(Reflectance::clamped);
        F82Tint::from_f82(f0, f82)
    };
    let artistic = move |i: &[f64; 2]| {
        let [eta, k] = index(i);
        let [r, g] = artistic_from_conductor(eta, k);
        [r, g.min(T::ONE)]
    };
    vec![
        Variant::new("quadrature", domain, index, |&[eta, k]: &[T; 2]| conductor_average(eta, k)),
        Variant::new("fit by edge tint", domain, artistic, |&[r, g]: &[T; 2]| {
            conductor_average_fit(r, g)
        }),
        Variant::new("F82's average", domain, f82, F82Tint::<T>::average),
        Variant::new("Schlick's average", domain, normal, |&f0: &T| schlick_average(f0)),
    ]
}
