//! What tests of the command `etendue` share: running it, folders that vanish, plain pictures.

#![allow(dead_code, reason = "each test file is a program of its own and uses a part of this")]

use core::time::Duration;
use std::fs::{self, File};
use std::io::{Read as _, Seek as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::Instant;

pub(crate) mod case;
pub(crate) mod effects;
pub(crate) mod golden;
pub(crate) mod picture;

pub(crate) use picture::Picture;

/// The command under test.
pub(crate) const ETENDUE: &str = env!("CARGO_BIN_EXE_etendue");

/// What a run of the command left behind.
#[derive(Debug)]
pub(crate) struct Outcome {
    /// Exit code; `None` when a signal ended the process.
    pub(crate) exit: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Outcome {
    /// What standard error reports as errors, with the indented lines that belong to each. Those of the argument parser have
    /// no program name in front.
    pub(crate) fn errors(&self) -> Vec<String> {
        let mut errors: Vec<String> = Vec::new();
        let mut is_part = false;
        for line in self.stderr.lines() {
            if line.starts_with("etendue: error:") || line.starts_with("error:") {
                errors.push(line.to_owned());
                is_part = true;
            } else if let (true, true, Some(error)) =
                (is_part, line.starts_with(' '), errors.last_mut())
            {
                *error += "\n";
                *error += line;
            } else {
                is_part = false;
            }
        }
        errors
    }

    /// The lines of standard error that warn.
    pub(crate) fn warnings(&self) -> Vec<&str> {
        self.stderr.lines().filter(|l| l.starts_with("etendue: warning:")).collect()
    }

    /// Standard output as one JSON value.
    pub(crate) fn json(&self) -> serde_json::Value {
        assert_eq!(self.stdout.lines().count(), 1, "one line: {}", self.stdout);
        serde_json::from_str(&self.stdout).expect("JSON")
    }
}

impl From<Output> for Outcome {
    fn from(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).expect("the command prints UTF-8");
        Self {
            exit: output.status.code(),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        }
    }
}

/// What a run of the command may take.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    pub(crate) time: Duration,
    /// Bytes of address space, where the system can bound it (Linux).
    pub(crate) memory: u64,
}

