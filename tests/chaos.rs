//! Renders that are killed, interrupted and robbed of their folders.
//!
//! The long form, 200 kills and a full disk: `cargo test --release -p etendue-cli --test chaos -- --include-ignored`.
#![cfg(target_os = "linux")]

mod common;

use core::time::Duration;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Instant, SystemTime};

use common::{ETENDUE, Folder, Outcome, Picture, repository, wait_until_rendering};

/// A scene without a texture, in which nothing depends on the number of samples.
fn cornell_box() -> String {
    repository("scenes/cornell-box/scene.xml").to_str().expect("UTF-8").to_owned()
}

const CHECKPOINT: &str = "a.checkpoint";

/// Time between checkpoints, and what writing one and a busy machine may add to it.
const INTERVAL: Duration = Duration::from_millis(20);
const SLACK: Duration = Duration::from_millis(1500);

/// A render of seconds, to `a.pfm`.
fn command(folder: &Folder, spp: &str, more: &[&str]) -> Command {
    let scene = cornell_box();
    let mut command = folder.command(&["render", &scene, "-o", "a.pfm", "--quiet"]);
    command.args(["--size", "96x80", "--spp", spp]).args(more);
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

fn kept(folder: &Folder, spp: &str) -> Child {
    let target = format!("{CHECKPOINT}:20ms");
    command(folder, spp, &["--checkpoint", &target]).spawn().expect("the command starts")
}

/// That a file is a whole checkpoint, by its lengths and by a checksum that shares no code with the command.
fn is_whole(bytes: &[u8]) -> bool {
    let Some(content) = bytes.len().checked_sub(4).map(|n| &bytes[..n]) else { return false };
    let mut remainder = u32::MAX;
    for &byte in content {
        remainder ^= u32::from(byte);
        for _ in 0..8 {
            let odd = remainder & 1 == 1;
            remainder = (remainder >> 1) ^ if odd { 0xedb8_8320 } else { 0 };
        }
    }
    bytes.starts_with(b"etendue\x1a") && bytes.ends_with(&(!remainder).to_le_bytes())
}

/// The age of the newest whole checkpoint at a moment, `None` if there is none; fails at one that is not whole.
fn age(folder: &Folder, at: SystemTime) -> Option<Duration> {
    let age = |name: &str| {
        let path = folder.path(name);
        let bytes = std::fs::read(&path).ok()?;
        assert!(is_whole(&bytes), "{name} is damaged");
        let written = path.metadata().and_then(|metadata| metadata.modified()).expect("a time");
        Some(at.duration_since(written).unwrap_or_default())
    };
    [CHECKPOINT, "a.checkpoint.previous"].into_iter().filter_map(age).min()
}

/// A number below `bound` that nobody chose.
fn random(state: &mut u64, bound: u64) -> u64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 33) % bound
}

/// Kills renders at random instants until it has been done so often, lets the same command go on each time, and compares the pictures of those
/// that come to their end.
fn kill(times: usize, spp: &str) {
    let expected = Folder::new();
    let status = command(&expected, spp, &[]).status().expect("the command starts");
    assert!(status.success());
    let expected = Picture::read_pfm(&expected.path("a.pfm")).bits();
    let mut folder = Folder::new();
    let (mut killed, mut pictures, mut with_checkpoint) = (0, 0, 0);
    let mut state = 1;
    while killed < times || pictures == 0 {
        let mut child = kept(&folder, spp);
        let begin = Instant::now();
        // Those that have been killed often enough may end.
        let life = if killed < times { 20 + random(&mut state, 500) } else { 1_000_000 };
        while begin.elapsed() < Duration::from_millis(life)
            && child.try_wait().expect("a child").is_none()
        {
            std::thread::sleep(Duration::from_millis(1));
        }
        let at = SystemTime::now();
        child.kill().expect("a child");
        let outcome = Outcome::from(child.wait_with_output().expect("a child"));
        if outcome.exit.is_none() {
            killed += 1;
            if let Some(age) = age(&folder, at) {
                with_checkpoint += 1;
                // Loading, and the beginning of the first interval, leave the one of the render before.
                let begun = begin.elapsed().saturating_sub(SLACK);
                assert!(age <= INTERVAL + SLACK || begun < age, "{age:?} are lost");
            }
        } else {
            assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
            let picture = Picture::read_pfm(&folder.path("a.pfm")).bits();
            assert!(picture == expected, "other bits after {killed} kills");
            pictures += 1;
            folder = Folder::new();
        }
    }
    assert!(with_checkpoint > 0, "no kill met a checkpoint");
}

