//! Laws of curves.

use alloc::vec;
use alloc::vec::Vec;

use super::*;
use crate::geometry::tests::Random;
use crate::geometry::{Geometry, GeometryBuilder, Shape};

fn point(x: f32, y: f32, z: f32, radius: f32) -> CurvePoint {
    CurvePoint { position: Vec3::new(x, y, z), radius }
}

/// Two linear curves: two segments, and one. Held to Mitsuba's values below.
fn linear() -> Curves {
    let points = vec![
        point(-1.0, 0.1, 0.1, 0.5),
        point(1.0, 1.4, 1.2, 0.3),
        point(2.0, 1.4, 0.2, 0.4),
        point(-1.0, 5.0, 2.2, 0.2),
        point(-2.3, 4.0, 2.3, 0.4),
    ];
    Curves::new(CurveBasis::Linear, points, &[3, 2], &Transform::IDENTITY).expect("two curves")
}

/// A B-spline of two segments.
fn spline() -> Curves {
    let points = vec![
        point(-1.0, 0.1, 0.1, 0.5),
        point(-0.3, 1.2, 1.0, 0.4),
        point(0.3, 0.3, 1.1, 0.3),
        point(1.0, 1.4, 1.2, 0.5),
        point(2.0, 1.4, 0.2, 0.3),
    ];
    Curves::new(CurveBasis::BSpline, points, &[5], &Transform::IDENTITY).expect("a curve")
}

fn geometry(curves: &Curves) -> Geometry {
    let mut builder = GeometryBuilder::new();
    builder.add_shape(Shape::Curves(curves.clone().into()));
    builder.build()
}

/// Curves that wind at random, thinner than they bend.
fn random_curves(basis: CurveBasis, random: &mut Random, place: &Transform, scale: f64) -> Curves {
    let (mut points, mut lengths) = (Vec::new(), Vec::new());
    for _ in 0..6 {
        let mut position = random.point();
        let mut heading = random.direction();
        for _ in 0..7 {
            let radius = (0.02 + 0.03 * random.uniform()) * scale as f32;
            points.push(CurvePoint { position, radius });
            heading = (heading + random.direction() * 0.6).normalize();
            position += heading * 0.4;
        }
        lengths.push(7);
    }
    Curves::new(basis, points, &lengths, place).expect("curves")
}

#[test]
fn hits_are_those_of_mitsuba() {
    // t, position, normal and texture coordinates of mi.load_dict(…).ray_intersect(…), 3.9.1.
    let cases = [
        (
            linear(),
            [0.0, 0.8, 5.0],
            [0.0, 0.0, -1.0],
            3.9155664,
            [-0.34915352, -0.09758535, 0.93197054],
            [0.23265271, 0.18915826],
        ),
        (
            linear(),
            [0.0, 3.0, 0.3],
            [0.0, -1.0, 0.1],
            1.8741523,
            [-0.17031491, 0.8449174, -0.5070576],
            [0.8985338, 0.17783086],
        ),
        (
            linear(),
            [-5.0, -0.6, -0.1],
            [1.0, 0.17, 0.0],
            3.551947,
            [-0.89610606, -0.1923381, -0.40000015],
            [0.99770755, 0.0],
        ),
        (
            spline(),
            [0.0, 0.8, 5.0],
            [0.0, 0.0, -1.0],
            3.6129484,
            [-0.0805498, 0.19338788, 0.97781026],
            [0.23056987, 0.2861526],
        ),
        (
            spline(),
            [0.0, 0.75, 0.65],
            [1.0, 0.65, 0.55],
            0.39244807,
            [-0.59844804, 0.4324526, -0.6744218],
            [0.8808468, 0.69496],
        ),
    ];
    for (curves, origin, direction, t, normal, uv) in cases {
        let direction: Vec3 = direction.into();
        // Mitsuba normalises no direction either.
        let ray = Ray::new(origin.into(), direction);
        let geometry = geometry(&curves);
        let hit = geometry.intersect(&ray).expect("Mitsuba hits it");
        let p = geometry.surface_point(&ray, &hit);
        // Six digits of Embree's.
        assert!((hit.t - t).abs() < 1e-5 * t, "{hit:?} {t}");
        assert!((p.normal - Vec3::from(normal)).length() < 1e-4, "{p:?} {normal:?}");
        assert!((0..2).all(|i| (p.uv[i] - uv[i]).abs() < 2e-5), "{p:?} {uv:?}");
    }
    // From inside, and along the axis of an open end.
    for (curves, origin, direction) in [
        (linear(), [0.0, 0.75, 0.65], [0.0, 0.0, 1.0]),
        (linear(), [-1.0, 0.1, 0.1], [-1.0, 0.0, 0.0]),
        (spline(), [0.0, 0.75, 0.65], [0.0, 0.0, 1.0]),
        (spline(), [0.0, 3.0, 0.3], [0.0, -1.0, 0.1]),
    ] {
        let ray = Ray::new(origin.into(), direction.into());
        assert_eq!(geometry(&curves).intersect(&ray), None);
    }
}

