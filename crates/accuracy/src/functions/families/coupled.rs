//! The matte term under a mirror that leaves exactly what the mirror does not reflect.

use std::rc::Rc;

use etendue_brdf::fresnel::{dielectric_transmittance, f0_from_ior};
use etendue_brdf::{Coupled, CoupledInterface, Ior, Reflectance};
use etendue_math::Vector3;

use super::averages::average_reflectance;
use super::dielectric_fresnel::reflectance;
use super::directions::{Pair, albedo_probe, models, pairs};
use crate::functions::domain::{Domain, linear};
use crate::functions::family::{ErrorKind, FamilyInfo, Setup};
use crate::functions::reference::{DoubleDouble, Effort};
use crate::functions::variant::{Scalar, Variant};

pub(super) const INFO: FamilyInfo =
    FamilyInfo { name: "coupled", title: "Coupled matte and specular reflection", build };

const INDICES: [f64; 3] = [1.25, 1.5, 2.0];

fn build(effort: Effort) -> Setup {
    let polar: Vec<f64> = linear([0.0, 88.0], effort.choose(12, 4)).collect();
    let cases = 0..INDICES.len();
    let probe = |case: usize| {
        let material = format!("η {}", INDICES[case]);
        [0.0, 45.0, 75.0, 85.0].map(|theta| albedo_probe::<24>(case, &material, theta))
    };
    let domain = Rc::new(Domain {
        words: "η 1.25, 1.5 and 2 over a white base; polar angles of viewer and light from 0° to 88° in steps of 8°".to_owned(),
        points: cases.clone().flat_map(|case| pairs(case, &polar, &[90.0])).collect(),
        place: |pair: &Pair| format!("η {}, {}", INDICES[pair.case], pair.words()),
        probes: cases.flat_map(probe).collect(),
    });
    Setup {
        quantity: "matte term f(wo, wi) = k (1 − F(θo)) (1 − F(θi)) in sr⁻¹",
        judged_by: ErrorKind::RmsRelative,
        variants: forms::<f64>(&domain).into_iter().chain(forms::<f32>(&domain)).collect(),
        // k comes from a quadrature good to 1e-10.
        bound: 1e-10,
        ground: Box::new(Rc::clone(&domain)),
        reference: "the model with Fresnel's F, and with k from the closed form of its average, in arithmetic of 106 bits",
        compute: domain.reference(exact),
        prose: vec![
            "Exact F and k: Fresnel's equations and the k that belongs to them. Schlick's F and k: the published model. Exact F, \
             Schlick's k: what comes of replacing one and not the other.",
        ],
        advice: "The exact F with the exact k, which costs a quadrature per material and nothing per evaluation. Schlick's F \
                 with Schlick's k where the reflectance at normal incidence is given and no index is: it conserves energy \
                 just as exactly, of another surface. Never one with the k of the other: nothing is saved, and energy \
                 no longer adds up.",
    }
}

fn forms<T: Scalar>(domain: &Rc<Domain<Pair>>) -> Vec<Variant> {
    let white = Reflectance::<T>::white;
    // Indices above 1 have an interface.
    let exact = INDICES.map(|eta| {
        let interface = Ior::new(T::lit(eta)).and_then(CoupledInterface::dielectric);
        Coupled::new(interface.expect("an index above 1"), white())
    });
    let schlick = INDICES.map(|eta| {
        let r0 = Reflectance::clamped(f0_from_ior(T::lit(eta)));
        Coupled::new(CoupledInterface::schlick(r0), white())
    });
    let mixed = |pair: &Pair| {
        let eta = T::lit(INDICES[pair.case]);
        let k = T::lit(21.0 / 20.0) * T::FRAC_1_PI / (T::ONE - f0_from_ior(eta));
        let [wo, wi] = pair.vectors::<T>();
        [k, eta, wo.z(), wi.z()]
    };
    vec![
        models("exact F and k", domain, exact.to_vec()),
        models("Schlick's F and k", domain, schlick.to_vec()),
        Variant::new("exact F, Schlick's k", domain, mixed, |&[k, eta, o, i]: &[T; 4]| {
            k * dielectric_transmittance(o, eta) * dielectric_transmittance(i, eta)
        }),
    ]
}

fn exact(pair: &Pair) -> f64 {
    let one = DoubleDouble::from(1.0);
    let eta = INDICES[pair.case].into();
    let transmitted = |w: [f64; 3]| one - reflectance(w[2].into(), eta);
    let k = one / (DoubleDouble::PI * (one - average_reflectance(eta)));
    (k * transmitted(pair.wo) * transmitted(pair.wi)).to_f64()
}
