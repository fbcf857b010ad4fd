//! Models made of other models.

use alloc::boxed::Box;

use etendue_math::Spectrum;

use super::{Built, Entry, Reader};
use crate::adapter::{blend, mask, two_sided};
use crate::{Blend, Mask, Opacity, TwoSided};

pub(super) fn entries<C: Spectrum>() -> [Entry<C>; 3] {
    [
        Entry { info: &blend::INFO, synonyms: &[], build: blend },
        Entry { info: &mask::INFO, synonyms: &[], build: mask },
        Entry { info: &two_sided::INFO, synonyms: &[], build: two_sided },
    ]
}

fn mask<C: Spectrum>(reader: &Reader) -> Built<C> {
    let opacity = reader.checked("opacity", Opacity::new(reader.number("opacity")?))?;
    Ok(Box::new(Mask::new(reader.model::<C>("inner")?, opacity)))
}

fn two_sided<C: Spectrum>(reader: &Reader) -> Built<C> {
    Ok(Box::new(TwoSided::new(reader.model::<C>("front")?, reader.model::<C>("back")?)))
}

fn blend<C: Spectrum>(reader: &Reader) -> Built<C> {
    let weight = reader.checked("weight", Opacity::new(reader.number("weight")?))?;
    let (first, second) = (reader.model::<C>("first")?, reader.model::<C>("second")?);
    Ok(Box::new(Blend::new(first, second, weight)))
}
