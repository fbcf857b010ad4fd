//! Diffuse reflectors.

use etendue_brdf::{Lambert, OrenNayar, OrenNayarQualitative, Sigma};

use super::parameters::{reflectance, valid};
use super::textbook;
use crate::scalar::{Scalar, shared};
use crate::subject::Case;

pub(super) fn lambert<T: Scalar>() -> Vec<Case<T>> {
    let case = |rho: f64| {
        Case::new(format!("albedo {rho}"), Lambert::new(reflectance::<T>(rho)))
            .textbook(move |wo, wi| textbook::lambert(rho, wo, wi))
    };
    vec![case(0.0), case(0.5), case(1.0).lossless().published(&[(0.01, 1.0), (1.56, 1.0)])]
}

pub(super) fn oren_nayar<T: Scalar>() -> Vec<Case<T>> {
    let case = |rho: f64, sigma: f64| {
        let model = OrenNayar::new(reflectance::<T>(rho), valid(Sigma::new(shared::<T>(sigma))));
        let [r, s] = [rho, sigma].map(shared::<f64>);
        Case::new(format!("albedo {rho}, σ {sigma}"), model)
            .textbook(move |wo, wi| textbook::oren_nayar(r, s, wo, wi))
    };
    vec![
        case(0.0, 0.3),
        case(0.5, 0.0),
        case(0.2, 1.5),
        case(1.0, 1e-3),
        case(1.0, 0.3).published(&[
            (0.01, 0.962),
            (0.8, 0.971),
            (1.3, 1.004),
            (1.5, 1.032),
            (1.56, 1.046),
        ]),
        case(1.0, 0.5).published(&[
            (0.01, 0.896),
            (0.8, 0.909),
            (1.3, 0.958),
            (1.5, 0.999),
            (1.56, 1.020),
        ]),
        case(1.0, 1.0).published(&[
            (0.01, 0.775),
            (0.8, 0.790),
            (1.3, 0.852),
            (1.5, 0.902),
            (1.56, 0.929),
        ]),
    ]
}

pub(super) fn oren_nayar_qualitative<T: Scalar>() -> Vec<Case<T>> {
    let case = |rho: f64, sigma: f64| {
        let sigma_checked = valid(Sigma::new(shared::<T>(sigma)));
        let model = OrenNayarQualitative::new(reflectance::<T>(rho), sigma_checked);
        let [r, s] = [rho, sigma].map(shared::<f64>);
        Case::new(format!("albedo {rho}, σ {sigma}"), model)
            .textbook(move |wo, wi| textbook::oren_nayar_qualitative(r, s, wo, wi))
    };
    vec![
        case(0.0, 0.3),
        case(0.5, 0.0),
        case(1.0, 0.3).published(&[
            (0.01, 0.893),
            (0.8, 0.939),
            (1.3, 0.983),
            (1.5, 1.000),
            (1.56, 1.005),
        ]),
        case(1.0, 1.0).published(&[
            (0.01, 0.625),
            (0.8, 0.709),
            (1.3, 0.789),
            (1.5, 0.821),
            (1.56, 0.829),
        ]),
    ]
}