/// A folder for one test, removed at its end.
pub(crate) struct Folder(tempfile::TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary folder"))
    }

    /// The path of a file in the folder.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).expect("a writable temporary folder");
    }

    /// The text of a file.
    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// A file as one JSON value.
    pub(crate) fn json(&self, name: &str) -> serde_json::Value {
        serde_json::from_str(&self.read(name)).expect("JSON")
    }

    /// Names of everything in the folder, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).expect("a readable temporary folder");
        let name = |entry: std::io::Result<fs::DirEntry>| {
            entry.expect("an entry").file_name().into_string().expect("a name in UTF-8")
        };
        let mut names: Vec<String> = entries.map(name).collect();
        names.sort();
        names
    }

    /// The command with the folder as current directory.
    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(ETENDUE);
        command.args(arguments).current_dir(self.0.path());
        command
    }

    /// Runs the command in the folder.
    pub(crate) fn run(&self, arguments: &[&str]) -> Outcome {
        self.command(arguments).output().expect("the command starts").into()
    }

    /// Runs the command in the folder; it must succeed.
    pub(crate) fn succeed(&self, arguments: &[&str]) -> Outcome {
        let outcome = self.run(arguments);
        assert_eq!(outcome.exit, Some(0), "{arguments:?}: {}", outcome.stderr);
        outcome
    }

    /// Runs the command in the folder; it must be refused with one error that says all of the given.
    pub(crate) fn refuse(&self, arguments: &[&str], exit: i32, says: &[&str]) {
        let outcome = self.run(arguments);
        assert_eq!(outcome.exit, Some(exit), "{arguments:?}: {}", outcome.stderr);
        let errors = outcome.errors();
        assert_eq!(errors.len(), 1, "{arguments:?}: {}", outcome.stderr);
        for fragment in says {
            assert!(errors[0].contains(fragment), "{fragment:?} is not said: {}", errors[0]);
        }
    }

    /// Runs the command in the folder; beyond the limits it is killed. Standard input stays open and silent, so that who reads it
    /// waits.
    pub(crate) fn run_within(&self, limits: Limits, arguments: &[&str]) -> Outcome {
        let mut command = if cfg!(target_os = "linux") {
            let mut shell = Command::new("sh");
            // Every arena of the C library would reserve 64 MiB.
            shell.env("MALLOC_ARENA_MAX", "1").env("RAYON_NUM_THREADS", "2");
            shell.args(["-c", r#"ulimit -v "$1"; shift; exec "$@""#, "sh"]);
            shell.arg((limits.memory >> 10).to_string()).arg(ETENDUE);
            shell
        } else {
            Command::new(ETENDUE)
        };
        let [mut stdout, mut stderr] = [(); 2].map(|()| tempfile::tempfile().expect("a file"));
        let into = |file: &File| Stdio::from(file.try_clone().expect("a file"));
        command.args(arguments).current_dir(self.0.path()).stdin(Stdio::piped());
        command.stdout(into(&stdout)).stderr(into(&stderr));
        let start = Instant::now();
        let mut child = command.spawn().expect("the command starts");
        let status = loop {
            if let Some(status) = child.try_wait().expect("a child") {
                break Some(status);
            }
            if start.elapsed() > limits.time {
                child.kill().and_then(|()| child.wait()).expect("a child");
                break None;
            }
            sleep(Duration::from_millis(2));
        };
        let text = |file: &mut File| {
            let mut text = String::new();
            file.rewind().and_then(|()| file.read_to_string(&mut text)).expect("UTF-8");
            text
        };
        let (stdout, mut stderr) = (text(&mut stdout), text(&mut stderr));
        if status.is_none() {
            stderr += &format!("\nkilled after {:?}", limits.time);
        }
        Outcome { exit: status.and_then(|status| status.code()), stdout, stderr }
    }

    /// Renders to `out.pfm`, which must succeed, and reads the picture.
    pub(crate) fn render(&self, scene: &Path, arguments: &[&str]) -> Picture {
        let scene = scene.to_str().expect("a path in UTF-8");
        let fixed = ["render", scene, "-o", "out.pfm", "--quiet"];
        let outcome = self.run(&[&fixed, arguments].concat());
        assert_eq!(outcome.exit, Some(0), "{scene} {arguments:?}: {}", outcome.stderr);
        Picture::read_pfm(&self.path("out.pfm"))
    }
}

/// Waits until the threads of the render are there; their names begin with `render`.
#[cfg(target_os = "linux")]
pub(crate) fn wait_until_rendering(child: &mut Child) {
    let tasks = format!("/proc/{}/task", child.id());
    let is_render = |task: std::io::Result<fs::DirEntry>| {
        let name = task.and_then(|task| fs::read_to_string(task.path().join("comm")));
        name.is_ok_and(|name| name.starts_with("render"))
    };
    while !fs::read_dir(&tasks).is_ok_and(|mut tasks| tasks.any(is_render)) {
        let ended = child.try_wait().expect("a child of this process");
        assert_eq!(ended, None, "it ends by itself");
        sleep(Duration::from_millis(10));
    }
}

/// Loading takes milliseconds.
#[cfg(all(unix, not(target_os = "linux")))]
pub(crate) fn wait_until_rendering(_: &mut Child) {
    sleep(Duration::from_secs(1));
}

/// A file of the repository.
pub(crate) fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)
}

/// A scene file with a camera of 4 × 4 pixels at (0, 0, 5) that looks at the origin; `body` begins
/// on line 3.
pub(crate) fn scene(body: &str) -> String {
    let camera = r#"<transform name="to_world"><lookat origin="0 0 5" target="0 0 0" up="0 1 0"/></transform>"#;
    let film = r#"<film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/></film>"#;
    format!(
        "<scene version=\"3.0.0\">\n<sensor type=\"perspective\">{camera}{film}</sensor>\n{body}\n</scene>\n"
    )
}
