//! The scenes in `scenes/`, against pictures of themselves, and scenes whose picture is known.

mod common;

use std::path::{Path, PathBuf};

use common::golden::Golden;
use common::{Folder, Picture, repository};

/// Measured with `--spp 64`, seeds 0 to 7; `tests/golden/README.md` says how.
const GOLDEN: [Golden<'static>; 5] = [
    Golden {
        scene: "scenes/cornell-box/scene.xml",
        name: "cornell-box",
        size: "64x64",
        relative_mse: 0.0071,
        mean_difference: 0.026,
    },
    Golden {
        scene: "scenes/glass-and-metal.xml",
        name: "glass-and-metal",
        size: "64x40",
        relative_mse: 0.052,
        mean_difference: 0.018,
    },
    Golden {
        scene: "scenes/gltf/still-life.gltf",
        name: "still-life",
        size: "64x40",
        relative_mse: 0.033,
        mean_difference: 0.0101,
    },
    Golden {
        scene: "scenes/lambert-oren-nayar.xml",
        name: "lambert-oren-nayar",
        size: "64x32",
        relative_mse: 2.5e-4,
        mean_difference: 4.2e-4,
    },
    Golden {
        scene: "scenes/materials.xml",
        name: "materials",
        size: "64x32",
        relative_mse: 0.039,
        mean_difference: 0.011,
    },
];

/// Every scene file under a folder.
fn scene_files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder of scenes") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            scene_files(&path, found);
        } else if path
            .extension()
            .is_some_and(|extension| extension == "xml" || extension == "gltf")
        {
            found.push(path);
        }
    }
}

#[test]
fn every_shipped_scene_has_a_golden_picture() {
    let mut files = Vec::new();
    scene_files(&repository("scenes"), &mut files);
    // Those of effects have a test of their own.
    files.retain(|file| !file.starts_with(repository("scenes/effects")));
    files.sort();
    let mut golden = GOLDEN.map(|golden| repository(golden.scene));
    golden.sort();
    assert_eq!(files, golden);
}

#[test]
fn every_shipped_scene_is_described_without_a_warning() {
    for Golden { scene, .. } in GOLDEN {
        let path = repository(scene);
        let outcome = Folder::new().run(&["info", path.to_str().expect("UTF-8")]);
        assert_eq!(outcome.exit, Some(0), "{scene}: {}", outcome.stderr);
        assert_eq!(outcome.stderr, "", "{scene}");
        for line in ["shapes ", "materials ", "lights ", "camera "] {
            assert!(outcome.stdout.contains(line), "{scene}: {line:?} in\n{}", outcome.stdout);
        }
        assert!(!outcome.stdout.contains("warning"), "{scene}:\n{}", outcome.stdout);
    }
}

#[test]
fn every_shipped_scene_looks_as_it_did() {
    for golden in &GOLDEN {
        golden.check();
    }
}

/// Renders a ball of radius 1 at the origin, seen along −z by an orthographic camera whose film
/// reaches `reach` to either side.
fn ball(reach: f64, light: &str, reflectance: &str, arguments: &[&str]) -> Picture {
    let folder = Folder::new();
    folder.write(
        "ball.xml",
        format!(
            r#"<scene version="3.0.0">
                <sensor type="orthographic">
                    <transform name="to_world">
                        <scale x="{reach}" y="{reach}"/>
                        <lookat origin="0 0 5" target="0 0 0" up="0 1 0"/>
                    </transform>
                    <film type="hdrfilm">
                        <integer name="width" value="32"/><integer name="height" value="32"/>
                        <rfilter type="box"/>
                    </film>
                </sensor>
                {light}
                <shape type="sphere">
                    <bsdf type="diffuse"><rgb name="reflectance" value="{reflectance}"/></bsdf>
                </shape>
            </scene>"#
        ),
    );
    folder.render(Path::new("ball.xml"), arguments)
}

#[test]
fn a_white_ball_in_a_white_world_cannot_be_seen() {
    let picture = ball(
        1.2,
        r#"<emitter type="constant"/>"#,
        "1",
        &["--spp", "64", "--sampler", "independent"],
    );
    let samples: Vec<f64> = picture.samples().step_by(3).map(f64::from).collect();
    let count = samples.len() as f64;
    let mean = samples.iter().sum::<f64>() / count;
    let variance = samples.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (count - 1.0);
    let error = (variance / count).sqrt();
    // Pixels beside the ball are 1 exactly and only lower the variance; those on it have a standard
    // deviation of 0.25 / √64 (over 24 seeds), so the mean of 1024 is known to 0.001 or better.
    assert!(error < 0.001, "{error}");
    // Five standard errors: one seed in two million fails by chance.
    assert!((mean - 1.0).abs() < 5.0 * error, "{mean} ± {error}");
    // A bias that depends on the place would show in single pixels: six standard deviations of one.
    let farthest = samples.iter().map(|x| (x - 1.0).abs()).fold(0.0, f64::max);
    assert!(farthest < 6.0 * 0.25 / 8.0, "{farthest}");
}

#[test]
fn a_lambertian_facing_parallel_light_reflects_albedo_times_irradiance_over_pi() {
    let light = r#"<emitter type="directional">
        <vector name="direction" value="0 0 -1"/><rgb name="irradiance" value="3 2 1"/>
    </emitter>"#;
    let picture = ball(0.01, light, "0.8 0.4 0.2", &["--spp", "4"]);
    let expected = [0.8 * 3.0, 0.4 * 2.0, 0.2].map(|x| x / core::f32::consts::PI);
    for pixel in &picture.pixels {
        for (found, expected) in pixel.iter().zip(expected) {
            // At the corner of the film the cosine is 1 − 0.01² = 1 − 1e-4.
            assert!((found / expected - 1.0).abs() < 1.1e-4, "{found} instead of {expected}");
        }
    }
}
