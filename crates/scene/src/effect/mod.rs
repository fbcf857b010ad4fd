//! What a scene may call for, and what it does call for.
//!
//! The vocabulary is closed: an [`Effect`] is something that takes code of its own, time, or random numbers, and that
//! a scene can do without. [`Scene::effects`](crate::Scene::effects) is a pure function of what the scene refers to, and
//! [`Scene::without`](crate::Scene::without) gives the scene that does not call for some of them.

mod causes;
mod presence;
mod selection;

pub use presence::{Element, Presence};

/// Something that is simulated only where a scene calls for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Effect {
    /// Light that arrives by way of other surfaces.
    IndirectLight,
    /// Shapes that emit.
    AreaLight,
    /// Light from a point.
    PointLight,
    /// Light from a point into a cone.
    SpotLight,
    /// A picture thrown from a point.
    Projector,
    /// Parallel light.
    DirectionalLight,
    /// The same light from everywhere.
    ConstantBackground,
    /// An image around the scene.
    EnvironmentMap,
    /// Mirrors: reflection into a single direction.
    DeltaReflection,
    /// Refraction into a single direction.
    DeltaTransmission,
    /// Reflection from microfacets.
    RoughReflection,
    /// Refraction by microfacets.
    RoughTransmission,
    /// Glass that parts white light into its colours.
    Dispersion,
    /// Transparent bodies that overlap.
    NestedDielectrics,
    /// Light that facets scatter more than once.
    MultipleScattering,
    /// Disney's material of many lobes.
    Principled,
    /// Surfaces that are partly not there.
    OpacityMask,
    /// Two materials in shares.
    Blend,
    /// Normals from an image.
    NormalMap,
    /// Normals of bumps whose height is an image.
    BumpMap,
    /// Surfaces that light does not notice.
    PassThrough,
    /// Images on surfaces and in lights.
    BitmapTexture,
    /// Images that are seen as coarsely as samples are far apart.
    TextureFiltering,
    /// Two textures in squares.
    CheckerboardTexture,
    /// Colours that meshes bring along.
    MeshAttribute,
    /// Colours that fill space, on surfaces.
    VolumeTexture,
    /// Matter of the same density everywhere, that scatters and absorbs.
    HomogeneousMedium,
    /// Matter whose density differs from place to place.
    HeterogeneousMedium,
    /// Matter that takes more of one colour than of another.
    ColouredExtinction,
    /// Matter that scatters more into some directions than into others.
    AnisotropicScattering,
    /// Shapes that stand in several places.
    Instancing,
    /// A lens with an extent, out of whose focus things blur.
    DepthOfField,
    /// Shapes, instances and a camera that move while the shutter is open.
    MotionBlur,
    /// Emitters that the camera looks through.
    HiddenEmitters,
    /// Paths that carry wavelengths although nothing parts them.
    SpectralColours,
    /// No light where geometric and interpolated normals disagree.
    StrictNormals,
}

impl Effect {
    /// The whole vocabulary.
    pub const ALL: [Self; 36] = [
        Self::IndirectLight,
        Self::AreaLight,
        Self::PointLight,
        Self::SpotLight,
        Self::Projector,
        Self::DirectionalLight,
        Self::ConstantBackground,
        Self::EnvironmentMap,
        Self::DeltaReflection,
        Self::DeltaTransmission,
        Self::RoughReflection,
        Self::RoughTransmission,
        Self::Dispersion,
        Self::NestedDielectrics,
        Self::MultipleScattering,
        Self::Principled,
        Self::OpacityMask,
        Self::Blend,
        Self::NormalMap,
        Self::BumpMap,
        Self::PassThrough,
        Self::BitmapTexture,
        Self::TextureFiltering,
        Self::CheckerboardTexture,
        Self::MeshAttribute,
        Self::VolumeTexture,
        Self::HomogeneousMedium,
        Self::HeterogeneousMedium,
        Self::ColouredExtinction,
        Self::AnisotropicScattering,
        Self::Instancing,
        Self::DepthOfField,
        Self::MotionBlur,
        Self::HiddenEmitters,
        Self::SpectralColours,
        Self::StrictNormals,
    ];

