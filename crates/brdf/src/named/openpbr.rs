//! OpenPBR's surface.

use alloc::boxed::Box;

use etendue_math::Spectrum;

use super::{Built, Entry, Reader};
use crate::openpbr::surface;
use crate::{OpenPbr, OpenPbrParameters};

pub(super) fn entries<C: Spectrum>() -> [Entry<C>; 1] {
    [Entry { info: &surface::INFO, synonyms: &[], build }]
}

fn build<C: Spectrum>(reader: &Reader) -> Built<C> {
    let mut p = OpenPbrParameters::<C>::default();
    reader.replace_colors(&mut [
        ("base_color", &mut p.base_color),
        ("specular_color", &mut p.specular_color),
        ("coat_color", &mut p.coat_color),
        ("fuzz_color", &mut p.fuzz_color),
    ])?;
    reader.replace(&mut [
        ("base_weight", &mut p.base_weight),
        ("base_diffuse_roughness", &mut p.base_diffuse_roughness),
        ("base_metalness", &mut p.base_metalness),
        ("specular_weight", &mut p.specular_weight),
        ("specular_roughness", &mut p.specular_roughness),
        ("specular_roughness_anisotropy", &mut p.specular_roughness_anisotropy),
        ("specular_ior", &mut p.specular_ior),
        ("coat_weight", &mut p.coat_weight),
        ("coat_roughness", &mut p.coat_roughness),
        ("coat_roughness_anisotropy", &mut p.coat_roughness_anisotropy),
        ("coat_ior", &mut p.coat_ior),
        ("coat_darkening", &mut p.coat_darkening),
        ("fuzz_weight", &mut p.fuzz_weight),
        ("fuzz_roughness", &mut p.fuzz_roughness),
    ])?;
    Ok(Box::new(reader.constructed(OpenPbr::new(p))?))
}
