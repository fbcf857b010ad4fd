//! Tables of measurements, made from models whose values are known.

use std::sync::OnceLock;

use etendue_brdf::{
    Alpha, Distribution, InternalReflectance, InternalScattering, Interpolation, Ior, Masking,
    Measured, MerlTable, Reflectance, RoughPlastic, TransmittanceTable, tabulate,
};

use super::parameters::valid;
use crate::scalar::Scalar;
use crate::subject::Case;

/// The 35 MB of a grey plastic, made once.
fn plastic() -> MerlTable<'static> {
    static FILE: OnceLock<Vec<u8>> = OnceLock::new();
    let file = FILE.get_or_init(|| {
        let interface = TransmittanceTable::new(
            valid(Ior::new(1.5_f64)),
            Distribution::Ggx,
            valid(Alpha::new(0.2)),
            Masking::HeightCorrelated,
            InternalReflectance::Exact,
        );
        let base = valid(Reflectance::new(0.5));
        let model = RoughPlastic::<f64>::new(&interface, base, InternalScattering::Linear);
        let mut file = vec![0; MerlTable::BYTES];
        tabulate(&model, &mut file).expect("a file of the length of a table");
        file
    });
    MerlTable::parse(file).expect("a table")
}

pub(super) fn measured<T: Scalar>() -> Vec<Case<T>> {
    [Interpolation::Nearest, Interpolation::Trilinear]
        .map(|interpolation| {
            let model = Measured::<T>::new(plastic(), interpolation);
            Case::new(format!("rough plastic α 0.2, {interpolation:?}"), model)
        })
        .into()
}
