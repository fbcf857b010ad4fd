//! Diffuse models.

use alloc::boxed::Box;

use etendue_math::{Real, Spectrum};

use super::{Built, Entry, Reader};
use crate::diffuse::{lambert, oren_nayar, oren_nayar_qualitative};
use crate::{Lambert, OrenNayar, OrenNayarQualitative, Reflectance, Sigma};

/// The papers' name of the parameter that the registry calls `reflectance`.
const ALBEDO: &[&str] = &["albedo"];

pub(super) fn entries<C: Spectrum>() -> [Entry<C>; 3] {
    [
        Entry { info: &lambert::INFO, synonyms: ALBEDO, build: lambert },
        Entry { info: &oren_nayar::INFO, synonyms: ALBEDO, build: oren_nayar },
        Entry { info: &oren_nayar_qualitative::INFO, synonyms: ALBEDO, build: qualitative },
    ]
}

fn albedo<C: Spectrum>(reader: &Reader) -> Result<Reflectance<C>, super::NamedError> {
    reader.reflectance(reader.either("reflectance", "albedo"))
}

fn sigma<T: Real>(reader: &Reader) -> Result<Sigma<T>, super::NamedError> {
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
