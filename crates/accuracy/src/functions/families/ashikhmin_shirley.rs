//! The half vectors of Ashikhmin and Shirley's model.

use std::rc::Rc;

use etendue_brdf::{Exponent, PhongHalfVectors};
use etendue_math::{Real, Vec3, Vector3};

use crate::functions::domain::{Domain, linear, narrow};
use crate::functions::family::{ErrorKind, FamilyInfo, Setup};
use crate::functions::reference::{DoubleDouble, Effort};
use crate::functions::variant::{Scalar, Variant};

pub(super) const INFO: FamilyInfo = FamilyInfo {
    name: "ashikhmin-shirley",
    title: "Ashikhmin and Shirley's distribution of half vectors",
    build,
};

const EXPONENTS: [[f64; 2]; 4] = [[10.0, 10.0], [1e3, 100.0], [1e5, 1e4], [1e6, 1e6]];

/// Exponents and the half vector's coordinates in the tangent plane.
#[derive(Clone, Copy)]
struct Point {
    exponents: [f64; 2],
    x: f64,
    y: f64,
}

fn build(effort: Effort) -> Setup {
    let widths: Vec<f64> = linear([0.05, 3.0], effort.choose(24, 4)).collect();
    let azimuths: Vec<f64> = linear([0.0, 90.0], effort.choose(12, 3)).collect();
    let mut points = Vec::new();
    for exponents in EXPONENTS {
        for &width in &widths {
            for &azimuth in &azimuths {
                let (sin, cos) = Real::sin_cos(azimuth.to_radians());
                let slope = |i: usize| width / (exponents[i] + 1.0).sqrt();
                let (x, y) = (slope(0) * cos, slope(1) * sin);
                let z = 1.0 / (1.0 + x * x + y * y).sqrt();
                points.push(Point { exponents, x: narrow(x * z), y: narrow(y * z) });
            }
        }
    }
    let domain = Rc::new(Domain {
        words: "exponents along the tangents (10, 10), (1000, 100), (1e5, 1e4) and (1e6, 1e6); half vectors up to three widths \
                of the lobe from the normal"
            .to_owned(),
        points,
        place: |p: &Point| format!("n {:?}, h ({:.2e}, {:.2e})", p.exponents, p.x, p.y),
        probes: Vec::new(),
    });
    Setup {
        quantity: "density p(h) of half vectors per steradian",
        judged_by: ErrorKind::RmsRelative,
        variants: forms::<f64>(&domain).into_iter().chain(forms::<f32>(&domain)).collect(),
        // A logarithm, an exponential and a dozen roundings.
        bound: 4e-15,
        ground: Box::new(Rc::clone(&domain)),
        reference: "the published formula in arithmetic of 106 bits, of the vector with the given coordinates in the tangent \
                    plane",
        compute: domain.reference(exact),
        prose: vec![
            "Half vectors are given by their coordinates in the tangent plane, exactly; the third is rounded in the \
             precision of the variant, as it is in a renderer. The stable form computes in double precision in either case.",
        ],
        advice: "The stable form. The textbook's raises a cosine that has lost its digits: with every factor of ten in \
                 the exponent it loses another one, in double precision as in single. The time that it saves in single \
                 precision is what the stable one spends on computing in double.",
    }
}

fn forms<T: Scalar>(domain: &Rc<Domain<Point>>) -> Vec<Variant> {
    let vector = |p: &Point| {
        let (x, y) = (T::lit(p.x), T::lit(p.y));
        Vec3::<T>::new(x, y, (T::ONE - (x * x + y * y)).sqrt())
    };
    let stable = move |p: &Point| {
        let [nu, nv] = p.exponents.map(|n| Exponent::clamped(T::lit(n)));
        (PhongHalfVectors::new(nu, nv), vector(p))
    };
    let textbook = move |p: &Point| {
        let [nu, nv] = p.exponents.map(T::lit);
        let peak = ((nu + T::ONE) * (nv + T::ONE)).sqrt() / (T::TWO * T::PI);
        (nu, nv, peak, vector(p))
    };
    vec![
        Variant::new("stable", domain, stable, |(lobe, h): &(PhongHalfVectors<T>, _)| lobe.pdf(*h)),
        // M. Ashikhmin and P. Shirley 2000, as printed.
        Variant::new("textbook", domain, textbook, |&(nu, nv, peak, h)| {
            let exponent = (nu * h.x() * h.x() + nv * h.y() * h.y()) / (T::ONE - h.z() * h.z());
            peak * h.z().powf(exponent)
        }),
    ]
}

fn exact(p: &Point) -> f64 {
    let [one, half, two] = [1.0, 0.5, 2.0].map(DoubleDouble::from);
    let [x2, y2] = [p.x, p.y].map(|x| DoubleDouble::from(x).sqr());
    let [nu, nv] = p.exponents.map(DoubleDouble::from);
    let s2 = x2 + y2;
    let exponent = (nu * x2 + nv * y2) / s2;
    let power = (one - s2).powf(half * exponent);
    (((nu + one) * (nv + one)).sqrt() / (two * DoubleDouble::PI) * power).to_f64()
}