#[test]
fn partials_of_a_spline_are_those_of_mitsuba() {
    let geometry = geometry(&spline());
    for (origin, direction, expected) in [
        (
            [0.0, 0.8, 5.0],
            [0.0, 0.0, -1.0],
            [[-1.2132382, -1.8315924, 0.2623018], [-1.9347203, -6.0701213, 1.041149]],
        ),
        (
            [0.0, 0.75, 0.65],
            [1.0, 0.65, 0.55],
            [[-1.134926, 1.1955607, 1.7736932], [2.2962644, -0.3882679, -2.2865543]],
        ),
    ] {
        let ray = Ray::new(origin.into(), direction.into());
        let hit = geometry.intersect(&ray).expect("it is hit");
        let point = geometry.surface_point(&ray, &hit);
        let found = crate::geometry::Located::new(&geometry, point).partials();
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - Vec3::from(expected)).length() < 1e-3, "{found} {expected:?}");
        }
        assert!(point.shading.s.dot(found[0].normalize()) > 0.999);
    }
}

/// Squared distance from the nearest swept sphere or circle less its squared radius, by brute force.
fn excess(curves: &Curves, p: DVec3) -> f64 {
    let mut least = f64::INFINITY;
    for segment in 0..curves.segment_count() {
        const STEPS: u32 = 400;
        let values: Vec<f64> = (0..=STEPS)
            .map(|i| {
                let v = f64::from(i) / f64::from(STEPS);
                let (center, radius) = match curves.basis {
                    CurveBasis::Linear => curves.cone(segment).sphere(v),
                    CurveBasis::BSpline => {
                        let center = curves.spline(segment).at(v);
                        (center.position, center.radius)
                    }
                };
                Vector3::length(p - center) - radius
            })
            .collect();
        least = values.into_iter().fold(least, f64::min);
    }
    least
}

#[test]
fn hits_lie_on_the_surface_within_their_bound_wherever_it_is() {
    let mut random = Random(71);
    for basis in [CurveBasis::Linear, CurveBasis::BSpline] {
        for scale in [1e-4, 1.0, 1e5] {
            let place = random.similarity(scale);
            let curves = random_curves(basis, &mut random, &place, scale);
            let geometry = geometry(&curves);
            let center = geometry.bounds().center();
            let size = scale as f32;
            let (mut found, mut oblique) = (0, 0);
            for _ in 0..1500 {
                let origin = center + random.direction() * (6.0 * size);
                let ray = Ray::new(origin, center + random.point() * size - origin);
                let Some(hit) = geometry.intersect(&ray) else { continue };
                found += 1;
                let p = geometry.surface_point(&ray, &hit);
                let cos = p.normal.dot(ray.direction.normalize());
                assert!(cos < 1e-3, "met from inside: {cos}");
                oblique += u32::from(cos > -0.5);
                // A hit lies on the ray, up to rounding: t has 24 bits, and so have both ends.
                let off = (ray.at(hit.t) - p.position).length();
                assert!(off < 8.0 * f32::EPSILON * (origin.length() + 7.0 * size), "{off}");
                // Four hundred steps on a way as long as 0.4 of the scale: the nearest sphere is at most half a step away,
                // which is 1e-5 of the scale farther from a point at 0.02.
                let reach = f64::from(p.error.length());
                let excess = excess(&curves, p.position.as_dvec3());
                assert!(excess < reach + 1e-5 * scale, "{excess} {p:?}");
                // A circle across a curve that grows lies within its neighbours' spheres.
                assert!(excess > -reach - 2e-3 * scale, "{excess} {p:?}");
                assert!(geometry.occluded(&Ray { t_max: hit.t * 1.001, ..ray }));
                assert!(!geometry.occluded(&Ray { t_max: hit.t, ..ray }));
            }
            assert!(found > 50 && oblique > 5, "{found} {oblique}");
        }
    }
}

