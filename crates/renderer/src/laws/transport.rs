//! The configuration for media gives the bits of the one without where there are none.

use std::path::Path;

use etendue_math::Spectrum;
use etendue_math::glam::DVec3;
use etendue_scene::film::Crop;
use etendue_scene::material::Material;
use etendue_scene::medium::{Extinction, Medium, MediumCurves, Phase, Volume};
use etendue_scene::scene::SamplerKind;
use etendue_scene::{Color, LoadOptions, Scene, load_scene};

use super::scenes::{Sketch, lamp_over_sphere, settings, sphere};
use crate::configuration::Configuration;
use crate::progressive::{Goal, Halt};
use crate::{RenderSettings, Renderer, Strategy};

/// Renders in both configurations, at once and progressively.
fn assert_same_bits(scene: &Scene, settings: &RenderSettings) {
    let renderer = Renderer::new(scene, settings.clone()).expect("threads");
    assert_eq!(renderer.configuration, Configuration::Surfaces);
    let render = |renderer: &Renderer<'_>| {
        let goal = Goal { samples_per_pixel: Some(4), ..Goal::default() };
        let go_on = core::sync::atomic::AtomicBool::new(false);
        let whole = renderer.render(&|_| (), &go_on);
        (whole, renderer.render_progressively(&goal, &|_| (), &|| Halt::No))
    };
    let surfaces = render(&renderer);
    let renderer = renderer.with_everything();
    assert_eq!(renderer.configuration, Configuration::Volumes);
    let volumes = render(&renderer);
    assert_eq!(surfaces.0, volumes.0);
    assert_eq!(surfaces.1, volumes.1);
}

#[test]
fn shipped_scenes_without_media_have_the_same_bits() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    for name in
        ["cornell-box/scene.xml", "glass-and-metal.xml", "lambert-oren-nayar.xml", "materials.xml"]
    {
        let options = LoadOptions { film_size: Some([24, 16]), ..LoadOptions::default() };
        let scene = load_scene(&folder.join(name), &options).expect(name).scene;
        let settings = RenderSettings { samples_per_pixel: 4, ..RenderSettings::of_scene(&scene) };
        assert_same_bits(&scene, &settings);
    }
}

#[test]
fn so_have_hidden_emitters_any_depth_and_either_sampler() {
    let mut scene = lamp_over_sphere([20, 20]);
    scene.film.crop = Crop { offset: [2, 3], size: [16, 12] };
    for sampler in [SamplerKind::Independent, SamplerKind::Sobol] {
        for max_depth in [Some(0), Some(1), Some(2), Some(5), None] {
            for hide_emitters in [false, true] {
                let mut settings = RenderSettings {
                    samples_per_pixel: 4,
                    sampler,
                    ..RenderSettings::of_scene(&scene)
                };
                settings.path.max_depth = max_depth;
                settings.path.hide_emitters = hide_emitters;
                assert_same_bits(&scene, &settings);
            }
        }
    }
}

#[test]
fn only_media_and_what_light_passes_call_for_the_configuration_of_volumes() {
    let kind = |volumes: bool, fill: fn(&mut Sketch)| {
        let mut sketch = Sketch::default();
        fill(&mut sketch);
        let scene = sketch.point_seen(DVec3::new(0.0, -4.0, 0.0), DVec3::ZERO);
        let mut settings = settings(None, Strategy::Mis);
        settings.path.volumes = volumes;
        Renderer::new(&scene, settings).expect("a thread").configuration
    };
    let solid = |sketch: &mut Sketch| {
        let grey = sketch.grey(0.5);
        sketch.shape(sphere(DVec3::ZERO, 1.0), grey);
    };
    let null = |sketch: &mut Sketch| {
        let nothing = sketch.material(Material::Null);
        sketch.shape(sphere(DVec3::ZERO, 1.0), nothing);
    };
    let filled = |sketch: &mut Sketch| {
        let grey = sketch.grey(0.5);
        let medium = sketch.medium(Medium {
            extinction: Extinction::Homogeneous(Color::white()),
            albedo: Volume::constant(Color::white()),
            phase: Phase::Isotropic,
            curves: MediumCurves::default(),
            samples_lights: true,
        });
        sketch.filled(sphere(DVec3::ZERO, 1.0), grey, medium);
    };
    assert_eq!(kind(true, solid), Configuration::Surfaces);
    for fill in [null, filled] as [fn(&mut Sketch); 2] {
        assert_eq!(kind(false, fill), Configuration::Surfaces);
        assert_eq!(kind(true, fill), Configuration::Volumes);
    }
}