#[test]
fn renders_that_are_killed_go_on_to_the_same_bits() {
    kill(8, "150");
}

#[test]
#[ignore = "minutes"]
fn two_hundred_kills_cost_nothing() {
    kill(200, "2000");
}

/// Waits until something is true of a running child.
fn wait_until(child: &mut Child, what: impl Fn() -> bool) {
    while !what() {
        assert_eq!(child.try_wait().expect("a child"), None, "it ends by itself");
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn signal(child: &Child, name: &str) {
    let status = Command::new("kill").args([name, &child.id().to_string()]).status();
    assert!(status.expect("kill starts").success());
}

#[test]
fn a_signal_saves_picture_and_checkpoint_within_seconds_and_the_render_goes_on() {
    for (name, exit) in [("-INT", 130), ("-TERM", 143)] {
        let folder = Folder::new();
        let mut child = kept(&folder, "1000000");
        wait_until(&mut child, || folder.path(CHECKPOINT).exists());
        let begin = Instant::now();
        signal(&child, name);
        let outcome = Outcome::from(child.wait_with_output().expect("a child"));
        // Pixels under way take milliseconds; the rest is for busy machines.
        assert!(begin.elapsed() < Duration::from_secs(5), "{:?}", begin.elapsed());
        assert_eq!(outcome.exit, Some(exit), "{}", outcome.stderr);
        let picture = Picture::read_pfm(&folder.path("a.pfm"));
        assert!(picture.pixels.iter().any(|pixel| pixel[0] > 0.0));
        assert_eq!(folder.names(), [CHECKPOINT, "a.checkpoint.previous", "a.pfm"]);
        assert!(age(&folder, SystemTime::now()).is_some());
    }
}

#[test]
fn renders_in_rounds_and_with_reuse_that_are_interrupted_go_on_to_the_same_bits() {
    for how in [&["--allocation", "adaptive"][..], &["--reuse"]] {
        let folder = Folder::new();
        let status = command(&folder, "200", how).status().expect("the command starts");
        assert!(status.success());
        let expected = Picture::read_pfm(&folder.path("a.pfm")).bits();
        let target = format!("{CHECKPOINT}:20ms");
        let kept = [how, &["--checkpoint", &target]].concat();
        let mut child = command(&folder, "200", &kept).spawn().expect("the command starts");
        wait_until(&mut child, || folder.path("a.checkpoint.previous").exists());
        signal(&child, "-INT");
        let outcome = Outcome::from(child.wait_with_output().expect("a child"));
        assert_eq!(outcome.exit, Some(130), "{}", outcome.stderr);
        let outcome = folder.run(&["resume", CHECKPOINT, "--quiet", "-o", "b.pfm"]);
        assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
        assert!(Picture::read_pfm(&folder.path("b.pfm")).bits() == expected, "{how:?}: other bits");
        assert!(
            Picture::read_pfm(&folder.path("a.pfm")).bits() != expected,
            "{how:?}: it was interrupted too late"
        );
    }
}

#[test]
fn a_part_that_is_interrupted_is_not_joined_but_finished_by_the_same_command() {
    let folder = Folder::new();
    let scene = cornell_box();
    // A second or more of one thread, so that the signal does not come too late.
    let fixed = ["render", &scene, "--quiet", "--size", "96x80", "--spp", "300"];
    let of = |more: &[&'static str]| [&fixed[..], more].concat();
    let first = of(&["--shard", "1/2", "-o", "1.exr"]);
    let mut child = folder
        .command(&[&first[..], &["--threads", "1"]].concat())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    wait_until_rendering(&mut child);
    signal(&child, "-INT");
    let outcome = Outcome::from(child.wait_with_output().expect("a child"));
    assert_eq!(outcome.exit, Some(130), "{}", outcome.stderr);
    folder.succeed(&of(&["--shard", "2/2", "-o", "2.exr"]));
    let merge = ["merge", "1.exr", "2.exr", "-o", "joined.pfm", "--quiet"];
    folder.refuse(&merge, 2, &["1.exr", "not whole"]);
    assert_eq!(folder.names(), ["1.exr", "2.exr"]);
    folder.succeed(&first);
    folder.succeed(&merge);
    folder.succeed(&of(&["-o", "whole.pfm"]));
    let [joined, whole] =
        ["joined.pfm", "whole.pfm"].map(|name| Picture::read_pfm(&folder.path(name)).bits());
    assert!(joined == whole, "other bits");
}

#[test]
fn a_second_render_with_the_same_checkpoint_is_refused() {
    let folder = Folder::new();
    let mut child = kept(&folder, "1000000");
    wait_until(&mut child, || folder.path(CHECKPOINT).exists());
    let outcome = folder.run(&["resume", CHECKPOINT, "--quiet"]);
    assert_eq!(outcome.exit, Some(4), "{}", outcome.stderr);
    assert!(outcome.errors()[0].contains("another render is writing"), "{}", outcome.stderr);
    // A second signal leaves at once.
    signal(&child, "-INT");
    let _ = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    let outcome = Outcome::from(child.wait_with_output().expect("a child"));
    assert_eq!(outcome.exit, Some(130), "{}", outcome.stderr);
    assert!(age(&folder, SystemTime::now()).is_some());
}

#[test]
fn a_picture_whose_folder_vanishes_is_saved_elsewhere() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("pictures")).expect("a folder");
    let target = format!("{CHECKPOINT}:20ms");
    let mut child = folder
        .command(&["render", &cornell_box(), "-o", "pictures/a.pfm", "--quiet", "--spp", "1000000"])
        .args(["--checkpoint", &target, "--size", "96x80"])
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    wait_until(&mut child, || folder.path(CHECKPOINT).exists());
    std::fs::remove_dir(folder.path("pictures")).expect("an empty folder");
    signal(&child, "-INT");
    let outcome = Outcome::from(child.wait_with_output().expect("a child"));
    assert_eq!(outcome.exit, Some(4), "{}", outcome.stderr);
    assert!(outcome.errors()[0].contains("a.pfm instead"), "{}", outcome.stderr);
    assert_eq!(Picture::read_pfm(&folder.path("a.pfm")).width, 96);
    assert!(age(&folder, SystemTime::now()).is_some());
}

/// Runs a shell script with a disk of 1 MiB at `full`, in a mount namespace of its own.
fn with_small_disk(folder: &Folder, script: &str) -> Outcome {
    let mount = "mount -t tmpfs -o size=1m none full";
    let output = Command::new("unshare")
        .args(["--user", "--map-root-user", "--mount", "sh", "-c", &format!("{mount} && {script}")])
        .env("ETENDUE", Path::new(ETENDUE))
        .current_dir(folder.path(""))
        .output()
        .expect("unshare exists");
    output.into()
}

#[test]
#[ignore = "needs the right to mount"]
fn a_full_disk_keeps_the_checkpoint_before_and_the_picture_goes_elsewhere() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("full")).expect("a folder");
    let scene = cornell_box();
    // The checkpoint of 2 samples fits; then there is no room for another, nor for the picture.
    let script = format!(
        "R=\"$ETENDUE render {scene} --size 96x80 --quiet --checkpoint full/{CHECKPOINT}\"
         $R --spp 2 -o a.pfm || exit 100
         head -c 900000 /dev/zero > full/ballast 2> /dev/null
         $R --spp 4 -o full/b.pfm; exit=$?
         cp full/a.checkpoint* . ; exit $exit"
    );
    let outcome = with_small_disk(&folder, &script);
    assert_eq!(outcome.exit, Some(4), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("b.pfm instead"), "{}", outcome.stderr);
    assert_eq!(Picture::read_pfm(&folder.path("b.pfm")).width, 96);
    assert!(age(&folder, SystemTime::now()).is_some(), "{:?}", folder.names());
}
