//! What Mitsuba 3 does not have.

use alloc::collections::BTreeSet;
use core::fmt;

use crate::effect::Effect;
use crate::scene::Scene;

/// Something of a scene that Mitsuba 3 (3.9) has no plugin for, and what is written instead.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Loss {
    /// An effect, left out as by [`Scene::without`].
    Effect(Effect),
    /// Oren and Nayar's reflection.
    RoughDiffuse,
    /// A sheet that scatters to both sides.
    DiffuseTransmitter,
    /// Phong's lobe.
    Phong,
    /// A layer of glass.
    Coating,
    /// The exact form of a microfacet model.
    ExactFacets,
    /// The exact reflectance of plastic from inside.
    ExactInternalReflectance,
    /// A box filter of another width.
    BoxFilter,
    /// A seed of more than 32 bits.
    Seed,
    /// A camera that stretches or shears what it sees.
    StretchedCamera,
    /// More than one light around the scene.
    SecondBackground,
    /// Borders of an image that differ.
    SecondWrap,
    /// Textures multiplied or compared that are no single image.
    Product,
    /// The colour that an attribute of a mesh is multiplied by.
    Tint,
    /// Edges where a filtered image reaches a limit.
    Edges,
}

/// The effects that Mitsuba 3 does not have.
const EFFECTS: [Effect; 7] = [
    Effect::Dispersion,
    Effect::NestedDielectrics,
    Effect::MultipleScattering,
    Effect::TextureFiltering,
    Effect::MotionBlur,
    Effect::SpectralColours,
    Effect::StrictNormals,
];

/// The scene without the effects that Mitsuba does not have, and those of them that it called for.
pub(super) fn without_what_is_lost(scene: Scene) -> (Scene, BTreeSet<Loss>) {
    let present: BTreeSet<Effect> = scene.effects().iter().map(|found| found.effect).collect();
    let lost: BTreeSet<Effect> = EFFECTS.into_iter().filter(|e| present.contains(e)).collect();
    let losses = lost.iter().copied().map(Loss::Effect).collect();
    // What no shape is made of would be changed, too, but is not written.
    let scene = if lost.is_empty() { scene } else { scene.without(&lost) };
    (scene, losses)
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self {
            Self::Effect(Effect::Dispersion) => {
                "dispersion is lost: glass has its index of the yellow line of helium for every wavelength"
            }
            Self::Effect(Effect::NestedDielectrics) => {
                "priorities of bodies that overlap are lost: each is there, in what is around all of them"
            }
            Self::Effect(Effect::MultipleScattering) => {
                "“multiple_scattering” is lost: facets lose the light that they scatter more than once"
            }
            Self::Effect(Effect::TextureFiltering) => {
                "trilinear filtering of textures is lost: it is bilinear"
            }
            Self::Effect(Effect::MotionBlur) => {
                "motion is lost: everything stands where it is when the shutter opens"
            }
            Self::Effect(Effect::SpectralColours) => {
                "“spectral” of the integrator is lost: wavelengths are a matter of Mitsuba's variant"
            }
            Self::Effect(Effect::StrictNormals) => {
                "“strict_normals” of the integrator is lost: light may pass where normals disagree"
            }
            Self::Effect(effect) => return write!(f, "“{}” is lost", effect.name()),
            Self::RoughDiffuse => "the roughness of “roughdiffuse” is lost: it is “diffuse”",
            Self::DiffuseTransmitter => {
                "“difftrans” is lost: it is “principledthin” that lets as much through"
            }
            Self::Phong => {
                "the lobe of “phong” is lost: it is that of “roughconductor”, or none where colours vary"
            }
            Self::Coating => {
                "the layer of “coating” is lost: it is “plastic” on “diffuse”, and not there on other surfaces"
            }
            Self::ExactFacets => {
                "“masking” and “smith_lambda” of facets are lost: they are “separable” and “walter”"
            }
            Self::ExactInternalReflectance => {
                "“internal_reflectance” of plastic is lost: it is Mitsuba's own"
            }
            Self::BoxFilter => "the radius of the box filter is lost: it is half a pixel",
            Self::Seed => "the sampler's seed is lost: it has more than 32 bits",
            Self::StretchedCamera => "the camera's uneven stretching or shearing is lost",
            Self::SecondWrap => "images have the same borders above and below as left and right",
            Self::Product => {
                "textures that are multiplied and no single image are lost: they are their mean"
            }
            Self::Tint => {
                "attributes of meshes that a colour multiplies are multiplied by its luminance"
            }
            Self::Edges => {
                "edges where a filtered image reaches a limit are lost: they are those of its texels"
            }
            Self::SecondBackground => "of several lights around the scene only the first is there",
        };
        f.write_str(text)
    }
}
