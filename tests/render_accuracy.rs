//! Accuracy and layers as the command offers them.

mod common;

use std::path::Path;

use common::case::messages;
use common::{Folder, Outcome, Picture, scene};
use exr::meta::MetaData;
use exr::meta::attribute::AttributeValue;
use exr::prelude::{AnyChannels, FlatSamples, Image, Layer, ReadChannels, ReadLayers, read};

/// A ball under a lamp, before nothing.
fn folder() -> Folder {
    let folder = Folder::new();
    folder.write(
        "scene.xml",
        scene(
            r#"<shape type="sphere"><bsdf type="diffuse"><rgb name="reflectance" value="0.5, 0.25, 0.125"/></bsdf></shape>
            <shape type="sphere"><point name="center" x="1" y="2" z="3"/><float name="radius" value="0.5"/>
            <emitter type="area"><rgb name="radiance" value="8"/></emitter></shape>"#,
        ),
    );
    folder
}

fn render(folder: &Folder, output: &str, arguments: &[&str]) -> Outcome {
    let fixed = ["render", "scene.xml", "--size", "24x16", "-o", output, "--json"];
    let outcome = folder.run(&[&fixed[..], arguments].concat());
    assert_eq!(outcome.exit, Some(0), "{arguments:?}: {}", outcome.stderr);
    outcome
}

fn number(json: &serde_json::Value, path: &str) -> f64 {
    json.pointer(path)
        .and_then(serde_json::Value::as_f64)
        .unwrap_or_else(|| panic!("{path}: {json}"))
}

#[test]
fn a_render_ends_at_the_error_asked_for_and_says_so() {
    let folder = folder();
    for (asked, bound) in [("5%", 0.05), ("0.04", 0.04)] {
        let outcome = render(&folder, "out.exr", &["--error", asked]);
        let json = outcome.json();
        assert!(number(&json, "/error/upper") <= bound, "{json}");
        assert!(number(&json, "/error/lower") < number(&json, "/error/estimate"), "{json}");
        assert_eq!(number(&json, "/error/confidence"), 0.95);
        assert!(number(&json, "/samples_per_pixel") >= 16.0, "{json}");
        assert!(number(&json, "/half_error/factor") <= 4.0, "{json}");
        let error = outcome.stderr.lines().find(|line| line.starts_with("etendue: error"));
        let error = error.unwrap_or_else(|| panic!("a line on the error in {}", outcome.stderr));
        for part in [" % ± ", "; half of it would take ", " × = "] {
            assert!(error.contains(part), "{part:?} in {error}");
        }
    }
}

#[test]
fn a_smaller_error_takes_more_samples_and_spp_limits_them() {
    let folder = folder();
    let samples = |arguments: &[&str]| {
        number(&render(&folder, "out.pfm", arguments).json(), "/samples_per_pixel")
    };
    let (coarse, fine) = (samples(&["--error", "8%"]), samples(&["--error", "1%"]));
    // 64 times for independent samples; Sobol' points need fewer.
    assert!(fine > 3.0 * coarse, "{fine} {coarse}");
    let limited = samples(&["--error", "1%", "--spp", "24"]);
    assert!((20.0..=24.0).contains(&limited), "{limited}");
    // Whichever is reached first.
    assert_eq!(samples(&["--error", "8%", "--spp", "100000", "--time", "1h"]), coarse);
}

#[test]
fn a_render_ends_when_its_time_is_over_with_a_whole_picture() {
    let folder = folder();
    let outcome = render(&folder, "out.pfm", &["--time", "1ms"]);
    let json = outcome.json();
    assert!(number(&json, "/samples_per_pixel") >= 2.0, "{json}");
    assert_eq!(json["complete"].as_bool(), Some(true));
    let picture = Picture::read_pfm(&folder.path("out.pfm"));
    assert!(picture.samples().all(f32::is_finite));
    assert!(picture.samples().any(|x| x > 0.0), "something is seen");
    // Time alone ends a render that nothing else would.
    render(&folder, "out.pfm", &["--time", "300ms", "--error", "0.0001%"]);
}

#[test]
fn the_same_bits_come_from_any_number_of_threads() {
    let folder = folder();
    let bits = |threads: &str| {
        render(&folder, "out.pfm", &["--error", "4%", "--threads", threads]);
        Picture::read_pfm(&folder.path("out.pfm")).bits()
    };
    let one = bits("1");
    assert_eq!(one, bits("2"));
    assert_eq!(one, bits("7"));
}

