//! Powers of cosines.

use core::f64::consts::FRAC_PI_3;

use etendue_brdf::{
    AshikhminShirley, AshikhminShirleyDiffuse, AshikhminShirleySampling, AshikhminShirleySpecular,
    Exponent, Phong,
};

use super::parameters::{reflectance, valid};
use crate::scalar::{Scalar, shared};
use crate::subject::{Case, Width};

fn exponent<T: Scalar>(n: f64) -> Exponent<T> {
    valid(Exponent::new(shared::<T>(n)))
}

/// A lobe of exponent n is √(2/n) wide; see [`Width`]. Most of the samples that shape the cells may belong to the
/// diffuse part, so that lobes count as narrow earlier than alone.
fn width<T: Scalar>(n: f64) -> Width {
    let slope = (2.0 / (n + 1.0)).sqrt();
    if slope < 0.05 { Width::Narrow } else { super::parameters::width::<T>(slope) }
}

/// The same of half vectors: where a pair of directions grazes with cosine c, the rounding of the directions turns
/// its half vector by ε/c, and the viewers of the audit reach cosines of 0.01.
fn half_vector_width<T: Scalar>(n: f64) -> Width {
    let slope = (2.0 / (n + 1.0)).sqrt();
    if slope < 100.0 * T::EPSILON.to_f64() { Width::Needle } else { width::<T>(n) }
}

pub(super) fn phong<T: Scalar>() -> Vec<Case<T>> {
    let case = |kd, ks, n: f64| {
        let model = valid(Phong::new(reflectance::<T>(kd), reflectance::<T>(ks), exponent::<T>(n)));
        Case::new(format!("kd {kd}, ks {ks}, exponent {n}"), model).of_width(width::<T>(n))
    };
    vec![
        case(0.0, 0.0, 5.0),
        case(1.0, 0.0, 5.0),
        // Not exponent 0: a step at α = π/2, on whose edge the two precisions may stand on different sides.
        case(0.5, 0.5, 1.0),
        case(0.0, 1.0, 1.0),
        // cos θ = 1, 0.7, 0.1; the lobe that grazes half-sinks into the surface.
        case(0.0, 1.0, 10.0).published(&[(0.0, 1.0), (0.795_4, 0.700), (1.470_63, 0.179)]),
        case(0.25, 0.5, 60.0),
        case(0.1, 0.9, 300.0),
        case(0.1, 0.9, 1e5),
        case(0.5, 0.5, 1e7),
        case(0.0, 1.0, 1e12),
    ]
}

const SAMPLINGS: [AshikhminShirleySampling; 2] =
    [AshikhminShirleySampling::Mixture, AshikhminShirleySampling::Specular];

pub(super) fn ashikhmin_shirley<T: Scalar>() -> Vec<Case<T>> {
    let case = |[nu, nv, rs, rd]: [f64; 4], sampling| {
        let (nu_checked, nv_checked) = (exponent::<T>(nu), exponent::<T>(nv));
        let (rs_checked, rd_checked) = (reflectance::<T>(rs), reflectance::<T>(rd));
        let model = AshikhminShirley::new(nu_checked, nv_checked, rs_checked, rd_checked);
        let name = format!("nu {nu}, nv {nv}, rs {rs}, rd {rd}, {sampling:?}");
        Case::new(name, model.with_sampling(sampling)).of_width(half_vector_width::<T>(nu.max(nv)))
    };
    let mixture = |parameters| case(parameters, AshikhminShirleySampling::Mixture);
    let mut cases = vec![
        mixture([1.0, 1.0, 1.0, 0.0]).published(&[(0.0, 0.250), (FRAC_PI_3, 0.375)]),
        mixture([1.0, 1.0, 0.0, 1.0]).published(&[(0.0, 0.969), (FRAC_PI_3, 0.767)]),
        mixture([10.0, 10.0, 0.5, 1.0]).published(&[
            (0.0, 0.832),
            (0.795_4, 0.772),
            (1.266_1, 0.585),
        ]),
        mixture([100.0, 100.0, 1.0, 0.0]).published(&[(0.0, 0.961), (FRAC_PI_3, 0.846)]),
        mixture([300.0, 1.0, 0.04, 0.5]),
        mixture([1e4, 1.0, 0.04, 0.5]),
        mixture([1e6, 1e6, 0.04, 1.0]),
        mixture([1e12, 1e12, 0.5, 0.5]),
    ];
    cases.extend(SAMPLINGS.map(|sampling| case([0.0, 0.0, 0.04, 0.5], sampling)));
    cases.extend(SAMPLINGS.map(|sampling| case([8.0, 200.0, 0.2, 0.6], sampling)));
    cases
}

pub(super) fn ashikhmin_shirley_specular<T: Scalar>() -> Vec<Case<T>> {
    let case = |[nu, nv, rs]: [f64; 3]| {
        let (nu_checked, nv_checked) = (exponent::<T>(nu), exponent::<T>(nv));
        let model = AshikhminShirleySpecular::new(nu_checked, nv_checked, reflectance::<T>(rs));
        Case::new(format!("nu {nu}, nv {nv}, rs {rs}"), model)
            .of_width(half_vector_width::<T>(nu.max(nv)))
    };
    vec![
        case([0.0, 0.0, 1.0]),
        case([10.0, 10.0, 1.0]).published(&[(0.0, 0.696), (0.795_4, 0.658), (1.266_1, 0.568)]),
        case([10.0, 300.0, 0.04]),
        case([1e4, 1e4, 1.0]).of_width(Width::Wide).published(&[(0.0, 0.999_6)]),
        case([3.0, 0.0, 0.0]),
        case([1e6, 1e5, 1.0]),
        case([1e12, 1e12, 1.0]),
    ]
}

pub(super) fn ashikhmin_shirley_diffuse<T: Scalar>() -> Vec<Case<T>> {
    let case = |rs, rd| {
        let model = AshikhminShirleyDiffuse::new(reflectance::<T>(rs), reflectance::<T>(rd));
        Case::new(format!("rs {rs}, rd {rd}"), model)
    };
    vec![
        case(0.0, 0.0),
        case(1.0, 1.0),
        case(0.2, 0.7),
        // At normal incidence 31/32; at grazing 5/2 cos θ.
        case(0.0, 1.0).published(&[(0.0, 0.968_75), (1.5, 0.164_5), (1.56, 0.026_70)]),
    ]
}
