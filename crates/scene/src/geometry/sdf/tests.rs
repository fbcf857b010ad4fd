//! Laws of distance fields.

use alloc::vec::Vec;

use super::*;
use crate::geometry::tests::Random;
use crate::geometry::{GeometryBuilder, Shape};

/// A field over the unit cube.
fn field(size: [u32; 3], value: impl Fn(DVec3) -> f64) -> SdfSamples {
    let [x, y, z] = size;
    let cells = DVec3::new(f64::from(x - 1), f64::from(y - 1), f64::from(z - 1));
    let mut values = Vec::new();
    for i in 0..x * y * z {
        let p = DVec3::new(f64::from(i % x), f64::from(i / x % y), f64::from(i / (x * y)));
        values.push(value(p / cells) as f32);
    }
    SdfSamples::new(size, values).expect("finite values")
}

fn ball(size: [u32; 3]) -> SdfSamples {
    field(size, |p| Vector3::length(p - DVec3::splat(0.5)) - 0.4)
}

fn surface(samples: SdfSamples, to_world: &Transform) -> SdfGrid {
    SdfGrid::new(samples, SdfNormals::Smooth, to_world).expect("it has a surface")
}

/// Noise with both signs.
fn rough(random: &mut Random) -> SdfSamples {
    let values = (0..6 * 5 * 7).map(|_| random.uniform() - 0.5).collect();
    SdfSamples::new([6, 5, 7], values).expect("finite values")
}

#[test]
fn fields_of_one_sign_have_no_surface() {
    let none = SdfGrid::new(field([2; 3], |_| 1.0), SdfNormals::Smooth, &Transform::IDENTITY);
    assert_eq!(none, Err(ShapeError::NoSurface));
}

#[test]
fn a_linear_field_is_a_plane_with_its_normal() {
    // Linear interpolation is exact: 2x + y − z = 1.
    let samples = field([3, 4, 5], |p| 2.0 * p.x + p.y - p.z - 1.0);
    let mut builder = GeometryBuilder::new();
    builder.add_shape(Shape::Sdf(surface(samples.clone(), &Transform::IDENTITY).into()));
    builder.add_shape(Shape::Sdf(surface(samples, &Transform::IDENTITY).flipped().into()));
    let geometry = builder.build();
    let ray = Ray::new(Vec3::new(-1.0, 0.5, 0.25), Vec3::X);
    let hit = geometry.intersect(&ray).expect("the plane crosses the cube");
    let p = geometry.surface_point(&ray, &hit);
    // 2x = 1 − 0.5 + 0.25; the samples have thirds of 24 bits.
    assert!((p.position - Vec3::new(0.375, 0.5, 0.25)).abs().max_element() < 1e-6, "{p:?}");
    let normal = Vec3::new(2.0, 1.0, -1.0).normalize();
    for n in [p.normal, p.shading.n] {
        // The two shapes coincide: either may be met, one with the opposite normal.
        let n = if hit.shape.0 == 0 { n } else { -n };
        assert!((n - normal).abs().max_element() < 1e-6, "{n}");
    }
}