#[test]
fn adaptive_and_uniform_samples_are_named() {
    let folder = folder();
    let samples = |allocation: &str| {
        let arguments = ["--spp", "40", "--allocation", allocation, "--aov", "samples"];
        render(&folder, "out.exr", &arguments);
        let image = read_exr(&folder.path("out.exr"));
        counts(&image, "samples.N")
    };
    let uniform = samples("uniform");
    assert!(uniform.iter().all(|&n| (32..=64).contains(&n)), "{uniform:?}");
    let adaptive = samples("adaptive");
    // Eight in each half where nothing is seen.
    assert_eq!(adaptive.iter().min(), Some(&16), "{adaptive:?}");
    assert!(adaptive.iter().max() > Some(&64), "{adaptive:?}");
}

type ExrImage = Image<Layer<AnyChannels<FlatSamples>>>;

#[test]
fn paths_share_without_a_trace_of_threads() {
    let folder = folder();
    let shared = ["--reuse", "--spp", "32", "--sampler", "sobol"];
    for (output, threads) in [("one.pfm", "1"), ("three.pfm", "3")] {
        let json = render(&folder, output, &[&shared[..], &["--threads", threads]].concat()).json();
        assert!((16.0..=32.0).contains(&number(&json, "/samples_per_pixel")), "{json}");
        assert!(json["error"].is_null() && json["complete"] == true, "{json}");
    }
    let bits = |name| std::fs::read(folder.path(name)).expect("a picture");
    assert_eq!(bits("one.pfm"), bits("three.pfm"));
    render(&folder, "plain.pfm", &["--spp", "32", "--sampler", "sobol"]);
    assert_ne!(bits("one.pfm"), bits("plain.pfm"));
}

fn read_exr(path: &Path) -> ExrImage {
    let channels = read().no_deep_data().largest_resolution_level().all_channels();
    channels.first_valid_layer().all_attributes().from_file(path).expect("an EXR file")
}

fn channel<'a>(image: &'a ExrImage, name: &str) -> &'a FlatSamples {
    let mut list = image.layer_data.channel_data.list.iter();
    &list.find(|channel| channel.name.eq(name)).unwrap_or_else(|| panic!("{name}")).sample_data
}

fn floats(image: &ExrImage, name: &str) -> Vec<f32> {
    match channel(image, name) {
        FlatSamples::F32(values) => values.clone(),
        other => panic!("{name} is not of floats: {other:?}"),
    }
}

fn counts(image: &ExrImage, name: &str) -> Vec<u32> {
    match channel(image, name) {
        FlatSamples::U32(values) => values.clone(),
        other => panic!("{name} is not of counts: {other:?}"),
    }
}

#[test]
fn layers_are_there_under_their_names_and_nothing_else() {
    let folder = folder();
    let all = "variance,samples,albedo,normal,depth,position,uv,shape,depth";
    render(&folder, "out.exr", &["--spp", "16", "--aov", all, "--precision", "half"]);
    let image = read_exr(&folder.path("out.exr"));
    let names: Vec<String> =
        image.layer_data.channel_data.list.iter().map(|c| c.name.to_string()).collect();
    let expected = [
        "B",
        "G",
        "R",
        "albedo.B",
        "albedo.G",
        "albedo.R",
        "depth.Z",
        "normal.X",
        "normal.Y",
        "normal.Z",
        "position.X",
        "position.Y",
        "position.Z",
        "samples.N",
        "shape.I",
        "uv.U",
        "uv.V",
        "variance.B",
        "variance.G",
        "variance.R",
    ];
    assert_eq!(names, expected);
    for name in ["R", "albedo.R", "variance.R"] {
        assert!(matches!(channel(&image, name), FlatSamples::F16(_)), "{name}");
    }
    // The middle of the picture sees the ball's front, the corner nothing.
    let (middle, corner) = (8 * 24 + 12, 0);
    let depth = floats(&image, "depth.Z");
    // Within half a pixel of (0, 0, 1), seen from (0, 0, 5): 0.14 aside, 0.01 behind.
    assert!((depth[middle] - 4.0).abs() < 0.02, "{}", depth[middle]);
    assert_eq!(depth[corner], f32::INFINITY);
    assert!((floats(&image, "position.Z")[middle] - 1.0).abs() < 0.02);
    assert!(floats(&image, "normal.Z")[middle] > 0.95);
    let shape = counts(&image, "shape.I");
    assert_eq!((shape[middle], shape[corner]), (1, 0));
    assert!(counts(&image, "samples.N").iter().all(|&n| n == 16));
    let albedo: Vec<f32> = channel(&image, "albedo.G").values_as_f32().collect();
    assert_eq!((albedo[middle], albedo[corner]), (0.25, 0.0));
    let variance: Vec<f32> = channel(&image, "variance.R").values_as_f32().collect();
    assert!(variance.iter().any(|&v| v > 0.0) && variance[corner] == 0.0);
}

