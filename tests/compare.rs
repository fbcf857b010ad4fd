//! `etendue compare` on pictures whose distance is known.

mod common;

use common::{Folder, Outcome, Picture};

/// A row of grey pixels.
fn grey(values: &[f32]) -> Picture {
    Picture { width: values.len(), height: 1, pixels: values.iter().map(|&v| [v; 3]).collect() }
}

fn compare(image: &Picture, reference: &Picture, arguments: &[&str]) -> (Folder, Outcome) {
    let folder = Folder::new();
    folder.write("image.pfm", image.to_pfm());
    folder.write("reference.pfm", reference.to_pfm());
    let outcome = folder.run(&[&["compare", "image.pfm", "reference.pfm"], arguments].concat());
    (folder, outcome)
}

#[test]
fn the_figures_are_those_of_their_formulas() {
    let (_, outcome) = compare(&grey(&[1.0, 0.0]), &grey(&[2.0, 0.5]), &["--json", "--flip"]);
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    let json = outcome.json();
    let figure = |name: &str| json[name].as_f64().unwrap_or_else(|| panic!("{name} in {json}"));
    // All pixel values are exact in f32 and the sums are in f64.
    assert_eq!(figure("mse"), f64::midpoint(1.0, 0.25));
    assert_eq!(figure("mean_difference"), -1.5 / 2.5);
    assert_eq!(figure("max_difference"), 1.0);
    assert_eq!(figure("non_finite_pixels"), 0.0);
    // Its values are those of a test of the renderer.
    assert!(figure("flip") > 0.1 && figure("flip") < 1.0, "{json}");
    // A few roundings in f64.
    let relative = f64::midpoint(1.0 / (4.0 + 0.01), 0.25 / (0.25 + 0.01));
    assert!((figure("rel_mse") - relative).abs() < 1e-15, "{json}");
    // 10 log₁₀(2² / 0.625) = 8.06180 dB, given to five decimals.
    assert!((figure("psnr") - 8.06180).abs() < 1e-5, "{json}");
}

#[test]
fn equal_pictures_have_no_difference_and_no_psnr() {
    let picture = grey(&[0.0, 0.5, 7.0]);
    let (_, outcome) = compare(&picture, &picture, &["--json", "--flip"]);
    let json = outcome.json();
    for name in ["mse", "rel_mse", "mean_difference", "max_difference", "flip"] {
        assert_eq!(json[name].as_f64(), Some(0.0), "{name}");
    }
    assert!(json["psnr"].is_null(), "an infinite ratio is null in JSON: {json}");
}

#[test]
fn the_text_names_every_figure() {
    let (_, outcome) = compare(&grey(&[1.5]), &grey(&[1.0]), &["--flip"]);
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    for line in [
        "MSE              2.5",
        "relMSE           2.4752",
        "PSNR             6.02 dB",
        "mean difference  +50.0000 %",
        "max difference   5.0",
        "ꟻLIP             0.",
    ] {
        assert!(outcome.stdout.contains(line), "{line:?} in\n{}", outcome.stdout);
    }
}

#[test]
fn pixels_that_are_not_finite_are_counted_and_left_out() {
    let image = grey(&[f32::NAN, 1.0, f32::INFINITY]);
    let (_, outcome) = compare(&image, &grey(&[1.0; 3]), &["--json"]);
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    let json = outcome.json();
    assert_eq!(json["non_finite_pixels"].as_u64(), Some(2), "{json}");
    assert_eq!(json["mse"].as_f64(), Some(0.0), "{json}");
}

#[test]
fn pictures_of_different_sizes_are_a_usage_error_that_names_both() {
    let (folder, outcome) = compare(&grey(&[1.0]), &grey(&[1.0, 1.0]), &["-o", "difference.pfm"]);
    assert_eq!(outcome.exit, Some(2), "{}", outcome.stderr);
    for fragment in ["image.pfm", "reference.pfm", "1×1", "2×1"] {
        assert!(outcome.stderr.contains(fragment), "{fragment} in {}", outcome.stderr);
    }
    assert_eq!(folder.names(), ["image.pfm", "reference.pfm"], "no difference picture");
}

#[test]
fn a_picture_that_is_missing_is_an_input_error() {
    let outcome = Folder::new().run(&["compare", "a.exr", "b.exr"]);
    assert_eq!(outcome.exit, Some(4), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("a.exr"), "{}", outcome.stderr);
}

#[test]
fn the_difference_picture_is_red_where_brighter_blue_where_darker_black_where_equal() {
    let (folder, outcome) =
        compare(&grey(&[2.0, 0.0, 1.0]), &grey(&[1.0, 1.0, 1.0]), &["-o", "difference.pfm"]);
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    let difference = Picture::read_pfm(&folder.path("difference.pfm"));
    assert_eq!([difference.width, difference.height], [3, 1]);
    // |Y(x) − Y(r)| / (Y(r) + 0.01) = 1 / 1.01 for the first two; luminance weights add up to 1
    // within a few roundings in f32.
    let intensity = 1.0 / 1.01;
    let [red, blue, black] = difference.pixels[..] else { panic!("three pixels") };
    assert!((red[0] - intensity).abs() < 1e-6 && red[1..] == [0.0; 2], "{red:?}");
    assert!((blue[2] - intensity).abs() < 1e-6 && blue[..2] == [0.0; 2], "{blue:?}");
    assert_eq!(black, [0.0; 3]);
}
