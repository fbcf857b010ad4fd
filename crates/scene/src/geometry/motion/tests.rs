//! Laws of motions.

use alloc::vec;
use alloc::vec::Vec;

use etendue_math::glam::{DAffine3, DVec3, Vec3};

use super::{Animation, AnimationError, Motion, Placement, Shutter, ShutterError};
use crate::geometry::tests::Random;
use crate::geometry::{Aabb, Transform};

fn shutter(open: f64, close: f64) -> Shutter {
    Shutter::new(open, close).expect("a shutter")
}

/// The motion from one placement to another over the whole exposure.
fn motion(start: &Transform, end: &Transform) -> Motion {
    let animation = Animation::new(vec![(0.0, *start), (1.0, *end)]).expect("an animation");
    match animation.during(shutter(0.0, 1.0)) {
        Placement::Moving(motion) => motion,
        Placement::Still(_) => panic!("it moves"),
    }
}

fn turn(axis: DVec3, degrees: f64) -> Transform {
    Transform::rotate(axis, degrees).expect("a rotation")
}

fn shift(by: DVec3) -> Transform {
    Transform::translate(by).expect("a translation")
}

fn product<const N: usize>(maps: [Transform; N]) -> Transform {
    let both = |a: Transform, b: &Transform| a.compose(b).expect("a regular product");
    maps.iter().fold(Transform::IDENTITY, both)
}

/// Any regular map of determinant of the given sign, with unequal and oblique stretches.
fn random_map(random: &mut Random, mirrored: bool) -> Transform {
    loop {
        let columns = [0; 4].map(|_| random.point().as_dvec3() * 3.0);
        let [x, y, z, b] = columns;
        match Transform::from_affine(DAffine3::from_cols(x, y, z, b)) {
            Ok(map) if map.is_mirrored() == mirrored => return map,
            _ => {}
        }
    }
}

