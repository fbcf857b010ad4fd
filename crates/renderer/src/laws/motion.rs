//! What moves while the shutter is open is seen in all its places.

use core::sync::atomic::AtomicBool;

use etendue_math::glam::DVec3;
use etendue_math::{Real, Spectrum};
use etendue_sampling::{Decision, Dimension, Independent, Sampler};
use etendue_scene::geometry::{Animation, Motion, Placement, Shape, Shutter, Transform};
use etendue_scene::material::Material;
use etendue_scene::medium::{Extinction, Medium, MediumCurves, Phase, Volume};
use etendue_scene::scene::SamplerKind;
use etendue_scene::{Color, Scene};

use super::scenes::{Estimate, Sketch, estimate, rectangle, settings, sphere};
use crate::{RenderSettings, Renderer, Strategy};

const ORIGIN: DVec3 = DVec3::ZERO;

fn shift(by: DVec3) -> Transform {
    Transform::translate(by).expect("a translation")
}

fn turn(axis: DVec3, degrees: f64) -> Transform {
    Transform::rotate(axis, degrees).expect("a rotation")
}

/// From one placement to another over the whole exposure.
fn motion(start: &Transform, end: &Transform) -> Motion {
    let animation = Animation::new(vec![(0.0, *start), (1.0, *end)]).expect("keyframes");
    let exposure = Shutter::new(0.0, 1.0).expect("a shutter");
    match animation.during(exposure) {
        Placement::Moving(motion) => motion,
        Placement::Still(_) => panic!("it moves"),
    }
}

fn put(scene: &mut Sketch, albedo: f32, shape: Shape) {
    let material = scene.grey(albedo);
    scene.shape(shape, material);
}

/// What moves in a test: the shape, and where it is at a share of the exposure, in closed form.
#[derive(Clone, Copy)]
struct Mover {
    shape: fn() -> Shape,
    at: fn(f64) -> Transform,
}

impl Mover {
    /// On its way, or as good as standing where it is at a time: by the same code, so that samples can be compared one
    /// by one.
    fn motion(&self, time: Option<f64>) -> Motion {
        match time {
            None => motion(&(self.at)(0.0), &(self.at)(1.0)),
            Some(time) => motion(&(self.at)(time), &(self.at)(time + 1e-12)),
        }
    }
}

const BALL: Mover = Mover { shape: || sphere(ORIGIN, 0.4), at: flight };
const BOARD: Mover = Mover { shape: || rectangle(ORIGIN, [0.7, 0.4], DVec3::Z), at: spin };

/// On a straight line.
fn flight(time: f64) -> Transform {
    shift(DVec3::new(-0.6, 0.0, 0.9).lerp(DVec3::new(0.7, 0.3, 0.6), time))
}

/// About an oblique axis, in place.
fn spin(time: f64) -> Transform {
    let place = shift(DVec3::new(0.0, 0.1, 0.8));
    place.compose(&turn(DVec3::new(1.0, 0.3, 0.2), 100.0 * time)).expect("a rotation")
}

/// A floor under a lamp with something above.
fn stage(mover: Mover, time: Option<f64>) -> Scene {
    let mut sketch = Sketch::default();
    let (grey, black) = (sketch.grey(0.7), sketch.grey(0.0));
    sketch.shape(rectangle(ORIGIN, [4.0, 4.0], DVec3::Z), grey);
    sketch.emitter(rectangle(DVec3::new(0.5, 0.5, 3.0), [0.5, 0.5], -DVec3::Z), black, 10.0);
    sketch.sky(0.3);
    sketch.moving((mover.shape)(), grey, mover.motion(time));
    sketch.seen(DVec3::new(0.0, -4.0, 2.0), DVec3::new(0.0, 0.0, 0.5), 50.0, [24, 16])
}

fn paths() -> RenderSettings {
    settings(Some(4), Strategy::Mis)
}

fn time_of(settings: &RenderSettings, pixel: [u32; 2], sample: u64) -> f32 {
    let points = Independent::at(settings.seed, pixel, sample);
    points.sample_1d(Dimension::camera(Decision::Time))
}

