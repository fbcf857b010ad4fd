//! The lists of rays that both sides get.

use etendue_math::glam::Vec3;
use etendue_scene::geometry::{Geometry, Ray, SurfacePoint};

use crate::kinds::Kind;
use crate::random::Random;

/// A column of the table.
pub struct List {
    pub name: &'static str,
    pub any: bool,
    pub rays: Vec<Ray>,
}

/// Four lists: from the camera, cosine-weighted from where those hit, to the light, and short ones.
pub fn lists(kind: &Kind, geometry: &Geometry, size: u32) -> [List; 4] {
    let mut random = Random(1);
    let forward = (kind.target - kind.eye).normalize();
    let right = forward.cross(Vec3::Y).normalize();
    let up = right.cross(forward);
    let scale = |i: u32, jitter: f32| kind.width * (2.0 * (i as f32 + jitter) / size as f32 - 1.0);
    let primary: Vec<Ray> = (0..size * size)
        .map(|i| {
            let x = scale(i % size, random.uniform());
            let y = scale(i / size, random.uniform());
            Ray::new(kind.eye, (forward + right * x - up * y).normalize())
        })
        .collect();
    let points: Vec<SurfacePoint> = primary
        .iter()
        .filter_map(|ray| Some(geometry.surface_point(ray, &geometry.intersect(ray)?)))
        .collect();
    // To the side of the camera, on which the ray came.
    let normal = |p: &SurfacePoint| {
        if p.normal.dot(kind.eye - p.position) < 0.0 { -p.normal } else { p.normal }
    };
    let mut hemisphere = |p: &SurfacePoint| p.spawn(random.about(normal(p)));
    let bounce = points.iter().map(&mut hemisphere).collect();
    let ambient = points.iter().map(|p| Ray { t_max: kind.reach, ..hemisphere(p) }).collect();
    let shadow = points.iter().map(|p| p.spawn_to(kind.light)).collect();
    [
        List { name: "primary", any: false, rays: primary },
        List { name: "bounce", any: false, rays: bounce },
        List { name: "shadow", any: true, rays: shadow },
        List { name: "ambient", any: true, rays: ambient },
    ]
}
