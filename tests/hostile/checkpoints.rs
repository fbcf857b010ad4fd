//! Checkpoints: files of other kinds, damaged ones, and ones that somebody has made, with a right checksum.

use std::fs;
use std::sync::LazyLock;

use flate2::Crc;
use serde_json::{Value, json};

use crate::common::Folder;
use crate::common::case::{Case, Content, RENDER, ball};
use crate::common::scene;

/// The render of which there are checkpoints.
const ARGUMENTS: [&str; 7] =
    ["scene.xml", "-o", "out.pfm", "--quiet", "--spp=1", "--checkpoint", "a.checkpoint"];

/// Bytes before the header: eight that are always the same, format, length of the header, length of the body.
const PREFIX: usize = 8 + 4 + 4 + 8;

/// A checkpoint in its parts.
#[derive(Clone, Debug)]
struct Parts {
    /// The first eight bytes and the format.
    begin: Vec<u8>,
    header: Value,
    /// The kind of render, and how far it is.
    body: Vec<u8>,
}

impl Parts {
    /// What the command writes, of a scene beside it wherever that is.
    fn genuine() -> Self {
        static GENUINE: LazyLock<Parts> = LazyLock::new(|| {
            let folder = Folder::new();
            folder.write("scene.xml", scene(&ball("")));
            folder.succeed(&[&["render"], &ARGUMENTS[..]].concat());
            let bytes = fs::read(folder.path("a.checkpoint")).expect("a checkpoint");
            let length = bytes[12..16].iter().rev().fold(0, |sum, &b| sum << 8 | usize::from(b));
            let (header, rest) = bytes[PREFIX..].split_at(length);
            let mut header: Value = serde_json::from_slice(header).expect("JSON");
            header["recipe"]["folder"] = json!(".");
            // The same bytes each time.
            header["seconds"] = json!(0.0);
            let body = rest[..rest.len() - 4].to_vec();
            Parts { begin: bytes[..12].to_vec(), header, body }
        });
        GENUINE.clone()
    }

    /// A file with right lengths and a right checksum.
    fn file(&self) -> Vec<u8> {
        self.file_with(&serde_json::to_vec(&self.header).expect("JSON"))
    }

    /// The same with any header.
    fn file_with(&self, header: &[u8]) -> Vec<u8> {
        let lengths =
            [&(header.len() as u32).to_le_bytes()[..], &(self.body.len() as u64).to_le_bytes()];
        let content = [&self.begin[..], &lengths.concat(), header, &self.body].concat();
        let mut crc = Crc::new();
        crc.update(&content);
        [&content[..], &crc.sum().to_le_bytes()].concat()
    }
}

/// A genuine checkpoint with one part of its header exchanged.
fn header(path: &str, value: Value) -> Vec<u8> {
    let mut parts = Parts::genuine();
    *parts.header.pointer_mut(path).expect("a part of the header") = value;
    parts.file()
}

/// A genuine checkpoint of another command line.
fn arguments(arguments: &[&str]) -> Vec<u8> {
    header("/recipe/arguments", json!(arguments))
}

/// A genuine checkpoint whose body is changed.
fn body(change: impl FnOnce(&mut Vec<u8>)) -> Vec<u8> {
    let mut parts = Parts::genuine();
    change(&mut parts.body);
    parts.file()
}

/// A genuine checkpoint with bytes replaced, whatever its checksum says.
fn damaged(place: usize, bytes: &[u8]) -> Vec<u8> {
    let mut file = Parts::genuine().file();
    file[place..place + bytes.len()].copy_from_slice(bytes);
    file
}

/// A checkpoint that is gone on with, beside its scene.
fn resumed(
    what: &'static str,
    exit: i32,
    says: &'static [&'static str],
    checkpoint: impl Into<Vec<u8>>,
) -> Case {
    of(what, exit, says, Content::File(checkpoint.into()))
}