    /// Its name for programs: lower-case words joined by hyphens.
    pub fn name(self) -> &'static str {
        match self {
            Self::IndirectLight => "indirect-light",
            Self::AreaLight => "area-light",
            Self::PointLight => "point-light",
            Self::SpotLight => "spot-light",
            Self::Projector => "projector",
            Self::DirectionalLight => "directional-light",
            Self::ConstantBackground => "constant-background",
            Self::EnvironmentMap => "environment-map",
            Self::DeltaReflection => "delta-reflection",
            Self::DeltaTransmission => "delta-transmission",
            Self::RoughReflection => "rough-reflection",
            Self::RoughTransmission => "rough-transmission",
            Self::Dispersion => "dispersion",
            Self::NestedDielectrics => "nested-dielectrics",
            Self::MultipleScattering => "multiple-scattering",
            Self::Principled => "principled",
            Self::OpacityMask => "opacity-mask",
            Self::Blend => "blend",
            Self::NormalMap => "normal-map",
            Self::BumpMap => "bump-map",
            Self::PassThrough => "pass-through",
            Self::BitmapTexture => "bitmap-texture",
            Self::TextureFiltering => "texture-filtering",
            Self::CheckerboardTexture => "checkerboard-texture",
            Self::MeshAttribute => "mesh-attribute",
            Self::VolumeTexture => "volume-texture",
            Self::HomogeneousMedium => "homogeneous-medium",
            Self::HeterogeneousMedium => "heterogeneous-medium",
            Self::ColouredExtinction => "coloured-extinction",
            Self::AnisotropicScattering => "anisotropic-scattering",
            Self::Instancing => "instancing",
            Self::DepthOfField => "depth-of-field",
            Self::MotionBlur => "motion-blur",
            Self::HiddenEmitters => "hidden-emitters",
            Self::SpectralColours => "spectral-colours",
            Self::StrictNormals => "strict-normals",
        }
    }

    /// What it costs where it is present, and from where on.
    pub fn cost(self) -> &'static str {
        match self {
            Self::IndirectLight => {
                "a ray, a light sample and its shadow ray per surface after the first"
            }
            Self::AreaLight => {
                "a light sample and a shadow ray per surface met, a look at every surface whether it emits"
            }
            Self::PointLight | Self::SpotLight | Self::Projector | Self::DirectionalLight => {
                "a choice among lights, a light sample and a shadow ray per surface met"
            }
            Self::ConstantBackground => {
                "a light sample and a shadow ray per surface met, a density per ray that leaves"
            }
            Self::EnvironmentMap => {
                "a table of its pixels, a search in it per light sample, a look-up and a density per ray that leaves"
            }
            Self::DeltaReflection => {
                "Fresnel's equations; paths grow longer, for a delta lobe takes no light sample"
            }
            Self::DeltaTransmission => {
                "Fresnel's equations and a random number per surface met; paths grow longer"
            }
            Self::RoughReflection => {
                "a normal sampled, a distribution and its masking evaluated twice per surface met"
            }
            Self::RoughTransmission => {
                "the same with a choice between two sides, and light samples from both"
            }
            Self::Dispersion | Self::SpectralColours => {
                "four wavelengths instead of three primaries all over the scene, models made at every surface met"
            }
            Self::NestedDielectrics => {
                "paths that know which bodies they are in, a look at every surface whether it is one of them, and a model of its own for it"
            }
            Self::MultipleScattering => {
                "a row of a table interpolated and a model made each time it is evaluated or sampled, a second lobe"
            }
            Self::Principled => {
                "a model made twice, a random number and up to four lobes evaluated per surface met"
            }
            Self::OpacityMask => {
                "a random number per surface met and a vertex of the path where it is not there"
            }
            Self::Blend => "a random number, two models made and evaluated each time one would be",
            Self::NormalMap => "a frame and a model made each time it is evaluated or sampled",
            Self::BumpMap => {
                "a copy of the point, derivatives of its position and a slope from four texels, then as a normal map"
            }
            Self::PassThrough => "a vertex of the path",
            Self::BitmapTexture => "four texels and a model of its own per surface met",
            Self::TextureFiltering => {
                "a third more memory for images; a copy of the point, derivatives of its position, a logarithm and eight texels"
            }
            Self::CheckerboardTexture => "a square found and a model of its own per surface met",
            Self::MeshAttribute => {
                "a copy of the point, a name found, a value of each corner and a model of its own per surface met"
            }
            Self::VolumeTexture => {
                "a copy of the point, a place in the grid, eight cells and a model of its own per surface met"
            }
            Self::HomogeneousMedium => {
                "a random number per ray in it and a vertex per collision, shadow rays that stop at every surface"
            }
            Self::HeterogeneousMedium => {
                "the same, with two random numbers and a look-up per tentative collision, also along shadow rays"
            }
            Self::ColouredExtinction => {
                "a random number per sample and three exponentials per collision or way through"
            }
            Self::AnisotropicScattering => "a frame, and a root or a search, per collision",
            Self::Instancing => "a ray transformed and a second hierarchy entered per instance met",
            Self::DepthOfField => "two random numbers and a point on the lens per sample",
            Self::MotionBlur => {
                "a random number per sample; a placement interpolated, a ray transformed and a second hierarchy entered per moving shape met"
            }
            Self::HiddenEmitters => "a further ray behind every emitter that the camera sees",
            Self::StrictNormals => "a comparison per direction",
        }
    }
}
