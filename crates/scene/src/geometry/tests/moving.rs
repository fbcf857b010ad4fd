//! What moves is at every moment what stands there.

use alloc::vec;
use alloc::vec::Vec;

use etendue_math::glam::{DVec3, Vec3};

use super::{Random, one_of_each};
use crate::geometry::bvh::simd::Backend;
use crate::geometry::{
    Animation, Cylinder, Disk, Geometry, GeometryBuilder, Located, Motion, Placement, Ray, Rays,
    Rectangle, Shape, Shutter, Sphere, Transform,
};

fn random_motion(random: &mut Random) -> Motion {
    let keyframes = (0..3).map(|i| (f64::from(i), random.similarity(0.3))).collect();
    let animation = Animation::new(keyframes).expect("increasing times");
    match animation.during(Shutter::new(0.5, 1.75).expect("a shutter")) {
        Placement::Moving(motion) => motion,
        Placement::Still(_) => panic!("it moves"),
    }
}

/// One of each shape by itself and a group of all, on their way; beside, an instance and a sphere that stand.
fn on_the_way(motions: &[Motion]) -> Geometry {
    let mut builder = GeometryBuilder::new();
    let (group, _) = builder.add_group(one_of_each(&Transform::IDENTITY).to_vec());
    let [first, rest @ ..] = motions else { panic!() };
    builder.add_moving_instance(group, first.clone());
    for (shape, motion) in one_of_each(&Transform::IDENTITY).into_iter().zip(rest) {
        builder.add_moving_shape(shape, motion.clone());
    }
    builder.add_instance(group, Random(31).similarity(0.2));
    builder.add_shape(Shape::Sphere(
        Sphere::new(DVec3::ONE, 0.3, &Transform::IDENTITY).expect("a sphere"),
    ));
    builder.build()
}

/// The same where it is at a moment, standing.
fn standing(motions: &[Motion], time: f32) -> Geometry {
    let mut builder = GeometryBuilder::new();
    let (group, _) = builder.add_group(one_of_each(&Transform::IDENTITY).to_vec());
    builder.add_instance(group, Random(31).similarity(0.2));
    builder.add_instance(group, motions[0].at(time));
    for (shape, motion) in one_of_each(&Transform::IDENTITY).into_iter().zip(&motions[1..]) {
        let (group, _) = builder.add_group(vec![shape]);
        builder.add_instance(group, motion.at(time));
    }
    builder.add_shape(Shape::Sphere(
        Sphere::new(DVec3::ONE, 0.3, &Transform::IDENTITY).expect("a sphere"),
    ));
    builder.build()
}

fn motions(seed: u64) -> Vec<Motion> {
    let mut random = Random(seed);
    (0..6).map(|_| random_motion(&mut random)).collect()
}

#[test]
fn rays_find_to_the_bit_what_stands_there_at_their_moment() {
    let motions = motions(32);
    let mut moving = on_the_way(&motions);
    let mut random = Random(33);
    let mut hits = 0;
    for _ in 0..200 {
        let time = random.uniform();
        let standing = standing(&motions, time);
        for _ in 0..40 {
            let ray = Ray::new(random.point() * 1.5, random.direction());
            let expected = standing.intersect(&ray);
            for backend in Backend::all() {
                moving.backend = backend;
                let found = moving.at(time).intersect(&ray);
                // All instances have the same numbers: those that move come last.
                assert_eq!(
                    found.map(|h| (h.t, h.shape, h.instance)),
                    expected.map(|h| (h.t, h.shape, h.instance))
                );
                assert_eq!(moving.at(time).occluded(&ray), expected.is_some());
            }
            let Some(hit) = expected else { continue };
            let expected = standing.surface_point(&ray, &hit);
            hits += usize::from(expected.instance > 0);
            let hit = moving.at(time).intersect(&ray).expect("as above");
            let point = moving.surface_point(&ray, &hit);
            assert_eq!(
                (point.position, point.error, point.normal),
                (expected.position, expected.error, expected.normal)
            );
            assert_eq!(
                (point.shading.s, point.uv, point.time),
                (expected.shading.s, expected.uv, time)
            );
            let partials = Located::new(&moving, point).partials();
            assert_eq!(partials, Located::new(&standing, expected).partials());
        }
    }
    assert!(hits > 500, "only {hits} hits: the test tests nothing");
}