#[test]
fn the_hierarchy_and_the_parts_leave_nothing_out() {
    // Any ray through the axis of a curve meets its wall before.
    let mut random = Random(72);
    for basis in [CurveBasis::Linear, CurveBasis::BSpline] {
        let curves = random_curves(basis, &mut random, &Transform::IDENTITY, 1.0);
        let geometry = geometry(&curves);
        let mut aimed = 0;
        for i in 0..20_000_u32 {
            // Of the four segments of a spline not those next to its open ends, through which rays leave.
            let segment = match basis {
                CurveBasis::Linear => i % curves.segment_count(),
                CurveBasis::BSpline => 4 * (i % 6) + 1 + i / 6 % 2,
            };
            // Joints of parts as well.
            let v = match i % 3 {
                0 => f64::from(random.uniform()),
                1 => f64::from((random.uniform() * 4.0).floor()) / 4.0,
                _ => f64::from((random.uniform() * 16.0).floor()) / 16.0,
            };
            let (center, tangent) = match basis {
                CurveBasis::Linear => (curves.cone(segment).sphere(v).0, curves.cone(segment).axis),
                CurveBasis::BSpline => {
                    let center = curves.spline(segment).at(v);
                    (center.position, center.tangent)
                }
            };
            let direction = random.direction();
            let target = center.as_vec3();
            let cos = direction.dot(tangent.as_vec3().normalize()).abs();
            // A ray along a curve may leave it where it bends, and has not met it from outside before.
            if cos > 0.9 {
                continue;
            }
            aimed += 1;
            let ray = Ray::new(target - direction * 5.0, direction);
            let hit = geometry.intersect(&ray);
            assert!(
                hit.is_some_and(|hit| hit.t < 5.0),
                "{basis:?} {segment} {v} {direction}: {hit:?}"
            );
        }
        assert!(aimed > 5000);
    }
}

#[test]
fn a_straight_spline_is_a_cylinder_and_a_linear_curve_a_capsule() {
    let line = |count| (0..count).map(|i| point(0.0, 0.0, i as f32, 0.5)).collect::<Vec<_>>();
    let spline = Curves::new(CurveBasis::BSpline, line(6), &[6], &Transform::IDENTITY);
    let spline = geometry(&spline.expect("a curve"));
    let linear = Curves::new(CurveBasis::Linear, line(3), &[3], &Transform::IDENTITY);
    let linear = geometry(&linear.expect("a curve"));
    for far in [1.0_f32, 1e3, 1e6] {
        // The spline goes from 1 to 4, the linear curve from 0 to 2.
        for (geometry, z) in [(&spline, 2.25), (&linear, 1.25)] {
            let ray = Ray::new(Vec3::new(far, 0.25, z), -Vec3::X);
            let hit = geometry.intersect(&ray).expect("aimed at");
            let x = Real::sqrt(0.1875_f64);
            assert!(
                Real::abs(f64::from(hit.t) - (f64::from(far) - x)) <= f64::from(far * f32::EPSILON)
            );
            let p = geometry.surface_point(&ray, &hit);
            assert!((p.position - Vec3::new(x as f32, 0.25, z)).length() < 1e-6, "{p:?}");
            assert!((p.normal - Vec3::new(2.0 * x as f32, 0.5, 0.0)).length() < 1e-6, "{p:?}");
            let beside = Ray::new(Vec3::new(far, 0.50001, z), -Vec3::X);
            assert_eq!(geometry.intersect(&beside), None);
        }
        // Along the axis: through the open ends, against the round one.
        let along = Ray::new(Vec3::new(0.0, 0.0, -far), Vec3::Z);
        assert_eq!(spline.intersect(&along), None);
        let hit = linear.intersect(&along).expect("a round end");
        assert!((hit.t - (far - 0.5)).abs() <= far * f32::EPSILON);
    }
}