fn distance(a: &Transform, b: &Transform) -> f64 {
    let (a, b) = (a.affine().to_cols_array(), b.affine().to_cols_array());
    a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn a_motion_passes_through_its_keyframes() {
    let mut random = Random(21);
    for i in 0..200 {
        let mirrored = i % 2 == 1;
        let keyframes: Vec<_> =
            (0..4).map(|t| (f64::from(t) * 0.25, random_map(&mut random, mirrored))).collect();
        let animation = Animation::new(keyframes.clone()).expect("an animation");
        let Placement::Moving(motion) = animation.during(shutter(0.0, 0.75)) else { panic!() };
        for (time, map) in &keyframes {
            // The share of the exposure in f32, times a rate of change of some tens.
            let found = motion.at((time / 0.75) as f32);
            assert!(distance(&found, map) < 1e-5, "{i} {time}");
            let Placement::Still(map) = animation.during(shutter(*time, *time)) else { panic!() };
            assert_eq!(map, keyframes.iter().find(|k| k.0 == *time).expect("a keyframe").1);
        }
        assert_eq!(*motion.opening(), keyframes[0].1);
    }
}

#[test]
fn rotations_turn_at_a_constant_rate_by_the_shorter_way() {
    let axis = DVec3::new(1.0, -2.0, 0.5);
    for degrees in [1e-9, 0.1, 45.0, 90.0, 179.9, 179.999] {
        for sign in [1.0, -1.0] {
            let motion = motion(&Transform::IDENTITY, &turn(axis, sign * degrees));
            for u in [0.25_f32, 0.5, 0.875] {
                let expected = turn(axis, sign * degrees * f64::from(u));
                // The quaternion of a matrix has half its digits where the angle is close to 0 or to 180°.
                assert!(distance(&motion.at(u), &expected) < 2e-8, "{degrees} {sign} {u}");
            }
        }
    }
    // 190° is 170° the other way.
    let motion = motion(&Transform::IDENTITY, &turn(axis, 190.0));
    assert!(distance(&motion.at(0.5), &turn(axis, -85.0)) < 1e-12);
}

#[test]
fn half_turns_go_anticlockwise_about_the_axis_with_a_positive_component() {
    for axis in
        [DVec3::X, DVec3::Y, DVec3::Z, DVec3::new(1.0, 1.0, 1.0), DVec3::new(-0.3, 0.9, 0.2)]
    {
        // The sign, and the rounding of what was before, change nothing.
        for degrees in [180.0, -180.0, 180.0 - 1e-10, 180.0 + 1e-10] {
            for before in [Transform::IDENTITY, turn(DVec3::new(0.3, 0.7, -0.4), 123.0)] {
                let after = product([turn(axis, degrees), before]);
                let keyframes = vec![(0.0, before), (1.0, after)];
                let animation = Animation::new(keyframes).expect("an animation");
                assert_eq!(animation.half_turn(), Some(1));
                let expected = product([turn(axis, 90.0), before]);
                let half = motion(&before, &after).at(0.5);
                assert!(distance(&half, &expected) < 1e-9, "{axis} {degrees}");
            }
        }
    }
    let less = Animation::new(vec![(0.0, Transform::IDENTITY), (1.0, turn(DVec3::X, 179.0))]);
    assert_eq!(less.expect("an animation").half_turn(), None);
}

#[test]
fn points_far_from_the_origin_turn_about_the_axis_of_the_file() {
    // About an axis at a distance of 10⁴: the keyframes' translations go straight, the points on an arc about the point
    // that goes with them, as in Mitsuba and pbrt.
    let far = DVec3::new(1e4, 0.0, 0.0);
    let around = |degrees| product([shift(far), turn(DVec3::Z, degrees), shift(-far)]);
    let motion = motion(&around(0.0), &around(60.0));
    let half = motion.at(0.5);
    let (start, end) = (around(0.0).affine().translation, around(60.0).affine().translation);
    let expected = product([shift((start + end) * 0.5), turn(DVec3::Z, 30.0)]);
    // 10⁴ times the rounding of f64.
    assert!(distance(&half, &expected) < 1e-11);
}

#[test]
fn mirrored_keyframes_stay_mirrored_and_regular_on_the_way() {
    let mut random = Random(22);
    for i in 0..300 {
        let mirrored = i % 2 == 1;
        let [a, b] = [0; 2].map(|_| random_map(&mut random, mirrored));
        let motion = motion(&a, &b);
        let least =
            [a, b].map(|m| m.affine().matrix3.determinant().abs()).into_iter().reduce(f64::min);
        for u in 0..=16 {
            let map = motion.at(u as f32 / 16.0);
            assert_eq!(map.is_mirrored(), mirrored, "{i} {u}");
            // Minkowski: the determinant of a mean of definite matrices is no less than the smaller one.
            let det = map.affine().matrix3.determinant().abs();
            assert!(det > least.expect("two") * (1.0 - 1e-6), "{i} {u} {det}");
        }
    }
}

#[test]
fn a_reflected_motion_is_the_motion_of_what_was_reflected() {
    let mut random = Random(24);
    let reflection = Transform::scale(DVec3::splat(-1.0)).expect("a reflection");
    for i in 0..50 {
        let [a, b] = [0; 2].map(|_| random_map(&mut random, i % 2 == 1));
        let (motion, reflected) = (motion(&a, &b), motion(&a, &b).reflected());
        for u in [0.0, 0.3, 1.0] {
            // To the bit: signs are exact.
            let expected = product([motion.at(u), reflection]);
            assert_eq!(reflected.at(u).affine(), expected.affine(), "{i} {u}");
            assert_ne!(reflected.at(u).is_mirrored(), motion.at(u).is_mirrored());
        }
        assert_eq!(reflected.opening().affine(), product([a, reflection]).affine());
    }
}

#[test]
fn boxes_hold_what_moves_at_every_time() {
    let mut random = Random(23);
    for i in 0..400 {
        let count = 2 + i % 3;
        let mut keyframes: Vec<_> =
            (0..count).map(|t| (f64::from(t), random_map(&mut random, i % 5 == 0))).collect();
        if i % 7 == 0 {
            // A pure rotation about a far axis, where the box is all arc.
            let far = shift(random.point().as_dvec3() * 100.0);
            let axis = random.direction().as_dvec3();
            keyframes = vec![(0.0, far), (1.0, product([turn(axis, 179.0), far]))];
        }
        let animation = Animation::new(keyframes.clone()).expect("an animation");
        let end = keyframes.last().expect("some").0;
        let [a, b] = [0; 2].map(|_| f64::from(random.uniform()) * end);
        let exposure = shutter(a.min(b) - 0.1, a.max(b) + 0.1);
        let Placement::Moving(motion) = animation.during(exposure) else { panic!() };
        let of = Aabb::from_points([random.point(), random.point()]);
        let bounds = motion.bounds(&of);
        let mut tight = Aabb::EMPTY;
        for time in 0..=200 {
            let map = motion.at(time as f32 / 200.0);
            for p in of.corners().into_iter().chain((0..4).map(|_| {
                let [x, y, z] = [0; 3].map(|_| random.uniform());
                of.min + of.extent() * Vec3::new(x, y, z)
            })) {
                let p = map.point(p);
                assert!(
                    p.cmpge(bounds.min).all() && p.cmple(bounds.max).all(),
                    "{i} {p} {bounds:?}"
                );
                tight = tight.grow(p);
            }
        }
        // Two percent of the diagonal: the rise of arcs, and what 200 times miss.
        let excess = (bounds.extent() - tight.extent()).max_element();
        assert!(excess < 0.02 * tight.extent().length(), "{i} {excess} {tight:?}");
    }
}

#[test]
fn the_box_of_a_translation_is_that_of_its_ends() {
    let unit = Aabb::from_points([Vec3::ZERO, Vec3::ONE]);
    let bounds = motion(&Transform::IDENTITY, &shift(DVec3::new(3.0, 0.0, -2.0))).bounds(&unit);
    let expected = Aabb { min: Vec3::new(0.0, 0.0, -2.0), max: Vec3::new(4.0, 1.0, 1.0) };
    // Margins for rounding: a few ε of the coordinates.
    assert!((bounds.min - expected.min).abs().max_element() < 1e-5, "{bounds:?}");
    assert!((bounds.max - expected.max).abs().max_element() < 1e-5, "{bounds:?}");
    assert!(motion(&Transform::IDENTITY, &turn(DVec3::X, 10.0)).bounds(&Aabb::EMPTY).is_empty());
}

#[test]
fn what_does_not_change_while_the_shutter_is_open_stands_still() {
    let (a, b) = (turn(DVec3::X, 30.0), shift(DVec3::X));
    let animation =
        Animation::new(vec![(0.0, a), (1.0, a), (2.0, b), (3.0, b)]).expect("keyframes");
    for (open, close, map) in
        [(-2.0, 0.5, a), (0.0, 1.0, a), (2.0, 9.0, b), (5.0, 6.0, b), (1.0, 1.0, a)]
    {
        assert_eq!(animation.during(shutter(open, close)), Placement::Still(map), "{open} {close}");
    }
    // Half way.
    let Placement::Still(half) = animation.during(shutter(1.5, 1.5)) else { panic!() };
    assert!(distance(&half, &product([shift(DVec3::X * 0.5), turn(DVec3::X, 15.0)])) < 1e-12);
    assert!(matches!(animation.during(shutter(1.5, 2.5)), Placement::Moving(_)));
    let Placement::Moving(motion) = animation.during(shutter(0.0, 3.0)) else { panic!() };
    for (time, map) in [(0.1, a), (0.3, a), (0.7, b), (1.0, b), (f32::NAN, a), (-1.0, a), (7.0, b)]
    {
        assert!(distance(&motion.at(time), &map) < 1e-15, "{time}");
    }
}

#[test]
fn keyframes_and_shutters_out_of_order_are_refused() {
    use AnimationError as E;
    let (a, mirror) =
        (Transform::IDENTITY, Transform::scale(DVec3::new(1.0, 1.0, -1.0)).expect("a mirror"));
    let refused = |keyframes| Animation::new(keyframes).expect_err("keyframes that fit no motion");
    assert_eq!(refused(vec![]), E::Empty);
    assert_eq!(refused(vec![(0.0, a), (f64::NAN, a)]), E::NotFinite { keyframe: 1 });
    for time in [0.5, 0.25] {
        let error = refused(vec![(0.0, a), (0.5, a), (time, a)]);
        assert_eq!(error, E::Order { keyframe: 2, time, previous: 0.5 });
    }
    let error = refused(vec![(0.0, mirror), (1.0, mirror), (2.0, a)]);
    assert_eq!((error, error.keyframe()), (E::Handedness { keyframe: 2 }, Some(2)));
    assert_eq!(Shutter::new(1.0, 0.5), Err(ShutterError::Order { open: 1.0, close: 0.5 }));
    for (open, close) in [(f64::NAN, 1.0), (0.0, f64::INFINITY), (-1e308, 1e308)] {
        assert_eq!(Shutter::new(open, close), Err(ShutterError::NotFinite));
    }
}
