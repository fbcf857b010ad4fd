//! Participating media against closed forms, quadrature and each other.

use core::sync::atomic::AtomicBool;

use etendue_math::glam::{DVec3, Vec3};
use etendue_math::quadrature::Adaptive;
use etendue_math::{Real, Spectrum};
use etendue_sampling::warp::henyey_greenstein::HenyeyGreenstein;
use etendue_scene::camera::{FieldOfView, FovAxis};
use etendue_scene::geometry::{Shape, Transform, TriangleMesh};
use etendue_scene::light::{Light, PointLight, ProjectorLight, SpotLight};
use etendue_scene::material::Material;
use etendue_scene::medium::{
    BlendPhase, Density, Extinction, GridFilter, Medium, MediumCurves, Phase, TabulatedPhase,
    Volume, VolumeGrid,
};
use etendue_scene::texture::Wrap;
use etendue_scene::{Color, Scene};

use super::scenes::{Estimate, Sketch, estimate, rectangle, settings, sphere};
use crate::{Airlight, RenderSettings, Renderer, Strategy};

/// Three extinctions, the first of which is that of the channel that estimates are of.
const COLOURED: [[f32; 3]; 3] = [[0.5, 1.0, 3.0], [3.0, 0.5, 1.0], [1.0, 0.0, 0.2]];

fn forwards(g: f32) -> Phase {
    Phase::HenyeyGreenstein(HenyeyGreenstein::new(g).expect("in (−1, 1)"))
}

/// Mostly sideways, a little backwards.
fn steps() -> Phase {
    Phase::Tabulated(TabulatedPhase::new(&[0.5, 0.0, 3.0, 2.0, 0.0, 0.0]).expect("a table"))
}

/// Forwards on one side of x = 0, by the table on the other.
fn half_and_half() -> Phase {
    let grid = VolumeGrid::new([2, 1, 1], 1, [0.2, 0.9].into()).expect("two cells");
    let size = Transform::scale(DVec3::splat(4.0)).expect("a size");
    let to_world = Transform::translate(DVec3::splat(-2.0)).and_then(|t| t.compose(&size));
    let to_world = to_world.expect("regular");
    let weight = Volume::grid(grid, to_world, GridFilter::Trilinear, Wrap::Clamp);
    Phase::Blend(Box::new(BlendPhase { weight, parts: [forwards(0.7), steps()] }))
}

fn homogeneous(sigma: [f32; 3], albedo: f32, phase: Phase) -> Medium {
    Medium {
        extinction: Extinction::Homogeneous(sigma.into()),
        albedo: Volume::constant(Color::splat(albedo)),
        phase,
        curves: MediumCurves::default(),
        samples_lights: true,
    }
}

/// Cells over [−2, 2]³: `value` of each, times `sigma`.
fn grid(sigma: [f32; 3], albedo: f32, phase: Phase, value: impl Fn(u32) -> f32) -> Medium {
    let values = (0..64).flat_map(|i| sigma.map(|sigma| sigma * value(i))).collect();
    let grid = VolumeGrid::new([4, 4, 4], 3, values).expect("cells");
    let size = Transform::scale(DVec3::splat(4.0)).expect("a size");
    let to_world = Transform::translate(DVec3::splat(-2.0)).and_then(|t| t.compose(&size));
    let volume = Volume::grid(grid, to_world.expect("regular"), GridFilter::Trilinear, Wrap::Clamp);
    let density = Density::new(volume, 1.0).expect("thin enough");
    Medium {
        extinction: Extinction::Heterogeneous(Box::new(density)),
        ..homogeneous(sigma, albedo, phase)
    }
}

/// A medium of the same density everywhere, in both forms.
fn both_forms(sigma: [f32; 3], albedo: f32, phase: Phase) -> [Medium; 2] {
    [homogeneous(sigma, albedo, phase.clone()), grid(sigma, albedo, phase, |_| 1.0)]
}

/// From nothing to twice the mean.
fn speckled(cell: u32) -> f32 {
    (etendue_math::hash_u32(cell) % 3) as f32
}

