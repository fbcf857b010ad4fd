//! Parts of a render, joined to the bits of the whole.

mod common;

use common::{Folder, Outcome, Picture, repository};

const SPP: &str = "14";

/// A scene with every kind of path, and a size that cuts tiles.
fn render(scene: &str, more: &[&str]) -> Vec<String> {
    let scene = repository(scene);
    let fixed =
        ["render", scene.to_str().expect("UTF-8"), "--quiet", "--size", "41x19", "--spp", SPP];
    fixed.iter().chain(more).map(|argument| (*argument).to_owned()).collect()
}

fn succeed(folder: &Folder, arguments: &[String]) -> Outcome {
    folder.succeed(&arguments.iter().map(String::as_str).collect::<Vec<_>>())
}

/// Draws the parts of a division, each with another number of threads.
fn draw_parts(folder: &Folder, scene: &str, count: usize, more: &[&str]) -> Vec<String> {
    (1..=count)
        .map(|index| {
            let (shard, output) = (format!("{index}/{count}"), format!("{index}-{count}.exr"));
            let threads = ["1", "2", "3", "7"][index % 4];
            let own = ["--shard", &shard, "-o", &output, "--threads", threads];
            succeed(folder, &render(scene, &[&own[..], more].concat()));
            output
        })
        .collect()
}

#[test]
fn parts_joined_in_any_order_have_the_bits_of_the_whole() {
    for scene in ["scenes/glass-and-metal.xml", "scenes/effects/dispersion.xml"] {
        let folder = Folder::new();
        succeed(&folder, &render(scene, &["-o", "whole.pfm"]));
        let whole = Picture::read_pfm(&folder.path("whole.pfm")).bits();
        for count in [1, 2, 3, 7] {
            let parts = draw_parts(&folder, scene, count, &[]);
            let mut orders = vec![parts.clone(), parts.iter().rev().cloned().collect()];
            let mut turned = parts.clone();
            turned.rotate_left(count / 2);
            orders.push(turned);
            for order in orders {
                let merge = ["merge", "-o", "joined.pfm", "--quiet"].map(str::to_owned);
                succeed(&folder, &[&merge[..], &order].concat());
                let joined = Picture::read_pfm(&folder.path("joined.pfm")).bits();
                assert_eq!(joined, whole, "{scene}, {order:?}");
            }
        }
    }
}

const BOX: &str = "scenes/cornell-box/scene.xml";

