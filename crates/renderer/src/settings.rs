//! What a render is asked to do.

use etendue_scene::Scene;
use etendue_scene::scene::{PathSettings, SamplerKind};

/// How a scene is rendered.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSettings {
    /// Number of threads; 0 for one per logical processor. Has no influence on the picture.
    pub threads: usize,
    /// Paths per pixel.
    pub samples_per_pixel: u32,
    /// Chooses the random numbers: equal seeds give equal pictures.
    pub seed: u64,
    /// The points that paths are built from.
    pub sampler: SamplerKind,
    /// Length of paths and what they see.
    pub path: PathSettings,
    /// How light is found.
    pub strategy: Strategy,
    /// Where light of single points is looked for in homogeneous media.
    pub airlight: Airlight,
}

impl RenderSettings {
    /// The settings that the scene itself asks for, on all processors.
    pub fn of_scene(scene: &Scene) -> Self {
        Self {
            threads: 0,
            samples_per_pixel: scene.sampling.samples_per_pixel,
            seed: scene.sampling.seed,
            sampler: scene.sampling.sampler,
            path: scene.path,
            strategy: Strategy::default(),
            airlight: Airlight::default(),
        }
    }
}

/// How paths find the lights. All strategies have the same expectation wherever each can find
/// every light; they differ in noise.
///
/// Lights of a single point or direction are found by light sampling, and lights seen through
/// mirrors and clear glass by following the path, whatever the strategy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Strategy {
    /// Light sampling and scattering combined by the power heuristic.
    #[default]
    Mis,
    /// Scattered rays that hit a light by chance.
    BsdfOnly,
    /// Light sampling. Noisy where light comes from all around: what is no brighter than the mean is drawn rarely, because with
    /// [`Mis`](Self::Mis) scattering finds it.
    LightOnly,
}

/// Where along a ray through a homogeneous medium light is looked for that comes from a single point: a point light, a spot
/// light, a projector. Both have the same expectation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Airlight {
    /// At collisions, and near to the light, combined by the power heuristic: a shadow ray more per way through such a
    /// medium, and no noise by lights in view.
    #[default]
    Combined,
    /// At collisions.
    Transmittance,
}
