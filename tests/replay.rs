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
    let scene = scene.to_str().expect("UTF-8");
    // One light sample may lie behind the surface; not all of four.
    let mut all = String::new();
    for sample in 0..4 {
        let address = format!("15,20,{sample}");
        let told = Folder::new().run(&["render", scene, "--size", SIZE, "--replay", &address]);
        assert_eq!(told.exit, Some(0), "{}", told.stderr);
        let begin = format!("column 15, row 20, sample {sample}, seed 0\nedge 1\n  ray from (");
        assert!(told.stdout.starts_with(&begin), "{}", told.stdout);
        assert!(told.stdout.contains("\nradiance, weighted by the filter: "), "{}", told.stdout);
        all += &told.stdout;
    }
    for fragment in
        ["edge 2\n", "  to a light from (", "  brings ", "bsdf “twosided” at ", "scene.xml:29:3"]
    {
        assert!(all.contains(fragment), "{fragment:?} is missing in {all}");
    }
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

#[test]
fn where_paths_are_cut_is_said_by_what_they_carry() {
    let folder = Folder::new();
    let scene = repository("scenes/cornell-box/scene.xml");
    let scene = scene.to_str().expect("UTF-8");
    let fixed = ["render", scene, "--size", SIZE, "--spp", "4", "-o", "a.exr", "--json"];
    let cut = folder.succeed(&[&fixed[..], &["--max-depth", "2"]].concat());
    let json = cut.json();
    assert!(json["cut_throughput"].as_f64() > Some(0.1), "{json}");
    let from = json["cut_from"].as_array().expect("a list");
    let share = |entry: &serde_json::Value| entry["share"].as_f64().expect("a number");
    let all: f64 = from.iter().map(share).sum();
    assert!(from.len() > 1 && (all - 1.0).abs() < 1e-9, "{json}");
    assert!(from.is_sorted_by(|a, b| share(a) >= share(b)), "{json}");
    let first = from[0]["from"].as_str().expect("text");
    assert!(first.starts_with("bsdf “") && first.contains("scene.xml:"), "{first}");
    let said = format!("({:.0} % from {first}", 100.0 * share(&from[0]));
    assert!(cut.stderr.contains(&said), "{said}: {}", cut.stderr);
    let long = folder.succeed(&[&fixed[..], &["--max-depth", "-1"]].concat()).json();
    assert_eq!(long["cut_from"].as_array().map(Vec::len), Some(0), "nothing is cut: {long}");
}
