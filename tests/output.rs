//! What the command writes, read back by other means.

mod common;

use std::path::Path;
use std::process::{Command, Stdio};

#[cfg(unix)]
use common::wait_until_rendering;
use common::{Folder, Outcome, Picture, scene};
use exr::meta::MetaData;
use exr::meta::attribute::AttributeValue;
use exr::prelude::{AnyChannels, FlatSamples, Image, Layer, ReadChannels, ReadLayers, read};

/// A coloured gradient from black to well above white: a textured light in front of the camera.
fn gradient() -> String {
    scene(
        "<shape type=\"rectangle\"><emitter type=\"area\">\
         <texture type=\"bitmap\" name=\"radiance\"><string name=\"filename\" value=\"light.pfm\"/>\
         </texture></emitter></shape>",
    )
}

/// A folder with the gradient in it.
fn folder() -> Folder {
    let folder = Folder::new();
    let pixel = |i: usize| [i as f32 / 8.0, 0.3, 4.0 / (1.0 + i as f32)];
    let light = Picture { width: 16, height: 1, pixels: (0..16).map(pixel).collect() };
    folder.write("light.pfm", light.to_pfm());
    folder.write("scene.xml", gradient());
    folder
}

const RENDER: [&str; 8] = ["render", "scene.xml", "--spp", "4", "--size", "24x18", "--seed", "7"];

/// Renders to a file of the folder.
fn write(folder: &Folder, output: &str, arguments: &[&str]) {
    let outcome = folder.run(&[&RENDER[..], &["-o", output], arguments].concat());
    assert_eq!(outcome.exit, Some(0), "{output}: {}", outcome.stderr);
}

/// The exact picture.
fn reference(folder: &Folder) -> Picture {
    write(folder, "reference.pfm", &[]);
    let picture = Picture::read_pfm(&folder.path("reference.pfm"));
    let brightest = picture.samples().fold(0.0, f32::max);
    assert!(brightest > 1.5, "the picture goes beyond white: {brightest}");
    picture
}

type ExrImage = Image<Layer<AnyChannels<FlatSamples>>>;

fn read_exr(path: &Path) -> ExrImage {
    let channels = read().no_deep_data().largest_resolution_level().all_channels();
    channels.first_valid_layer().all_attributes().from_file(path).expect("an EXR file")
}

/// The picture in the channels R, G and B.
fn exr_pixels(image: &ExrImage) -> Picture {
    let channel = |name: &str| {
        let mut list = image.layer_data.channel_data.list.iter();
        let found = list.find(|channel| channel.name.eq(name)).expect("a channel R, G or B");
        found.sample_data.values_as_f32().collect::<Vec<_>>()
    };
    let [red, green, blue] = ["R", "G", "B"].map(channel);
    let pixels = red.iter().zip(&green).zip(&blue).map(|((&r, &g), &b)| [r, g, b]).collect();
    Picture { width: image.layer_data.size.0, height: image.layer_data.size.1, pixels }
}

#[test]
fn exr_of_floats_holds_the_same_bits_as_pfm() {
    let folder = folder();
    let reference = reference(&folder);
    write(&folder, "out.exr", &[]);
    assert_eq!(exr_pixels(&read_exr(&folder.path("out.exr"))).bits(), reference.bits());
}

#[test]
fn exr_of_halves_holds_the_nearest_halves() {
    let folder = folder();
    let reference = reference(&folder);
    write(&folder, "out.exr", &["--precision", "half"]);
    let image = read_exr(&folder.path("out.exr"));
    for channel in &image.layer_data.channel_data.list {
        assert!(matches!(channel.sample_data, FlatSamples::F16(_)), "{}", channel.name);
    }
    let rounded = |x| half::f16::from_f32(x).to_f32();
    let expected: Vec<f32> = reference.samples().map(rounded).collect();
    assert_eq!(exr_pixels(&image).samples().collect::<Vec<_>>(), expected);
}

#[test]
fn exr_says_how_it_was_made() {
    let folder = folder();
    write(&folder, "out.exr", &[]);
    let meta = MetaData::read_from_file(folder.path("out.exr"), true).expect("an EXR file");
    let header = &meta.headers[0];
    let text = |name: &str| {
        let found = header.own_attributes.other.iter().find(|(known, _)| *known == name);
        match found {
            Some((_, AttributeValue::Text(text))) => text.to_string(),
            other => panic!("{name}: {other:?}"),
        }
    };
    assert_eq!(text("etendue.scene"), "scene.xml");
    assert_eq!(text("etendue.spp"), "4");
    assert_eq!(text("etendue.seed"), "7");
    assert_eq!(text("etendue.non_finite"), "0");
    assert_eq!(text("etendue.version"), env!("CARGO_PKG_VERSION"));
    assert!(text("etendue.seconds").parse::<f64>().is_ok_and(|seconds| seconds >= 0.0));
}

#[test]
fn hdr_holds_every_pixel_to_one_part_in_256_of_its_largest_channel() {
    let folder = folder();
    let reference = reference(&folder);
    write(&folder, "out.hdr", &[]);
    let decoded = image::open(folder.path("out.hdr")).expect("an HDR file").into_rgb32f();
    assert_eq!(decoded.dimensions(), (24, 18));
    for (found, expected) in decoded.pixels().zip(&reference.pixels) {
        let largest = expected.iter().copied().fold(0.0, f32::max);
        for (a, e) in found.0.iter().zip(expected) {
            // Eight bits below the shared exponent, which is at most twice the largest channel:
            // one step is at most 1/128 of it, whether it is rounded or cut off.
            assert!((a - e).abs() <= largest / 128.0, "{found:?} instead of {expected:?}");
        }
    }
}

