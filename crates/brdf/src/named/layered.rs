//! A base under an interface.

use alloc::boxed::Box;

use etendue_math::Spectrum;

use super::forward::OwnedRoughPlastic;
use super::{Built, Entry, NamedError, Reader};
use crate::layered::{plastic, rough_plastic};
use crate::{
    Alpha, InternalReflectance, InternalScattering, Masking, Plastic, PlasticInterface,
    TransmittanceTable,
};

const BETWEEN_MEDIA: &[&str] = &["ior_int", "ior_ext"];

pub(super) fn entries<C: Spectrum>() -> [Entry<C>; 2] {
    [
        Entry { info: &plastic::INFO, synonyms: BETWEEN_MEDIA, build: plastic },
        Entry { info: &rough_plastic::INFO, synonyms: BETWEEN_MEDIA, build: rough_plastic },
    ]
}

fn scattering(reader: &Reader) -> Result<InternalScattering, NamedError> {
    let [linear, non_linear] = [InternalScattering::Linear, InternalScattering::NonLinear];
    reader.choice("scattering", &[("linear", linear), ("non-linear", non_linear)])
}

fn internal(reader: &Reader) -> Result<InternalReflectance, NamedError> {
    let [exact, mitsuba] = [InternalReflectance::Exact, InternalReflectance::Mitsuba];
    reader.choice("internal_reflectance", &[("exact", exact), ("mitsuba", mitsuba)])
}

fn plastic<C: Spectrum>(reader: &Reader) -> Built<C> {
    let interface = PlasticInterface::new(reader.ior()?, internal(reader)?);
    let model: Plastic<C> =
        Plastic::new(interface, reader.reflectance("reflectance")?, scattering(reader)?);
    Ok(Box::new(model.with_specular_reflectance(reader.factor("specular_reflectance")?)))
}

fn rough_plastic<C: Spectrum>(reader: &Reader) -> Built<C> {
    let alpha = reader.checked("alpha", Alpha::new(reader.number("alpha")?))?;
    Ok(Box::new(OwnedRoughPlastic::<C> {
        table: TransmittanceTable::new(
            reader.ior()?,
            reader.distribution()?,
            alpha,
            reader.masking(Masking::HeightCorrelated)?,
            internal(reader)?,
        ),
        diffuse: reader.reflectance("reflectance")?,
        scattering: scattering(reader)?,
        specular: reader.factor("specular_reflectance")?,
    }))
}
