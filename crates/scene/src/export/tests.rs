//! What is written, piece by piece; `tests/convert.rs` of the repository converts whole scenes.

use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;
use std::path::Path;

use etendue_math::glam::{DMat3, DVec3};

use super::element::comment;
use super::names::Names;
use super::*;
use crate::geometry::TriangleMesh;
use crate::load::{TexCoords, parse_ply, parse_volume};
use crate::medium::VolumeGrid;
use crate::mitsuba::{LoadOptions, load_scene};

/// The scene of a file with this body.
fn scene(body: &str) -> Scene {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.xml");
    let text = format!("<scene version=\"3.0.0\">{body}</scene>");
    std::fs::write(&path, text).expect("a writable folder");
    load_scene(&path, &LoadOptions::default()).unwrap_or_else(|e| panic!("{body}: {e}")).scene
}

fn exported(body: &str) -> Export {
    export(scene(body), &ExportOptions::default()).expect("a conversion")
}

/// What is written of a scene that loses nothing.
fn xml(body: &str) -> String {
    let Export { xml, losses, .. } = exported(body);
    assert!(losses.is_empty(), "{body}: {losses:?}");
    xml
}

fn losses(body: &str) -> Vec<Loss> {
    exported(body).losses.into_iter().collect()
}

fn sphere_of(bsdf: &str) -> String {
    format!("<shape type=\"sphere\">{bsdf}</shape>")
}

#[test]
fn text_of_any_kind_is_well_formed() {
    let hostile = "a\"b<c>&--d$e\u{1}";
    let element = Element::value("string", "name", values::text(hostile));
    let mut text = String::new();
    element.write(0, &mut text);
    assert_eq!(text, "<string name=\"name\" value=\"a&quot;b&lt;c&gt;&amp;--d\\$e\"/>\n");
    assert_eq!(comment("a--b---c\n"), "a- -b- - -c");
    let options = ExportOptions { remark: hostile.into(), ..ExportOptions::default() };
    let body = "<shape type=\"sphere\" id=\"1 &quot;&lt;\\$x&amp;.\"/>";
    let Export { xml, .. } = export(scene(body), &options).expect("a conversion");
    let document = roxmltree::Document::parse(&xml).expect("well-formed");
    let shape = document.descendants().find(|node| node.has_tag_name("shape"));
    assert_eq!(shape.and_then(|node| node.attribute("id")), Some("1----x"));
}

#[test]
fn names_are_unique_whatever_the_letter_case_and_begin_with_no_underscore() {
    let mut names = Names::default();
    let wishes = ["Ball", "ball", "ball", "_x.y", "…", ""];
    let found = wishes.map(|wish| names.unique(wish));
    assert_eq!(found, ["Ball", "ball-2", "ball-3", "x-y", "unnamed", "unnamed-2"]);
}

#[test]
fn numbers_are_the_shortest_that_read_back() {
    let written = [values::number(0.1_f32), values::number(1.0_f32), values::number(-3.5e-9_f32)];
    assert_eq!(written, ["0.1", "1", "-3.5e-9"]);
    assert_eq!(values::number(0.1_f64 + 0.2), "0.30000000000000004");
}

#[test]
fn each_material_texture_and_medium_is_described_once() {
    let shared = "<texture type=\"checkerboard\" id=\"t\"/>\
        <bsdf type=\"diffuse\" id=\"m\"><ref id=\"t\" name=\"reflectance\"/></bsdf>\
        <medium type=\"homogeneous\" id=\"air\"/>\
        <integrator type=\"volpath\"/>";
    let shape = sphere_of("<ref id=\"m\"/><ref name=\"interior\" id=\"air\"/>");
    let text = xml(&format!("{shared}{shape}{shape}"));
    let count = |part: &str| text.matches(part).count();
    assert_eq!(count("<bsdf type=\"diffuse\" id=\"diffuse\">"), 1);
    assert_eq!(count("<texture type=\"checkerboard\" id=\"checkerboard\">"), 1);
    assert_eq!(count("<medium type=\"homogeneous\" id=\"medium\">"), 1);
    assert_eq!(
        (count("<ref id=\"diffuse\"/>"), count("<ref name=\"interior\" id=\"medium\"/>")),
        (2, 2)
    );
}

#[test]
fn what_no_shape_is_made_of_is_not_written_and_loses_nothing() {
    let text = xml(&format!("<bsdf type=\"roughdiffuse\" id=\"unused\"/>{}", sphere_of("")));
    assert!(!text.contains("roughdiffuse"), "{text}");
}

#[test]
fn facets_between_equal_indices_are_not_there() {
    let equal = "<float name=\"int_ior\" value=\"1.3\"/><float name=\"ext_ior\" value=\"1.3\"/>";
    let text = xml(&sphere_of(&format!("<bsdf type=\"roughdielectric\">{equal}</bsdf>")));
    // Mitsuba refuses rough ones.
    assert!(text.contains("<bsdf type=\"dielectric\""), "{text}");
}

