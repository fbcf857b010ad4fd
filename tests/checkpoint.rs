//! Renders that are stopped and go on: to the same bits, or to a message that says why not.

mod common;

use core::time::Duration;

use common::{Folder, Limits, Outcome, Picture, case, repository, scene};

const SIZE: [&str; 2] = ["--size", "45x37"];

/// The picture of a file of the folder.
fn picture(folder: &Folder, name: &str) -> Vec<u32> {
    Picture::read_pfm(&folder.path(name)).bits()
}

fn cornell_box() -> String {
    repository("scenes/cornell-box/scene.xml").to_str().expect("UTF-8").to_owned()
}

#[test]
fn a_render_with_a_checkpoint_has_the_bits_of_one_without_and_more_samples_those_of_one_with_more()
{
    let folder = Folder::new();
    let scene = cornell_box();
    for sampler in ["independent", "sobol"] {
        let fixed = [&["render", &scene, "--quiet", "--sampler", sampler], &SIZE[..]].concat();
        let of = |spp, output| [&fixed[..], &["--spp", spp, "-o", output]].concat();
        folder.succeed(&of("3", "3.pfm"));
        folder.succeed(&of("70", "70.pfm"));
        for threads in ["1", "2", "3", "7"] {
            let checkpoint = format!("{sampler}{threads}.checkpoint");
            let kept = ["--checkpoint", &checkpoint, "--threads", threads];
            folder.succeed(&[&of("3", "a.pfm")[..], &kept].concat());
            assert_eq!(picture(&folder, "a.pfm"), picture(&folder, "3.pfm"), "{threads} threads");
            folder.succeed(&["resume", &checkpoint, "--spp", "70", "-o", "b.pfm", "--quiet"]);
            assert_eq!(picture(&folder, "b.pfm"), picture(&folder, "70.pfm"), "{threads} threads");
            // A render that is whole is written once more, to where it was last.
            std::fs::remove_file(folder.path("b.pfm")).expect("it was written");
            folder.succeed(&["resume", &checkpoint, "--quiet"]);
            assert_eq!(picture(&folder, "b.pfm"), picture(&folder, "70.pfm"));
        }
    }
}

#[test]
fn a_progressive_render_goes_on_to_a_smaller_error_with_the_bits_of_one_that_was_asked_for_it() {
    let folder = Folder::new();
    let scene = cornell_box();
    let fixed = [&["render", &scene, "--quiet"], &SIZE[..]].concat();
    let of = |error, output| [&fixed[..], &["--error", error, "-o", output]].concat();
    folder.succeed(&of("10%", "expected.pfm"));
    folder.succeed(&[&of("25%", "a.pfm")[..], &["--checkpoint", "a.checkpoint"]].concat());
    assert_ne!(picture(&folder, "a.pfm"), picture(&folder, "expected.pfm"));
    folder.succeed(&["resume", "a.checkpoint", "--error", "10%", "--quiet"]);
    assert_eq!(picture(&folder, "a.pfm"), picture(&folder, "expected.pfm"));
    folder.refuse(
        &[&fixed[..], &["--spp", "4", "-o", "a.pfm", "--checkpoint", "a.checkpoint"]].concat(),
        2,
        &["it was made with --allocation adaptive, now without"],
    );
}