fn through_media(max_depth: Option<u32>, strategy: Strategy) -> RenderSettings {
    let mut settings = settings(max_depth, strategy);
    settings.path.volumes = true;
    settings
}

fn cube(half: f64) -> Shape {
    let size = Transform::scale(DVec3::splat(half)).expect("a size");
    Shape::Mesh(TriangleMesh::cube(&size).expect("a cube"))
}

/// A ball of a medium, seen through its middle.
fn ball(medium: Medium, world: impl FnOnce(&mut Sketch)) -> Scene {
    let mut sketch = Sketch::default();
    let medium = sketch.medium(medium);
    let nothing = sketch.material(Material::Null);
    sketch.filled(sphere(DVec3::ZERO, 1.0), nothing, medium);
    world(&mut sketch);
    sketch.point_seen(DVec3::new(0.0, -4.0, 0.0), DVec3::ZERO)
}

fn assert_equal(a: Estimate, b: Estimate) {
    // 4 standard deviations of the difference.
    let error = (a.error * a.error + b.error * b.error).sqrt();
    assert!((a.mean - b.mean).abs() < 4.0 * error, "{a:?} {b:?}");
    assert!(error < 0.02 * a.mean, "too noisy to tell: {a:?} {b:?}");
}

#[test]
fn every_path_through_a_grey_medium_that_absorbs_nothing_brings_back_exactly_the_sky() {
    for medium in both_forms([2.0; 3], 1.0, forwards(0.6)) {
        let scene = ball(medium, |sketch| sketch.sky(1.0));
        let mut settings = through_media(None, Strategy::BsdfOnly);
        settings.path.roulette_depth = u32::MAX;
        let renderer = Renderer::new(&scene, settings).expect("a thread");
        for i in 0..1000 {
            assert_eq!(renderer.sample([0, 0], i), Color::white());
        }
    }
}

#[test]
fn media_that_absorb_nothing_are_invisible_in_even_light() {
    let albedo = 1.0;
    for sigma in COLOURED {
        let media = [
            homogeneous(sigma, albedo, Phase::Isotropic),
            grid(sigma, albedo, forwards(-0.5), speckled),
            homogeneous(sigma, albedo, Phase::Rayleigh),
            homogeneous(sigma, albedo, steps()),
            homogeneous(sigma, albedo, half_and_half()),
        ];
        for medium in media {
            let scene = ball(medium, |sketch| sketch.sky(1.0));
            for strategy in [Strategy::Mis, Strategy::LightOnly, Strategy::BsdfOnly] {
                estimate(&scene, through_media(None, strategy), 40_000).assert_is(1.0);
            }
        }
    }
}

#[test]
fn a_medium_behind_glass_is_invisible_in_even_light() {
    let mut sketch = Sketch::default();
    let glass = sketch.glass();
    let milk = Medium { samples_lights: false, ..homogeneous([3.0; 3], 1.0, forwards(0.3)) };
    let medium = sketch.medium(milk);
    sketch.filled(sphere(DVec3::ZERO, 1.0), glass, medium);
    sketch.sky(1.0);
    let scene = sketch.point_seen(DVec3::new(0.0, -4.0, 0.3), DVec3::new(0.0, 0.0, 0.3));
    estimate(&scene, through_media(None, Strategy::Mis), 20_000).assert_is(1.0);
}

#[test]
fn what_shines_through_an_absorbing_medium_follows_beer_and_lambert() {
    // Half as dense, since what is seen of a medium by chance is noise.
    for sigma in COLOURED.map(|sigma| sigma.map(|sigma| 0.5 * sigma)) {
        for medium in both_forms(sigma, 0.0, Phase::Isotropic) {
            let scene = ball(medium, |sketch| sketch.sky(3.0));
            // Through the middle of the unit ball.
            let expected = 3.0 * Real::exp(-2.0 * f64::from(sigma[0]));
            estimate(&scene, through_media(None, Strategy::Mis), 400_000).assert_is(expected);
        }
    }
}

