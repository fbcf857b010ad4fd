//! One sample of a render, told ray by ray.

mod common;

use common::{Folder, repository};

const SIZE: &str = "31x23";

#[test]
fn a_replayed_sample_is_the_one_of_the_picture() {
    let folder = Folder::new();
    for scene in ["scenes/cornell-box/scene.xml", "scenes/glass-and-metal.xml"] {
        let scene = repository(scene);
        let picture = folder.render(&scene, &["--size", SIZE, "--spp", "1", "--seed", "9"]);
        for [x, y] in [[0, 0], [15, 11], [20, 17], [30, 22]] {
            let address = format!("{x},{y},0");
            let scene = scene.to_str().expect("UTF-8");
            let fixed = ["render", scene, "--size", SIZE, "--spp", "1", "--seed", "9"];
            let told = folder.run(&[&fixed[..], &["--replay", &address, "--json"]].concat());
            assert_eq!(told.exit, Some(0), "{}", told.stderr);
            let json = told.json();
            let radiance: Vec<f32> =
                serde_json::from_value(json["radiance"].clone()).expect("three");
            assert_eq!(radiance[..], picture.pixel(x, y), "{scene} {x} {y}");
            let edges = json["edges"].as_array().expect("edges");
            assert_eq!(edges.last().expect("one at least")["radiance"], json["radiance"]);
            assert_eq!(edges[0]["rays"].as_array().map(Vec::len), Some(1), "the camera's");
        }
    }
}

#[test]
fn it_says_what_the_path_meets_and_where_that_is_described() {
    let scene = repository("scenes/cornell-box/scene.xml");
    let arguments =
        ["render", scene.to_str().expect("UTF-8"), "--size", SIZE, "--replay", "15,20,2"];
    let told = Folder::new().run(&arguments);
    assert_eq!(told.exit, Some(0), "{}", told.stderr);
    for line in [
        "column 15, row 20, sample 2, seed ",
        "edge 1\n  ray from (",
        "edge 2\n  to a light",
        "brings ",
        "radiance",
    ] {
        assert!(told.stdout.contains(line), "{line:?} is missing in {}", told.stdout);
    }
    assert!(told.stdout.contains("bsdf “diffuse” at ") && told.stdout.contains("scene.xml:"));
}

#[test]
fn a_sample_outside_the_film_and_one_with_a_picture_are_refused() {
    let scene = repository("scenes/cornell-box/scene.xml");
    let scene = scene.to_str().expect("UTF-8");
    let cases: [(&[&str], &str); 3] = [
        (&["--replay", "31,0,0"], "the film has 31 columns and 23 rows"),
        (&["--replay", "1,2"], "expected column, row and number of a sample"),
        (&["--replay", "1,2,3", "-o", "x.exr"], "cannot be used with"),
    ];
    for (arguments, says) in cases {
        let fixed = ["render", scene, "--size", SIZE];
        let outcome = Folder::new().run(&[&fixed[..], arguments].concat());
        assert_eq!(outcome.exit, Some(2), "{}", outcome.stderr);
        assert!(outcome.stderr.contains(says), "{}", outcome.stderr);
    }
}
