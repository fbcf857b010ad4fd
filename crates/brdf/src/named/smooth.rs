//! Mirrors, glass and nothing.

use alloc::boxed::Box;

use etendue_math::Spectrum;

use super::{Built, Entry, Reader};
use crate::smooth::{null, smooth_conductor, smooth_dielectric, thin_dielectric};
use crate::{Null, SmoothConductor, SmoothDielectric, ThinDielectric};

const BETWEEN_MEDIA: &[&str] = &["ior_int", "ior_ext"];

pub(super) fn entries<C: Spectrum>() -> [Entry<C>; 4] {
    [
        Entry { info: &null::INFO, synonyms: &[], build: |_| Ok(Box::new(Null::<C>::new())) },
        Entry { info: &smooth_conductor::INFO, synonyms: &[], build: smooth_conductor },
        Entry { info: &smooth_dielectric::INFO, synonyms: BETWEEN_MEDIA, build: smooth_dielectric },
        Entry { info: &thin_dielectric::INFO, synonyms: BETWEEN_MEDIA, build: thin_dielectric },
    ]
}

fn smooth_conductor<C: Spectrum>(reader: &Reader) -> Built<C> {
    let model = SmoothConductor::<C>::new(reader.complex_ior()?);
    Ok(Box::new(model.with_specular_reflectance(reader.factor("specular_reflectance")?)))
}

fn smooth_dielectric<C: Spectrum>(reader: &Reader) -> Built<C> {
    let (ks, kt) = reader.factors()?;
    Ok(Box::new(SmoothDielectric::<C>::new(reader.ior()?).with_factors(ks, kt)))
}

fn thin_dielectric<C: Spectrum>(reader: &Reader) -> Built<C> {
    let (ks, kt) = reader.factors()?;
    Ok(Box::new(ThinDielectric::<C>::new(reader.ior()?).with_factors(ks, kt)))
}