/// Linear to sRGB (IEC 61966-2-1), as an 8-bit value before rounding.
fn srgb(linear: f32) -> f64 {
    let x = f64::from(linear).clamp(0.0, 1.0);
    // `powf` of the platform is good enough for a comparison to half a step.
    #[allow(clippy::disallowed_methods, reason = "the test must not use what it tests")]
    let encoded = if x <= 0.0031308 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
    255.0 * encoded
}

#[test]
fn png_holds_the_nearest_srgb_values_of_the_exposed_picture() {
    let folder = folder();
    let reference = reference(&folder);
    for (stops, gain) in [("0", 1.0), ("1", 2.0), ("-2", 0.25)] {
        write(&folder, "out.png", &["--exposure", stops]);
        let decoded = image::open(folder.path("out.png")).expect("a PNG file").into_rgb8();
        assert_eq!(decoded.dimensions(), (24, 18));
        for (found, expected) in decoded.pixels().zip(&reference.pixels) {
            for (a, e) in found.0.iter().zip(expected) {
                let exact = srgb(e * gain);
                // Half a step, and the rounding of the curve in f32.
                let near = (f64::from(*a) - exact).abs() <= 0.5 + 1e-3;
                assert!(near, "{a} instead of {exact} at {stops} stops");
            }
        }
    }
}

#[test]
fn the_line_of_json_has_the_documented_keys() {
    let folder = folder();
    let outcome = folder.run(&[&RENDER[..], &["-o", "out.pfm", "--json", "--quiet"]].concat());
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    assert_eq!(outcome.stderr, "", "quiet");
    let json = outcome.json();
    let figure = |name: &str| json[name].as_f64().unwrap_or_else(|| panic!("{name} in {json}"));
    assert_eq!(figure("samples"), 24.0 * 18.0 * 4.0);
    assert!(figure("rays") >= figure("samples"), "a ray from the camera for every sample: {json}");
    assert_eq!(figure("non_finite"), 0.0);
    assert!(figure("render_seconds") > 0.0 && figure("build_seconds") > 0.0, "{json}");
    let speed = figure("rays") / figure("render_seconds") / 1e6;
    // The same quotient of the same numbers, printed to 17 digits.
    assert!((figure("mrays_per_second") / speed - 1.0).abs() < 1e-9, "{json}");
    assert!(json.get("peak_rss").is_some(), "{json}");
    #[cfg(target_os = "linux")]
    assert!(figure("peak_rss") > f64::from(1 << 20), "{json}");
    #[cfg(target_os = "linux")]
    assert!(figure("cpu_seconds") > 0.0, "{json}");
    assert_eq!(figure("load_seconds"), figure("build_seconds"));
}

#[test]
fn a_summary_is_printed_unless_it_is_quiet() {
    let folder = folder();
    let outcome = folder.run(&[&RENDER[..], &["-o", "out.pfm"]].concat());
    assert_eq!(outcome.stdout, "");
    for fragment in ["out.pfm in ", "1728 samples", "rays"] {
        assert!(outcome.stderr.contains(fragment), "{fragment} in {}", outcome.stderr);
    }
}

#[test]
fn a_picture_replaces_the_one_before_and_a_bad_scene_leaves_it() {
    let folder = folder();
    folder.write("out.pfm", "old");
    folder.write("bad.xml", "<scene version=\"3.0.0\"><shape/></scene>");
    let outcome = folder.run(&["render", "bad.xml", "-o", "out.pfm"]);
    assert_eq!(outcome.exit, Some(3), "{}", outcome.stderr);
    let content = std::fs::read(folder.path("out.pfm")).expect("the old file");
    assert_eq!(content, b"old");
    write(&folder, "out.pfm", &[]);
    assert_eq!(Picture::read_pfm(&folder.path("out.pfm")).width, 24);
    assert_eq!(folder.names(), ["bad.xml", "light.pfm", "out.pfm", "scene.xml"]);
}

/// What is left of a render that would take an hour when a signal comes after it has begun.
#[cfg(unix)]
fn interrupted(signal: &str, length: [&str; 2]) -> (Folder, Outcome) {
    let folder = folder();
    let mut child = folder
        .command(&["render", "scene.xml", "-o", "out.pfm", "--json", "--quiet"])
        .args(length)
        .args(["--size", "1024x1024"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    wait_until_rendering(&mut child);
    let sent = Command::new("kill").args([signal, &child.id().to_string()]).status();
    assert!(sent.expect("kill starts").success());
    let outcome = child.wait_with_output().expect("the command ends").into();
    (folder, outcome)
}

#[cfg(unix)]
#[test]
fn an_interrupted_render_saves_what_it_has_and_says_so() {
    let (plain, progressive) = (["--spp", "4096"], ["--error", "0.0001%"]);
    for (signal, exit, length) in
        [("-INT", 130, plain), ("-TERM", 143, plain), ("-INT", 130, progressive)]
    {
        let (folder, outcome) = interrupted(signal, length);
        assert_eq!(outcome.exit, Some(exit), "{signal}: {}", outcome.stderr);
        assert_eq!(outcome.json()["complete"].as_bool(), Some(false), "{signal}");
        let picture = Picture::read_pfm(&folder.path("out.pfm"));
        assert_eq!([picture.width, picture.height], [1024, 1024], "{signal}");
        assert_eq!(folder.names(), ["light.pfm", "out.pfm", "scene.xml"], "{signal}");
    }
}