#[test]
fn hits_lie_on_the_surface_within_their_bound_wherever_it_is() {
    let mut random = Random(61);
    for scale in [1e-4, 1.0, 1e5] {
        for away in [0.0, 1e3] {
            let shift = Transform::translate(DVec3::splat(away * scale)).expect("a map");
            let place = shift.compose(&random.similarity(scale)).expect("a map");
            let grid = surface(rough(&mut random), &place);
            let inverse = place.inverse_affine();
            let center = grid.bounds().center();
            let mut builder = GeometryBuilder::new();
            builder.add_shape(Shape::Sdf(grid.clone().into()));
            let geometry = builder.build();
            let mut found = 0;
            for _ in 0..500 {
                let size = scale as f32;
                let origin = center + random.direction() * (3.0 * size);
                let ray = Ray::new(origin, center + random.point() * (0.5 * size) - origin);
                let Some(hit) = geometry.intersect(&ray) else { continue };
                found += 1;
                let p = geometry.surface_point(&ray, &hit);
                let (corner, voxel) = grid.voxel(hit.primitive).expect("it was hit");
                let value =
                    |p: DVec3| voxel.at(inverse.transform_point3(p) * grid.cells() - corner);
                // The field has both signs, or is 0, within the bound along the normal.
                let n = p.normal.as_dvec3();
                let reach = n.abs().dot(p.error.as_dvec3());
                let [low, high] =
                    [-1.0, 1.0].map(|side| value(p.position.as_dvec3() + n * (side * reach)));
                assert!(
                    low <= 0.0 && high >= 0.0,
                    "scale {scale}, away {away}: {low} {high} {p:?}"
                );
                assert!(geometry.occluded(&Ray { t_max: hit.t * 1.001, ..ray }));
                assert!(!geometry.occluded(&Ray { t_max: hit.t, ..ray }));
            }
            assert!(found > 200, "{found}");
        }
    }
}

#[test]
fn no_ray_gets_into_a_closed_surface() {
    let mut random = Random(62);
    // From the middle of a ball, through vertices, edges and faces of voxels as well.
    let mut builder = GeometryBuilder::new();
    builder.add_shape(Shape::Sdf(surface(ball([9, 5, 7]), &Transform::IDENTITY).into()));
    let geometry = builder.build();
    let cells = Vec3::new(8.0, 4.0, 6.0);
    for i in 0..40_000 {
        let mut target = (random.point() + 1.0) * 0.5;
        for axis in 0..3 {
            if (i + axis) % 4 != 0 {
                target[axis] = (target[axis] * cells[axis]).round() / cells[axis];
            }
        }
        let direction = target - Vec3::splat(0.5);
        let outwards = Ray::new(Vec3::splat(0.5), direction);
        if direction != Vec3::ZERO {
            assert!(geometry.intersect(&outwards).is_some(), "{target}");
        }
    }
}

#[test]
fn every_side_is_met_from_where_the_ray_comes() {
    let mut random = Random(63);
    let mut builder = GeometryBuilder::new();
    builder.add_shape(Shape::Sdf(surface(ball([12; 3]), &Transform::IDENTITY).into()));
    let geometry = builder.build();
    for _ in 0..2000 {
        let target = Vec3::splat(0.5) + random.point() * 0.2;
        let origin = Vec3::splat(0.5) + random.direction() * 5.0;
        let ray = Ray::new(origin, target - origin);
        let first = geometry.intersect(&ray).expect("aimed at the inside");
        let p = geometry.surface_point(&ray, &first);
        assert!(p.normal.dot(ray.direction) < 0.0);
        let inside = p.spawn(ray.direction);
        let second = geometry.intersect(&inside).expect("it is closed");
        let q = geometry.surface_point(&inside, &second);
        assert!(q.normal.dot(ray.direction) > 0.0);
        assert!(!geometry.occluded(&q.spawn(ray.direction)), "nothing is behind a ball");
    }
}

#[test]
fn values_of_any_size_do_no_harm() {
    let mut random = Random(64);
    for magnitude in [0.0, 1e-45, f32::MAX] {
        let values = (0..27).map(|i| magnitude * [1.0, -1.0, 0.0][i % 3]).collect();
        let samples = SdfSamples::new([3; 3], values).expect("finite values");
        let grid = surface(samples, &Transform::IDENTITY);
        let mut builder = GeometryBuilder::new();
        builder.add_shape(Shape::Sdf(grid.into()));
        let geometry = builder.build();
        for _ in 0..300 {
            let ray = Ray::new(random.point() * 2.0, random.direction());
            if let Some(hit) = geometry.intersect(&ray) {
                let p = geometry.surface_point(&ray, &hit);
                assert!(p.position.is_finite() && p.error.is_finite(), "{p:?}");
                assert!((p.normal.length() - 1.0).abs() < 1e-5, "{p:?}");
            }
        }
    }
}