#[test]
fn parts_that_overlap_are_missing_or_of_other_renders_are_named() {
    let folder = Folder::new();
    draw_parts(&folder, BOX, 3, &[]);
    draw_parts(&folder, BOX, 2, &[]);
    let merge = |parts: &[&'static str]| [&["merge", "-o", "a.pfm"], parts].concat();
    folder.refuse(&merge(&["3-3.exr", "1-3.exr"]), 2, &["missing: --shard 2/3"]);
    folder.refuse(&merge(&["2-3.exr"]), 2, &["missing: --shard 1/3, --shard 3/3"]);
    folder.refuse(&merge(&["1-2.exr", "3-3.exr"]), 2, &["missing: the samples 7 to 8"]);
    let all = ["1-3.exr", "2-3.exr", "3-3.exr"];
    folder.refuse(
        &merge(&[&all[..], &["1-2.exr"]].concat()),
        2,
        &["overlaps", "the samples 0 to 3"],
    );
    folder.refuse(&merge(&["1-3.exr", "1-3.exr"]), 2, &["overlaps with 1-3.exr"]);
    let other = ["--shard", "2/3", "--seed", "5", "-o", "other.exr"];
    succeed(&folder, &render(BOX, &other));
    let says = ["other.exr", "not of the same render as 1-3.exr", "--seed 5, now it is 0"];
    folder.refuse(&merge(&["1-3.exr", "other.exr", "3-3.exr"]), 2, &says);
    let longer = ["--shard", "2/3", "--spp", "20", "-o", "longer.exr"];
    let mut arguments = render(BOX, &longer);
    arguments.retain(|argument| argument != SPP);
    let place = arguments.iter().position(|argument| argument == "--spp").expect("the first");
    arguments.remove(place);
    succeed(&folder, &arguments);
    folder.refuse(&merge(&["1-3.exr", "longer.exr", "3-3.exr"]), 2, &["--spp 20, now it is 14"]);
    let whole = ["-o", "whole.exr"];
    succeed(&folder, &render(BOX, &whole));
    folder.refuse(&merge(&["1-3.exr", "whole.exr"]), 4, &["whole.exr", "not a part of a render"]);
    folder.refuse(&merge(&["1-3.exr", "missing.exr"]), 4, &["missing.exr"]);
}

#[test]
fn a_damaged_part_is_found_out() {
    let folder = Folder::new();
    draw_parts(&folder, BOX, 1, &[]);
    let bytes = std::fs::read(folder.path("1-1.exr")).expect("the part");
    // Within the sums, which are the end of the file and most of it.
    for place in (bytes.len() / 2..bytes.len()).step_by(bytes.len() / 37) {
        let mut changed = bytes.clone();
        changed[place] ^= 0x10;
        folder.write("changed.exr", changed);
        folder.refuse(&["merge", "-o", "a.pfm", "changed.exr"], 4, &["changed.exr", "damaged"]);
    }
    folder.write("cut.exr", &bytes[..bytes.len() / 2]);
    folder.refuse(&["merge", "-o", "a.pfm", "cut.exr"], 4, &["cut.exr"]);
}

#[test]
fn a_part_whose_header_says_what_cannot_be_is_refused() {
    let folder = Folder::new();
    draw_parts(&folder, BOX, 2, &[]);
    let bytes = std::fs::read(folder.path("1-2.exr")).expect("the part");
    let lie = |from: &str, to: &str| {
        let place = bytes.windows(from.len()).position(|window| window == from.as_bytes());
        let place = place.expect("it is in the header");
        let mut changed = bytes.clone();
        changed[place..place + from.len()].copy_from_slice(to.as_bytes());
        folder.write("lie.exr", changed);
    };
    let merge = ["merge", "-o", "a.pfm", "lie.exr", "2-2.exr"];
    let shard = "\"shard\":{\"index\":1,\"count\":2}";
    for (to, exit, says) in [
        ("\"shard\":{\"index\":0,\"count\":2}", 4, "there is no part 0/2"),
        ("\"shard\":{\"index\":1,\"count\":0}", 4, "there is no part 1/0"),
        ("\"shard\":{\"index\":2,\"count\":2}", 2, "overlaps"),
        ("\"shard\":{\"index\":1,\"count\":3}", 2, "missing: the samples 4 to 6"),
        ("\"shard\":{\"index\":1}          ", 4, "its header"),
    ] {
        lie(shard, to);
        folder.refuse(&merge, exit, &[says]);
    }
    lie("\"whole\":true", "\"whole\":null");
    folder.refuse(&merge, 4, &["lie.exr", "its header"]);
    lie("\"samples_per_pixel\":14", "\"samples_per_pixel\":0 ");
    folder.refuse(&merge, 2, &["lie.exr", "no samples"]);
    // A picture that says nothing of a part.
    lie("etendue.part", "etendue.porp");
    folder.refuse(&merge, 4, &["lie.exr", "not a part"]);
}

#[test]
fn a_part_that_is_there_is_not_drawn_again_and_another_one_is_not_replaced() {
    let folder = Folder::new();
    let shard = ["--shard", "1/2", "-o", "a.exr"];
    succeed(&folder, &render(BOX, &shard));
    let content = || std::fs::read(folder.path("a.exr")).expect("the part");
    let first = content();
    let again = render(BOX, &[&shard[..], &["--json"]].concat());
    let outcome = succeed(&folder, &again);
    assert_eq!(outcome.stdout, "", "nothing is rendered");
    assert_eq!(content(), first);
    let refused = |more: &[&str], says: &str| {
        let arguments = render(BOX, more);
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        folder.refuse(&arguments, 2, &["a.exr", says]);
    };
    refused(
        &["--shard", "2/2", "-o", "a.exr"],
        "it was made with --shard 1/2, now it is with --shard 2/2",
    );
    refused(&["--shard", "1/2", "-o", "a.exr", "--max-depth", "2"], "--max-depth");
    assert_eq!(content(), first);
    let arguments = render(BOX, &["--shard", "1/2", "-o", "a.pfm"]);
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    folder.refuse(&arguments, 2, &["a.pfm", "parts of renders are EXR pictures"]);
    let arguments = render(BOX, &["--shard", "2/15", "-o", "b.exr"]);
    // A part of one sample.
    succeed(&folder, &arguments);
    let arguments = render(BOX, &["--shard", "1/15", "-o", "c.exr"]);
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    folder.refuse(&arguments, 2, &["--shard 1/15 has none of the 14 samples"]);
}
