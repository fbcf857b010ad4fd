//! Rays that leave a surface do not hit it again, and reach what they aim at.

use etendue_math::glam::DVec3;

use super::{Random, one_of_each, without_points};
use crate::geometry::{Geometry, GeometryBuilder, Ray, Shape, Transform};

/// How many of `rays` random rays hit, and how many rays that leave these hits meet the same primitive
/// again right away. Across itself, from inside, a round shape is rightly met again.
fn self_hits(geometry: &Geometry, size: f32, random: &mut Random, rays: u32) -> (u32, u32) {
    let (mut found, mut bad) = (0, 0);
    let center = geometry.bounds().center();
    for _ in 0..rays {
        let origin = center + random.direction() * (size * (0.05 + 6.0 * random.uniform()));
        let target = center + random.point() * (0.5 * size);
        let ray = Ray::new(origin, target - origin);
        let Some(hit) = geometry.intersect(&ray) else { continue };
        found += 1;
        let p = geometry.surface_point(&ray, &hit);
        for _ in 0..4 {
            let direction = random.direction();
            let leaving = p.spawn(direction);
            if let Some(again) = geometry.intersect(&leaving) {
                let same = (again.shape, again.primitive, again.instance)
                    == (hit.shape, hit.primitive, hit.instance);
                // A flat primitive cannot be hit again at all, a round one only across itself.
                if same && again.t < 1e-3 * size * direction.dot(p.normal).abs() {
                    bad += 1;
                }
            }
        }
    }
    (found, bad)
}

/// From a tenth of a millimetre to a thousand kilometres, in metres.
const SCALES: [f64; 11] = [1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6];

#[test]
fn rays_that_leave_a_shape_do_not_hit_it_at_once_on_any_scale() {
    let mut random = Random(21);
    let mut found = 0;
    for scale in SCALES {
        for _ in 0..4 {
            let place = random.similarity(scale);
            let shapes = one_of_each(&place).into_iter().chain(without_points(&place, scale));
            for (i, shape) in shapes.enumerate() {
                let mut builder = GeometryBuilder::new();
                builder.add_shape(shape);
                let (hits, bad) = self_hits(&builder.build(), scale as f32, &mut random, 150);
                assert_eq!(bad, 0, "shape {i} at scale {scale}: {bad} of {hits}");
                found += hits;
            }
        }
    }
    assert!(found > 10_000, "{found}");
}

#[test]
fn rays_that_leave_an_instance_do_not_hit_it_at_once() {
    let mut random = Random(22);
    for scale in SCALES {
        let mut builder = GeometryBuilder::new();
        // The group's own coordinates are of another size than the world's.
        let own = random.similarity(7.0);
        let shapes = one_of_each(&own).into_iter().chain(without_points(&own, 7.0));
        let (group, _) = builder.add_group(shapes.collect());
        builder.add_instance(group, random.similarity(scale / 7.0));
        let (found, bad) = self_hits(&builder.build(), scale as f32, &mut random, 800);
        assert!(found > 50 && bad == 0, "scale {scale}: {bad} of {found}");
    }
}

#[test]
fn slivers_are_left_too() {
    let mut random = Random(23);
    let place = Transform::scale(DVec3::new(1.0, 1e-4, 1.0)).expect("a scale");
    for _ in 0..20 {
        let place = random.similarity(1.0).compose(&place).expect("an affine map");
        let mesh = super::sphere_mesh(1).transformed(&place).expect("in range");
        let mut builder = GeometryBuilder::new();
        builder.add_shape(Shape::Mesh(mesh));
        let (found, bad) = self_hits(&builder.build(), 1.0, &mut random, 300);
        assert!(found > 20 && bad == 0, "{bad} of {found}");
    }
}

#[test]
fn segments_between_surfaces_touch_neither_end() {
    let mut random = Random(24);
    for scale in SCALES {
        let mut builder = GeometryBuilder::new();
        let from = one_of_each(&random.similarity(scale));
        // Far away compared with its own size, so that the direction's rounding counts.
        let apart = Transform::translate(DVec3::new(50.0, 20.0, 30.0) * scale).expect("in range");
        let to = one_of_each(&apart.compose(&random.similarity(0.1 * scale)).expect("in range"));
        for shape in from.iter().chain(&to) {
            builder.add_shape(shape.clone());
        }
        let geometry = builder.build();
        let (mut segments, mut blocked) = (0, 0);
        for source in &from {
            let center = source.bounds().center();
            for (light_id, light) in (from.len() as u32..).zip(&to) {
                for _ in 0..40 {
                    let origin = center + random.direction() * (9.0 * scale as f32);
                    let ray =
                        Ray::new(origin, center - origin + random.point() * scale as f32 * 0.3);
                    let Some(hit) = geometry.intersect(&ray) else { continue };
                    let p = geometry.surface_point(&ray, &hit);
                    let primitive = (random.uniform() * light.primitive_count() as f32) as u32;
                    let Some(s) = light.sample_area(primitive, random.pair()) else { continue };
                    // Sides that face each other.
                    let w = s.position - p.position;
                    let facing = p.normal.dot(w) > 0.0 && s.normal.dot(w) < 0.0;
                    let sources = from.len() as u32;
                    if !facing || hit.shape.0 >= sources {
                        continue;
                    }
                    segments += 1;
                    let segment = p.spawn_to_sample(&s);
                    if let Some(h) = geometry.intersect(&segment) {
                        // Convex shapes that face each other cannot block what is between them.
                        let ends = [hit.shape.0, light_id].contains(&h.shape.0);
                        blocked += u32::from(ends);
                    }
                }
            }
        }
        assert!(segments > 30 && blocked == 0, "scale {scale}: {blocked} of {segments}");
    }
}
