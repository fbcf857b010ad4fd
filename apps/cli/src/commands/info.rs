//! `etendue info`: what a scene contains.

use std::collections::BTreeMap;

use etendue_scene::Scene;
use etendue_scene::geometry::Shape;
use etendue_scene::light::Light;
use etendue_scene::material::Material;

use super::scene_arguments::{SceneArguments, load};
use crate::failure::{Exit, Failure};

/// Prints what a scene contains and what is odd about it.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let loaded = load(&arguments.scene.scene, &arguments.scene.load_options())?;
    let scene = &loaded.scene;
    let geometry = scene.geometry.statistics();
    println!("files      {}", loaded.files.len());
    println!("shapes     {}", counted(scene.geometry.shapes().iter().map(shape_name)));
    println!("triangles  {}", with_degenerate(geometry.triangles, geometry.degenerate_triangles));
    println!(
        "hierarchy  {} nodes, {:.1} MiB, {:.0} bytes per triangle",
        geometry.nodes,
        geometry.bytes as f64 / f64::from(1 << 20),
        geometry.bytes_per_triangle()
    );
    println!("materials  {}", counted(scene.materials.iter().map(material_name)));
    println!("textures   {}", scene.textures.iter().count());
    println!("lights     {}", counted(scene.lights.iter().map(light_name)));
    println!("camera     {}", camera(scene));
    println!("motion     {}", motion(scene));
    println!("film       {}", film(scene));
    println!("sampling   {}", sampling(scene));
    println!("paths      {}", paths(scene));
    for diagnosis in scene.diagnose() {
        println!("warning    {diagnosis}");
    }
    Ok(Exit::Done)
}

/// `2 sphere, 1 rectangle`, in alphabetical order.
fn counted<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let mut counts = BTreeMap::<&str, usize>::new();
    for name in names {
        *counts.entry(name).or_default() += 1;
    }
    let parts: Vec<String> = counts.iter().map(|(name, count)| format!("{count} {name}")).collect();
    if parts.is_empty() { "none".to_owned() } else { parts.join(", ") }
}

fn with_degenerate(triangles: usize, degenerate: usize) -> String {
    match degenerate {
        0 => triangles.to_string(),
        _ => format!("{triangles}, and {degenerate} without area, which are never hit"),
    }
}

fn shape_name(shape: &Shape) -> &'static str {
    match shape {
        Shape::Mesh(_) => "mesh",
        Shape::Sphere(_) => "sphere",
        Shape::Rectangle(_) => "rectangle",
        Shape::Disk(_) => "disk",
        Shape::Cylinder(_) => "cylinder",
    }
}

fn material_name(material: &Material) -> &'static str {
    match material {
        Material::Diffuse { .. } => "diffuse",
        Material::RoughDiffuse { .. } => "rough diffuse",
        Material::DiffuseTransmitter { .. } => "diffuse transmitter",
        Material::Phong { .. } => "phong",
        Material::Dielectric { roughness: None, .. } => "dielectric",
        Material::Dielectric { .. } => "rough dielectric",
        Material::ThinDielectric { .. } => "thin dielectric",
        Material::Compensated { .. } => "with multiple scattering",
        Material::Conductor { roughness: None, .. } => "conductor",
        Material::Conductor { .. } => "rough conductor",
        Material::Plastic { .. } => "plastic",
        Material::Principled(_) => "principled",
        Material::PrincipledThin(_) => "thin principled",
        Material::Coated { .. } => "coated",
        Material::Mask { .. } => "mask",
        Material::Blend { .. } => "blend",
        Material::NormalMap { .. } => "normal map",
        Material::BumpMap { .. } => "bump map",
        Material::TwoSided { .. } => "two-sided",
        Material::Null => "null",
    }
}

fn light_name(light: &Light) -> &'static str {
    match light {
        Light::Area(_) => "area",
        Light::Beam(_) => "directional area",
        Light::Point(_) => "point",
        Light::Spot(_) => "spot",
        Light::Projector(_) => "projector",
        Light::Directional(_) => "directional",
        Light::Constant(_) => "constant",
        Light::Environment(_) => "environment map",
    }
}

fn camera(scene: &Scene) -> String {
    format!("{} at {}", scene.camera.name(), scene.camera.position())
}

/// What moves while the shutter is open.
fn motion(scene: &Scene) -> String {
    let shapes = match scene.geometry.moving_count() {
        0 => None,
        count => Some(format!("{count} of the shapes and instances")),
    };
    let camera = scene.camera.is_moving().then(|| "the camera".to_owned());
    let moving: Vec<String> = shapes.into_iter().chain(camera).collect();
    if moving.is_empty() { "none".to_owned() } else { moving.join(", ") }
}

fn film(scene: &Scene) -> String {
    let film = &scene.film;
    let [width, height] = film.size;
    let whole = film.crop.offset == [0, 0] && film.crop.size == film.size;
    let crop = if whole {
        String::new()
    } else {
        let ([x, y], [w, h]) = (film.crop.offset, film.crop.size);
        format!(", crop {w} × {h} at ({x}, {y})")
    };
    format!("{width} × {height}{crop}, {:?}", film.filter)
}

fn sampling(scene: &Scene) -> String {
    let sampling = &scene.sampling;
    format!(
        "{} samples per pixel, {:?}, seed {}",
        sampling.samples_per_pixel, sampling.sampler, sampling.seed
    )
}

fn paths(scene: &Scene) -> String {
    let depth = scene.path.max_depth.map_or("no limit".to_owned(), |d| format!("at most {d}"));
    format!("{depth} on the number of edges, roulette from {}", scene.path.roulette_depth)
}