#[test]
fn spawned_rays_leave_what_moves() {
    let moving = on_the_way(&motions(34));
    let mut random = Random(35);
    let mut left = 0;
    for _ in 0..4000 {
        let at = moving.at(random.uniform());
        let ray = Ray::new(random.point() * 1.5, random.direction());
        let Some(hit) = at.intersect(&ray) else { continue };
        let point = moving.surface_point(&ray, &hit);
        // Off a plane and away from it, nothing of the same surface can be met again.
        if matches!(moving.shapes()[hit.shape.0 as usize], Shape::Rectangle(_) | Shape::Disk(_)) {
            let away =
                if ray.direction.dot(point.normal) < 0.0 { point.normal } else { -point.normal };
            for direction in [away, -away] {
                left += 1;
                let next = at.intersect(&point.spawn(direction));
                assert!(next.is_none_or(|next| (next.shape, next.instance) != (hit.shape, hit.instance)));
            }
        }
    }
    assert!(left > 200, "only {left}: the test tests nothing");
}

#[test]
fn without_motion_shapes_stand_where_they_are_when_the_shutter_opens() {
    let motions = motions(36);
    let moving = on_the_way(&motions);
    assert_eq!((moving.moving_count(), moving.instance_count()), (6, 2));
    let still = moving.clone().without_motion();
    assert_eq!((still.moving_count(), still.instance_count()), (0, 2));
    // Shapes made for the place itself, to the bit.
    let p1 = DVec3::new(0.3, -0.2, 1.0);
    let [m, s, r, d, c] = [1, 2, 3, 4, 5].map(|i| *motions[i].opening());
    let [mesh, ..] = one_of_each(&m);
    let shapes = [
        mesh,
        Shape::Sphere(Sphere::new(DVec3::new(0.2, 0.1, 0.0), 0.9, &s).expect("a sphere")),
        Shape::Rectangle(Rectangle::new(&r).expect("in range")),
        Shape::Disk(Disk::new(&d)),
    ];
    assert_eq!(still.shapes()[5..9], shapes);
    // The stored axis of the cylinder is one of unit length, rounded.
    let cylinder = Shape::Cylinder(Cylinder::new(-p1, p1, 0.5, &c).expect("a cylinder"));
    let (found, expected) = (still.shapes()[9].bounds(), cylinder.bounds());
    assert!((found.min - expected.min).abs().max_element() < 1e-6, "{found:?} {expected:?}");
    assert!((found.max - expected.max).abs().max_element() < 1e-6, "{found:?} {expected:?}");
    // Rays see them at the top level, and what is left of the instance where it opens.
    let opening = standing(&motions, 0.0);
    let mut random = Random(37);
    let (mut hits, mut disagreements) = (0, 0);
    for _ in 0..4000 {
        let ray = Ray::new(random.point() * 1.5, random.direction());
        let [a, b] = [&still, &opening].map(|g| g.intersect(&ray).map(|h| h.t));
        hits += usize::from(b.is_some());
        disagreements += usize::from(match (a, b) {
            (Some(a), Some(b)) => (a - b).abs() > 1e-4,
            (a, b) => a.is_some() != b.is_some(),
        });
    }
    // Only rays along silhouettes and edges, where rounding decides.
    assert!(hits > 300 && disagreements < 10, "{disagreements} of {hits}");
}

#[test]
fn shapes_that_are_moved_face_as_their_instances() {
    let mirror = Transform::scale(DVec3::new(1.0, -1.0, 1.0)).expect("a mirror");
    let end = Random(39).similarity(0.7);
    for base in [Transform::IDENTITY, mirror] {
        let shapes = one_of_each(&base).into_iter();
        for shape in shapes.flat_map(|shape| [shape.clone(), shape.flipped()]) {
            let mut builder = GeometryBuilder::new();
            let (group, _) = builder.add_group(vec![shape.clone()]);
            builder.add_instance(group, end);
            let instance = builder.build();
            let mut builder = GeometryBuilder::new();
            builder.add_shape(shape.transformed(&end).expect("a similarity"));
            let moved = builder.build();
            let ray = Ray::new(Vec3::new(0.3, 0.35, 5.0), Vec3::new(0.01, -0.02, -1.0));
            let points = [&instance, &moved].map(|geometry| {
                let ray = end.ray(&ray);
                let hit = geometry.intersect(&ray).expect("it is aimed at");
                geometry.surface_point(&ray, &hit)
            });
            let [a, b] = points.map(|point| point.normal);
            assert!(a.dot(b) > 0.999, "{a} {b}");
        }
    }
}

#[test]
fn without_instances_shapes_still_move() {
    let left = on_the_way(&motions(38)).without_instances();
    assert_eq!((left.moving_count(), left.instance_count()), (5, 0));
}