/// Asserts that samples of a scene are those of the scene at the time of each, whose other numbers are the same.
fn assert_samples_belong_to_their_times(moving: &Scene, at: impl Fn(f64) -> Scene) {
    let renderer = Renderer::new(moving, paths()).expect("a thread");
    let [width, height] = moving.film.size;
    let (mut compared, mut different) = (0, 0);
    for pixel in (0..height).flat_map(|y| (0..width).map(move |x| [x, y])) {
        for sample in 0..2 {
            let scene = at(f64::from(time_of(&paths(), pixel, sample)));
            let still = Renderer::new(&scene, paths()).expect("a thread");
            let [a, b] = [&renderer, &still].map(|renderer| renderer.sample(pixel, sample));
            compared += 1;
            // Rounding of a placement, along paths of a few edges; what is on the other side of a silhouette differs.
            different += usize::from((a.g - b.g).abs() > 1e-3 * (a.g.abs() + b.g.abs()));
        }
    }
    assert!(different * 100 < compared, "{different} of {compared}");
}

#[test]
fn every_sample_is_one_of_the_scene_at_its_time() {
    for mover in [BALL, BOARD] {
        assert_samples_belong_to_their_times(&stage(mover, None), |time| stage(mover, Some(time)));
    }
}

/// Fog in a ball.
fn fog(time: Option<f64>) -> Scene {
    let mut sketch = Sketch::default();
    let medium = |sigma| Medium {
        extinction: Extinction::Homogeneous(Color::splat(sigma)),
        albedo: Volume::constant(Color::splat(0.8)),
        phase: Phase::Isotropic,
        curves: MediumCurves::default(),
        samples_lights: true,
    };
    let thick = sketch.medium(medium(3.0));
    let nothing = sketch.material(Material::Null);
    sketch.moving(sphere(ORIGIN, 0.5), nothing, BALL.motion(time));
    sketch.fill(thick);
    put(&mut sketch, 0.5, rectangle(ORIGIN, [4.0, 4.0], DVec3::Z));
    sketch.sky(1.0);
    sketch.seen(DVec3::new(0.0, -4.0, 2.0), DVec3::new(0.0, 0.0, 0.5), 50.0, [24, 16])
}

#[test]
fn media_move_with_the_shapes_that_bound_them() {
    let volumes = |mut scene: Scene| {
        scene.path.volumes = true;
        scene
    };
    assert_samples_belong_to_their_times(&volumes(fog(None)), |time| volumes(fog(Some(time))));
}

#[test]
fn a_picture_of_what_moves_is_the_mean_of_pictures_at_all_times() {
    const TIMES: u32 = 64;
    for mover in [BALL, BOARD] {
        let mut sums = [[0.0_f64; 2]; 6];
        let pixels = [[6, 5], [9, 8], [12, 8], [15, 7], [13, 11], [17, 5]];
        let samples = |scene: &Scene, pixel: [u32; 2], n: u32| {
            let renderer = Renderer::new(scene, paths()).expect("a thread");
            let (mut sum, mut squares) = (0.0, 0.0);
            for i in 0..u64::from(n) {
                let x = f64::from(renderer.sample(pixel, i).g);
                sum += x;
                squares += x * x;
            }
            let mean = sum / f64::from(n);
            (mean, (squares / f64::from(n) - mean * mean) / f64::from(n))
        };
        for i in 0..TIMES {
            let scene = stage(mover, Some((f64::from(i) + 0.5) / f64::from(TIMES)));
            for (sum, pixel) in sums.iter_mut().zip(pixels) {
                let (mean, variance) = samples(&scene, pixel, 64);
                sum[0] += mean / f64::from(TIMES);
                sum[1] += variance / f64::from(TIMES * TIMES);
            }
        }
        let moving = stage(mover, None);
        for ([expected, variance], pixel) in sums.into_iter().zip(pixels) {
            let (mean, own) = samples(&moving, pixel, 4096);
            let error = (own + variance).sqrt();
            // Four standard errors, and two edges that the midpoints of 64 times place half a step wrong, 1/64 of the
            // brightest there is nearby.
            let allowed = 4.0 * error + mean.max(1.0) / 64.0;
            assert!((mean - expected).abs() < allowed, "{pixel:?} {mean} {expected} {error}");
        }
    }
}

/// One pixel that sees a point of the plane z = 0.
fn seen_from_above(sketch: Sketch, x: f64) -> Scene {
    sketch.point_seen(DVec3::new(x, 0.0, 5.0), DVec3::new(x, 0.0, 0.0))
}

