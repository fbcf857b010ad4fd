//! The picture depends on scene, settings and seed, and on nothing else.

mod common;

use common::{Folder, Picture, repository};

/// The shipped scenes that between them have every kind of path: diffuse walls under an area light,
/// specular chains under an environment map, and wavelengths.
const SCENES: [&str; 3] =
    ["scenes/cornell-box/scene.xml", "scenes/glass-and-metal.xml", "scenes/effects/dispersion.xml"];

/// Not a multiple of any tile, so that tiles at the edges are cut.
const SIZE: &str = "45x37";

fn render(scene: &str, arguments: &[&str]) -> Picture {
    let fixed = ["--size", SIZE, "--spp", "4"];
    Folder::new().render(&repository(scene), &[&fixed, arguments].concat())
}

#[test]
fn the_number_of_threads_does_not_change_a_bit() {
    for scene in SCENES {
        for sampler in ["independent", "sobol"] {
            let with =
                |threads| render(scene, &["--sampler", sampler, "--threads", threads]).bits();
            let one = with("1");
            assert_eq!(one, with("2"), "{scene}, {sampler}, 2 threads");
            assert_eq!(one, with("3"), "{scene}, {sampler}, 3 threads");
            assert_eq!(one, with("7"), "{scene}, {sampler}, 7 threads");
        }
    }
}

#[test]
fn another_seed_gives_another_picture_and_the_same_seed_the_same() {
    for scene in SCENES {
        for sampler in ["independent", "sobol"] {
            let with = |seed| render(scene, &["--sampler", sampler, "--seed", seed]).bits();
            let one = with("1");
            assert_eq!(one, with("1"), "{scene}, {sampler}");
            assert_ne!(one, with("2"), "{scene}, {sampler}");
        }
    }
}

#[test]
fn the_two_samplers_give_different_pictures() {
    for scene in SCENES {
        let with = |sampler| render(scene, &["--sampler", sampler]).bits();
        assert_ne!(with("independent"), with("sobol"), "{scene}");
    }
}

#[test]
fn a_crop_is_that_part_of_the_whole_picture_bit_by_bit() {
    for scene in SCENES {
        let whole = render(scene, &[]);
        for (crop, offset, size) in [
            ("0,0,1,1", [0, 0], [1, 1]),
            ("13,7,20,19", [13, 7], [20, 19]),
            ("44,36,1,1", [44, 36], [1, 1]),
        ] {
            let part = render(scene, &["--crop", crop]);
            assert_eq!([part.width, part.height], size, "{scene}, crop {crop}");
            assert_eq!(part.bits(), whole.crop(offset, size).bits(), "{scene}, crop {crop}");
        }
    }
}
