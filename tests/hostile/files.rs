//! What names lead to: devices, pipes, folders, links, and places outside of the scene's folder.

use crate::common::case::{Case, Content, LIGHT, RENDER, ball, material};
use crate::common::scene;

/// What a scene can name, with `NAME` in place of the name.
const ASSETS: [(&str, &str); 11] = [
    ("OBJ", "<shape type=\"obj\"><string name=\"filename\" value=\"NAME\"/></shape>"),
    ("PLY", "<shape type=\"ply\"><string name=\"filename\" value=\"NAME\"/></shape>"),
    (
        "serialized mesh",
        "<shape type=\"serialized\"><string name=\"filename\" value=\"NAME\"/></shape>",
    ),
    ("curves", "<shape type=\"bsplinecurve\"><string name=\"filename\" value=\"NAME\"/></shape>"),
    (
        "distance field",
        "<shape type=\"sdfgrid\"><string name=\"filename\" value=\"NAME\"/></shape>",
    ),
    ("texture", "<texture type=\"bitmap\"><string name=\"filename\" value=\"NAME\"/></texture>"),
    (
        "environment",
        "<emitter type=\"envmap\"><string name=\"filename\" value=\"NAME\"/></emitter>",
    ),
    (
        "spectrum",
        "<emitter type=\"constant\"><spectrum name=\"radiance\" filename=\"NAME\"/></emitter>",
    ),
    (
        "volume",
        "<shape type=\"sphere\"><medium type=\"heterogeneous\" name=\"interior\"><volume name=\"sigma_t\" type=\"gridvolume\"><string name=\"filename\" value=\"NAME\"/></volume></medium></shape>",
    ),
    ("included file", "<include filename=\"NAME\"/>"),
    ("folder", "<path value=\"NAME\"/>"),
];

