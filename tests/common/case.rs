//! Command lines on given files, with what must come of them.

use super::{Folder, Outcome, scene};

/// Files, a command line, and what must come of them.
pub(crate) struct Case {
    pub(crate) what: &'static str,
    pub(crate) files: Vec<(&'static str, Vec<u8>)>,
    pub(crate) arguments: Vec<&'static str>,
    pub(crate) exit: i32,
    /// What the error, or else the warnings, must contain.
    pub(crate) says: &'static [&'static str],
}

/// Renders `scene.xml`, which the case adds, at one sample per pixel.
pub(crate) const RENDER: [&str; 6] = ["render", "scene.xml", "-o", "out.pfm", "--quiet", "--spp=1"];
/// The same of a bare mesh.
pub(crate) const RENDER_OBJ: [&str; 7] =
    ["render", "mesh.obj", "-o", "out.pfm", "--quiet", "--spp=1", "--size=4x4"];
pub(crate) const RENDER_PLY: [&str; 7] =
    ["render", "mesh.ply", "-o", "out.pfm", "--quiet", "--spp=1", "--size=4x4"];

impl Case {
    pub(crate) fn new(what: &'static str, exit: i32, says: &'static [&'static str]) -> Self {
        Self { what, files: Vec::new(), arguments: RENDER.to_vec(), exit, says }
    }

    /// A scene whose content after the camera, from line 3 on, is `body`.
    pub(crate) fn scene(
        what: &'static str,
        exit: i32,
        says: &'static [&'static str],
        body: &str,
    ) -> Self {
        Self::new(what, exit, says).file("scene.xml", scene(body))
    }

    pub(crate) fn obj(
        what: &'static str,
        exit: i32,
        says: &'static [&'static str],
        text: &str,
    ) -> Self {
        let case = Self::new(what, exit, says).file("mesh.obj", text);
        Self { arguments: RENDER_OBJ.to_vec(), ..case }
    }

    pub(crate) fn ply(
        what: &'static str,
        exit: i32,
        says: &'static [&'static str],
        bytes: impl Into<Vec<u8>>,
    ) -> Self {
        let case = Self::new(what, exit, says).file("mesh.ply", bytes);
        Self { arguments: RENDER_PLY.to_vec(), ..case }
    }

    pub(crate) fn file(mut self, name: &'static str, content: impl Into<Vec<u8>>) -> Self {
        self.files.push((name, content.into()));
        self
    }

    /// More of the command line.
    pub(crate) fn with(mut self, arguments: &[&'static str]) -> Self {
        self.arguments.extend(arguments);
        self
    }

    /// What is wrong with what the command did; `None` if nothing.
    fn complaint(&self) -> Option<String> {
        let folder = Folder::new();
        let mut expected: Vec<String> = Vec::new();
        for (name, content) in &self.files {
            folder.write(name, content);
            expected.push((*name).to_owned());
        }
        let outcome = folder.run(&self.arguments);
        if self.exit == 0 {
            expected.push("out.pfm".to_owned());
        }
        expected.sort();
        let complaint = if outcome.exit != Some(self.exit) {
            format!("exit {:?} instead of {}", outcome.exit, self.exit)
        } else if let Some(complaint) = messages(&outcome, self.exit, self.says) {
            complaint
        } else if folder.names() != expected {
            format!("the folder holds {:?} instead of {expected:?}", folder.names())
        } else {
            return None;
        };
        Some(format!("{}: {complaint}\n{}", self.what, outcome.stderr))
    }
}

/// What is wrong with the messages of a run; `None` if nothing.
pub(crate) fn messages(outcome: &Outcome, exit: i32, says: &[&str]) -> Option<String> {
    if outcome.stderr.contains("panicked") {
        return Some("it panics".to_owned());
    }
    let errors = outcome.errors();
    let expected = usize::from(exit != 0);
    if errors.len() != expected {
        return Some(format!("{} errors instead of {expected}", errors.len()));
    }
    let text = if exit == 0 { outcome.warnings().join("\n") } else { errors.join("\n") };
    if says.is_empty() && exit == 0 && !text.is_empty() {
        return Some("it warns".to_owned());
    }
    let missing = says.iter().find(|fragment| !text.contains(**fragment))?;
    Some(format!("{missing:?} is not said"))
}

/// Fails with every case that is not as it must be.
pub(crate) fn check(cases: impl IntoIterator<Item = Case>) {
    let complaints: Vec<String> = cases.into_iter().filter_map(|c| c.complaint()).collect();
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
}

/// White light from everywhere, on one line.
pub(crate) const LIGHT: &str = r#"<emitter type="constant"/>"#;

/// A light on line 3, a ball with the given content from line 4 on.
pub(crate) fn ball(content: &str) -> String {
    format!("{LIGHT}\n<shape type=\"sphere\">\n{content}\n</shape>")
}

/// A ball whose bsdf, on line 5, is `bsdf`.
pub(crate) fn material(
    what: &'static str,
    exit: i32,
    says: &'static [&'static str],
    bsdf: &str,
) -> Case {
    Case::scene(what, exit, says, &ball(bsdf))
}