#[test]
fn one_sphere_in_another_is_the_larger_one() {
    let points = vec![point(0.0, 0.0, 0.0, 1.0), point(0.0, 0.0, 0.25, 0.5)];
    let curves = Curves::new(CurveBasis::Linear, points, &[2], &Transform::IDENTITY);
    let geometry = geometry(&curves.expect("a curve"));
    let hit = geometry.intersect(&Ray::new(Vec3::new(0.0, 0.0, 5.0), -Vec3::Z));
    assert_eq!(hit.map(|hit| hit.t), Some(4.0));
}

#[test]
fn curves_without_extent_do_no_harm() {
    let mut random = Random(73);
    let large = 1e18;
    let all = [
        // A point, a line, a point with a radius, a cusp, what is as large as can be.
        vec![point(0.0, 0.0, 0.0, 0.0); 5],
        (0..5).map(|i| point(i as f32 * 0.2, 0.0, 0.0, 0.0)).collect(),
        vec![point(0.1, 0.0, 0.0, 0.3); 5],
        [0.0, 1.0, 0.0, 1.0, 0.0].map(|x| point(x, 0.0, 0.0, 0.1)).to_vec(),
        [0.0, 1.0, 0.0, -1.0, 0.0].map(|x| point(x * large, x, 0.0, large * x.abs())).to_vec(),
        [0.0, 0.0, 0.0, 1.0, 1.0].map(|x| point(x, 0.0, 0.0, 0.2)).to_vec(),
    ];
    for (i, points) in all.into_iter().enumerate() {
        for basis in [CurveBasis::Linear, CurveBasis::BSpline] {
            let curves = Curves::new(basis, points.clone(), &[5], &Transform::IDENTITY);
            let geometry = geometry(&curves.expect("a curve"));
            let mut found = 0;
            for _ in 0..400 {
                let origin = random.point() * 3.0;
                let ray = Ray::new(origin, random.point() - origin);
                let Some(hit) = geometry.intersect(&ray) else { continue };
                found += 1;
                let p = geometry.surface_point(&ray, &hit);
                assert!(p.position.is_finite() && p.error.is_finite(), "{i} {basis:?} {p:?}");
                assert!((p.normal.length() - 1.0).abs() < 1e-5, "{i} {basis:?} {p:?}");
            }
            assert!(i >= 2 || found == 0, "{i} {basis:?}: lines without a radius are not hit");
        }
    }
}

#[test]
fn what_makes_no_curves_is_refused() {
    let refused = |points: Vec<CurvePoint>, lengths: &[u32]| {
        Curves::new(CurveBasis::BSpline, points, lengths, &Transform::IDENTITY).expect_err("bad")
    };
    let points = vec![point(0.0, 1.0, 2.0, 1.0); 7];
    assert_eq!(refused(vec![], &[]), CurveError::Empty.into());
    let short = CurveError::Short { curve: 1, points: 3, needed: 4 };
    assert_eq!(refused(points.clone(), &[4, 3]), short.into());
    let length = CurveError::Length { expected: 4, found: 7 };
    assert_eq!(refused(points.clone(), &[4]), length.into());
    for bad in [f32::NAN, -1.0, f32::INFINITY] {
        let mut points = points.clone();
        points[5].radius = bad;
        assert_eq!(refused(points, &[7]), CurveError::Point { point: 5 }.into());
    }
    let mut points = points;
    points[2].position.y = f32::NAN;
    assert_eq!(refused(points, &[7]), CurveError::Point { point: 2 }.into());
}

#[test]
fn motions_scale_radii_and_refuse_to_stretch() {
    let twice = Transform::scale(DVec3::splat(2.0)).expect("a map");
    let curves = spline().transformed(&twice).expect("a similarity");
    assert_eq!(curves.points[0], point(-2.0, 0.2, 0.2, 1.0));
    let stretch = Transform::scale(DVec3::new(1.0, 2.0, 1.0)).expect("a map");
    assert_eq!(spline().transformed(&stretch), Err(ShapeError::NonUniformScale));
    // As to_world, it moves the points alone.
    let moved = Curves::new(CurveBasis::Linear, linear().points, &[3, 2], &stretch);
    assert_eq!(moved.expect("curves").points[0], point(-1.0, 0.2, 0.1, 0.5));
}
