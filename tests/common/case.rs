//! Command lines on given files, with what must come of them.

use core::time::Duration;
use std::fs;
use std::path::Path;

use super::{Folder, Limits, Outcome, scene};

/// What a name in the folder of a case stands for.
#[derive(Clone, Debug)]
pub(crate) enum Content {
    File(Vec<u8>),
    Folder,
    /// A link to another name.
    Link(&'static str),
    /// A pipe that nobody writes to.
    Pipe,
}

/// Files, a command line, and what must come of them.
pub(crate) struct Case {
    pub(crate) what: &'static str,
    pub(crate) files: Vec<(&'static str, Content)>,
    pub(crate) arguments: Vec<&'static str>,
    pub(crate) exit: i32,
    /// What the error, or else the warnings, must contain.
    pub(crate) says: &'static [&'static str],
}

/// What a case may take: a hundred times what most take, so that a busy machine passes and what never ends, or takes whatever memory
/// a file asks for, does not.
const LIMITS: Limits = Limits { time: Duration::from_secs(30), memory: 1 << 30 };

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

    pub(crate) fn file(self, name: &'static str, content: impl Into<Vec<u8>>) -> Self {
        self.with_content(name, Content::File(content.into()))
    }

    /// Something that is no file, or a file.
    pub(crate) fn with_content(mut self, name: &'static str, content: Content) -> Self {
        self.files.push((name, content));
        self
    }

    /// Another command line.
    pub(crate) fn command(self, arguments: &[&'static str]) -> Self {
        Self { arguments: arguments.to_vec(), ..self }
    }

    /// More of the command line.
    pub(crate) fn with(mut self, arguments: &[&'static str]) -> Self {
        self.arguments.extend(arguments);
        self
    }

    /// Writes its files below a folder, which is made; returns how many bytes they have.
    pub(crate) fn write(&self, folder: &Path) -> usize {
        fs::create_dir_all(folder).expect("a writable folder");
        let size = |(name, content): &(&str, Content)| {
            add(&folder.join(name), content);
            match content {
                Content::File(bytes) => bytes.len(),
                _ => 0,
            }
        };
        self.files.iter().map(size).sum()
    }

    /// What is wrong with what the command did; `None` if nothing.
    fn complaint(&self) -> Option<String> {
        let folder = Folder::new();
        self.write(&folder.path(""));
        let mut expected = folder.names();
        let outcome = folder.run_within(LIMITS, &self.arguments);
        if self.exit == 0 && self.arguments.contains(&"out.pfm") {
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

/// Puts what a name stands for into a folder, and the folders above it.
fn add(path: &Path, content: &Content) {
    fs::create_dir_all(path.parent().expect("a folder")).expect("a writable folder");
    match content {
        Content::File(bytes) => fs::write(path, bytes).expect("a writable folder"),
        Content::Folder => fs::create_dir(path).expect("a writable folder"),
        #[cfg(unix)]
        Content::Link(target) => {
            std::os::unix::fs::symlink(target, path).expect("a writable folder");
        }
        #[cfg(unix)]
        Content::Pipe => {
            let made = std::process::Command::new("mkfifo").arg(path).status();
            assert!(made.is_ok_and(|status| status.success()), "mkfifo");
        }
        // Only Unix has the cases with these.
        #[cfg(not(unix))]
        Content::Link(_) | Content::Pipe => {}
    }
}

/// No file may flood a terminal: a hundred warnings, the longest of which have 1000 characters, are less.
const MOST_TEXT: usize = 150_000;

/// What is wrong with the messages of a run; `None` if nothing.
pub(crate) fn messages(outcome: &Outcome, exit: i32, says: &[&str]) -> Option<String> {
    if outcome.stderr.contains("panicked") {
        return Some("it panics".to_owned());
    }
    let acts = |c: char| c.is_control() && c != '\n';
    if outcome.stderr.contains(acts) || outcome.stdout.contains(acts) {
        return Some("it controls the terminal".to_owned());
    }
    if outcome.stderr.len() > MOST_TEXT {
        return Some(format!("{} bytes of messages", outcome.stderr.len()));
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
