//! Tests of loading as a whole.

mod examples;
mod materials;
mod media;
mod motion;
mod shapes;

use alloc::format;
use alloc::string::{String, ToString};
use std::path::Path;

use etendue_math::glam::Vec3;

use super::{Context, LoadOptions, LoadedScene, load_scene, scene};
use crate::film::{Crop, ReconstructionFilter};
use crate::geometry::Shape;
use crate::light::Light;
use crate::load::Sandbox;
use crate::material::{ConductorIndex, Material};
use crate::medium::{Boundary, Extinction, MediumId, Phase};
use crate::scene::SamplerKind;
use crate::texture::Texture;
use crate::xml::{Leniency, parse_text};
use crate::{ErrorKind, SceneError};

fn load_with(content: &str, options: &LoadOptions) -> Result<LoadedScene, SceneError> {
    let text = format!("<scene version=\"3.0.0\">\n{content}\n</scene>");
    let description = parse_text(&text, Path::new("scene.xml"), &[], options.leniency)?;
    scene::scene(Context::new(&description, options, Sandbox::default()))
}

fn load(content: &str) -> Result<LoadedScene, SceneError> {
    load_with(content, &LoadOptions::default())
}

/// The material of a sphere made of `bsdf`.
fn material(bsdf: &str) -> (Material, LoadedScene) {
    let loaded = load(&format!("<shape type=\"sphere\">{bsdf}</shape>")).expect(bsdf);
    let id = loaded.scene.surfaces[0].material;
    (loaded.scene.materials.get(id).expect("a material").clone(), loaded)
}

fn light(emitter: &str) -> Light {
    load(emitter).expect(emitter).scene.lights.remove(0)
}

/// Asserts that `content`, whose first line is line 2 of the file, is refused there.
fn refused(content: &str, line: u32, fragment: &str) {
    let error = load(content).expect_err(content);
    assert!(error.to_string().contains(fragment), "{error}");
    assert_eq!(error.location.line, Some(line), "{error}");
}

#[test]
fn unknown_plugins_and_parameters_are_named_with_those_that_exist() {
    refused(
        "<shape type=\"sphere\">\n<bsdf type=\"fur\"/></shape>",
        3,
        "the bsdf “fur” is not supported; supported are blendbsdf, bumpmap, coating",
    );
    refused("<bsdf type=\"difuse\"/>", 2, "did you mean “diffuse”?");
    refused(
        "<bsdf type=\"diffuse\">\n<rgb name=\"reflectence\" value=\"1\"/></bsdf>",
        3,
        "bsdf “diffuse” has no parameter “reflectence”; did you mean “reflectance”?",
    );
    refused(
        "<emitter type=\"point\"><medium type=\"homogeneous\"/></emitter>",
        2,
        "cannot use a medium",
    );
    refused("<integrator type=\"prb\"/>", 2, "the integrator “prb” is not supported");
    refused("<shape type=\"hair\"/>", 2, "the shape “hair” is not supported");
}

#[test]
fn a_lenient_reader_warns_about_unknown_parameters() {
    let options = LoadOptions { leniency: Leniency::Lenient, ..LoadOptions::default() };
    let bsdf = "<bsdf type=\"diffuse\"><float name=\"shine\" value=\"1\"/></bsdf>";
    let loaded = load_with(bsdf, &options).expect("a lenient reader");
    assert!(loaded.warnings[0].to_string().starts_with("scene.xml:2:"), "{}", loaded.warnings[0]);
    assert!(loaded.warnings[0].message.contains("“shine”"));
}

#[test]
fn values_out_of_their_domain_are_refused_where_they_stand() {
    let bsdf =
        |plugin: &str, parameter: &str| format!("<bsdf type=\"{plugin}\">\n{parameter}\n</bsdf>");
    for (plugin, parameter, fragment) in [
        ("roughconductor", "<float name=\"alpha\" value=\"-1\"/>", "must not be negative"),
        ("roughplastic", "<float name=\"alpha\" value=\"-1\"/>", "“alpha”"),
        ("dielectric", "<float name=\"int_ior\" value=\"0\"/>", "“int_ior” must be positive"),
        ("dielectric", "<string name=\"int_ior\" value=\"watr\"/>", "did you mean “water”?"),
        ("conductor", "<string name=\"material\" value=\"Unobtainium\"/>", "no known conductor"),
        ("diffuse", "<string name=\"reflectance\" value=\"red\"/>", "must be a number, a colour"),
        ("plastic", "<float name=\"nonlinear\" value=\"1\"/>", "must be a boolean, not a float"),
        ("roughconductor", "<string name=\"distribution\" value=\"phong\"/>", "beckmann, ggx"),
    ] {
        refused(&bsdf(plugin, parameter), 3, fragment);
    }
    for (shape, parameter, line, fragment) in [
        ("sphere", "<float name=\"radius\" value=\"0\"/>", 3, "“radius” must be positive"),
        (
            "cube",
            "<transform name=\"to_world\"><scale x=\"0\"/></transform>",
            3,
            "the transform is singular",
        ),
        (
            "cube",
            "<transform name=\"to_world\"><matrix value=\"1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1\"/></transform>",
            3,
            "last row",
        ),
        ("obj", "<string name=\"filename\" value=\"none.obj\"/>", 2, "none.obj"),
    ] {
        let content = format!("<shape type=\"{shape}\">\n{parameter}</shape>");
        let error = load(&content).expect_err(&content);
        assert!(error.to_string().contains(fragment), "{error}");
        let place = format!("scene.xml:{line}");
        assert!(error.to_string().contains(&place), "{error}");
    }
}

