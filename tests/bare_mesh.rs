//! Meshes rendered without a scene file.

mod common;

use common::{Folder, Outcome, Picture};

/// A square of side 2 in the plane z = 0, seen from above right.
const OBJ: &str = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";

const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
    property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
    -1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n4 0 1 2 3\n";

fn run(name: &str, text: &str, arguments: &[&str]) -> (Folder, Outcome) {
    let folder = Folder::new();
    folder.write(name, text);
    let fixed = ["render", name, "-o", "out.pfm", "--quiet", "--size", "33x33"];
    let outcome = folder.run(&[&fixed, arguments].concat());
    (folder, outcome)
}

fn render(name: &str, text: &str, arguments: &[&str]) -> Picture {
    let (folder, outcome) = run(name, text, arguments);
    assert_eq!(outcome.exit, Some(0), "{name} {arguments:?}: {}", outcome.stderr);
    assert_eq!(outcome.warnings(), [""; 0], "{name} {arguments:?}");
    Picture::read_pfm(&folder.path("out.pfm"))
}

/// Renders one pixel only.
fn pixel(name: &str, text: &str, crop: &str, arguments: &[&str]) -> [f32; 3] {
    let fixed = ["--crop", crop, "--spp", "4096"];
    render(name, text, &[&fixed, arguments].concat()).pixel(0, 0)
}

/// The pixel in the middle of the picture, which shows the middle of the square.
const MIDDLE: &str = "16,16,1,1";
/// A pixel beside it.
const CORNER: &str = "0,0,1,1";

/// Light is sampled in two ways whose combination has, for a diffuse surface under a constant sky, a
/// standard deviation of about 0.14 of the value per sample; with 4096 samples, five standard errors
/// are 1.1 %. Mirrors have no noise.
const TOLERANCE: f32 = 0.011;

#[track_caller]
fn assert_close(actual: [f32; 3], expected: [f32; 3]) {
    let near = actual.iter().zip(expected).all(|(a, e)| (a - e).abs() <= TOLERANCE * e);
    assert!(near, "{actual:?} instead of {expected:?}");
}

#[test]
fn a_mesh_without_material_reflects_a_half_before_a_white_sky() {
    for (name, text) in [("mesh.obj", OBJ), ("mesh.ply", PLY)] {
        assert_close(pixel(name, text, MIDDLE, &[]), [0.5; 3]);
        assert_close(pixel(name, text, CORNER, &[]), [1.0; 3]);
    }
}

#[test]
fn the_same_mesh_in_either_format_gives_the_same_picture() {
    let [obj, ply] = [("mesh.obj", OBJ), ("mesh.ply", PLY)]
        .map(|(name, text)| render(name, text, &["--spp", "4"]));
    assert_eq!(obj.bits(), ply.bits());
}

#[test]
fn the_diffuse_colours_of_an_mtl_file_are_used() {
    let folder = Folder::new();
    folder.write("mesh.mtl", "newmtl paint\nKd 0.8 0.4 0.2\n");
    folder.write("mesh.obj", format!("mtllib mesh.mtl\nusemtl paint\n{OBJ}"));
    let arguments = ["--size", "33x33", "--crop", MIDDLE, "--spp", "4096"];
    let picture = folder.render("mesh.obj".as_ref(), &arguments);
    assert_close(picture.pixel(0, 0), [0.8, 0.4, 0.2]);
}

#[test]
fn the_bsdf_of_the_command_line_replaces_every_material() {
    let with = |bsdf| pixel("mesh.obj", OBJ, MIDDLE, &["--bsdf", bsdf]);
    assert_close(with("diffuse:reflectance=0.25"), [0.25; 3]);
    assert_close(with("diffuse:reflectance=0.8 0.2 0.1"), [0.8, 0.2, 0.1]);
    // A mirror reflects the sky whole, and a dielectric divides it between two directions in which
    // there is the same sky.
    assert_close(with("conductor"), [1.0; 3]);
    assert_close(with("thindielectric:int_ior=1.5"), [1.0; 3]);
}

#[test]
fn a_rough_metal_has_its_colour() {
    // Gold reflects more than 0.9 of red light and less than 0.4 of blue.
    let bsdf = ["--bsdf", "roughconductor:material=Au,alpha=0.2"];
    let [red, green, blue] = pixel("mesh.obj", OBJ, MIDDLE, &bsdf);
    assert!(red > green && green > blue && red > 2.0 * blue, "{red} {green} {blue}");
    assert!(red < 1.0, "gold absorbs: {red}");
}

#[test]
fn a_bsdf_that_does_not_exist_is_an_error_that_names_those_that_do() {
    for (bsdf, fragments) in [
        ("nonsense", ["“nonsense”", "roughconductor", "diffuse"]),
        ("diffuse:shine=1", ["“shine”", "reflectance", "diffuse"]),
        ("roughconductor:alpha=-1", ["“alpha”", "negative", "-1"]),
        ("", ["bsdf", "supported", "diffuse"]),
    ] {
        let (folder, outcome) = run("mesh.obj", OBJ, &["--bsdf", bsdf]);
        assert_eq!(outcome.exit, Some(3), "{bsdf}: {}", outcome.stderr);
        let [error] = &outcome.errors()[..] else { panic!("one error: {}", outcome.stderr) };
        for fragment in fragments {
            assert!(error.contains(fragment), "{bsdf}: {fragment} in {error}");
        }
        assert_eq!(folder.names(), ["mesh.obj"]);
    }
}

#[test]
fn info_counts_what_a_mesh_holds() {
    let folder = Folder::new();
    folder.write("mesh.obj", OBJ);
    let outcome = folder.run(&["info", "mesh.obj"]);
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    for line in ["shapes     1 mesh", "triangles  2", "lights     1 constant"] {
        assert!(outcome.stdout.contains(line), "{line:?} in\n{}", outcome.stdout);
    }
}
