//! Burley's diffuse lobe.

use std::rc::Rc;

use etendue_brdf::{Burley, Lambert, Reflectance, Roughness};
use etendue_math::Vector3;

use super::directions::{Pair, albedo_probe, models, pairs};
use crate::functions::domain::Domain;
use crate::functions::family::{ErrorKind, FamilyInfo, Setup};
use crate::functions::reference::{DoubleDouble, Effort};
use crate::functions::variant::{Scalar, Variant};

pub(super) const INFO: FamilyInfo =
    FamilyInfo { name: "burley", title: "Burley's diffuse reflection", build };

const ROUGHNESS: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];
const POLAR: [f64; 7] = [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0];
const AZIMUTHS: [f64; 5] = [0.0, 45.0, 90.0, 135.0, 180.0];

fn build(effort: Effort) -> Setup {
    let cases = 0..ROUGHNESS.len();
    let views: &[f64] = effort.choose(&[0.0, 40.0, 80.0], &[40.0]);
    let polar = effort.choose(&POLAR[..], &POLAR[1..4]);
    let probe = |case: usize| {
        let material = format!("roughness {}", ROUGHNESS[case]);
        views.iter().map(move |&theta| albedo_probe::<16>(case, &material, theta))
    };
    let domain = Rc::new(Domain {
        words: "roughness 0 to 1 in steps of a quarter; polar angles of viewer and light from 0° to 75° in steps of 15° \
                and 85°, azimuths between them from 0° to 180° in steps of 45°"
            .to_owned(),
        points: cases.clone().flat_map(|case| pairs(case, polar, &AZIMUTHS)).collect(),
        place: |pair: &Pair| format!("roughness {}, {}", ROUGHNESS[pair.case], pair.words()),
        probes: cases.flat_map(probe).collect(),
    });
    Setup {
        quantity: "scattering function f(wo, wi) of a white surface in sr⁻¹",
        judged_by: ErrorKind::RmsRelative,
        variants: forms::<f64>(&domain).into_iter().chain(forms::<f32>(&domain)).collect(),
        // Directions have length 1 to the last digit only; a dozen roundings.
        bound: 2e-15,
        ground: Box::new(Rc::clone(&domain)),
        reference: "the published formula in arithmetic of 106 bits",
        compute: domain.reference(exact),
        prose: vec![
            "The literal form normalises the half vector, takes its angle to the light and raises complements of cosines to \
             the fifth power by `powf`; the stable one takes the square of that angle's cosine from the length of the sum \
             of the directions. Lambert's reflector is what one would use if the effect were not wanted.",
        ],
        advice: "The stable form: it has no root, no general power and no half vector to normalise, and is as exact. \
                 Lambert's reflector where the retro-reflection of rough surfaces does not matter; no cheaper form of \
                 this model stands between the two. The model itself gains energy when rough: where that matters, EON.",
    }
}

fn forms<T: Scalar>(domain: &Rc<Domain<Pair>>) -> Vec<Variant> {
    let rough = ROUGHNESS.map(|r| Roughness::clamped(T::lit(r)));
    let stable = rough.map(|r| Burley::new(Reflectance::<T>::white(), r)).to_vec();
    let prepare = |pair: &Pair| (T::lit(ROUGHNESS[pair.case]), pair.vectors::<T>());
    vec![
        models("stable", domain, stable),
        Variant::new("literal", domain, prepare, |&(r, [wo, wi])| literal(r, wo, wi)),
        models("Lambert", domain, vec![Lambert::new(Reflectance::<T>::white()); ROUGHNESS.len()]),
    ]
}

/// B. Burley, "Physically-Based Shading at Disney", SIGGRAPH 2012 course, section 5.3, as printed.
fn literal<T: Scalar>(r: T, wo: T::Vec3, wi: T::Vec3) -> T {
    let sum = wo + wi;
    let h = sum / sum.length();
    let cos_d = wi.dot(h);
    let f90 = T::HALF + T::TWO * r * cos_d * cos_d;
    let factor = |cos: T| T::ONE + (f90 - T::ONE) * (T::ONE - cos).powf(T::lit(5.0));
    T::FRAC_1_PI * factor(wo.z()) * factor(wi.z())
}

/// The same in 106 bits, of the directions that the coordinates stand for.
fn exact(pair: &Pair) -> f64 {
    let [one, half, two] = [1.0, 0.5, 2.0].map(DoubleDouble::from);
    let unit = |w: [f64; 3]| {
        let [x, y, z] = w.map(DoubleDouble::from);
        let length = (x.sqr() + y.sqr() + z.sqr()).sqrt();
        [x / length, y / length, z / length]
    };
    let (o, i) = (unit(pair.wo), unit(pair.wi));
    let dot = o[0] * i[0] + o[1] * i[1] + o[2] * i[2];
    // cos² θd = (1 + wo·wi)/2
    let f90 = half + two * ROUGHNESS[pair.case].into() * (one + dot) * half;
    let factor = |cos: DoubleDouble| one + (f90 - one) * (one - cos).powi(5);
    (factor(o[2]) * factor(i[2]) / DoubleDouble::PI).to_f64()
}
