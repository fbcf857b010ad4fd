//! glTF documents and binary glTF. What is wrong inside documents is tested at length in `crates/scene/src/gltf/tests`.

use crate::common::case::Case;

const RENDER_GLTF: [&str; 7] =
    ["render", "a.gltf", "-o", "out.pfm", "--quiet", "--spp=1", "--size=4x4"];
const RENDER_GLB: [&str; 7] =
    ["render", "a.glb", "-o", "out.pfm", "--quiet", "--spp=1", "--size=4x4"];

/// A container of chunks, whose header states a length.
fn container(length: u32, chunks: &[(u32, &[u8; 4], &[u8])]) -> Vec<u8> {
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend(length.to_le_bytes());
    for (length, kind, content) in chunks {
        bytes.extend(length.to_le_bytes());
        bytes.extend(*kind);
        bytes.extend(*content);
    }
    bytes
}

pub(super) fn cases() -> Vec<Case> {
    let text = |what, exit, says, content: &str| {
        Case::new(what, exit, says).file("a.gltf", content).command(&RENDER_GLTF)
    };
    let binary = |what, says, content: Vec<u8>| {
        Case::new(what, 3, says).file("a.glb", content).command(&RENDER_GLB)
    };
    let document = |what, exit, says, rest: &str| {
        text(what, exit, says, &format!(r#"{{"asset":{{"version":"2.0"}},{rest}}}"#))
    };
    // One triangle whose accessors are given.
    let triangle = |what, exit, says, accessors: &str| {
        document(
            what,
            exit,
            says,
            &format!(
                r#""nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
            "buffers":[{{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}],
            "bufferViews":[{{"buffer":0,"byteLength":36}}],"accessors":[{accessors}]"#
            ),
        )
    };
    let chain: Vec<String> = (1..50_000).map(|i| format!(r#"{{"children":[{i}]}}"#)).collect();
    let empty = br#"{"asset":{"version":"2.0"}} "#.as_slice();
    vec![
        text("empty", 3, &["a.gltf", "not the JSON"], ""),
        text("no JSON", 3, &["a.gltf", "not the JSON"], "v 0 0 0"),
        text("list", 3, &["a.gltf", "must be an object"], "[]"),
        text("JSON nested 10⁵ deep", 3, &["a.gltf", "recursion limit"], &"[".repeat(100_000)),
        text(
            "number of 10⁵ digits",
            3,
            &["a.gltf"],
            &format!("{{\"asset\":{}}}", "1".repeat(100_000)),
        ),
        text("version 1", 3, &["asset.version", "glTF 2.0"], r#"{"asset":{"version":"1.0"}}"#),
        binary("container of its first bytes", &["a.glb", "cut off"], b"glTF".to_vec()),
        binary("container of length 0", &["a.glb"], container(0, &[(28, b"JSON", empty)])),
        binary(
            "container of 2³² − 1 bytes",
            &["a.glb", "cut off"],
            container(u32::MAX, &[(28, b"JSON", empty)]),
        ),
        binary(
            "chunk of 2³² − 1 bytes",
            &["a.glb", "reaches beyond"],
            container(48, &[(u32::MAX, b"JSON", empty)]),
        ),
        binary(
            "first chunk is not JSON",
            &["a.glb", "is not JSON"],
            container(48, &[(28, b"BIN\0", empty)]),
        ),
        binary(
            "container of version 1",
            &["a.glb", "version 1"],
            b"glTF\x01\0\0\0\x0c\0\0\0".to_vec(),
        ),
        document(
            "node that is its own child",
            3,
            &["a second time"],
            r#""scenes":[{"nodes":[0]}],"nodes":[{"children":[0]}]"#,
        ),
        document(
            "nodes in a circle",
            3,
            &["every node is the child"],
            r#""nodes":[{"children":[1]},{"children":[0]}]"#,
        ),
        document(
            "50000 nodes in a chain",
            0,
            &["no"],
            &format!(r#""nodes":[{},{{}}]"#, chain.join(",")),
        ),
        document(
            "node that is not there",
            3,
            &["nodes[7]"],
            r#""scenes":[{"nodes":[7]}],"nodes":[{}]"#,
        ),
        document(
            "node with index −1",
            3,
            &["not negative"],
            r#""scenes":[{"nodes":[-1]}],"nodes":[{}]"#,
        ),
        document(
            "node with index 2⁶⁴",
            3,
            &["nodes"],
            r#""scenes":[{"nodes":[18446744073709551616]}],"nodes":[{}]"#,
        ),
        document(
            "buffer of a URL",
            3,
            &["“http:…” is not supported"],
            r#""buffers":[{"uri":"http://localhost/a.bin","byteLength":4}]"#,
        ),
        document(
            "buffer of a file URL",
            3,
            &["“file:…” is not supported"],
            r#""buffers":[{"uri":"file:///etc/passwd","byteLength":4}]"#,
        ),
        document(
            "buffer of a device",
            4,
            &["/dev/zero", "not a regular file"],
            r#""buffers":[{"uri":"/dev/zero","byteLength":4}]"#,
        ),
        document(
            "buffer with NUL in its name",
            4,
            &["cannot read"],
            r#""buffers":[{"uri":"a\u0000b","byteLength":4}]"#,
        ),
        document(
            "buffer of no base64",
            3,
            &["base64 data is broken"],
            r#""buffers":[{"uri":"data:;base64,????","byteLength":4}]"#,
        ),
        document(
            "buffer shorter than it says",
            3,
            &["buffers[0]", "instead of 1000000000000"],
            r#""buffers":[{"uri":"data:;base64,AAAA","byteLength":1000000000000}]"#,
        ),
        triangle(
            "sound triangle",
            0,
            &[],
            r#"{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}"#,
        ),
        triangle(
            "accessor past its buffer",
            3,
            &["accessors[0]", "reads past"],
            r#"{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}"#,
        ),
        triangle(
            "accessor that overflows",
            3,
            &["accessors[0]"],
            r#"{"bufferView":0,"componentType":5126,"count":1537228672809129302,"type":"VEC3"}"#,
        ),
        triangle(
            "accessor of 2⁴⁰ zeros",
            5,
            &["out of all proportion"],
            r#"{"componentType":5126,"count":1099511627776,"type":"VEC3"}"#,
        ),
        triangle(
            "accessor of −1 elements",
            3,
            &["not negative"],
            r#"{"bufferView":0,"componentType":5126,"count":-1,"type":"VEC3"}"#,
        ),
        triangle(
            "accessor that begins behind its end",
            3,
            &["reads past"],
            r#"{"bufferView":0,"byteOffset":18446744073709551615,"componentType":5126,"count":3,"type":"VEC3"}"#,
        ),
        triangle(
            "positions of an unknown type",
            3,
            &["5130"],
            r#"{"bufferView":0,"componentType":5130,"count":3,"type":"VEC3"}"#,
        ),
        triangle(
            "positions that are matrices",
            3,
            &["accessors[0]", "elements of 16 numbers"],
            r#"{"componentType":5126,"count":3,"type":"MAT4"}"#,
        ),
        triangle(
            "sparse index beyond the end",
            3,
            &["sparse", "replaces element"],
            r#"{"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,"indices":{"bufferView":0,"byteOffset":12,"componentType":5125},"values":{"bufferView":0}}}"#,
        ),
        triangle(
            "more sparse elements than elements",
            3,
            &["elements replace 3"],
            r#"{"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":4,"indices":{"bufferView":0,"componentType":5125},"values":{"bufferView":0}}}"#,
        ),
        Case::new("names with escape codes in the list of effects", 0, &[])
            .file("a.gltf", r#"{"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"materials":[{"name":"\u001b[2J"}],"accessors":[{"componentType":5126,"count":3,"type":"VEC3"}]}"#)
            .command(&["effects", "a.gltf"]),
        document(
            "name with escape codes",
            3,
            &["\\u{1b}[2J"],
            r#""extensionsRequired":["\u001b[2J"]"#,
        ),
    ]
}
