//! The folder that a scene stays in.

use alloc::format;
use alloc::sync::Arc;
use std::io;
use std::path::{Path, PathBuf, absolute};

use crate::error::{Location, SceneError};

/// The folder that the files a scene names must lie in, if there is one.
///
/// What counts is where a file is, not how it is named: links and `..` are followed first. A scene that is trusted may name files
/// anywhere, which is the default.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sandbox(Option<Arc<Path>>);

impl Sandbox {
    /// The folder of a file, and what is below it.
    ///
    /// # Errors
    /// A folder that does not exist.
    ///
    /// # Examples
    /// ```
    /// use etendue_scene::load::Sandbox;
    /// let folder = tempfile::tempdir()?;
    /// let sandbox = Sandbox::beside(&folder.path().join("scene.xml"))?;
    /// assert!(sandbox.check(&folder.path().join("textures/wood.png")).is_ok());
    /// assert!(sandbox.check(&folder.path().join("../wood.png")).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn beside(file: &Path) -> Result<Self, SceneError> {
        let folder = absolute(file).map(|file| file.parent().map(Path::to_path_buf));
        let folder = folder.and_then(|folder| folder.unwrap_or_default().canonicalize());
        let folder: PathBuf = folder.map_err(|error| SceneError::io(file, &error))?;
        Ok(Self(Some(folder.into())))
    }

    /// Refuses a path that leads out of the folder.
    ///
    /// Of a file that does not exist, the nearest folder above it that does says where it would be: whether there is such a file
    /// outside is nothing a scene can find out.
    ///
    /// # Errors
    /// [`ErrorKind::Io`](crate::ErrorKind::Io) for a file that is elsewhere.
    pub fn check(&self, path: &Path) -> Result<(), SceneError> {
        let Some(folder) = &self.0 else { return Ok(()) };
        let io = |error: io::Error| SceneError::io(path, &error);
        let whole = absolute(path).map_err(io)?;
        let place = whole.ancestors().find_map(|part| part.canonicalize().ok());
        if place.is_some_and(|place| place.starts_with(folder)) {
            return Ok(());
        }
        let error = SceneError {
            kind: crate::ErrorKind::Io,
            ..SceneError::scene(Location::file(path), "not read: it is outside of the sandbox")
        };
        Err(error.help(format!("copy it to {}, or render without --sandbox", folder.display())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind;
    use std::fs;

    #[test]
    fn without_a_folder_everything_may_be_read() {
        assert_eq!(Sandbox::default().check(Path::new("/etc/passwd")), Ok(()));
    }

    #[test]
    fn what_leads_out_is_refused_whether_it_is_there_or_not() {
        let outside = tempfile::tempdir().expect("a temporary folder");
        let inside = outside.path().join("scene");
        fs::create_dir_all(inside.join("textures")).expect("writable");
        fs::write(outside.path().join("secret"), "").expect("writable");
        let sandbox = Sandbox::beside(&inside.join("a.xml")).expect("a folder");
        for name in ["a.png", "textures/a.png", "textures/../a.png", "missing/a.png", "./a.png", ""]
        {
            assert_eq!(sandbox.check(&inside.join(name)), Ok(()), "{name}");
        }
        for name in [
            "../secret",
            "../none",
            "textures/../../secret",
            "/",
            "/etc/passwd",
            "/none/at/all",
            "..",
        ] {
            let error = sandbox.check(&inside.join(name)).expect_err(name);
            assert_eq!(error.kind, ErrorKind::Io, "{name}");
        }
        // A folder of a name that only begins as the sandbox does.
        fs::create_dir(outside.path().join("scene-2")).expect("writable");
        assert!(sandbox.check(&inside.join("../scene-2/a.png")).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed() {
        use std::os::unix::fs::symlink;
        let outside = tempfile::tempdir().expect("a temporary folder");
        let inside = outside.path().join("scene");
        fs::create_dir(&inside).expect("writable");
        fs::write(outside.path().join("secret"), "").expect("writable");
        fs::write(inside.join("open"), "").expect("writable");
        symlink("../secret", inside.join("file")).expect("writable");
        symlink("..", inside.join("folder")).expect("writable");
        symlink("open", inside.join("within")).expect("writable");
        let sandbox = Sandbox::beside(&inside.join("a.xml")).expect("a folder");
        assert_eq!(sandbox.check(&inside.join("within")), Ok(()));
        for name in ["file", "folder/secret", "folder/none", "folder"] {
            assert!(sandbox.check(&inside.join(name)).is_err(), "{name}");
        }
        // The folder itself may be reached by one.
        symlink(&inside, outside.path().join("alias")).expect("writable");
        let alias = outside.path().join("alias");
        let sandbox = Sandbox::beside(&alias.join("a.xml")).expect("a folder");
        assert_eq!(sandbox.check(&alias.join("open")), Ok(()));
    }
}