#[test]
fn shadow_rays_follow_beer_and_lambert_through_several_boundaries() {
    for sigma in COLOURED {
        for medium in both_forms(sigma, 0.0, Phase::Isotropic) {
            let mut sketch = Sketch::default();
            let (grey, nothing) = (sketch.grey(0.5), sketch.material(Material::Null));
            let medium = sketch.medium(medium);
            // A hollow cube: its walls are 0.5 thick, and the hollow is empty.
            sketch.filled(cube(1.0), nothing, medium);
            sketch.filled(cube(0.5).flipped(), nothing, medium);
            sketch.shape(rectangle(DVec3::new(0.0, 0.0, -2.0), [5.0, 5.0], DVec3::Z), grey);
            let (position, intensity) = (Vec3::new(0.0, 0.0, 2.0), Color::splat(16.0));
            sketch.light(Light::Point(PointLight { position, intensity }));
            let scene = sketch.point_seen(DVec3::new(0.0, -6.0, -1.0), DVec3::new(0.0, 0.0, -2.0));
            let expected = 0.5 * f64::FRAC_1_PI * Real::exp(-f64::from(sigma[0]));
            let found = estimate(&scene, through_media(Some(2), Strategy::Mis), 100_000);
            // Segments begin beyond each of four walls by a bound of the error of positions, about
            // 1e-6 each: 1e-5 of an optical thickness of 3.
            let allowed = 4.0 * found.error + 3e-5 * expected;
            assert!((found.mean - expected).abs() < allowed, "{found:?}, expected {expected}");
            assert!(found.error < 0.02 * expected, "too noisy to tell: {found:?}");
        }
    }
}

#[test]
fn light_scattered_once_from_a_point_is_that_of_quadrature() {
    let (eye, light) = (DVec3::new(0.0, -1.5, 0.0), DVec3::new(0.4, 0.3, 0.5));
    let intensity = 5.0;
    for (sigma, g) in [([0.8, 0.8, 0.8], 0.0), ([0.5, 1.0, 3.0], 0.6), ([1.0, 0.0, 0.2], -0.4)] {
        let phase = if g == 0.0 { Phase::Isotropic } else { forwards(g) };
        let mut sketch = Sketch::default();
        let medium = sketch.medium(homogeneous(sigma, 0.7, phase));
        sketch.media.around_camera = Some(medium);
        let (position, color) = (light.as_vec3(), Color::splat(intensity));
        sketch.light(Light::Point(PointLight { position, intensity: color }));
        let scene = sketch.point_seen(eye, DVec3::new(0.0, 1.0, 0.0));
        let (sigma, g) = (f64::from(sigma[0]), f64::from(g));
        let scattered = |s: f64| {
            let to_light = light - (eye + DVec3::Y * s);
            let d = to_light.length();
            let q = 1.0 + g * g - 2.0 * g * to_light.y / d;
            let phase = (1.0 - g * g) / (4.0 * f64::PI * q * Real::sqrt(q));
            0.7 * sigma * phase * Real::exp(-sigma * (s + d)) * f64::from(intensity) / (d * d)
        };
        // Beyond 60 mean free paths nothing is left.
        let rule = Adaptive::<f64, 10>::new(40);
        let expected = rule.integrate([0.0, 120.0], 1e-12, &mut { scattered });
        let [combined, transmittance] = both_airlights(&scene, Some(2), 200_000);
        combined.assert_is(expected);
        transmittance.assert_is(expected);
        // What is drawn about the light does not know the transmittance, nor the phase function: 1.5 mean free paths away
        // both are noise as well.
        assert!(combined.error < transmittance.error, "{combined:?} {transmittance:?}");
    }
}

/// Light of points looked for everywhere, and at collisions only.
fn both_airlights(scene: &Scene, max_depth: Option<u32>, samples: u32) -> [Estimate; 2] {
    [Airlight::Combined, Airlight::Transmittance].map(|airlight| {
        let settings = RenderSettings { airlight, ..through_media(max_depth, Strategy::Mis) };
        estimate(scene, settings, samples)
    })
}