/// The same of what need not be a file.
fn of(what: &'static str, exit: i32, says: &'static [&'static str], checkpoint: Content) -> Case {
    Case::scene(what, exit, says, &ball("")).with_content("a.checkpoint", checkpoint).command(&[
        "resume",
        "a.checkpoint",
        "--quiet",
    ])
}

/// The command that writes checkpoints, where there is one.
fn rendered(
    what: &'static str,
    exit: i32,
    says: &'static [&'static str],
    checkpoint: Content,
) -> Case {
    of(what, exit, says, checkpoint).command(&RENDER).with(&["--checkpoint", "a.checkpoint"])
}

pub(super) fn cases() -> Vec<Case> {
    let genuine = Parts::genuine().file();
    let half = genuine.len() / 2;
    let previous = |case: Case| case.file("a.checkpoint.previous", genuine.clone());
    vec![
        resumed("empty file", 4, &["a.checkpoint", "cut short"], ""),
        resumed("text", 4, &["a.checkpoint", "no checkpoint of a render"], "a line of text\n"),
        of("folder", 4, &["a.checkpoint", "not a regular file"], Content::Folder),
        of("pipe", 4, &["a.checkpoint", "not a regular file"], Content::Pipe),
        of("link to a device", 4, &["not a regular file"], Content::Link("/dev/zero")),
        of("link to itself", 4, &["a.checkpoint", "cannot read"], Content::Link("a.checkpoint")),
        Case::new("none", 4, &["a.checkpoint", "no such checkpoint"])
            .command(&["resume", "a.checkpoint"]),
        of(
            "pipe, and one before it that is a folder",
            4,
            &["a.checkpoint", "a.checkpoint.previous"],
            Content::Pipe,
        )
        .with_content("a.checkpoint.previous", Content::Folder),
        resumed("its first bytes", 4, &["cut short"], &genuine[..8]),
        resumed("cut off in its lengths", 4, &["cut short"], &genuine[..PREFIX - 1]),
        resumed("cut in half", 4, &["cut short"], &genuine[..half]),
        resumed("without its last byte", 4, &["cut short"], &genuine[..genuine.len() - 1]),
        resumed("with a byte more", 4, &["damaged"], [&genuine[..], b"\0"].concat()),
        resumed("flipped bit of the header", 4, &["damaged", "checksum"], damaged(PREFIX, b"[")),
        resumed("flipped bit of the sums", 4, &["damaged", "checksum"], {
            damaged(genuine.len() - 9, &[genuine[genuine.len() - 9] ^ 4])
        }),
        resumed("format 2³² − 1", 4, &["its format is 4294967295"], damaged(8, &[0xff; 4])),
        resumed("header of 2³² − 1 bytes", 4, &["cut short"], damaged(12, &[0xff; 4])),
        resumed("body of 2⁶⁴ − 1 bytes", 4, &["cut short"], damaged(16, &[0xff; 8])),
        resumed("no body", 4, &["damaged"], body(Vec::clear)),
        resumed("no header", 4, &["its header"], Parts::genuine().file_with(b"")),
        resumed("header that is a list", 4, &["its header"], Parts::genuine().file_with(b"[]")),
        resumed(
            "header of nothing",
            4,
            &["its header", "missing field"],
            Parts::genuine().file_with(b"{}"),
        ),
        resumed("header nested 10⁵ deep", 4, &["its header"], {
            Parts::genuine()
                .file_with(&[b"{\"identity\":".as_slice(), &b"[".repeat(100_000)].concat())
        }),
        resumed("time of 10⁴⁰⁰ s", 4, &["its header"], {
            let text = Parts::genuine().header.to_string();
            Parts::genuine()
                .file_with(text.replace("\"seconds\":0.0", "\"seconds\":1e400").as_bytes())
        }),
        resumed("unknown kind of render", 4, &["a kind of render"], body(|body| body[0] = 255)),
        resumed("another kind of render", 4, &["a.checkpoint"], body(|body| body[0] ^= 1)),
        resumed("no sums", 4, &["cut short"], body(|body| body.truncate(1))),
        resumed("sums that are all ones", 4, &["cannot be"], body(|body| body[1..].fill(0xff))),
        // Offset, size and samples come first.
        resumed("sums of 2⁶² pixels", 4, &["cut short"], {
            body(|body| body[9..17].copy_from_slice(&[0, 0, 0, 0x80, 0, 0, 0, 0x80]))
        }),
        resumed("sums of 5 × 4 pixels", 4, &["a.checkpoint"], body(|body| body[9] = 5)),
        resumed(
            "sums of 2³² − 1 samples",
            2,
            &["which is less"],
            body(|body| body[21..25].fill(0xff)),
        ),
        resumed(
            "unknown option",
            2,
            &["does not know the command line", "--unknown"],
            arguments(&["scene.xml", "--unknown"]),
        ),
        resumed("option with escape codes", 2, &["does not know the command line"], {
            arguments(&["scene.xml", "--\u{1b}[2J\u{202e}"])
        }),
        resumed(
            "command line that asks for help",
            2,
            &["does not know the command line"],
            arguments(&["--help"]),
        ),
        resumed("command line of nothing", 2, &["does not know the command line"], arguments(&[])),
        resumed(
            "command line that asks for one sample",
            2,
            &["no picture"],
            arguments(&["scene.xml", "--replay", "1,1,0"]),
        ),
        resumed(
            "scene that is not there",
            4,
            &["none.xml"],
            arguments(&["none.xml", "-o", "out.pfm"]),
        ),
        resumed(
            "scene that is a pipe",
            4,
            &["pipe.xml", "not a regular file"],
            arguments(&["pipe.xml", "-o", "out.pfm"]),
        )
        .with_content("pipe.xml", Content::Pipe),
        resumed(
            "folder with escape codes",
            4,
            &["\\u{1b}[2J"],
            header("/recipe/folder", json!("\u{1b}[2J")),
        ),
        resumed(
            "part 5 of 0",
            4,
            &["a.checkpoint", "there is no part 5/0"],
            header("/shard", json!({"index": 5, "count": 0})),
        ),
        resumed(
            "another version",
            2,
            &["it was made by version \\u{1b}"],
            header("/identity/version", json!("\u{1b}")),
        ),
        resumed("10⁵ settings", 2, &["a.checkpoint", "it was made with"], {
            let settings: Vec<_> = (0..100_000).map(|i| json!([format!("--{i}"), "1"])).collect();
            header("/identity/settings", json!(settings))
        }),
        resumed("another scene", 2, &["the file scene.xml has changed"], genuine.clone())
            .file("scene.xml", scene(&ball("<!-- another -->"))),
        previous(resumed("genuine", 0, &[], genuine.clone()).with(&["-o", "out.pfm"])),
        previous(rendered(
            "genuine, by the command that made it",
            0,
            &[],
            Content::File(genuine.clone()),
        )),
        rendered(
            "render: empty file",
            4,
            &["a.checkpoint", "cut short", "name another file"],
            Content::File(Vec::new()),
        ),
        rendered(
            "render: text",
            4,
            &["no checkpoint of a render", "name another file"],
            Content::File(b"text".to_vec()),
        ),
        rendered(
            "render: cut in half",
            4,
            &["cut short", "name another file"],
            Content::File(genuine[..half].to_vec()),
        ),
        rendered("render: folder", 4, &["a.checkpoint", "directory"], Content::Folder),
        rendered("render: pipe", 4, &["a.checkpoint", "not a regular file"], Content::Pipe),
        rendered(
            "render: link to a device",
            4,
            &["not a regular file"],
            Content::Link("/dev/zero"),
        ),
        resumed(
            "lock that is a pipe",
            4,
            &[".a.checkpoint.lock", "not a regular file"],
            genuine.clone(),
        )
        .with_content(".a.checkpoint.lock", Content::Pipe),
        resumed(
            "lock that is a link",
            4,
            &[".a.checkpoint.lock", "not a regular file"],
            genuine.clone(),
        )
        .with_content(".a.checkpoint.lock", Content::Link("scene.xml")),
        rendered(
            "render: another scene",
            2,
            &["the file scene.xml has changed"],
            Content::File(genuine.clone()),
        )
        .file("scene.xml", scene(&ball("<!-- another -->"))),
    ]
}