#[test]
fn every_exact_form_is_a_loss() {
    let bsdf = |kind: &str, parameter: &str| {
        losses(&sphere_of(&format!("<bsdf type=\"{kind}\">{parameter}</bsdf>")))
    };
    let string = |name: &str, value: &str| format!("<string name=\"{name}\" value=\"{value}\"/>");
    for kind in ["roughconductor", "roughdielectric", "roughplastic"] {
        let [masking, lambda] = [("masking", "correlated"), ("smith_lambda", "exact")];
        assert_eq!(bsdf(kind, &string(masking.0, masking.1)), [Loss::ExactFacets], "{kind}");
        assert_eq!(bsdf(kind, &string(lambda.0, lambda.1)), [Loss::ExactFacets], "{kind}");
        assert_eq!(bsdf(kind, &string("distribution", "ggx")), [], "{kind}");
    }
    for kind in ["plastic", "roughplastic"] {
        let exact = string("internal_reflectance", "exact");
        assert_eq!(bsdf(kind, &exact), [Loss::ExactInternalReflectance], "{kind}");
        assert_eq!(bsdf(kind, ""), [], "{kind}");
    }
    assert_eq!(bsdf("roughdiffuse", ""), [Loss::RoughDiffuse]);
}

#[test]
fn films_and_samplers_lose_what_mitsuba_has_no_parameter_for() {
    let sensor = |inside: &str| losses(&format!("<sensor type=\"perspective\">{inside}</sensor>"));
    let film = |filter: &str| sensor(&format!("<film type=\"hdrfilm\">{filter}</film>"));
    let wide = "<rfilter type=\"box\"><float name=\"radius\" value=\"1\"/></rfilter>";
    assert_eq!(film(wide), [Loss::BoxFilter]);
    assert_eq!(film("<rfilter type=\"box\"/>"), []);
    let seed = |seed: &str| {
        sensor(&format!(
            "<sampler type=\"independent\"><integer name=\"seed\" value=\"{seed}\"/></sampler>"
        ))
    };
    assert_eq!((seed("4294967295"), seed("4294967296")), (vec![], vec![Loss::Seed]));
}

#[test]
fn one_light_surrounds_a_scene_and_any_number_of_directions_shine() {
    let sun = "<emitter type=\"directional\"/>";
    let sky = "<emitter type=\"constant\"/>";
    let Export { xml, losses, .. } = exported(&format!("{sun}{sky}{sun}{sky}"));
    assert_eq!(losses, [Loss::SecondBackground].into());
    let count = |kind: &str| xml.matches(&format!("<emitter type=\"{kind}\">")).count();
    assert_eq!((count("directional"), count("constant")), (2, 1));
}

#[test]
fn a_camera_that_is_scaled_is_written_without() {
    let sensor = |matrix: &str| {
        format!(
            "<sensor type=\"thinlens\"><float name=\"aperture_radius\" value=\"0.25\"/>\
             <float name=\"focus_distance\" value=\"3\"/>\
             <transform name=\"to_world\">{matrix}</transform></sensor>"
        )
    };
    let turned = "<rotate y=\"1\" angle=\"90\"/><translate x=\"5\"/>";
    let plain = scene(
        &xml(&sensor(turned)).split_once("3.0.0\">").expect("a scene").1.replace("</scene>", ""),
    );
    let scaled = xml(&sensor(&format!("<scale value=\"2\"/>{turned}")));
    let scaled = scene(&scaled.split_once("3.0.0\">").expect("a scene").1.replace("</scene>", ""));
    for film in [[0.0, 0.0], [768.0, 576.0], [100.0, 300.0]] {
        let at = |scene: &Scene, lens| scene.camera.ray(film, lens);
        let (a, b) = (at(&plain, [0.5; 2]), at(&scaled, [0.5; 2]));
        // Rounding of unit vectors.
        assert!((a.direction - b.direction).length() < 1e-6, "{a:?} {b:?}");
    }
    // A lens that is scaled by 2 is twice as large and in focus twice as far.
    let crate::camera::Projection::ThinLens { aperture_radius, focus_distance, .. } =
        scaled.camera.projection()
    else {
        panic!("{:?}", scaled.camera)
    };
    assert_eq!((aperture_radius, focus_distance), (0.5, 6.0));
    let lengths = |m: &DMat3| [m.x_axis, m.y_axis, m.z_axis].map(DVec3::length);
    for length in lengths(&scaled.camera.to_world().affine().matrix3) {
        assert!((length - 1.0).abs() < 1e-12, "{length}");
    }
    let stretched = sensor(&format!("<scale x=\"2\" y=\"1\" z=\"1\"/>{turned}"));
    assert_eq!(losses(&stretched), [Loss::StretchedCamera]);
}