/// The mean of 1024 samples whose times are stratified.
fn stratified(scene: &Scene) -> f64 {
    let settings =
        RenderSettings { sampler: SamplerKind::Sobol, ..settings(Some(2), Strategy::Mis) };
    let Estimate { mean, .. } = estimate(scene, settings, 1024);
    mean
}

#[test]
fn a_board_that_passes_covers_a_point_for_its_share_of_the_exposure() {
    // A black board from −1/2 to 1/2 that moves by 2: a trapezoid with sides of length 1 and a top of length 1.
    for (x, covered) in [
        (-0.6, 0.0),
        (-0.4, 0.05),
        (0.0, 0.25),
        (0.3, 0.4),
        (0.6, 0.5),
        (1.4, 0.5),
        (1.9, 0.3),
        (2.4, 0.05),
        (2.6, 0.0),
    ] {
        let mut sketch = Sketch::default();
        sketch.sky(1.0);
        let black = sketch.grey(0.0);
        let board = rectangle(ORIGIN, [0.5, 0.5], DVec3::Z);
        sketch.moving(board, black, motion(&shift(ORIGIN), &shift(DVec3::X * 2.0)));
        let mean = stratified(&seen_from_above(sketch, x));
        // 1024 strata of which the ends of the interval cut two; the pixel is 10⁻⁴ wide.
        assert!((mean - (1.0 - covered)).abs() < 2.0 / 1024.0 + 1e-4, "{x}: {mean}");
    }
}

#[test]
fn a_camera_that_turns_sees_a_board_for_its_share_of_the_angle() {
    // A black board from −10° to 20° about the axis of a camera that turns from −25° to 75°.
    let mut sketch = Sketch::default();
    sketch.sky(1.0);
    let black = sketch.grey(0.0);
    let [left, right] = [-10.0_f64, 20.0].map(|degrees| 5.0 * Real::tan(degrees.to_radians()));
    let centre = DVec3::new(0.0, 0.5 * (left + right), -5.0);
    sketch.shape(rectangle(centre, [0.5 * (right - left), 2.0], DVec3::Z), black);
    let mut scene = sketch.point_seen(ORIGIN, -DVec3::Z);
    let view = Transform::look_at(ORIGIN, -DVec3::Z, DVec3::X).expect("a view");
    // Turning about +x takes −z to +y.
    let seen = |degrees| turn(DVec3::X, degrees).compose(&view).expect("a view");
    scene.camera = scene.camera.moving(motion(&seen(-25.0), &seen(75.0))).expect("a camera");
    let mean = stratified(&scene);
    // As above; an edge is a strip of 10⁻³ of the angle less than 10⁻³ ° wide.
    assert!((mean - 0.7).abs() < 2.0 / 1024.0 + 1e-4, "{mean}");
}

#[test]
fn features_are_those_of_the_time_of_the_sample() {
    // A camera that rises from 2 to 4 above a floor.
    let mut sketch = Sketch::default();
    put(&mut sketch, 0.5, rectangle(ORIGIN, [9.0, 9.0], DVec3::Z));
    let mut scene = sketch.point_seen(DVec3::Z * 2.0, ORIGIN);
    let above = |z: f64| Transform::look_at(DVec3::Z * z, ORIGIN, DVec3::X).expect("a view");
    scene.camera = scene.camera.moving(motion(&above(2.0), &above(4.0))).expect("a camera");
    let sobol = RenderSettings { sampler: SamplerKind::Sobol, ..paths() };
    let renderer = Renderer::new(&scene, sobol).expect("a thread");
    let features = renderer.features(256, &AtomicBool::new(false));
    // A stratum of 256 is 2/256 of depth; their midpoints are off by half of that at the most.
    assert!((features[0].depth - 3.0).abs() < 1.0 / 256.0, "{}", features[0].depth);
}

#[test]
fn pictures_of_what_moves_have_the_same_bits_for_any_number_of_threads() {
    let scene = stage(BALL, None);
    for sampler in [SamplerKind::Independent, SamplerKind::Sobol] {
        let render = |threads| {
            let settings = RenderSettings { threads, sampler, samples_per_pixel: 5, ..paths() };
            let renderer = Renderer::new(&scene, settings).expect("threads");
            renderer.render(&|_| (), &AtomicBool::new(false))
        };
        let one = render(1);
        assert!(one.image.mean().g > 0.1);
        for threads in [2, 7] {
            assert_eq!(one, render(threads));
        }
    }
}
