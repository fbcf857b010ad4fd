//! Paths that carry wavelengths see what those see that carry primaries, and what parts wavelengths loses none.

use etendue_brdf::fresnel::Dispersion;
use etendue_math::glam::DVec3;
use etendue_math::{Real, Rgb, Spectrum};
use etendue_scene::color::{Channels, Curve, Wavelengths};
use etendue_scene::material::Material;
use etendue_scene::medium::{Extinction, Medium, MediumCurves, Phase, Volume};
use etendue_scene::{Color, Scene};

use super::scenes::{Estimate, Sketch, estimate, lamp_over_sphere, rectangle, settings, sphere};
use crate::configuration::Configuration;
use crate::{RenderSettings, Renderer, Strategy};

fn by_wavelength(max_depth: Option<u32>, strategy: Strategy) -> RenderSettings {
    let mut settings = settings(max_depth, strategy);
    settings.path.spectral = true;
    settings
}

fn assert_equal(a: Estimate, b: Estimate) {
    // Each test is a single draw: 4 standard errors of the difference.
    let allowed = 4.0 * (a.error.sqr() + b.error.sqr()).sqrt();
    assert!((a.mean - b.mean).abs() <= allowed, "{a:?} {b:?}");
    assert!(allowed <= 0.1 * a.mean, "too noisy to tell: {a:?} {b:?}");
}

/// A ball of glass under an even sky.
fn ball(dispersion: Dispersion, alpha: Option<f32>, world: impl FnOnce(&mut Sketch)) -> Scene {
    let mut sketch = Sketch::default();
    let glass = sketch.interface(Some(dispersion), alpha);
    let glass = sketch.material(glass);
    sketch.shape(sphere(DVec3::ZERO, 1.0), glass);
    world(&mut sketch);
    sketch.point_seen(DVec3::new(0.0, -4.0, 1.0), DVec3::new(0.2, 0.0, 0.3))
}

/// So much dispersion that blue and red go quite different ways.
fn strong() -> Dispersion {
    Dispersion::from_abbe_number(1.5, 4.0)
}

#[test]
fn grey_scenes_look_as_they_do_in_primaries() {
    let scene = lamp_over_sphere([1, 1]);
    let [spectral, rgb] = [by_wavelength, settings]
        .map(|settings| estimate(&scene, settings(None, Strategy::Mis), 60_000));
    assert_equal(spectral, rgb);
}

#[test]
fn a_colour_that_is_lit_once_is_the_same_by_wavelength() {
    let mut sketch = Sketch::default();
    let reflectance = sketch.textures.constant(Rgb::new(0.8, 0.2, 0.1));
    let red = sketch.material(Material::Diffuse { reflectance });
    sketch.shape(rectangle(DVec3::ZERO, [9.0, 9.0], DVec3::Z), red);
    sketch.sky(1.0);
    let scene = sketch.point_seen(DVec3::new(0.0, -4.0, 2.0), DVec3::ZERO);
    estimate(&scene, by_wavelength(Some(2), Strategy::Mis), 60_000).assert_is(0.8);
}

#[test]
fn glass_that_parts_colours_is_invisible_under_an_even_sky() {
    let scene = ball(strong(), None, |sketch| sketch.sky(1.0));
    let settings = || settings(None, Strategy::Mis);
    let renderer = Renderer::new(&scene, settings()).expect("a thread");
    assert_eq!(renderer.configuration, Configuration::Spectral);
    estimate(&scene, settings(), 200_000).assert_is(1.0);
}

#[test]
fn what_disperses_nothing_is_plain_glass_to_the_bit() {
    let same = Dispersion::Constant(1.5);
    let lit = |sketch: &mut Sketch| sketch.sky(1.0);
    let dispersive = ball(same, None, lit);
    let mut sketch = Sketch::default();
    let plain = sketch.glass();
    sketch.shape(sphere(DVec3::ZERO, 1.0), plain);
    sketch.sky(1.0);
    let plain = sketch.point_seen(DVec3::new(0.0, -4.0, 1.0), DVec3::new(0.2, 0.0, 0.3));
    let [a, b] = [&dispersive, &plain].map(|scene| {
        let settings = by_wavelength(None, Strategy::Mis);
        let renderer = Renderer::new(scene, settings).expect("a thread");
        (0..200).map(|i| renderer.sample([0, 0], i)).collect::<Vec<_>>()
    });
    assert_eq!(a, b);
}

