//! The smallest renderer: a Lambertian ball under a point light, without files. Prints what it sees.
//!
//! `cargo run --release -p etendue-renderer --example minimal`
//!
//! `tests/measure/binary_sizes.sh` compares its size with that of the command.

use core::error::Error;
use core::sync::atomic::AtomicBool;

use etendue_math::Spectrum;
use etendue_math::glam::{DVec3, Vec3};
use etendue_renderer::{RenderSettings, Renderer};
use etendue_scene::camera::{Camera, FieldOfView, FovAxis, Projection};
use etendue_scene::film::Film;
use etendue_scene::geometry::{GeometryBuilder, Shape, Sphere, Transform};
use etendue_scene::light::{Light, PointLight};
use etendue_scene::material::{Material, Materials};
use etendue_scene::medium::Media;
use etendue_scene::scene::{PathSettings, SamplingSettings, SceneParts, SurfaceInfo};
use etendue_scene::texture::Textures;
use etendue_scene::{Color, Scene};

const SIZE: [u32; 2] = [48, 24];

fn scene() -> Result<Scene, Box<dyn Error>> {
    let mut textures = Textures::default();
    let reflectance = textures.constant(Color::splat(0.8));
    let mut materials = Materials::default();
    let material = materials.add(Material::Diffuse { reflectance })?;
    let mut geometry = GeometryBuilder::new();
    geometry.add_shape(Shape::Sphere(Sphere::new(DVec3::ZERO, 1.0, &Transform::IDENTITY)?));
    let ball = SurfaceInfo { material, light: None, boundary: None, name: "ball".to_owned() };
    let lamp = PointLight { position: Vec3::new(-3.0, 4.0, 4.0), intensity: Color::splat(100.0) };
    let field_of_view = FieldOfView::Angle { degrees: 50.0, axis: FovAxis::X };
    let pinhole = Projection::Perspective { field_of_view, principal_point_offset: [0.0; 2] };
    let view = Transform::look_at(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, DVec3::Y)?;
    Ok(Scene::new(SceneParts {
        geometry: geometry.build(),
        surfaces: vec![ball],
        materials,
        textures,
        lights: vec![Light::Point(lamp)],
        media: Media::default(),
        camera: Camera::new(pinhole, view, 0.01, 100.0, SIZE)?,
        film: Film::new(SIZE),
        sampling: SamplingSettings::default(),
        path: PathSettings::default(),
    })?)
}

fn main() -> Result<(), Box<dyn Error>> {
    let scene = scene()?;
    let renderer = Renderer::new(&scene, RenderSettings::of_scene(&scene))?;
    let rendering = renderer.render(&|_| (), &AtomicBool::new(false));
    for row in rendering.image.pixels().chunks(SIZE[0] as usize) {
        let shade = |color: &Color| {
            let level = (color.luminance() * 9.0).clamp(0.0, 9.0) as usize;
            char::from(b" .:-=+*#%@"[level])
        };
        println!("{}", row.iter().map(shade).collect::<String>());
    }
    Ok(())
}
