//! Models made of other models.

use alloc::boxed::Box;

use etendue_math::Spectrum;

use super::{Built, Entry, Reader};
use crate::adapter::{mask, two_sided};
use crate::{Mask, Opacity, TwoSided};

pub(super) fn entries<C: Spectrum>() -> [Entry<C>; 2] {
    [
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