#[test]
fn layers_of_what_is_seen_leave_the_picture_alone() {
    let folder = folder();
    let picture = |arguments: &[&str]| {
        render(&folder, "out.exr", &[&["--spp", "8"], arguments].concat());
        ["R", "G", "B"].map(|name| floats(&read_exr(&folder.path("out.exr")), name))
    };
    assert_eq!(picture(&["--aov", "albedo,normal,depth"]), picture(&[]));
}

#[test]
fn exr_says_how_accurate_it_is() {
    let folder = folder();
    let text = |name: &str| {
        let meta = MetaData::read_from_file(folder.path("out.exr"), true).expect("an EXR file");
        let own = &meta.headers[0].own_attributes.other;
        own.iter().find(|(known, _)| *known == name).map(|(_, value)| match value {
            AttributeValue::Text(text) => text.to_string(),
            other => panic!("{name}: {other:?}"),
        })
    };
    let json = render(&folder, "out.exr", &["--error", "5%"]).json();
    for (name, path) in [
        ("etendue.error", "/error/estimate"),
        ("etendue.error_lower", "/error/lower"),
        ("etendue.error_upper", "/error/upper"),
        ("etendue.samples", "/samples"),
        ("etendue.spp", "/samples_per_pixel"),
    ] {
        let value = text(name).unwrap_or_else(|| panic!("{name}"));
        assert_eq!(value.parse::<f64>().ok(), Some(number(&json, path)), "{name}");
    }
    let json = render(&folder, "out.exr", &["--spp", "4"]).json();
    assert!(json["error"].is_null() && json["half_error"].is_null(), "{json}");
    assert_eq!(text("etendue.error"), None, "not known without halves");
}

#[test]
fn what_cannot_be_done_is_refused_with_a_reason() {
    let folder = folder();
    for (arguments, says) in [
        (&["-o", "a.exr", "--error", "0"][..], "expected an error above 0, up to 1 or 100%"),
        (&["-o", "a.exr", "--error", "-1%"], "expected an error above 0"),
        (&["-o", "a.exr", "--error", "200%"], "expected an error above 0"),
        (&["-o", "a.exr", "--time", "30"], "expected a time above 0 with its unit, as in 500ms"),
        (&["-o", "a.exr", "--time", "0s"], "expected a time above 0"),
        (&["-o", "a.exr", "--allocation", "clever"], "clever"),
        (&["-o", "a.exr", "--aov", "albedo,beauty"], "beauty"),
        (&["-o", "a.exr", "--error", "1%", "--spp", "1"], "ask for --spp 2 or more"),
        (&["-o", "a.exr", "--aov", "variance", "--spp", "1"], "ask for --spp 2 or more"),
        (&["-o", "a.exr", "--reuse", "--aov", "variance"], "--reuse leaves nothing for the layers"),
        (&["-o", "a.exr", "--reuse", "--time", "1s"], "cannot be used with '--time"),
        (&["-o", "a.png", "--aov", "albedo"], "a.png: only EXR pictures have layers"),
    ] {
        // A value that begins with a minus has to be joined to its name.
        let joined = arguments[2..].join("=");
        let mut line = vec!["render", "scene.xml", arguments[0], arguments[1]];
        if arguments.len() == 4 {
            line.push(&joined);
        } else {
            line.extend(&arguments[2..]);
        }
        let outcome = folder.run(&line);
        assert_eq!(outcome.exit, Some(2), "{line:?}: {}", outcome.stderr);
        assert_eq!(messages(&outcome, 2, &[says]), None, "{line:?}: {}", outcome.stderr);
        assert_eq!(folder.names(), ["scene.xml"], "{line:?}");
    }
}
