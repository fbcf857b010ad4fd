//! The hierarchy finds what trying every shape finds.

use alloc::vec;
use alloc::vec::Vec;

use etendue_math::Real;
use etendue_math::glam::{DVec3, Vec3};

use super::{Random, one_of_each, soup, without_points};
use crate::geometry::bvh::simd::Backend;
use crate::geometry::{
    Geometry, GeometryBuilder, Hit, Ray, Shape, Sphere, Transform, TriangleMesh, triangle,
};

fn geometry(shapes: impl IntoIterator<Item = Shape>) -> Geometry {
    let mut builder = GeometryBuilder::new();
    for shape in shapes {
        builder.add_shape(shape);
    }
    builder.build()
}

/// Rays between random places, some along axes, some with an end.
fn random_ray(random: &mut Random) -> Ray {
    let origin = random.point() * 1.5;
    let mut direction = random.point();
    match (random.uniform() * 8.0) as u32 {
        0 => direction = Vec3::new(0.0, direction.y, 0.0),
        1 => direction = Vec3::new(-0.0, direction.y, direction.z),
        _ => {}
    }
    let t_max = if random.uniform() < 0.3 { random.uniform() } else { f32::INFINITY };
    Ray { origin, direction, t_max }
}

/// One geometry per triangle with area: boxes of single triangles, no order to get wrong.
fn brute_force(mesh: &TriangleMesh, ray: &Ray) -> Option<Hit> {
    std::thread_local! {
        static SINGLE: core::cell::RefCell<Vec<(u32, Geometry)>> = const { core::cell::RefCell::new(Vec::new()) };
    }
    SINGLE.with_borrow_mut(|single| {
        if single.is_empty() {
            *single = (0..mesh.triangles().len() as u32)
                .filter(|&i| triangle::normal(&mesh.corners(i)).is_some())
                .map(|i| {
                    let one = TriangleMesh::new(
                        mesh.corners(i).to_vec(),
                        vec![],
                        vec![],
                        vec![[0, 1, 2]],
                    );
                    (i, geometry([Shape::Mesh(one.expect("finite corners"))]))
                })
                .collect();
        }
        let mut best: Option<Hit> = None;
        for (i, g) in single.iter() {
            let t_max = best.map_or(ray.t_max, |b| b.t);
            if let Some(hit) = g.intersect(&Ray { t_max, ..*ray }) {
                best = Some(Hit { primitive: *i, ..hit });
            }
        }
        best
    })
}

#[test]
fn every_backend_finds_the_closest_triangle_of_a_soup() {
    let mut random = Random(1);
    // An interpreter gets few of both.
    let (triangles, rays, least) = if cfg!(miri) { (200, 100, 2) } else { (700, 4000, 500) };
    let mesh = soup(&mut random, triangles);
    let mut geometry = geometry([Shape::Mesh(mesh.clone())]);
    assert_eq!(geometry.statistics().degenerate_triangles, triangles as usize / 50);
    let mut hits = 0;
    for _ in 0..rays {
        let ray = random_ray(&mut random);
        let want = brute_force(&mesh, &ray);
        hits += usize::from(want.is_some());
        for backend in Backend::all() {
            geometry.backend = backend;
            let got = geometry.intersect(&ray);
            // Equal bits: the same arithmetic on the same triangles, whatever the order.
            assert_eq!(got.map(|h| h.t), want.map(|h| h.t), "{backend:?} {ray:?}");
            assert_eq!(geometry.occluded(&ray), want.is_some(), "{backend:?} {ray:?}");
        }
    }
    assert!(hits > least, "only {hits} hits: the test tests nothing");
}

#[test]
fn mixed_scenes_give_the_closest_of_what_their_shapes_give() {
    let mut random = Random(2);
    let shapes: Vec<Shape> = (0..12).flat_map(|_| one_of_each(&random.similarity(0.2))).collect();
    let together = geometry(shapes.iter().cloned());
    let alone: Vec<Geometry> = shapes.into_iter().map(|s| geometry([s])).collect();
    for _ in 0..3000 {
        let ray = random_ray(&mut random);
        let want = alone.iter().filter_map(|g| g.intersect(&ray)).map(|h| h.t).reduce(f32::min);
        assert_eq!(together.intersect(&ray).map(|h| h.t), want, "{ray:?}");
        assert_eq!(together.occluded(&ray), want.is_some(), "{ray:?}");
    }
}

#[test]
fn instances_show_what_moved_shapes_show() {
    let mut random = Random(3);
    let (mut instanced, mut flat) = (GeometryBuilder::new(), GeometryBuilder::new());
    let (group, ids) = instanced.add_group(one_of_each(&Transform::IDENTITY).to_vec());
    for _ in 0..10 {
        let place = random.similarity(0.3);
        instanced.add_instance(group, place);
        for shape in one_of_each(&place) {
            flat.add_shape(shape);
        }
    }
    let (instanced, flat) = (instanced.build(), flat.build());
    let (mut hits, mut disagreements) = (0, 0);
    for _ in 0..4000 {
        let ray = Ray::new(random.point() * 1.5, random.direction());
        match (instanced.intersect(&ray), flat.intersect(&ray)) {
            (Some(a), Some(b)) => {
                hits += 1;
                let (p, q) = (instanced.surface_point(&ray, &a), flat.surface_point(&ray, &b));
                if ids[(b.shape.0 % 5) as usize] != a.shape
                    || (p.position - q.position).length() > 1e-4
                {
                    disagreements += 1;
                    continue;
                }
                // The map of a unit normal by f32 matrices: a few ε. Facets are the same facets.
                assert!((p.normal - q.normal).length() < 1e-5, "{p:?} {q:?}");
                // Meshes without texture coordinates have tangents of no particular direction.
                if a.shape != ids[0] {
                    assert!((p.shading.s - q.shading.s).length() < 1e-4, "{p:?} {q:?}");
                }
            }
            (None, None) => {}
            _ => disagreements += 1,
        }
    }
    // Only rays along silhouettes and edges, where rounding decides.
    assert!(hits > 500 && disagreements < 10, "{disagreements} of {hits}");
}