#[test]
fn spectra_are_curves_where_paths_carry_wavelengths_and_colours_elsewhere() {
    let body = |spectral: bool| {
        let lamp = "<emitter type=\"area\"><spectrum name=\"radiance\" value=\"2\"/></emitter>";
        let metal =
            "<bsdf type=\"conductor\"><spectrum name=\"eta\" value=\"400:1.5, 700:2.5\"/></bsdf>";
        format!(
            "<integrator type=\"path\"><boolean name=\"spectral\" value=\"{spectral}\"/></integrator>\
             {}{}",
            sphere_of(metal),
            sphere_of(lamp)
        )
    };
    let text = xml(&body(false));
    assert!(text.contains("<rgb name=\"eta\"") && !text.contains("<spectrum"), "{text}");
    let Export { xml, losses, .. } = exported(&body(true));
    assert_eq!(losses, [Loss::Effect(crate::Effect::SpectralColours)].into());
    assert!(xml.contains("<spectrum name=\"eta\" value=\"400:1.5, 700:2.5\"/>"), "{xml}");
    assert!(xml.contains("<spectrum name=\"radiance\" value=\"2\"/>"), "{xml}");
}

#[test]
fn integrators_are_those_that_see_what_there_is() {
    let beam = "<shape type=\"disk\"><emitter type=\"directionalarea\"/></shape>";
    let medium = sphere_of("<medium name=\"interior\" type=\"homogeneous\"/>");
    let colour = "<rgb name=\"sigma_t\" value=\"0.1 0.2 0.3\"/>";
    let coloured = medium.replace("/></shape>", &format!(">{colour}</medium></shape>"));
    let volpath = |body: &str| format!("<integrator type=\"volpath\"/>{body}");
    for (body, kind) in [
        (sphere_of(""), "path"),
        (beam.into(), "ptracer"),
        (volpath(&medium), "volpath"),
        (volpath(&coloured), "volpathmis"),
        ("<integrator type=\"depth\"/>".into(), "depth"),
    ] {
        let text = xml(&body);
        assert!(text.contains(&format!("<integrator type=\"{kind}\"")), "{text}");
        // Roulette begins where it did.
        assert!(!text.contains("rr_depth"), "{text}");
    }
    let layers = vec![Layer::Uv, Layer::Normal];
    let options = ExportOptions { layers, ..ExportOptions::default() };
    let text = export(scene(""), &options).expect("a conversion").xml;
    assert!(text.contains("<string name=\"aovs\" value=\"uv:uv,sh_normal:sh_normal\"/>"), "{text}");
}

#[test]
fn an_extinction_above_1_has_a_scale_beside_it() {
    let medium = "<medium name=\"interior\" type=\"homogeneous\"><rgb name=\"sigma_t\" value=\"1 3 10\"/></medium>";
    let text = xml(&format!("<integrator type=\"volpath\"/>{}", sphere_of(medium)));
    assert!(text.contains("<rgb name=\"sigma_t\" value=\"0.0625 0.1875 0.625\"/>"), "{text}");
    assert!(text.contains("<float name=\"scale\" value=\"16\"/>"), "{text}");
}

#[test]
fn meshes_keep_their_bits_and_their_attributes() {
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
        property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\n\
        property float r\nproperty float g\nproperty float b\nproperty float w_0\n\
        element face 1\nproperty list uchar int vertex_indices\nproperty float t_x\nend_header\n\
        0.1 0 0 0 0 1 0.5 0.25 1 2 3 4\n1 1e-30 0 0 1 0 0 1 0 0 0 5\n0 1 3e30 1 0 0 1 1 4 5 6 7\n3 0 1 2 9\n";
    let path = Path::new("mesh.ply");
    let read = |bytes: &[u8]| {
        TriangleMesh::from(parse_ply(bytes, path, TexCoords::AsWritten).expect("a mesh").mesh)
    };
    let mesh = read(text.as_bytes());
    let names: Vec<_> = mesh.attributes().iter().map(|a| a.name.as_str()).collect();
    assert_eq!(names, ["vertex_color", "vertex_w", "face_t"]);
    assert_eq!(read(&mesh::ply(&mesh)), mesh);
}

#[test]
fn grids_keep_their_bits() {
    for channels in [1, 3] {
        let values = (0..2 * 3 * 4 * channels).map(|i| (i * i) as f32 * 0.1).collect();
        let grid = VolumeGrid::new([2, 3, 4], channels, values).expect("a grid");
        let read = parse_volume(&volumes::vol(&grid), Path::new("grid.vol")).expect("a volume");
        assert_eq!(read.grid, grid);
    }
}