#[test]
fn a_render_with_reuse_knows_how_many_samples_there_were_to_be() {
    let folder = Folder::new();
    let scene = cornell_box();
    let fixed = [&["render", &scene, "--reuse", "--spp", "16", "-o", "a.pfm"], &SIZE[..]].concat();
    folder.succeed(&[&fixed[..], &["--quiet"]].concat());
    let expected = picture(&folder, "a.pfm");
    let kept = ["--checkpoint", "a.checkpoint", "--threads", "1", "--quiet"];
    folder.succeed(&[&fixed[..], &kept].concat());
    assert_eq!(picture(&folder, "a.pfm"), expected);
    std::fs::remove_file(folder.path("a.pfm")).expect("it was written");
    folder.succeed(&["resume", "a.checkpoint", "--quiet"]);
    assert_eq!(picture(&folder, "a.pfm"), expected);
    let more = ["resume", "a.checkpoint", "--spp", "32"];
    folder.refuse(&more, 2, &["it was made with --spp 16, now it is 32"]);
    let plain = ["render", &scene, "-o", "b.pfm", "--checkpoint", "a.checkpoint", "--quiet"];
    folder.refuse(&[&plain[..], &SIZE].concat(), 2, &["--reuse"]);
    // Paths through media do not share: the render is a plain one, and so is its checkpoint.
    let medium = repository("scenes/effects/homogeneous-medium.xml");
    let medium = medium.to_str().expect("UTF-8");
    let fixed = ["render", medium, "--quiet", "--spp", "2", "-o", "m.pfm", "--reuse"];
    folder.succeed(&[&fixed[..], &SIZE, &["--checkpoint", "m.checkpoint"]].concat());
    folder.succeed(&["resume", "m.checkpoint", "--spp", "3", "--quiet"]);
}

#[test]
fn samples_that_stand_for_less_of_a_texture_are_another_render() {
    let folder = Folder::new();
    let scene = repository("scenes/effects/texture-filtering.xml");
    let scene = scene.to_str().expect("UTF-8");
    let fixed = ["render", scene, "-o", "a.pfm", "--quiet", "--checkpoint", "a.checkpoint"];
    folder.succeed(&[&fixed[..], &SIZE, &["--spp", "2"]].concat());
    let more = ["resume", "a.checkpoint", "--spp", "3"];
    folder.refuse(&more, 2, &["it was made with --spp 2, now it is 3"]);
}

/// A render of the Cornell box of which a checkpoint has been written, of so many samples per pixel.
fn begun(spp: &str) -> Folder {
    let folder = Folder::new();
    let scene = cornell_box();
    let fixed = ["render", &scene, "-o", "a.pfm", "--quiet", "--checkpoint", "a.checkpoint"];
    folder.succeed(&[&fixed[..], &SIZE, &["--spp", spp]].concat());
    folder
}

#[test]
fn the_newest_complete_checkpoint_is_used_and_a_damaged_one_named() {
    let folder = begun("2");
    folder.succeed(&["resume", "a.checkpoint", "--spp", "5", "-o", "expected.pfm", "--quiet"]);
    assert_eq!(
        folder.names(),
        ["a.checkpoint", "a.checkpoint.previous", "a.pfm", "expected.pfm"],
        "no temporary file stays behind"
    );
    let bytes = std::fs::read(folder.path("a.checkpoint")).expect("a checkpoint");
    let mut flipped = bytes.clone();
    flipped[bytes.len() / 2] ^= 4;
    for (damage, says) in [(&bytes[..bytes.len() - 1], "cut short"), (&flipped, "damaged")] {
        let folder = begun("2");
        folder.succeed(&["resume", "a.checkpoint", "--spp", "3", "--quiet"]);
        folder.write("a.checkpoint", damage);
        let outcome = folder.succeed(&["resume", "a.checkpoint", "--spp", "5", "--quiet"]);
        let warnings = outcome.warnings();
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        assert!(warnings[0].contains(says) && warnings[0].contains("a.checkpoint"), "{warnings:?}");
        let expected = begun("5");
        assert_eq!(picture(&folder, "a.pfm"), picture(&expected, "a.pfm"));
        for name in ["a.checkpoint", "a.checkpoint.previous"] {
            folder.write(name, damage);
        }
        folder.refuse(&["resume", "a.checkpoint"], 4, &["a.checkpoint", says]);
    }
    folder.write("a.xml", scene(""));
    folder.refuse(&["resume", "a.xml"], 4, &["a.xml", "no checkpoint"]);
    folder.refuse(&["resume", "missing"], 4, &["missing", "no such checkpoint"]);
}