#[test]
fn reflectances_out_of_range_are_clamped_with_a_warning() {
    let (material, loaded) =
        material("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"1.5 0.5 -1\"/></bsdf>");
    let Material::Diffuse { reflectance } = material else { panic!("{material:?}") };
    assert_eq!(loaded.scene.textures.mean(reflectance).to_array(), [1.0, 0.5, 0.0]);
    let warning = loaded.warnings[0].to_string();
    assert!(warning.contains("scene.xml:2") && warning.contains("clamped"), "{warning}");
}

#[test]
fn emitters_have_their_parameters() {
    match light(
        "<emitter type=\"point\"><point name=\"position\" value=\"1 2 3\"/>\
         <rgb name=\"intensity\" value=\"4\"/></emitter>",
    ) {
        Light::Point(light) => {
            assert_eq!(light.position, Vec3::new(1.0, 2.0, 3.0));
            assert_eq!(light.intensity.to_array(), [4.0; 3]);
        }
        other => panic!("{other:?}"),
    }
    match light(
        "<emitter type=\"directional\"><transform name=\"to_world\">\
         <lookat origin=\"0 0 0\" target=\"5 0 0\" up=\"0 1 0\"/></transform></emitter>",
    ) {
        Light::Directional(light) => assert_eq!(light.direction, Vec3::X),
        other => panic!("{other:?}"),
    }
    assert!(matches!(light("<emitter type=\"constant\"/>"), Light::Constant(_)));
    assert!(matches!(light("<emitter type=\"spot\"/>"), Light::Spot(_)));
    assert!(matches!(light("<emitter type=\"projector\"/>"), Light::Projector(_)));
    refused("<emitter type=\"area\"/>", 2, "must stand inside a shape");
    refused(
        "<emitter type=\"point\"><point name=\"position\" value=\"1\"/>\
         <transform name=\"to_world\"/></emitter>",
        2,
        "give either “position” or “to_world”",
    );
    refused(
        "<emitter type=\"directional\"><vector name=\"direction\" value=\"0\"/></emitter>",
        2,
        "the direction has no length",
    );
    refused(
        "<emitter type=\"spot\">\n<float name=\"cutoff_angle\" value=\"-3\"/></emitter>",
        3,
        "cutoff",
    );
    refused(
        "<emitter type=\"projector\">\n<float name=\"fov\" value=\"180\"/></emitter>",
        3,
        "must lie between 0 and 180 degrees",
    );
    refused(
        "<emitter type=\"projector\">\n<string name=\"focal_length\" value=\"0mm\"/></emitter>",
        3,
        "the field of view must lie between 0° and 180°",
    );
    refused(
        "<emitter type=\"projector\">\n<float name=\"scale\" value=\"-1\"/></emitter>",
        3,
        "not negative",
    );
}

#[test]
fn an_area_light_is_a_shape_and_without_bsdf_it_is_black() {
    let loaded = load("<shape type=\"rectangle\" id=\"lamp\"><emitter type=\"area\">\
         <spectrum name=\"radiance\" value=\"400:0, 500:8, 600:15.6, 700:18.4\"/></emitter></shape>")
    .expect("a light");
    let scene = &loaded.scene;
    assert_eq!(scene.surfaces[0].name, "lamp");
    let Light::Area(light) = &scene.lights[0] else { panic!() };
    // Mitsuba 3.9.1, scalar_rgb, to six digits.
    for (ours, theirs) in
        scene.textures.mean(light.radiance).to_array().into_iter().zip([20.7108, 10.8546, 2.77115])
    {
        assert!((ours / theirs - 1.0).abs() < 2e-5);
    }
    let Some(Material::Diffuse { reflectance }) = scene.materials.get(scene.surfaces[0].material)
    else {
        panic!()
    };
    assert_eq!(scene.textures.mean(*reflectance).to_array(), [0.0; 3]);
}