#[test]
fn a_point_in_view_is_next_to_no_noise() {
    let (eye, light) = (DVec3::new(0.0, -2.0, 0.0), DVec3::new(0.002, 0.0, 0.0));
    let mut sketch = Sketch::default();
    let medium = sketch.medium(homogeneous([0.1; 3], 0.7, Phase::Isotropic));
    sketch.media.around_camera = Some(medium);
    let (position, intensity) = (light.as_vec3(), Color::splat(1.0));
    sketch.light(Light::Point(PointLight { position, intensity }));
    let scene = sketch.point_seen(eye, DVec3::new(0.0, 1.0, 0.0));
    let [combined, transmittance] = both_airlights(&scene, Some(2), 20_000);
    let scattered = |s: f64| {
        let d = light.distance(eye + DVec3::Y * s);
        0.7 * 0.1 * 0.25 * f64::FRAC_1_PI * Real::exp(-0.1 * (s + d)) / (d * d)
    };
    let rule = Adaptive::<f64, 10>::new(60);
    let pieces = [[0.0, 1.9], [1.9, 2.0], [2.0, 2.1], [2.1, 500.0]];
    let expected = pieces.map(|piece| rule.integrate(piece, 1e-12, &mut { scattered }));
    combined.assert_is(expected.iter().sum());
    // Every distance contributes almost the same; of collisions one in a thousand is next to the light.
    assert!(combined.error < 0.01 * transmittance.error, "{combined:?} {transmittance:?}");
}

#[test]
fn light_of_points_is_the_same_wherever_it_is_looked_for() {
    let view = Transform::look_at(DVec3::new(0.2, 0.1, 0.8), DVec3::new(0.0, 0.0, -1.0), DVec3::Y);
    let view = view.expect("a direction");
    let across = FieldOfView::Angle { degrees: 50.0, axis: FovAxis::X };
    for (sigma, phase, hides_emitters) in [
        ([0.7, 0.7, 0.7], Phase::Isotropic, false),
        ([0.3, 1.0, 2.0], forwards(0.5), false),
        ([1.0, 0.0, 0.2], Phase::Rayleigh, true),
    ] {
        let mut sketch = Sketch::default();
        let (grey, black) = (sketch.grey(0.6), sketch.grey(0.0));
        let (nothing, glass) = (sketch.material(Material::Null), sketch.glass());
        let medium = sketch.medium(homogeneous(sigma, 0.8, phase));
        sketch.filled(cube(1.0), nothing, medium);
        sketch.filled(sphere(DVec3::new(0.5, 0.2, -0.4), 0.3), glass, medium);
        sketch.shape(rectangle(DVec3::new(0.0, 0.0, -1.2), [3.0, 3.0], DVec3::Z), grey);
        // In the camera's view where it is looked through.
        let lamp = DVec3::new(if hides_emitters { 0.0 } else { 0.9 }, -1.5, 0.2);
        sketch.emitter(rectangle(lamp, [0.2, 0.2], DVec3::Y), black, 4.0);
        let (two, picture) = (Color::splat(2.0), sketch.textures.constant(Color::splat(0.5)));
        let (position, intensity) = (Vec3::new(-0.3, 0.2, 0.1), Color::splat(0.5));
        sketch.light(Light::Point(PointLight { position, intensity }));
        let spot = SpotLight::new(view, two, None, 30.0, 20.0).expect("a spot light");
        sketch.light(Light::Spot(spot));
        let projector = ProjectorLight::new(view, picture, 1.0, across, [1, 1]);
        sketch.light(Light::Projector(projector.expect("a projector")));
        let scene = sketch.point_seen(DVec3::new(0.0, -4.0, 0.4), DVec3::new(0.0, 0.0, 0.1));
        let [combined, transmittance] =
            [Airlight::Combined, Airlight::Transmittance].map(|airlight| {
                let mut settings =
                    RenderSettings { airlight, ..through_media(Some(6), Strategy::Mis) };
                settings.path.hide_emitters = hides_emitters;
                estimate(&scene, settings, 400_000)
            });
        assert_equal(combined, transmittance);
    }
}