#[test]
fn the_checkpoint_before_is_enough() {
    let folder = begun("2");
    folder.succeed(&["resume", "a.checkpoint", "--spp", "3", "--quiet"]);
    std::fs::remove_file(folder.path("a.checkpoint")).expect("it was written");
    let outcome = folder.succeed(&["resume", "a.checkpoint", "--spp", "5", "--quiet"]);
    assert_eq!(outcome.stderr, "", "a name that is not there is not damaged");
    assert_eq!(picture(&folder, "a.pfm"), picture(&begun("5"), "a.pfm"));
    assert_eq!(folder.names(), ["a.checkpoint", "a.checkpoint.previous", "a.pfm"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_checkpoint_beyond_the_memory_is_an_error() {
    let folder = Folder::new();
    // A hole: it takes no room on the disk.
    let file = std::fs::File::create(folder.path("a.checkpoint")).expect("a file");
    file.set_len(1 << 40).expect("a file of a tebibyte");
    let limits = Limits { time: Duration::from_secs(30), memory: 1 << 30 };
    let outcome = folder.run_within(limits, &["resume", "a.checkpoint", "--quiet"]);
    assert_eq!(case::messages(&outcome, 4, &["a.checkpoint", "cannot read"]), None);
    assert_eq!(outcome.exit, Some(4), "{}", outcome.stderr);
}

#[cfg(unix)]
#[test]
fn a_render_in_a_sandbox_stays_there_when_it_goes_on() {
    const MESH: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let of = |mesh: &str| {
        scene(&format!(
            "<emitter type=\"constant\"/><shape type=\"obj\"><string name=\"filename\" value=\"{mesh}\"/></shape>"
        ))
    };
    let begun = || {
        let folder = Folder::new();
        std::fs::create_dir(folder.path("inside")).expect("a folder");
        folder.write("outside.obj", MESH);
        folder.write("inside/mesh.obj", MESH);
        folder.write("inside/scene.xml", of("mesh.obj"));
        let command = ["render", "inside/scene.xml", "-o", "a.pfm", "--quiet", "--spp", "2"];
        let kept = ["--checkpoint", "a.checkpoint", "--sandbox"];
        folder.succeed(&[&command[..], &kept].concat());
        folder
    };
    let more = ["resume", "a.checkpoint", "--quiet", "--spp", "3"];
    begun().succeed(&more);
    let outside = "outside of the sandbox";
    // The scene now names what lies outside, whether there is such a file or not.
    for name in ["../outside.obj", "../none.obj", "/none/at/all.obj"] {
        let folder = begun();
        folder.write("inside/scene.xml", of(name));
        folder.refuse(&more, 4, &[name, outside, "scene.xml:3:"]);
    }
    // What it named leads there now; that the content is the same does not matter.
    let folder = begun();
    std::fs::remove_file(folder.path("inside/mesh.obj")).expect("the mesh");
    let link = std::os::unix::fs::symlink("../outside.obj", folder.path("inside/mesh.obj"));
    link.expect("a writable folder");
    folder.refuse(&more, 4, &["mesh.obj", outside]);
    // A command that does not ask for a sandbox reads it.
    let command = ["render", "inside/scene.xml", "-o", "b.pfm", "--quiet", "--spp", "3"];
    folder.succeed(&[&command[..], &["--checkpoint", "a.checkpoint"]].concat());
}

#[test]
fn leftovers_of_a_crash_are_removed() {
    let folder = begun("2");
    folder.write(".a.checkpoint.tmp", "half of a checkpoint");
    folder.succeed(&["resume", "a.checkpoint", "--quiet"]);
    assert!(!folder.names().contains(&".a.checkpoint.tmp".to_owned()), "{:?}", folder.names());
}

#[test]
fn another_render_is_refused_with_what_differs() {
    let folder = Folder::new();
    let light = Picture { width: 2, height: 1, pixels: vec![[1.0; 3], [2.0; 3]] };
    folder.write("light.pfm", light.to_pfm());
    folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("part.xml", "<scene version=\"3.0.0\"><emitter type=\"constant\"/></scene>");
    let body = "<default name=\"light\" value=\"1\"/><emitter type=\"point\">\
        <rgb name=\"intensity\" value=\"$light\"/></emitter><include filename=\"part.xml\"/>\
        <shape type=\"obj\"><string name=\"filename\" value=\"mesh.obj\"/></shape>\
        <shape type=\"rectangle\"><emitter type=\"area\"><texture type=\"bitmap\" name=\"radiance\">\
        <string name=\"filename\" value=\"light.pfm\"/></texture></emitter></shape>";
    folder.write("scene.xml", scene(body));
    let fixed = [
        "render",
        "scene.xml",
        "-o",
        "a.pfm",
        "--quiet",
        "--spp",
        "2",
        "--checkpoint",
        "a.checkpoint",
    ];
    let with = |more: &[&'static str]| [&fixed[..], more].concat();
    folder.succeed(&with(&["--max-depth", "8"]));
    folder.succeed(&with(&["--max-depth", "8"]));
    let cases: [(&[&str], &str); 6] = [
        (&["--max-depth", "4"], "it was made with --max-depth 8, now it is 4"),
        (&["--max-depth", "8", "--seed", "3"], "it was made with --seed 0, now it is 3"),
        (&["--max-depth", "8", "--size", "8x8"], "it was made with --size 4x4, now it is 8x8"),
        (&["--max-depth", "8", "--spectral"], "it was made without --spectral, now it is on"),
        (&["--max-depth", "8", "--without", "area-light"], "without --without"),
        (&["--max-depth", "8", "-D", "light=2"], "it was made without -D light, now it is 2"),
    ];
    for (more, says) in cases {
        folder.refuse(&with(more), 2, &["a.checkpoint", says]);
    }
    // Every file counts, whatever reads it, and it is the content that does.
    for name in ["light.pfm", "mesh.obj", "part.xml", "scene.xml"] {
        let content = std::fs::read(folder.path(name)).expect("a file");
        let changed = match name {
            "light.pfm" => {
                let mut changed = content.clone();
                *changed.last_mut().expect("samples") ^= 1;
                changed
            }
            _ => [&content[..], b"\n"].concat(),
        };
        folder.write(name, changed);
        let says = format!("the file {name} has changed");
        folder.refuse(&["resume", "a.checkpoint"], 2, &[&says]);
        folder.write(name, content);
    }
    folder.succeed(&["resume", "a.checkpoint", "--quiet"]);
    folder.succeed(&["resume", "a.checkpoint", "--quiet", "--spp", "3"]);
    folder.refuse(&with(&["--max-depth", "8"]), 2, &["--spp 3, now it is 2, which is less"]);
}

#[test]
fn what_cannot_be_kept_is_refused_before_rendering() {
    let folder = Folder::new();
    folder.write("scene.xml", scene("<emitter type=\"constant\"/>"));
    let fixed = ["render", "scene.xml", "-o", "a.pfm", "--spp", "2", "--checkpoint"];
    let with = |more: &[&'static str]| [&fixed[..], more].concat();
    folder.refuse(&with(&["missing/a.checkpoint"]), 4, &["missing", "is not a folder"]);
    folder.refuse(&with(&[".."]), 2, &["expected FILE"]);
    assert_eq!(folder.names(), ["scene.xml"]);
}

#[cfg(unix)]
#[test]
fn a_checkpoint_that_finds_no_room_costs_neither_the_picture_nor_the_one_before() {
    let folder = begun("2");
    let before = std::fs::read(folder.path("a.checkpoint")).expect("a checkpoint");
    // Files end at 24 or 48 KiB, as shells count, for whoever ignores the signal: between the picture and the checkpoint.
    assert!(before.len() > 50_000, "{}", before.len());
    let command = format!(
        "trap '' XFSZ; ulimit -f 48; exec {} resume a.checkpoint --spp 4 --quiet",
        common::ETENDUE
    );
    let output = std::process::Command::new("sh")
        .args(["-c", &command])
        .current_dir(folder.path(""))
        .output()
        .expect("a shell");
    let outcome = Outcome::from(output);
    assert_eq!(outcome.exit, Some(4), "{}", outcome.stderr);
    assert!(outcome.errors()[0].contains("a.checkpoint: cannot write"), "{}", outcome.stderr);
    assert_eq!(picture(&folder, "a.pfm"), picture(&begun("4"), "a.pfm"));
    assert_eq!(std::fs::read(folder.path("a.checkpoint")).ok(), Some(before));
    assert_eq!(folder.names(), ["a.checkpoint", "a.pfm"]);
}