#[test]
fn the_tree_is_the_same_for_one_and_four_threads() {
    let mesh = soup(&mut Random(4), 20_000);
    let build = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let mesh = Shape::Mesh(mesh.clone());
        pool.expect("threads").install(|| geometry([mesh]))
    };
    assert!(build(1).top.bvh == build(4).top.bvh);
}

#[test]
fn items_at_one_place_and_depths_beyond_the_heuristic_are_built() {
    // Nested spheres in geometric progression: the heuristic would peel them off one by one.
    let mut shapes = Vec::new();
    for i in 0..3000 {
        let size = Real::powi(0.97_f64, i % 1500);
        let place = Transform::scale(DVec3::splat(size)).expect("a scale");
        shapes.push(Shape::Sphere(Sphere::new(DVec3::ZERO, 1.0, &place).expect("a sphere")));
    }
    let g = geometry(shapes);
    let hit = g.intersect(&Ray::new(Vec3::ZERO, Vec3::X)).expect("inside all spheres");
    // 0.97¹⁴⁹⁹ as a radius.
    assert!((f64::from(hit.t) / Real::powi(0.97_f64, 1499) - 1.0).abs() < 1e-6);
}

#[test]
fn an_empty_scene_is_empty() {
    let g = GeometryBuilder::new().build();
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    assert_eq!(g.intersect(&ray), None);
    assert!(!g.occluded(&ray) && g.bounds().is_empty());
    assert_eq!(g.statistics().bytes_per_triangle(), 0.0);
}

#[test]
fn invalid_rays_hit_nothing() {
    // One of each shape by itself and, as a group, through an instance; triangles at right angles and
    // askew, seen from their own plane too.
    let mut builder = GeometryBuilder::new();
    let (group, _) = builder.add_group(one_of_each(&Transform::IDENTITY).to_vec());
    builder.add_instance(group, Random(6).similarity(1.0));
    for shape in one_of_each(&Transform::IDENTITY) {
        builder.add_shape(shape);
    }
    builder.add_shape(Shape::Mesh(soup(&mut Random(7), 100)));
    let mut g = builder.build();
    // Every ray with one bad component, along every axis, and with several.
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    let mut invalid = vec![Ray::new(Vec3::ZERO, Vec3::ZERO)];
    for x in bad {
        for set in [1, 2, 4, 3, 5, 6, 7] {
            let spoilt = |v: Vec3| {
                Vec3::from_array([0, 1, 2].map(|i| if set >> i & 1 == 1 { x } else { v[i] }))
            };
            for (origin, direction) in
                [(Vec3::ZERO, Vec3::X), (Vec3::new(0.3, 0.25, -0.1), Vec3::new(0.3, -0.5, 0.7))]
            {
                invalid.push(Ray::new(spoilt(origin), direction));
                invalid.push(Ray::new(origin, spoilt(direction)));
                invalid.push(Ray::new(spoilt(origin), spoilt(direction)));
            }
        }
    }
    for t_max in [0.0, -0.0, -1.0, f32::NAN, f32::NEG_INFINITY] {
        invalid.push(Ray { t_max, ..Ray::new(Vec3::ZERO, Vec3::X) });
    }
    for backend in Backend::all() {
        g.backend = backend;
        for ray in &invalid {
            assert_eq!(g.intersect(ray), None, "{backend:?} {ray:?}");
            assert!(!g.occluded(ray), "{backend:?} {ray:?}");
        }
    }
}

#[test]
fn extreme_rays_give_no_nan() {
    let mut shapes = one_of_each(&Transform::IDENTITY).to_vec();
    shapes.push(Shape::Mesh(soup(&mut Random(5), 100)));
    let g = geometry(shapes);
    let numbers = [0.0, -0.0, 1e-45, 1e-30, 1.0, -1e20, f32::MAX, f32::MIN_POSITIVE];
    for &a in &numbers {
        for &b in &numbers {
            for origin in [Vec3::new(a, b, -2.0), Vec3::new(0.3, a, b)] {
                for direction in [Vec3::new(a, 1.0, b), Vec3::new(b, a, a)] {
                    let ray = Ray::new(origin, direction);
                    if let Some(hit) = g.intersect(&ray) {
                        let p = g.surface_point(&ray, &hit);
                        assert!(hit.t > 0.0 && hit.t < f32::INFINITY, "{ray:?} {hit:?}");
                        assert!(p.position.is_finite() && p.error.is_finite(), "{ray:?} {p:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn voxels_and_parts_of_curves_are_found_as_by_trying_all() {
    let mut random = Random(18);
    for _ in 0..6 {
        for shape in without_points(&random.similarity(1.5), 1.5) {
            let whole = geometry([shape.clone()]);
            let center = whole.bounds().center();
            let mut found = 0;
            for _ in 0..1500 {
                let ray = random_ray(&mut random);
                let ray = Ray { origin: ray.origin + center, ..ray };
                let all = (0..shape.object_count()).filter_map(|i| shape.intersect_object(i, &ray));
                let nearest = all.min_by(f32::total_cmp);
                assert_eq!(whole.intersect(&ray).map(|hit| hit.t), nearest, "{ray:?}");
                assert_eq!(whole.occluded(&ray), nearest.is_some(), "{ray:?}");
                found += u32::from(nearest.is_some());
            }
            assert!(found > 50, "{found}");
        }
    }
}
