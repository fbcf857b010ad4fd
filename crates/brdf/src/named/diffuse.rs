//! Diffuse models.

use alloc::boxed::Box;

use etendue_math::{Real, Spectrum};

use super::{Built, Entry, NamedError, Reader};
use crate::diffuse::{
    burley, diffuse_transmitter, eon, lambert, oren_nayar, oren_nayar_fujii, oren_nayar_qualitative,
};
use crate::{
    Burley, DiffuseTransmitter, Eon, EonAlbedo, EonSampling, Lambert, OrenNayar, OrenNayarFujii,
    OrenNayarQualitative, Reflectance, Roughness, Sigma,
};

/// The papers' name of the parameter that the registry calls `reflectance`.
const ALBEDO: &[&str] = &["albedo"];

pub(super) fn entries<C: Spectrum>() -> [Entry<C>; 8] {
    [
        Entry { info: &burley::INFO, synonyms: &[], build: burley },
        Entry { info: &diffuse_transmitter::INFO, synonyms: &[], build: diffuse_transmitter },
        Entry { info: &eon::INFO, synonyms: ALBEDO, build: |r| eon(r, EonAlbedo::Exact) },
        Entry {
            info: &eon::INFO_APPROXIMATE,
            synonyms: ALBEDO,
            build: |r| eon(r, EonAlbedo::Approximate),
        },
        Entry { info: &lambert::INFO, synonyms: ALBEDO, build: lambert },
        Entry { info: &oren_nayar::INFO, synonyms: ALBEDO, build: oren_nayar },
        Entry { info: &oren_nayar_fujii::INFO, synonyms: ALBEDO, build: fujii },
        Entry { info: &oren_nayar_qualitative::INFO, synonyms: ALBEDO, build: qualitative },
    ]
}

fn albedo<C: Spectrum>(reader: &Reader) -> Result<Reflectance<C>, NamedError> {
    reader.reflectance(reader.either("reflectance", "albedo"))
}

fn sigma<T: Real>(reader: &Reader) -> Result<Sigma<T>, NamedError> {
    reader.checked("sigma", Sigma::new(reader.number("sigma")?))
}

fn lambert<C: Spectrum>(reader: &Reader) -> Built<C> {
    Ok(Box::new(Lambert::new(albedo(reader)?)))
}

fn oren_nayar<C: Spectrum>(reader: &Reader) -> Built<C> {
    Ok(Box::new(OrenNayar::new(albedo(reader)?, sigma(reader)?)))
}

fn qualitative<C: Spectrum>(reader: &Reader) -> Built<C> {
    Ok(Box::new(OrenNayarQualitative::new(albedo(reader)?, sigma(reader)?)))
}

fn roughness<T: Real>(reader: &Reader) -> Result<Roughness<T>, NamedError> {
    reader.checked("roughness", Roughness::new(reader.number("roughness")?))
}

fn fujii<C: Spectrum>(reader: &Reader) -> Built<C> {
    Ok(Box::new(OrenNayarFujii::new(albedo::<C>(reader)?, roughness(reader)?)))
}

fn eon<C: Spectrum>(reader: &Reader, form: EonAlbedo) -> Built<C> {
    let samplings = [("cosine", EonSampling::Cosine), ("cltc", EonSampling::Cltc)];
    let sampling = reader.choice("sampling", &samplings)?;
    let model = Eon::<C>::new(albedo(reader)?, roughness(reader)?);
    Ok(Box::new(model.with_albedo(form).with_sampling(sampling)))
}

fn burley<C: Spectrum>(reader: &Reader) -> Built<C> {
    Ok(Box::new(Burley::<C>::new(reader.reflectance("base_color")?, roughness(reader)?)))
}

fn diffuse_transmitter<C: Spectrum>(reader: &Reader) -> Built<C> {
    let (r, t) = (reader.reflectance("reflectance")?, reader.reflectance("transmittance")?);
    let model: DiffuseTransmitter<C> = reader.constructed(DiffuseTransmitter::new(r, t))?;
    Ok(Box::new(model))
}
