//! Mirrors, glass and nothing.

use alloc::boxed::Box;

use etendue_math::Spectrum;

use super::{Built, Entry, Reader};
use crate::smooth::{absorbing_slab, null, smooth_conductor, smooth_dielectric, thin_dielectric};
use crate::{AbsorbingSlab, Null, OpticalDepth, SmoothConductor, SmoothDielectric, ThinDielectric};

const BETWEEN_MEDIA: &[&str] = &["ior_int", "ior_ext"];

pub(super) fn entries<C: Spectrum>() -> [Entry<C>; 5] {
    [
        Entry { info: &absorbing_slab::INFO, synonyms: BETWEEN_MEDIA, build: absorbing_slab },
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

fn absorbing_slab<C: Spectrum>(reader: &Reader) -> Built<C> {
    let depth = OpticalDepth::new(reader.color("optical_depth")?);
    let depth = reader.checked("optical_depth", depth)?;
    Ok(Box::new(AbsorbingSlab::<C>::new(reader.ior()?, depth)))
}