#[test]
fn groups_are_shared_by_instances() {
    let group = "<shape type=\"shapegroup\" id=\"g\"><shape type=\"sphere\"/>\
                 <shape type=\"cube\"/></shape>";
    let instances = "<shape type=\"instance\"><ref id=\"g\"/></shape>".repeat(2);
    let loaded = load(&format!("{instances}{group}")).expect("instances");
    assert_eq!(loaded.scene.surfaces.len(), 2);
    assert!(matches!(loaded.scene.geometry.shapes()[0], Shape::Sphere(_)));
    refused(
        "<shape type=\"shapegroup\"><shape type=\"sphere\"><emitter type=\"area\"/></shape></shape>",
        2,
        "a shapegroup cannot contain emitters",
    );
    refused("<shape type=\"instance\"/>", 2, "the instance has no shapegroup");
    refused(
        "<shape type=\"instance\"><shape type=\"sphere\"/></shape>",
        2,
        "an instance needs a shapegroup",
    );
}

#[test]
fn sensors_bring_film_filter_and_sampler() {
    let loaded = load(
        "<integrator type=\"moment\"><integrator type=\"direct\"/></integrator>
        <sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/>
        <film type=\"hdrfilm\"><integer name=\"width\" value=\"20\"/>
        <integer name=\"height\" value=\"10\"/><integer name=\"crop_offset_x\" value=\"5\"/>
        <rfilter type=\"tent\"/></film>
        <sampler type=\"independent\"><integer name=\"sample_count\" value=\"7\"/></sampler></sensor>",
    )
    .expect("a sensor");
    let scene = &loaded.scene;
    assert_eq!(scene.film.size, [20, 10]);
    assert_eq!(scene.film.crop, Crop { offset: [5, 0], size: [15, 10] });
    assert_eq!(scene.film.filter, ReconstructionFilter::Tent { radius: 1.0 });
    assert_eq!(scene.sampling.samples_per_pixel, 7);
    assert_eq!(scene.sampling.sampler, SamplerKind::Independent);
    assert_eq!(scene.path.max_depth, Some(2));
}

#[test]
fn mitchell_and_netravali_call_their_parameters_b_and_c() {
    let filter = |parameters: &str| {
        let content = format!(
            "<sensor type=\"perspective\"><film type=\"hdrfilm\">
            <rfilter type=\"mitchell\">{parameters}</rfilter></film></sensor>"
        );
        load(&content).expect("a filter").scene.film.filter
    };
    let third = 1.0 / 3.0;
    assert_eq!(filter(""), ReconstructionFilter::Mitchell { b: third, c: third });
    let b = filter("<float name=\"B\" value=\"0.75\"/>");
    assert_eq!(b, ReconstructionFilter::Mitchell { b: 0.75, c: third });
    let c = filter("<float name=\"C\" value=\"0.75\"/>");
    assert_eq!(c, ReconstructionFilter::Mitchell { b: third, c: 0.75 });
}

#[test]
fn sensors_that_see_nothing_are_refused() {
    let sensor = |content: &str| format!("<sensor type=\"perspective\">\n{content}</sensor>");
    let film = |content: &str| sensor(&format!("<film type=\"hdrfilm\">\n{content}</film>"));
    for fov in ["0", "180", "-5"] {
        let content = sensor(&format!("<float name=\"fov\" value=\"{fov}\"/>"));
        refused(&content, 3, "“fov” must lie between 0 and 180");
    }
    refused(&film("<integer name=\"width\" value=\"0\"/>"), 4, "its width is 0");
    refused(&film("<integer name=\"width\" value=\"-4\"/>"), 4, "cannot be -4 pixels");
    refused(&film("<integer name=\"crop_width\" value=\"1000\"/>"), 4, "exceeds the film");
    let error = load(&film("<integer name=\"width\" value=\"2147483648\"/>")).expect_err("huge");
    assert_eq!(error.kind, ErrorKind::Resource);
    refused(
        &sensor("<sampler type=\"sobol\"><integer name=\"sample_count\" value=\"0\"/></sampler>"),
        3,
        "“sample_count” must be from 1",
    );
    refused(&sensor("<string name=\"focal_length\" value=\"long\"/>"), 3, "no focal length");
    refused(
        "<integrator type=\"path\"><integer name=\"max_depth\" value=\"-2\"/></integrator>",
        2,
        "“max_depth” must be −1",
    );
}

#[test]
fn the_caller_overrides_the_file() {
    let options = LoadOptions {
        film_size: Some([8, 4]),
        samples_per_pixel: Some(3),
        max_depth: Some(9),
        sampler: Some(SamplerKind::Independent),
        seed: Some(5),
        ..LoadOptions::default()
    };
    let sensor = "<sensor type=\"orthographic\"><film type=\"hdrfilm\">\
                  <integer name=\"crop_offset_x\" value=\"5\"/></film></sensor>";
    for content in [sensor, ""] {
        let scene = load_with(content, &options).expect("a scene").scene;
        assert_eq!(scene.film.crop, Crop { offset: [0, 0], size: [8, 4] });
        assert_eq!((scene.sampling.samples_per_pixel, scene.sampling.seed), (3, 5));
        assert_eq!(scene.sampling.sampler, SamplerKind::Independent);
        assert_eq!(scene.path.max_depth, Some(9));
    }
}

