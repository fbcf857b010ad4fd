//! Surfaces of microfacets.

use alloc::boxed::Box;

use etendue_math::Spectrum;

use super::{Built, Entry, Reader};
use crate::rough::{
    conductor, dielectric, kulla_conty, kulla_conty_dielectric, rough_conductor, rough_dielectric,
    turquin,
};
use crate::{
    Conductor, Dielectric, KullaContyConductor, KullaContyDielectric, Masking, RoughConductor,
    RoughDielectric, TurquinConductor,
};

const ISOTROPIC: &[&str] = &["alpha"];
const BETWEEN_MEDIA: &[&str] = &["alpha", "ior_int", "ior_ext"];

pub(super) fn entries<C: Spectrum>() -> [Entry<C>; 7] {
    [
        Entry { info: &conductor::INFO, synonyms: ISOTROPIC, build: conductor },
        Entry { info: &dielectric::INFO, synonyms: BETWEEN_MEDIA, build: dielectric },
        Entry { info: &rough_conductor::INFO, synonyms: ISOTROPIC, build: rough_conductor },
        Entry { info: &rough_dielectric::INFO, synonyms: BETWEEN_MEDIA, build: rough_dielectric },
        Entry { info: &kulla_conty::INFO, synonyms: &[], build: kulla_conty },
        Entry {
            info: &kulla_conty_dielectric::INFO,
            synonyms: &["ior_int", "ior_ext"],
            build: kulla_conty_dielectric,
        },
        Entry { info: &turquin::INFO, synonyms: &[], build: turquin },
    ]
}

fn rough_conductor<C: Spectrum>(reader: &Reader) -> Built<C> {
    let facets = reader.microfacets(Masking::HeightCorrelated)?;
    let model = RoughConductor::new(reader.complex_ior()?, facets);
    Ok(Box::new(model.with_specular_reflectance(reader.factor("specular_reflectance")?)))
}

fn conductor<C: Spectrum>(reader: &Reader) -> Built<C> {
    let masking = reader.masking(Masking::HeightCorrelated)?;
    let (ior, widths) = (reader.complex_ior()?, reader.widths()?);
    let model = Conductor::new(ior, reader.distribution()?, widths, masking);
    let model = reader.constructed(model)?;
    Ok(Box::new(model.with_specular_reflectance(reader.factor("specular_reflectance")?)))
}

fn kulla_conty<C: Spectrum>(reader: &Reader) -> Built<C> {
    let facets = reader.microfacets(Masking::HeightCorrelated)?;
    let model = KullaContyConductor::new(reader.complex_ior()?, facets);
    let model = reader.constructed(model)?;
    Ok(Box::new(model.with_specular_reflectance(reader.factor("specular_reflectance")?)))
}

fn kulla_conty_dielectric<C: Spectrum>(reader: &Reader) -> Built<C> {
    let (eta, facets) = (reader.ior()?, reader.microfacets(Masking::HeightCorrelated)?);
    let model: KullaContyDielectric<C> =
        reader.constructed(KullaContyDielectric::new(eta, facets))?;
    let (ks, kt) = reader.factors()?;
    Ok(Box::new(model.with_factors(ks, kt)))
}

fn turquin<C: Spectrum>(reader: &Reader) -> Built<C> {
    let facets = reader.microfacets(Masking::HeightCorrelated)?;
    let model = reader.constructed(TurquinConductor::new(reader.complex_ior()?, facets))?;
    Ok(Box::new(model.with_specular_reflectance(reader.factor("specular_reflectance")?)))
}

/// Separable masking unless another is asked for, as Walter et al. have it.
fn rough_dielectric<C: Spectrum>(reader: &Reader) -> Built<C> {
    let (eta, facets) = (reader.ior()?, reader.microfacets(Masking::Separable)?);
    let model: RoughDielectric<C> = reader.checked("eta", RoughDielectric::new(eta, facets))?;
    let (ks, kt) = reader.factors()?;
    Ok(Box::new(model.with_factors(ks, kt)))
}

fn dielectric<C: Spectrum>(reader: &Reader) -> Built<C> {
    let masking = reader.masking(Masking::Separable)?;
    let (eta, widths) = (reader.ior()?, reader.widths()?);
    let model = Dielectric::new(eta, reader.distribution()?, widths, masking);
    let model: Dielectric<C> = reader.constructed(model)?;
    let (ks, kt) = reader.factors()?;
    Ok(Box::new(model.with_factors(ks, kt)))
}
