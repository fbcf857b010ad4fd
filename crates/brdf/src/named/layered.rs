//! A base under an interface.

use alloc::boxed::Box;

use etendue_math::Spectrum;

use super::forward::OwnedPlastic;
use super::{Built, Entry, NamedError, Reader};
use crate::layered::{
    any_coupled, any_plastic, coupled, layered_fresnel, layered_linear, plastic, rough_coupled,
    rough_plastic,
};
use crate::{
    Alpha, AnyCoupled, Coupled, CoupledInterface, InternalReflectance, InternalScattering,
    LayeredFresnel, LayeredLinear, Masking, Plastic, PlasticInterface, PlasticSurface,
    RoughCoupled, TransmittanceTable,
};

const BETWEEN_MEDIA: &[&str] = &["ior_int", "ior_ext"];

pub(super) fn entries<C: Spectrum>() -> [Entry<C>; 8] {
    [
        Entry { info: &any_coupled::INFO, synonyms: &["eta", "alpha"], build: any_coupled },
        Entry { info: &any_plastic::INFO, synonyms: BETWEEN_MEDIA, build: any_plastic },
        Entry { info: &coupled::INFO, synonyms: &["eta"], build: coupled },
        Entry { info: &layered_fresnel::INFO, synonyms: &[], build: layered_fresnel },
        Entry { info: &layered_linear::INFO, synonyms: &[], build: layered_linear },
        Entry { info: &plastic::INFO, synonyms: BETWEEN_MEDIA, build: plastic },
        Entry { info: &rough_coupled::INFO, synonyms: &["eta", "alpha"], build: rough_coupled },
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

/// What every plastic has beside its surface.
fn owned_plastic<C: Spectrum>(reader: &Reader, surface: PlasticSurface<C::Real>) -> Built<C> {
    Ok(Box::new(OwnedPlastic::<C> {
        surface,
        diffuse: reader.reflectance("reflectance")?,
        scattering: scattering(reader)?,
        specular: reader.factor("specular_reflectance")?,
    }))
}

fn rough_plastic<C: Spectrum>(reader: &Reader) -> Built<C> {
    let alpha = reader.checked("alpha", Alpha::new(reader.number("alpha")?))?;
    let masking = reader.masking(Masking::HeightCorrelated)?;
    let (eta, distribution, internal) = (reader.ior()?, reader.distribution()?, internal(reader)?);
    let table = TransmittanceTable::new(eta, distribution, alpha, masking, internal);
    owned_plastic(reader, PlasticSurface::Rough(table))
}

fn any_plastic<C: Spectrum>(reader: &Reader) -> Built<C> {
    let (alpha, masking) = (reader.number("alpha")?, reader.masking(Masking::HeightCorrelated)?);
    let (eta, distribution, internal) = (reader.ior()?, reader.distribution()?, internal(reader)?);
    let surface = PlasticSurface::new(eta, distribution, alpha, masking, internal);
    owned_plastic(reader, reader.constructed(surface)?)
}

/// Schlick's reflectance from `r0`, or the exact one from `eta`.
fn coupled_interface<C: Spectrum>(reader: &Reader) -> Result<CoupledInterface<C>, NamedError> {
    if reader.either("r0", "eta") == "r0" {
        return Ok(CoupledInterface::schlick(reader.reflectance("r0")?));
    }
    reader.checked("eta", CoupledInterface::dielectric(reader.ior()?))
}

fn coupled<C: Spectrum>(reader: &Reader) -> Built<C> {
    Ok(Box::new(Coupled::<C>::new(coupled_interface(reader)?, reader.reflectance("rm")?)))
}

fn rough_coupled<C: Spectrum>(reader: &Reader) -> Built<C> {
    let facets = reader.microfacets(Masking::HeightCorrelated)?;
    let interface = coupled_interface(reader)?;
    Ok(Box::new(RoughCoupled::<C>::new(interface, facets, reader.reflectance("rm")?)))
}

fn any_coupled<C: Spectrum>(reader: &Reader) -> Built<C> {
    let masking = reader.masking(Masking::HeightCorrelated)?;
    let (interface, rm) = (coupled_interface(reader)?, reader.reflectance("rm")?);
    let (distribution, widths) = (reader.distribution()?, reader.widths()?);
    let model = AnyCoupled::<C>::new(interface, distribution, widths, masking, rm);
    Ok(Box::new(reader.constructed(model)?))
}

fn layered_fresnel<C: Spectrum>(reader: &Reader) -> Built<C> {
    Ok(Box::new(LayeredFresnel::<C>::new(reader.reflectance("r0")?, reader.reflectance("rd")?)))
}

fn layered_linear<C: Spectrum>(reader: &Reader) -> Built<C> {
    let (rd, rs) = (reader.reflectance("rd")?, reader.reflectance("rs")?);
    let model: LayeredLinear<C> = reader.constructed(LayeredLinear::new(rd, rs))?;
    Ok(Box::new(model))
}