#[test]
fn textures_are_translated_once() {
    let loaded = load(
        "<texture type=\"checkerboard\" id=\"t\"/>
        <bsdf type=\"diffuse\" id=\"a\"><ref name=\"reflectance\" id=\"t\"/></bsdf>
        <shape type=\"sphere\"><bsdf type=\"diffuse\"><ref name=\"reflectance\" id=\"t\"/></bsdf></shape>
        <shape type=\"sphere\"><ref id=\"a\"/></shape>",
    )
    .expect("textures");
    let reflectance =
        |shape: usize| match loaded.scene.materials.get(loaded.scene.surfaces[shape].material) {
            Some(Material::Diffuse { reflectance }) => *reflectance,
            other => panic!("{other:?}"),
        };
    assert_eq!(reflectance(0), reflectance(1));
    let texture = loaded.scene.textures.get(reflectance(0));
    assert!(matches!(texture, Some(Texture::Checkerboard(_))));
}

/// A mesh file in a folder of its own.
fn mesh_file(name: &str, content: &str) -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join(name);
    std::fs::write(&path, content).expect("a writable folder");
    (folder, path)
}

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

#[test]
fn a_bare_mesh_is_seen_whole_and_lit() {
    let (_folder, path) = mesh_file("a.obj", TRIANGLE);
    let loaded = load_scene(&path, &LoadOptions::default()).expect("a mesh");
    let scene = &loaded.scene;
    assert!(matches!(scene.lights[..], [Light::Constant(_)]));
    assert_eq!(loaded.files, [path]);
    let [width, height] = scene.film.size.map(|n| n as f32);
    // The ray through the middle of the picture meets the middle of the bounding box.
    let ray = scene.camera.ray([0.5 * width, 0.5 * height], [0.5; 2]);
    let hit = scene.geometry.intersect(&ray).expect("the triangle's edge or the triangle");
    assert!((scene.geometry.surface_point(&ray, &hit).position.z).abs() < 1e-4);
    // Rays through the border of the picture miss its bounding sphere.
    let border = scene.camera.ray([0.5 * width, 0.0], [0.5; 2]);
    assert!(!scene.geometry.occluded(&border));
}

#[test]
fn the_bsdf_of_a_bare_mesh_can_be_chosen() {
    let (_folder, path) = mesh_file("a.obj", TRIANGLE);
    let with = |bsdf: &str| {
        load_scene(&path, &LoadOptions { bsdf: Some(bsdf.to_string()), ..LoadOptions::default() })
    };
    let kind = |bsdf: &str| {
        let scene = with(bsdf).expect(bsdf).scene;
        scene.materials.get(scene.surfaces[0].material).cloned()
    };
    assert!(matches!(
        kind("roughconductor:material=Au,alpha=0.2"),
        Some(Material::TwoSided { .. })
    ));
    assert!(matches!(kind("dielectric"), Some(Material::Dielectric { .. })));
    for (bsdf, fragment) in [
        ("glass", "--bsdf:1:24: the bsdf “glass” is not supported"),
        ("diffuse:colour=red", "bsdf “diffuse” has no parameter “colour”"),
        ("diffuse:reflectance", "must be a number, a colour"),
    ] {
        let error = with(bsdf).expect_err(bsdf).to_string();
        assert!(error.contains(fragment), "{error}");
    }
}

#[test]
fn files_of_other_kinds_are_refused() {
    let (_folder, path) = mesh_file("a.fbx", "{}");
    let error = load_scene(&path, &LoadOptions::default()).expect_err("no scene").to_string();
    assert!(error.contains("bare meshes .obj or .ply"), "{error}");
}

#[test]
fn a_scene_file_names_its_mesh_relative_to_itself() {
    let (folder, mesh) = mesh_file("a.obj", TRIANGLE);
    let path = folder.path().join("scene.xml");
    let text: String = "<scene version=\"0.6.0\"><shape type=\"obj\">\
        <string name=\"filename\" value=\"a.obj\"/><boolean name=\"faceNormals\" value=\"true\"/>\
        </shape></scene>"
        .into();
    std::fs::write(&path, text).expect("a writable folder");
    let loaded = load_scene(&path, &LoadOptions::default()).expect("a scene");
    assert_eq!(loaded.files, [path, mesh]);
    let Shape::Mesh(mesh) = &loaded.scene.geometry.shapes()[0] else { panic!() };
    assert!(mesh.normals().is_empty());
}
