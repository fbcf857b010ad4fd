//! Points drawn on shapes follow the densities they claim.

use etendue_math::glam::{DVec3, Vec3};

use super::{Random, one_of_each};
use crate::geometry::{GeometryBuilder, Ray, Shape, Sphere, Transform};

#[test]
fn areas_are_the_closed_forms() {
    use core::f32::consts::PI;
    let shapes = one_of_each(&Transform::scale(DVec3::splat(2.0)).expect("a scale"));
    let length = 2.0 * (0.3_f32 * 0.3 + 0.2 * 0.2 + 1.0).sqrt();
    let want =
        [None, Some(4.0 * PI * 3.24), Some(16.0), Some(4.0 * PI), Some(2.0 * PI * 2.0 * length)];
    for (shape, want) in shapes.iter().zip(want) {
        if let Some(want) = want {
            // A few roundings.
            assert!((shape.area_total() / want - 1.0).abs() < 1e-6, "{shape:?}");
        }
    }
    // A fine mesh of the sphere of radius 2 has nearly its area, from below.
    let mesh = shapes[0].area_total() / (16.0 * PI);
    assert!(mesh > 0.9 && mesh < 1.0, "{mesh}");
}

#[test]
fn uniform_samples_lie_on_the_shape_and_average_to_its_centre() {
    let mut random = Random(31);
    let place = random.similarity(2.0);
    for shape in one_of_each(&place) {
        let mut builder = GeometryBuilder::new();
        builder.add_shape(shape.clone());
        let geometry = builder.build();
        let mut missed = 0;
        for i in 0..1000 {
            let primitive = i % shape.primitive_count();
            let s = shape.sample_area(primitive, random.pair()).expect("an area");
            assert_eq!(s.pdf_area, 1.0 / shape.primitive_area(primitive));
            let ray =
                Ray { t_max: 1.0, ..Ray::new(s.position + s.normal * 0.01, s.normal * -0.02) };
            let Some(hit) = geometry.intersect(&ray) else {
                missed += 1;
                continue;
            };
            let p = geometry.surface_point(&ray, &hit);
            // A step of 0.02 along the normal and back: a few ε of the coordinates.
            assert!((p.position - s.position).length() < 1e-5, "{s:?} {p:?}");
            let du = (p.uv[0] - s.uv[0]).abs();
            assert!(du.min(1.0 - du) < 1e-3 && (p.uv[1] - s.uv[1]).abs() < 1e-3, "{s:?} {p:?}");
        }
        // Points on the very edge.
        assert!(missed < 5, "{missed}");
    }
}

/// `∫ dω` over the directions that see a shape, by drawing points on it and, independently, by
/// shooting directions uniform over the sphere.
#[test]
fn the_mean_of_one_over_the_density_is_the_solid_angle() {
    let mut random = Random(32);
    let place = random.similarity(0.5);
    for shape in one_of_each(&place) {
        let mut builder = GeometryBuilder::new();
        builder.add_shape(shape.clone());
        let geometry = builder.build();
        let center = shape.bounds().center();
        let reference = center + Vec3::new(0.9, -0.7, 0.8);
        let count = 20_000;
        let mut drawn = 0.0_f64;
        for i in 0..count {
            let primitive = i % shape.primitive_count();
            let Some((s, pdf)) = shape.sample_from(primitive, reference, random.pair()) else {
                continue;
            };
            // One point per direction: only what is seen counts, whatever is behind it.
            let ray = Ray { t_max: 1.0 - 1e-3, ..Ray::between(reference, s.position) };
            if !geometry.occluded(&ray) {
                drawn += f64::from(shape.primitive_count()) / f64::from(pdf);
            }
        }
        let drawn = drawn / f64::from(count);
        let shot = (0..count * 4)
            .filter(|_| geometry.occluded(&Ray::new(reference, random.direction())))
            .count() as f64;
        let shot = shot / f64::from(count * 4) * 4.0 * core::f64::consts::PI;
        // Binomial noise of the shot rays: σ < 1.5 % at a few per cent of 80 000; five of them.
        assert!((drawn / shot - 1.0).abs() < 0.08, "{drawn} {shot} {shape:?}");
    }
}

#[test]
fn the_density_of_a_sample_is_the_density_of_the_point_that_its_ray_hits() {
    let mut random = Random(33);
    for scale in [1e-3, 1.0, 1e3] {
        for shape in one_of_each(&random.similarity(scale)) {
            let mut builder = GeometryBuilder::new();
            builder.add_shape(shape.clone());
            let geometry = builder.build();
            let center = shape.bounds().center();
            for i in 0..300 {
                let reference = center + random.direction() * (6.0 * scale as f32);
                let primitive = i % shape.primitive_count();
                let Some((s, pdf)) = shape.sample_from(primitive, reference, random.pair()) else {
                    continue;
                };
                let w = s.position - reference;
                // Grazing directions have densities that any rounding changes.
                let cos = (w.dot(s.normal) / w.length()).abs();
                if cos < 0.1 {
                    continue;
                }
                let ray = Ray::new(reference, w);
                let Some(hit) = geometry.intersect(&ray) else { continue };
                let p = geometry.surface_point(&ray, &hit);
                if p.primitive != primitive
                    || (p.position - s.position).length() > 1e-3 * scale as f32
                {
                    continue;
                }
                let again = shape.pdf_from(reference, &p);
                // The hit is a few ε of the coordinates away, with the cosine 0.1 at worst.
                assert!((again / pdf - 1.0).abs() < 2e-4, "{again} {pdf} {shape:?}");
            }
        }
    }
}

#[test]
fn a_sphere_is_sampled_within_its_cone_however_far_or_near() {
    let mut random = Random(34);
    let shape =
        Shape::Sphere(Sphere::new(DVec3::ZERO, 1.0, &Transform::IDENTITY).expect("a sphere"));
    for distance in [1.0001_f32, 1.5, 1e2, 1e4, 1e6] {
        let reference = Vec3::X * distance;
        let sin2 = (f64::from(distance) * f64::from(distance)).recip();
        let solid_angle = core::f64::consts::TAU * sin2 / (1.0 + (1.0 - sin2).sqrt());
        for _ in 0..200 {
            let (s, pdf) = shape.sample_from(0, reference, random.pair()).expect("outside");
            // The density is computed in f64 and rounded once.
            assert!((f64::from(pdf) * solid_angle - 1.0).abs() < 1e-6);
            // The near side: its points see the reference.
            assert!(s.normal.dot(reference - s.position) >= -1e-5 * distance, "{s:?}");
        }
    }
    // From inside every direction meets it.
    let (s, pdf) = shape.sample_from(0, Vec3::ZERO, [0.3, 0.6]).expect("inside");
    assert!((pdf * 4.0 * core::f32::consts::PI - 1.0).abs() < 1e-6 && s.pdf_area > 0.0);
}