#[test]
fn hits_and_normals_are_those_of_mitsuba() {
    // Origin, direction, t, and the normals of the geometry and of smooth shading of mi.load_dict(…).ray_intersect(…),
    // 3.9.1. The field goes through the sides of the cube, next to which normals are blended in another way.
    let samples = field([5; 3], |p| {
        let [x, y, z] = (p * 4.0).to_array();
        (3.0 * x + 5.0 * y + 7.0 * z) % 11.0 / 11.0 - 0.3 + 0.2 * (x + y - z) / 4.0
    });
    let cases = [
        (
            [2.09, 1.05, 2.01],
            [-0.83, -0.04, -0.56],
            2.170921,
            [0.5114194, -0.5044312, 0.6957005],
            [0.3124953, -0.7337691, 0.6032657],
        ),
        (
            [1.23, 1.81, 1.19],
            [-0.26, -0.9, -0.34],
            1.980654,
            [-0.7283656, 0.4474553, 0.5189097],
            [-0.4964962, 0.8468406, 0.1906635],
        ),
        (
            [0.2, 0.28, 2.8],
            [0.02, 0.02, -1.0],
            1.816932,
            [0.5443529, 0.7868533, -0.2907607],
            [0.6102125, 0.738893, -0.2857932],
        ),
        (
            [1.35, 0.1, 1.32],
            [-0.67, 0.42, -0.62],
            0.5267728,
            [-0.5049866, 0.666839, -0.5480093],
            [-0.4546435, 0.7368886, -0.5002943],
        ),
        (
            [-0.04, -0.95, 0.06],
            [0.22, 0.94, 0.25],
            1.235166,
            [-0.1340318, -0.787495, -0.6015705],
            [0.1376759, -0.3748174, -0.9168191],
        ),
        (
            [2.21, 1.03, -0.25],
            [-0.79, -0.33, 0.52],
            2.379585,
            [0.581651, -0.2702373, -0.7672378],
            [0.8662704, -0.006192926, -0.4995371],
        ),
        (
            [-0.79, 0.25, 1.57],
            [0.83, 0.02, -0.56],
            1.1995,
            [0.6028984, 0.3611922, -0.7113746],
            [0.6870552, 0.08818862, -0.7212337],
        ),
        (
            [1.27, 1.74, 2.16],
            [-0.2, -0.7, -0.68],
            2.418506,
            [0.4563032, 0.7561365, 0.4690895],
            [0.08695406, 0.9962056, 0.003657499],
        ),
        (
            [-1.67, -0.44, -0.08],
            [0.94, 0.32, 0.07],
            1.793487,
            [0.7031693, 0.7023888, 0.1104671],
            [0.6990452, 0.7065943, 0.1098192],
        ),
    ];
    let smooth = surface(samples.clone(), &Transform::IDENTITY);
    let analytic = SdfGrid::new(samples, SdfNormals::Analytic, &Transform::IDENTITY);
    let shapes = [smooth, analytic.expect("it has a surface")];
    for (shape, is_smooth) in shapes.into_iter().zip([true, false]) {
        let mut builder = GeometryBuilder::new();
        builder.add_shape(Shape::Sdf(shape.into()));
        let geometry = builder.build();
        for (origin, direction, t, normal, shading) in cases {
            let ray = Ray::new(Vec3::from(origin), Vec3::from(direction));
            let hit = geometry.intersect(&ray).expect("Mitsuba hits it");
            // It stops within 1e-5.
            assert!((hit.t - t).abs() < 3e-5, "{hit:?} {t}");
            let p = geometry.surface_point(&ray, &hit);
            let shading = if is_smooth { shading } else { normal };
            assert!((p.normal - Vec3::from(normal)).length() < 1e-3, "{p:?} {normal:?}");
            assert!((p.shading.n - Vec3::from(shading)).length() < 1e-3, "{p:?} {shading:?}");
        }
    }
}
