//! Forms of models, one cheaper or simpler than the other.

use etendue_brdf::{BeckmannLambda, Distribution, InternalScattering, Masking};
use etendue_scene::material::{Material, Materials, OrenNayarForm, Roughness};

/// A form that all materials are given where they have the choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Oren and Nayar's model with interreflection.
    OrenNayarFull,
    /// Their simplification.
    OrenNayarQualitative,
    /// Lambert's reflector in its place.
    OrenNayarLambert,
    /// Facets of metal and glass that hide each other by their common height.
    MaskingCorrelated,
    /// Facets that hide each other independently.
    MaskingSeparable,
    /// Smith's Λ of Beckmann facets with the error function.
    BeckmannExact,
    /// Walter's rational fit of it.
    BeckmannWalter,
    /// Plastic whose colour shifts by scattering below the interface.
    PlasticNonLinear,
    /// Plastic whose colour does not.
    PlasticLinear,
    /// Glass with one index of refraction for all wavelengths.
    OneIndex,
}

impl Form {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::OrenNayarFull,
        Self::OrenNayarQualitative,
        Self::OrenNayarLambert,
        Self::MaskingCorrelated,
        Self::MaskingSeparable,
        Self::BeckmannExact,
        Self::BeckmannWalter,
        Self::PlasticNonLinear,
        Self::PlasticLinear,
        Self::OneIndex,
    ];

    /// For people.
    pub fn name(self) -> &'static str {
        match self {
            Self::OrenNayarFull => "Oren–Nayar, full",
            Self::OrenNayarQualitative => "Oren–Nayar, qualitative",
            Self::OrenNayarLambert => "Lambert for Oren–Nayar",
            Self::MaskingCorrelated => "masking, correlated",
            Self::MaskingSeparable => "masking, separable",
            Self::BeckmannExact => "Beckmann's Λ, exact",
            Self::BeckmannWalter => "Beckmann's Λ, Walter's fit",
            Self::PlasticNonLinear => "plastic, non-linear",
            Self::PlasticLinear => "plastic, linear",
            Self::OneIndex => "one index for all wavelengths",
        }
    }

    /// Whether any material would become another.
    pub fn changes(self, materials: &Materials) -> bool {
        materials.iter().any(|material| self.of(material).is_some())
    }

    /// The materials in this form.
    #[expect(
        clippy::missing_panics_doc,
        reason = "a form changes nothing that a material is refused for"
    )]
    pub fn apply(self, materials: &Materials) -> Materials {
        let mut changed = Materials::default();
        for material in materials.iter() {
            let material = self.of(material).unwrap_or_else(|| material.clone());
            changed.add(material).expect("materials that were accepted before");
        }
        changed
    }

    /// The material in this form; `None` where it is so already or has no such choice.
    fn of(self, material: &Material) -> Option<Material> {
        if let (Self::OrenNayarLambert, &Material::RoughDiffuse { reflectance, .. }) =
            (self, material)
        {
            return Some(Material::Diffuse { reflectance });
        }
        let mut changed = material.clone();
        let is_new = match &mut changed {
            Material::RoughDiffuse { form, .. } => match self {
                Self::OrenNayarFull => replace(form, OrenNayarForm::Full),
                Self::OrenNayarQualitative => replace(form, OrenNayarForm::Qualitative),
                _ => false,
            },
            Material::Dielectric { dispersion, .. } if self == Self::OneIndex => {
                replace(dispersion, None)
            }
            Material::Dielectric { roughness: Some(roughness), .. }
            | Material::Conductor { roughness: Some(roughness), .. } => self.of_facets(roughness),
            Material::Plastic { scattering, .. } => match self {
                Self::PlasticNonLinear => replace(scattering, InternalScattering::NonLinear),
                Self::PlasticLinear => replace(scattering, InternalScattering::Linear),
                _ => false,
            },
            _ => false,
        };
        is_new.then_some(changed)
    }

    fn of_facets(self, Roughness { distribution, masking, .. }: &mut Roughness) -> bool {
        match (self, distribution) {
            (Self::MaskingCorrelated, _) => replace(masking, Masking::HeightCorrelated),
            (Self::MaskingSeparable, _) => replace(masking, Masking::Separable),
            (Self::BeckmannExact, Distribution::Beckmann { lambda }) => {
                replace(lambda, BeckmannLambda::Exact)
            }
            (Self::BeckmannWalter, Distribution::Beckmann { lambda }) => {
                replace(lambda, BeckmannLambda::Walter)
            }
            _ => false,
        }
    }
}

/// Sets a value; whether it was another one before.
fn replace<T: PartialEq>(place: &mut T, value: T) -> bool {
    let is_new = *place != value;
    *place = value;
    is_new
}
