//! The Phong family.

use alloc::boxed::Box;

use etendue_math::{Real, Spectrum};

use super::{Built, Entry, NamedError, Reader};
use crate::phong::{
    ashikhmin_shirley, ashikhmin_shirley_diffuse, ashikhmin_shirley_specular, modified_phong,
};
use crate::{
    AshikhminShirley, AshikhminShirleyDiffuse, AshikhminShirleySampling, AshikhminShirleySpecular,
    Exponent, Phong,
};

pub(super) fn entries<C: Spectrum>() -> [Entry<C>; 4] {
    [
        Entry { info: &ashikhmin_shirley::INFO, synonyms: &[], build: both },
        Entry { info: &ashikhmin_shirley_diffuse::INFO, synonyms: &[], build: diffuse },
        Entry { info: &ashikhmin_shirley_specular::INFO, synonyms: &[], build: specular },
        Entry { info: &modified_phong::INFO, synonyms: &[], build: phong },
    ]
}

pub(super) fn exponent<T: Real>(
    reader: &Reader,
    name: &'static str,
) -> Result<Exponent<T>, NamedError> {
    reader.checked(name, Exponent::new(reader.number(name)?))
}

/// Sampled as published unless a mixture is asked for.
fn both<C: Spectrum>(reader: &Reader) -> Built<C> {
    let sampling = reader.choice(
        "sampling",
        &[
            ("half-vectors", AshikhminShirleySampling::Specular),
            ("mixture", AshikhminShirleySampling::Mixture),
        ],
    )?;
    let (nu, nv) = (exponent(reader, "nu")?, exponent(reader, "nv")?);
    let (rs, rd) = (reader.reflectance("rs")?, reader.reflectance("rd")?);
    Ok(Box::new(AshikhminShirley::<C>::new(nu, nv, rs, rd).with_sampling(sampling)))
}

fn specular<C: Spectrum>(reader: &Reader) -> Built<C> {
    let (nu, nv) = (exponent(reader, "nu")?, exponent(reader, "nv")?);
    Ok(Box::new(AshikhminShirleySpecular::<C>::new(nu, nv, reader.reflectance("rs")?)))
}

fn diffuse<C: Spectrum>(reader: &Reader) -> Built<C> {
    let (rs, rd) = (reader.reflectance("rs")?, reader.reflectance("rd")?);
    Ok(Box::new(AshikhminShirleyDiffuse::<C>::new(rs, rd)))
}

fn phong<C: Spectrum>(reader: &Reader) -> Built<C> {
    let (kd, ks) = (reader.reflectance("kd")?, reader.reflectance("ks")?);
    let model: Phong<C> = reader.constructed(Phong::new(kd, ks, exponent(reader, "exponent")?))?;
    Ok(Box::new(model))
}
