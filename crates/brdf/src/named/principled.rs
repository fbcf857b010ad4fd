//! Disney's material.

use alloc::boxed::Box;

use etendue_math::Spectrum;

use super::{Built, Entry, NamedError, Reader};
use crate::principled::{solid as solid_model, thin as thin_model};
use crate::{Principled, PrincipledParameters, PrincipledThin, PrincipledThinParameters};

pub(super) fn entries<C: Spectrum>() -> [Entry<C>; 2] {
    [
        Entry { info: &solid_model::INFO, synonyms: &["specular"], build: solid },
        Entry { info: &thin_model::INFO, synonyms: &[], build: thin },
    ]
}

fn solid<C: Spectrum>(reader: &Reader) -> Built<C> {
    let mut p = PrincipledParameters::<C>::default();
    reader.replace_colors(&mut [("base_color", &mut p.base_color)])?;
    if reader.has("specular") && !reader.has("eta") {
        p = reader.constructed(p.with_specular(reader.number("specular")?))?;
    } else if reader.has("specular") {
        let expected = "absent where eta is given".into();
        return Err(NamedError::Kind { of: reader.of, parameter: "specular", expected });
    }
    reader.replace(&mut [
        ("roughness", &mut p.roughness),
        ("anisotropic", &mut p.anisotropic),
        ("metallic", &mut p.metallic),
        ("spec_trans", &mut p.spec_trans),
        ("eta", &mut p.eta),
        ("spec_tint", &mut p.spec_tint),
        ("sheen", &mut p.sheen),
        ("sheen_tint", &mut p.sheen_tint),
        ("flatness", &mut p.flatness),
        ("clearcoat", &mut p.clearcoat),
        ("clearcoat_gloss", &mut p.clearcoat_gloss),
        ("diffuse_reflectance_sampling_rate", &mut p.diffuse_reflectance_sampling_rate),
        ("main_specular_sampling_rate", &mut p.main_specular_sampling_rate),
        ("clearcoat_sampling_rate", &mut p.clearcoat_sampling_rate),
    ])?;
    Ok(Box::new(reader.constructed(Principled::new(p))?))
}

fn thin<C: Spectrum>(reader: &Reader) -> Built<C> {
    let mut p = PrincipledThinParameters::<C>::default();
    reader.replace_colors(&mut [("base_color", &mut p.base_color)])?;
    reader.replace(&mut [
        ("roughness", &mut p.roughness),
        ("anisotropic", &mut p.anisotropic),
        ("spec_trans", &mut p.spec_trans),
        ("eta", &mut p.eta),
        ("spec_tint", &mut p.spec_tint),
        ("sheen", &mut p.sheen),
        ("sheen_tint", &mut p.sheen_tint),
        ("flatness", &mut p.flatness),
        ("diff_trans", &mut p.diff_trans),
        ("specular_reflectance_sampling_rate", &mut p.specular_reflectance_sampling_rate),
        ("specular_transmittance_sampling_rate", &mut p.specular_transmittance_sampling_rate),
        ("diffuse_reflectance_sampling_rate", &mut p.diffuse_reflectance_sampling_rate),
        ("diffuse_transmittance_sampling_rate", &mut p.diffuse_transmittance_sampling_rate),
    ])?;
    Ok(Box::new(reader.constructed(PrincipledThin::new(p))?))
}

#[cfg(test)]
mod tests {
    use alloc::string::ToString;

    use super::super::{Parameters, build, direction};

    #[test]
    fn specular_is_another_way_to_give_the_index() {
        let [wo, wi] = [[0.6, 0.0, 0.8], [0.0, 0.8, 0.6]].map(|w| direction::<f64>(w).unwrap());
        let by = |parameters: Parameters| build::<f64>("principled", &parameters);
        // Half of 8 % is the default.
        let half = by(Parameters::new().with_number("specular", 0.5)).unwrap();
        assert_eq!(half.eval(wo, wi), by(Parameters::new()).unwrap().eval(wo, wi));
        let both = Parameters::new().with_number("specular", 0.5).with_number("eta", 1.5);
        let message = by(both).err().unwrap().to_string();
        assert_eq!(message, "principled: specular must be absent where eta is given");
    }
}
