//! A base under an interface.

use etendue_brdf::{
    Distribution, InternalReflectance, InternalScattering, Masking, Plastic, PlasticInterface,
    RoughPlastic, TransmittanceTable,
};

use super::parameters::{BECKMANN, alpha, ior, reflectance};
use super::textbook;
use crate::scalar::{Scalar, shared};
use crate::subject::Case;

fn interface<T: Scalar>(eta: f64) -> PlasticInterface<T> {
    PlasticInterface::new(ior::<T>(eta), InternalReflectance::Exact)
}

pub(super) fn plastic<T: Scalar>() -> Vec<Case<T>> {
    let case = |rho: f64, eta: f64, scattering| {
        let model = Plastic::new(interface::<T>(eta), reflectance::<T>(rho), scattering);
        let [r, n] = [rho, eta].map(shared::<f64>);
        let base = match scattering {
            InternalScattering::Linear => textbook::linear_base(r, n),
            InternalScattering::NonLinear => textbook::non_linear_base(r, n),
        };
        Case::new(format!("albedo {rho}, η {eta}, {scattering:?}"), model)
            .textbook(move |wo, wi| textbook::plastic(base, n, wo, wi))
    };
    vec![
        case(0.0, 1.5, InternalScattering::Linear),
        case(0.5, 1.5, InternalScattering::Linear),
        case(0.5, 1.5, InternalScattering::NonLinear),
        case(1.0, 1.5, InternalScattering::Linear).lossless(),
        case(1.0, 1.000_001, InternalScattering::NonLinear).lossless(),
        case(1.0, 4.0, InternalScattering::NonLinear).lossless(),
    ]
}

pub(super) fn rough_plastic<T: Scalar>() -> Vec<Case<T>> {
    let case = |rho: f64, eta: f64, distribution, a: f64, scattering| {
        let table = TransmittanceTable::new(
            ior::<T>(eta),
            distribution,
            alpha::<T>(a),
            Masking::HeightCorrelated,
            InternalReflectance::Exact,
        );
        // Models borrow their table; a few kilobytes per case live as long as the audit.
        let table = Box::leak(Box::new(table));
        let model = RoughPlastic::new(table, reflectance::<T>(rho), scattering);
        Case::new(format!("albedo {rho}, η {eta}, {distribution:?} α {a}, {scattering:?}"), model)
    };
    vec![
        case(0.0, 1.5, Distribution::Ggx, 0.3, InternalScattering::Linear),
        case(0.5, 1.5, Distribution::Ggx, 0.1, InternalScattering::NonLinear),
        case(1.0, 1.5, BECKMANN, 0.3, InternalScattering::Linear),
        case(1.0, 2.4, Distribution::Ggx, 1.0, InternalScattering::NonLinear),
    ]
}
