//! What is compared: ways to render one scene.

use etendue_renderer::{Airlight, RenderSettings, Strategy};
use etendue_scene::scene::{PathSettings, SamplerKind};
use etendue_scene::{Effect, Scene};

use super::forms::Form;

/// A way to render a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Variant {
    /// Its name, unique among those of a scene.
    pub name: String,
    /// Whether it is one of finding light, with the same expectation, or leaves something out.
    pub kind: Kind,
    /// How light is found.
    pub strategy: Strategy,
    /// Points.
    pub sampler: SamplerKind,
    /// A limit of the length of paths below that of the scene.
    pub max_depth: Option<u32>,
    /// Another form of its models.
    pub form: Option<Form>,
    /// Red, green and blue where the scene asks for wavelengths.
    pub primaries: bool,
    /// Where light of single points is looked for in homogeneous media.
    pub airlight: Airlight,
}

/// What sets a variant apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// How light is found: unbiased wherever every light can be found.
    Strategy,
    /// What is computed.
    Approximation,
}

/// Limits of path lengths that are tried, in edges.
const DEPTHS: [u32; 4] = [2, 3, 5, 9];

impl Variant {
    /// Every variant of a scene. The first is how it would be rendered: by everything there is.
    pub fn of(scene: &Scene) -> Vec<Self> {
        let strategies = [
            ("MIS", Strategy::Mis),
            ("BSDF only", Strategy::BsdfOnly),
            ("light only", Strategy::LightOnly),
        ];
        let samplers = [("Sobol'", SamplerKind::Sobol), ("independent", SamplerKind::Independent)];
        let mut variants = Vec::new();
        for (strategy_name, strategy) in strategies {
            for (sampler_name, sampler) in samplers {
                let name = format!("{strategy_name}, {sampler_name}");
                variants.push(Self {
                    name,
                    kind: Kind::Strategy,
                    strategy,
                    sampler,
                    max_depth: None,
                    form: None,
                    primaries: false,
                    airlight: Airlight::Combined,
                });
            }
        }
        variants.extend(has_airlight(scene).then(|| Self {
            name: "MIS, Sobol', points at collisions only".to_owned(),
            airlight: Airlight::Transmittance,
            ..variants[0].clone()
        }));
        let base = Self { kind: Kind::Approximation, ..variants[0].clone() };
        variants.extend(scene.path.spectral.then(|| Self {
            name: "primaries for wavelengths".to_owned(),
            primaries: true,
            ..base.clone()
        }));
        let shorter = |depth: &u32| scene.path.max_depth.is_none_or(|limit| *depth < limit);
        variants.extend(DEPTHS.iter().copied().filter(shorter).map(|depth| Self {
            name: format!("at most {depth} edges"),
            max_depth: Some(depth),
            ..base.clone()
        }));
        variants.extend(
            Form::ALL.into_iter().filter(|form| form.changes(&scene.materials)).map(|form| Self {
                name: form.name().to_owned(),
                form: Some(form),
                ..base.clone()
            }),
        );
        variants
    }

    /// The settings of one picture.
    pub(super) fn settings(&self, scene: &Scene, picture: Picture) -> RenderSettings {
        RenderSettings {
            threads: picture.threads,
            samples_per_pixel: picture.samples_per_pixel,
            seed: picture.seed,
            sampler: self.sampler,
            path: PathSettings {
                max_depth: self.max_depth.or(scene.path.max_depth),
                spectral: scene.path.spectral && !self.primaries,
                ..scene.path
            },
            strategy: self.strategy,
            airlight: self.airlight,
        }
    }
}

/// Whether lights of single points shine into homogeneous media.
fn has_airlight(scene: &Scene) -> bool {
    let present = scene.effects();
    present.iter().any(|presence| presence.effect == Effect::HomogeneousMedium)
        && scene.lights.iter().any(|light| light.position().is_some())
}

/// What distinguishes pictures of one variant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Picture {
    pub(super) samples_per_pixel: u32,
    pub(super) seed: u64,
    pub(super) threads: usize,
}
