//! Diffuse reflectors.

use etendue_brdf::{
    Burley, DiffuseTransmitter, Eon, EonAlbedo, EonSampling, Lambert, OrenNayar, OrenNayarFujii,
    OrenNayarQualitative, Roughness, Sigma,
};

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

fn roughness<T: Scalar>(r: f64) -> Roughness<T> {
    valid(Roughness::new(shared::<T>(r)))
}

pub(super) fn oren_nayar_fujii<T: Scalar>() -> Vec<Case<T>> {
    let case = |rho, r| {
        let model = OrenNayarFujii::new(reflectance::<T>(rho), roughness::<T>(r));
        let name = format!("albedo {rho}, roughness {r}");
        let [rho, r] = [rho, r].map(shared::<f64>);
        Case::new(name, model).textbook(move |wo, wi| textbook::fujii(rho, r, wo, wi))
    };
    vec![
        case(0.0, 0.5),
        case(0.5, 0.0),
        case(0.8, 1e-6),
        case(0.2, 0.4),
        case(1.0, 1.0).published(&[(0.0, 0.776_5)]),
    ]
}

fn eon_case<T: Scalar>(albedo: EonAlbedo, rho: f64, r: f64, sampling: EonSampling) -> Case<T> {
    let model = Eon::new(reflectance::<T>(rho), roughness::<T>(r));
    let name = format!("albedo {rho}, roughness {r}, {sampling:?}");
    Case::new(name, model.with_albedo(albedo).with_sampling(sampling))
}

pub(super) fn eon<T: Scalar>() -> Vec<Case<T>> {
    let case = |rho, r, sampling| {
        let case = eon_case::<T>(EonAlbedo::Exact, rho, r, sampling);
        let [rho, r] = [rho, r].map(shared::<f64>);
        case.textbook(move |wo, wi| textbook::eon(rho, r, wo, wi))
    };
    let white = &[(0.01, 1.0), (0.8, 1.0), (1.3, 1.0), (1.56, 1.0)];
    vec![
        case(0.0, 0.5, EonSampling::Cosine),
        case(0.5, 0.0, EonSampling::Cltc),
        case(0.8, 1e-6, EonSampling::Cltc),
        case(0.4, 0.3, EonSampling::Cosine),
        case(0.4, 0.3, EonSampling::Cltc),
        case(1.0, 0.5, EonSampling::Cosine).lossless().published(white),
        case(1.0, 1.0, EonSampling::Cosine).lossless().published(white),
        case(1.0, 1.0, EonSampling::Cltc).lossless().published(white),
    ]
}

pub(super) fn eon_approx<T: Scalar>() -> Vec<Case<T>> {
    let case = |rho, r, sampling| eon_case::<T>(EonAlbedo::Approximate, rho, r, sampling);
    vec![
        case(0.0, 0.5, EonSampling::Cosine),
        case(0.5, 0.0, EonSampling::Cosine),
        case(0.8, 1e-6, EonSampling::Cltc),
        case(0.4, 0.3, EonSampling::Cltc),
        case(1.0, 1.0, EonSampling::Cosine).published(&[(0.0, 0.999_92)]),
        case(1.0, 1.0, EonSampling::Cltc),
    ]
}

pub(super) fn burley<T: Scalar>() -> Vec<Case<T>> {
    let case = |base, r| {
        let model = Burley::new(reflectance::<T>(base), roughness::<T>(r));
        Case::new(format!("base {base}, roughness {r}"), model)
    };
    vec![
        case(0.0, 0.5),
        case(0.5, 0.25),
        case(1.0, 0.0).published(&[
            (0.01, 0.976),
            (0.8, 0.975),
            (1.3, 0.873),
            (1.5, 0.638),
            (1.56, 0.514),
        ]),
        case(1.0, 0.5).published(&[
            (0.01, 1.006),
            (0.8, 1.005),
            (1.3, 1.022),
            (1.5, 1.021),
            (1.56, 1.009),
        ]),
        case(1.0, 1.0).published(&[
            (0.01, 1.036),
            (0.8, 1.035),
            (1.3, 1.178),
            (1.5, 1.428),
            (1.56, 1.536),
        ]),
    ]
}

pub(super) fn diffuse_transmitter<T: Scalar>() -> Vec<Case<T>> {
    let case = |r, t| {
        let model = DiffuseTransmitter::new(reflectance::<T>(r), reflectance::<T>(t));
        Case::new(format!("reflectance {r}, transmittance {t}"), valid(model))
    };
    vec![
        case(0.0, 0.0),
        case(1.0, 0.0).lossless(),
        case(0.0, 1.0).lossless(),
        case(0.25, 0.75).lossless().published(&[(0.01, 1.0), (1.56, 1.0)]),
        case(0.4, 0.1),
        case(1e-6, 0.5),
    ]
}