/// A scene in a folder of its own, beside which there are other files.
fn inside(what: &'static str, exit: i32, says: &'static [&'static str], body: &str) -> Case {
    Case::new(what, exit, says)
        .file("inside/scene.xml", scene(body))
        .file("outside.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        .command(&["render", "inside/scene.xml", "-o", "out.pfm", "--quiet", "--spp=1"])
}

const IN_SANDBOX: [&str; 1] = ["--sandbox"];

fn mesh(name: &str) -> String {
    format!("{LIGHT}<shape type=\"obj\"><string name=\"filename\" value=\"{name}\"/></shape>")
}

pub(super) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    // The names are told apart by what they lead to; one title per asset and kind of trouble.
    for (title, (what, body)) in DEVICES.into_iter().zip(ASSETS) {
        if what == "folder" {
            cases.push(Case::scene(
                title,
                3,
                &["there is no folder"],
                &body.replace("NAME", "/dev/zero"),
            ));
            continue;
        }
        let says: &[&str] = &["/dev/zero", "not a regular file", "scene.xml:3:"];
        cases.push(Case::scene(title, 4, says, &body.replace("NAME", "/dev/zero")));
    }
    for (title, (what, body)) in PIPES.into_iter().zip(ASSETS) {
        let (exit, says): (i32, &[&str]) = match what {
            "folder" => (3, &["there is no folder"]),
            _ => (4, &["pipe", "not a regular file"]),
        };
        let case = Case::scene(title, exit, says, &body.replace("NAME", "pipe"));
        cases.push(case.with_content("pipe", Content::Pipe));
    }
    for (title, (what, body)) in ESCAPES.into_iter().zip(ASSETS) {
        let says: &[&str] = &["outside", "not read: it is outside of the sandbox"];
        let name = if what == "folder" { ".." } else { "../outside.obj" };
        cases.push(inside(title, 4, says, &body.replace("NAME", name)).with(&IN_SANDBOX));
    }
    let textured = |name: &str| {
        format!(
            "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" value=\"{name}\"/></texture></bsdf>"
        )
    };
    cases.extend([
        Case::scene("standard input as a mesh", 4, &["/dev/stdin", "not a regular file"], &mesh("/dev/stdin")),
        Case::scene("folder as a mesh", 4, &["a.obj", "not a regular file"], &mesh("a.obj"))
            .with_content("a.obj", Content::Folder),
        material("folder as a texture", 4, &["a.png", "not a regular file"], &textured("a.png"))
            .with_content("a.png", Content::Folder),
        Case::scene("no name", 3, &["a file name is empty", "scene.xml:3:"], &mesh("")),
        Case::scene("link to itself", 4, &["a.obj", "cannot read"], &mesh("a.obj"))
            .with_content("a.obj", Content::Link("a.obj")),
        Case::scene("link to a device", 4, &["a.obj", "not a regular file"], &mesh("a.obj"))
            .with_content("a.obj", Content::Link("/dev/zero")),
        Case::scene("name of 10⁵ characters", 4, &["cannot read", "xxx … xxx"], &mesh(&"x".repeat(100_000))),
        Case::scene("path of 10⁴ folders", 4, &["cannot read"], &mesh(&"x/".repeat(10_000))),
        Case::scene("file of the system that states no size", 0, &["no faces"], &mesh("/proc/self/status")),
        Case::new("scene that is a pipe", 4, &["scene.xml", "not a regular file"])
            .with_content("scene.xml", Content::Pipe),
        Case::new("scene that is a device", 4, &["scene.xml", "not a regular file"])
            .with_content("scene.xml", Content::Link("/dev/zero")),
        Case::new("model that is a pipe", 4, &["a.glb", "not a regular file"])
            .with_content("a.glb", Content::Pipe)
            .command(&["render", "a.glb", "-o", "out.pfm", "--quiet"]),
        Case::new("bare mesh that is a pipe", 4, &["a.obj", "not a regular file"])
            .with_content("a.obj", Content::Pipe)
            .command(&["render", "a.obj", "-o", "out.pfm", "--quiet"]),
        Case::new("materials that are a pipe", 0, &["mesh.obj:1", "material library left out", "not a regular file"])
            .file("mesh.obj", "mtllib pipe\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
            .with_content("pipe", Content::Pipe)
            .command(&["render", "mesh.obj", "-o", "out.pfm", "--quiet", "--spp=1", "--size=4x4"]),
        // Named plainly, and read.
        inside("file above the scene", 0, &[], &mesh("../outside.obj")),
        inside("link to a file above the scene", 0, &[], &mesh("link.obj"))
            .with_content("inside/link.obj", Content::Link("../outside.obj")),
        // And not in a sandbox.
        inside("sandbox: absolute name", 4, &["/etc/passwd", "outside of the sandbox"], &mesh("/etc/passwd")).with(&IN_SANDBOX),
        inside("sandbox: name that is not there", 4, &["outside of the sandbox"], &mesh("/none/at/all")).with(&IN_SANDBOX),
        inside("sandbox: up by a folder that is not there", 4, &["cannot read"], &mesh("none/../../outside.obj")).with(&IN_SANDBOX),
        inside("sandbox: up by backslashes", 4, &["outside of the sandbox"], &mesh("..\\outside.obj")).with(&IN_SANDBOX),
        inside("sandbox: link to a file", 4, &["link.obj", "outside of the sandbox"], &mesh("link.obj"))
            .with_content("inside/link.obj", Content::Link("../outside.obj"))
            .with(&IN_SANDBOX),
        inside("sandbox: link to a folder", 4, &["outside of the sandbox"], &mesh("up/outside.obj"))
            .with_content("inside/up", Content::Link(".."))
            .with(&IN_SANDBOX),
        inside("sandbox: by a definition", 4, &["outside of the sandbox"], &mesh("$up/outside.obj"))
            .with(&["--sandbox", "-D", "up=.."]),
        inside("sandbox: link that stays inside", 0, &[], &mesh("link.obj"))
            .file("inside/deep/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
            .with_content("inside/link.obj", Content::Link("deep/a.obj"))
            .with(&IN_SANDBOX),
        inside("sandbox: up and back", 0, &[], &mesh("../inside/a.obj"))
            .file("inside/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
            .with(&IN_SANDBOX),
        inside("sandbox: scene behind a link", 0, &[], &mesh("a.obj"))
            .file("inside/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
            .with_content("link", Content::Link("inside"))
            .command(&["render", "link/scene.xml", "-o", "out.pfm", "--quiet", "--spp=1", "--sandbox"]),
        inside("sandbox: file that an included file names", 4, &["outside of the sandbox"], "<include filename=\"deep/b.xml\"/>")
            .file("inside/deep/b.xml", "<scene version=\"3.0.0\"><shape type=\"obj\"><string name=\"filename\" value=\"../../outside.obj\"/></shape></scene>")
            .with(&IN_SANDBOX),
        Case::new("sandbox: materials of a bare mesh", 0, &["material library left out", "outside of the sandbox"])
            .file("inside/mesh.obj", "mtllib ../outside.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
            .file("outside.mtl", "newmtl a\n")
            .command(&["render", "inside/mesh.obj", "-o", "out.pfm", "--quiet", "--spp=1", "--size=4x4", "--sandbox"]),
        Case::new("sandbox: textures of a bare mesh", 0, &["outside.png", "outside of the sandbox"])
            .file("inside/mesh.obj", "mtllib mesh.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
            .file("inside/mesh.mtl", "newmtl a\nmap_Kd ../outside.png\n")
            .file("outside.png", "")
            .command(&["render", "inside/mesh.obj", "-o", "out.pfm", "--quiet", "--spp=1", "--size=4x4", "--sandbox"]),
        Case::new("sandbox: buffer of a model", 4, &["outside of the sandbox", "buffers[0].uri"])
            .file("inside/a.gltf", r#"{"asset":{"version":"2.0"},"buffers":[{"uri":"%2e%2e/outside.bin","byteLength":4}]}"#)
            .file("outside.bin", "four")
            .command(&["render", "inside/a.gltf", "-o", "out.pfm", "--quiet", "--sandbox"]),
        inside("sandbox: information", 4, &["outside of the sandbox"], &mesh("../outside.obj"))
            .command(&["info", "inside/scene.xml", "--sandbox"]),
        inside("sandbox: effects", 4, &["outside of the sandbox"], &mesh("../outside.obj"))
            .command(&["effects", "inside/scene.xml", "--sandbox"]),
        inside("sandbox: conversion", 4, &["outside of the sandbox"], &mesh("../outside.obj"))
            .command(&["convert", "inside/scene.xml", "converted.xml", "--sandbox"]),
        Case::scene("sandbox: plain scene", 0, &[], &ball("")).command(&RENDER).with(&IN_SANDBOX),
    ]);
    cases
}

const DEVICES: [&str; 11] = [
    "device as OBJ",
    "device as PLY",
    "device as serialized mesh",
    "device as curves",
    "device as distance field",
    "device as texture",
    "device as environment",
    "device as spectrum",
    "device as volume",
    "device as included file",
    "device as folder",
];

const PIPES: [&str; 11] = [
    "pipe as OBJ",
    "pipe as PLY",
    "pipe as serialized mesh",
    "pipe as curves",
    "pipe as distance field",
    "pipe as texture",
    "pipe as environment",
    "pipe as spectrum",
    "pipe as volume",
    "pipe as included file",
    "pipe as folder",
];

const ESCAPES: [&str; 11] = [
    "sandbox: OBJ",
    "sandbox: PLY",
    "sandbox: serialized mesh",
    "sandbox: curves",
    "sandbox: distance field",
    "sandbox: texture",
    "sandbox: environment",
    "sandbox: spectrum",
    "sandbox: volume",
    "sandbox: included file",
    "sandbox: folder",
];