/// A speckled or even block with a lamp inside, above a floor; forwards scattering.
fn lamp_in_a_block(medium: Medium) -> Scene {
    let mut sketch = Sketch::default();
    let (grey, black) = (sketch.grey(0.6), sketch.grey(0.0));
    let nothing = sketch.material(Material::Null);
    let medium = sketch.medium(medium);
    sketch.filled(cube(1.0), nothing, medium);
    sketch.shape(rectangle(DVec3::new(0.0, 0.0, -1.2), [3.0, 3.0], DVec3::Z), grey);
    sketch.emitter(rectangle(DVec3::new(0.3, 0.0, 0.6), [0.3, 0.3], -DVec3::Z), black, 8.0);
    sketch.sky(0.2);
    sketch.point_seen(DVec3::new(0.0, -4.0, 0.4), DVec3::new(0.0, 0.0, -0.3))
}

#[test]
fn a_constant_grid_looks_like_a_homogeneous_medium() {
    for sigma in COLOURED {
        let [a, b] = both_forms(sigma, 0.8, forwards(0.4)).map(|medium| {
            estimate(&lamp_in_a_block(medium), through_media(Some(8), Strategy::Mis), 100_000)
        });
        assert_equal(a, b);
    }
}

#[test]
fn all_strategies_agree_in_media() {
    let phases: [fn() -> Phase; 3] = [|| forwards(0.5), || Phase::Rayleigh, half_and_half];
    for phase in phases {
        let run = |strategy| {
            let medium = grid([1.0, 0.7, 0.5], 0.8, phase(), speckled);
            estimate(&lamp_in_a_block(medium), through_media(Some(6), strategy), 300_000)
        };
        let mis = run(Strategy::Mis);
        for strategy in [Strategy::BsdfOnly, Strategy::LightOnly] {
            assert_equal(mis, run(strategy));
        }
    }
}

#[test]
fn light_passes_masks_and_panes_straight_on_without_a_vertex() {
    let mut sketch = Sketch::default();
    let (grey, black) = (sketch.grey(0.5), sketch.grey(0.0));
    let quarter = sketch.textures.constant(Color::splat(0.25));
    let mask = sketch.material(Material::Mask { opacity: quarter, nested: black });
    let nothing = sketch.material(Material::Null);
    let floor = DVec3::new(0.0, 0.0, -2.0);
    sketch.shape(rectangle(floor, [5.0, 5.0], DVec3::Z), grey);
    sketch.shape(rectangle(DVec3::ZERO, [5.0, 5.0], DVec3::Z), mask);
    sketch.shape(rectangle(DVec3::new(0.0, 0.0, 0.5), [5.0, 5.0], DVec3::Z), nothing);
    let (position, intensity) = (Vec3::new(0.0, 0.0, 2.0), Color::splat(16.0));
    sketch.light(Light::Point(PointLight { position, intensity }));
    let scene = sketch.point_seen(DVec3::new(0.0, -6.0, 4.0), floor);
    // The camera looks through the mask, too: two edges all the same.
    let expected = 0.75 * 0.75 * 0.5 * f64::FRAC_1_PI;
    estimate(&scene, through_media(Some(2), Strategy::Mis), 20_000).assert_is(expected);
}

#[test]
fn pictures_of_media_have_the_same_bits_for_any_number_of_threads() {
    let mut sketch = Sketch::default();
    let nothing = sketch.material(Material::Null);
    let medium = sketch.medium(grid([1.0, 2.0, 0.5], 0.9, forwards(0.5), speckled));
    sketch.filled(sphere(DVec3::ZERO, 1.0), nothing, medium);
    sketch.sky(1.0);
    let scene = sketch.seen(DVec3::new(0.0, -4.0, 0.0), DVec3::ZERO, 40.0, [40, 30]);
    let render = |threads| {
        let settings =
            RenderSettings { threads, samples_per_pixel: 4, ..through_media(None, Strategy::Mis) };
        let renderer = Renderer::new(&scene, settings).expect("threads");
        renderer.render(&|_| (), &AtomicBool::new(false))
    };
    let one = render(1);
    assert_eq!(one.statistics.non_finite.count(), 0);
    for threads in [2, 7] {
        assert_eq!(one, render(threads));
    }
}