#[test]
fn all_strategies_agree_on_rough_glass_that_parts_colours() {
    let lit = |sketch: &mut Sketch| {
        let black = sketch.grey(0.0);
        sketch.sky(0.2);
        let behind = DVec3::new(0.0, 3.0, -1.0);
        sketch.emitter(rectangle(behind, [1.5, 1.5], DVec3::new(0.0, -1.0, 0.5)), black, 5.0);
    };
    let scene = ball(strong(), Some(0.25), lit);
    let [mis, light, bsdf] = [Strategy::Mis, Strategy::LightOnly, Strategy::BsdfOnly]
        .map(|strategy| estimate(&scene, settings(Some(6), strategy), 200_000));
    assert_equal(mis, light);
    assert_equal(mis, bsdf);
}

#[test]
fn the_leading_wavelength_and_an_even_choice_agree() {
    // Behind a mask that hides nothing, nobody knows which wavelength leads.
    let lit = |sketch: &mut Sketch| {
        let black = sketch.grey(0.0);
        sketch.sky(0.2);
        sketch.emitter(rectangle(DVec3::new(0.0, 3.0, -1.0), [1.5, 1.5], -DVec3::Y), black, 5.0);
    };
    for alpha in [None, Some(0.3)] {
        let led = ball(strong(), alpha, lit);
        let mut sketch = Sketch::default();
        let glass = sketch.interface(Some(strong()), alpha);
        let glass = sketch.material(glass);
        let zero = sketch.textures.constant(Color::black());
        let blended = sketch.material(Material::Blend { weight: zero, parts: [glass, glass] });
        sketch.shape(sphere(DVec3::ZERO, 1.0), blended);
        lit(&mut sketch);
        let even = sketch.point_seen(DVec3::new(0.0, -4.0, 1.0), DVec3::new(0.2, 0.0, 0.3));
        let [led, even] =
            [led, even].map(|scene| estimate(&scene, settings(Some(5), Strategy::Mis), 200_000));
        assert_equal(led, even);
    }
}

#[test]
fn a_slab_lets_each_wavelength_through_as_its_own_extinction_says() {
    let mut sketch = Sketch::default();
    let samples = Vec::from([(360.0, 2.0), (560.0, 0.2), (830.0, 1.5)]);
    let curve = Curve::new(samples.clone());
    let medium = sketch.medium(Medium {
        extinction: Extinction::Homogeneous(Rgb::new(1.0, 0.3, 1.0)),
        albedo: Volume::constant(Color::black()),
        phase: Phase::Isotropic,
        curves: MediumCurves { extinction: Some(curve), albedo: None },
        samples_lights: true,
    });
    let nothing = sketch.material(Material::Null);
    // Seen through its middle: two units of length.
    sketch.filled(sphere(DVec3::ZERO, 1.0), nothing, medium);
    sketch.sky(1.0);
    let scene = sketch.point_seen(DVec3::new(0.0, -4.0, 0.0), DVec3::ZERO);
    let mut settings = by_wavelength(None, Strategy::Mis);
    settings.path.volumes = true;
    // What the law of Beer and Lambert leaves of daylight, over all wavelengths.
    let expected = (0..20_000_u16).map(|i| {
        let channels = Wavelengths::of_number((f32::from(i) + 0.5) / 20_000.0);
        let curve = Curve::new(samples.clone());
        let sigma = channels.curve(&curve, Color::black());
        let left = channels.light(Color::white()) * sigma.map(|sigma| Real::exp(-2.0 * sigma));
        f64::from(channels.seen(left).r) / 20_000.0
    });
    estimate(&scene, settings, 200_000).assert_is(expected.sum());
}

#[test]
fn a_medium_that_absorbs_nothing_is_invisible_in_glass_that_parts_colours() {
    let mut sketch = Sketch::default();
    let medium = sketch.medium(Medium {
        extinction: Extinction::Homogeneous(Rgb::new(0.5, 1.0, 3.0)),
        albedo: Volume::constant(Color::white()),
        phase: Phase::Isotropic,
        curves: MediumCurves::default(),
        samples_lights: true,
    });
    let glass = sketch.interface(Some(Dispersion::from_abbe_number(1.5, 20.0)), None);
    let glass = sketch.material(glass);
    sketch.filled(sphere(DVec3::ZERO, 1.0), glass, medium);
    sketch.sky(1.0);
    let scene = sketch.point_seen(DVec3::new(0.0, -4.0, 1.0), DVec3::new(0.2, 0.0, 0.3));
    let mut settings = settings(None, Strategy::Mis);
    settings.path.volumes = true;
    estimate(&scene, settings, 200_000).assert_is(1.0);
}
