//! The document: JSON by itself or in a binary container.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::glb;
use super::json::Json;
use crate::load::{Sandbox, read_asset};
use crate::{Location, SceneError, Warning};

/// The largest JSON that is read, in bytes, as of scene files.
const LARGEST: usize = 1 << 28;

/// The extensions that mean something here.
pub(super) const EXTENSIONS: [&str; 13] = [
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_texture_transform",
];

/// Those that only allow what is read anyway.
const FREE_EXTENSIONS: [&str; 1] = ["KHR_mesh_quantization"];

/// A file that says what there is; the numbers are in its buffers.
#[derive(Debug)]
pub(super) struct Document {
    file: PathBuf,
    root: Value,
    /// The buffer inside a binary container.
    binary: Option<Vec<u8>>,
    /// An object that says nothing.
    empty: Value,
    /// Where the files that it names must lie.
    sandbox: Sandbox,
}

impl Document {
    /// Reads a file.
    ///
    /// # Errors
    /// A file that cannot be read, and what [`parse`](Self::parse) refuses.
    pub(super) fn read(path: &Path, sandbox: &Sandbox) -> Result<Self, SceneError> {
        let document = Self::parse(&read_asset(path)?, path)?;
        Ok(Self { sandbox: sandbox.clone(), ..document })
    }

    /// Reads the content of a file: binary containers are told by their first bytes.
    ///
    /// # Errors
    /// What is no JSON, a container that is cut off, a version other than 2, required extensions that are not known.
    pub(super) fn parse(bytes: &[u8], path: &Path) -> Result<Self, SceneError> {
        let (text, binary) =
            if bytes.starts_with(&glb::MAGIC) { glb::chunks(bytes, path)? } else { (bytes, None) };
        if text.len() > LARGEST {
            let message =
                format!("{} bytes of JSON are more than the {LARGEST} allowed", text.len());
            return Err(SceneError::resource(Location::file(path), message)
                .help("keep buffers and images in files of their own"));
        }
        let root: Value = serde_json::from_slice(text).map_err(|error| {
            SceneError::scene(Location::file(path), format!("not the JSON of a glTF file: {error}"))
        })?;
        let document = Self {
            file: path.to_path_buf(),
            root,
            binary: binary.map(Vec::from),
            empty: Value::Object(serde_json::Map::new()),
            sandbox: Sandbox::default(),
        };
        document.check()?;
        Ok(document)
    }

    fn check(&self) -> Result<(), SceneError> {
        let root = self.root();
        let asset = root.need("asset")?;
        for name in ["version", "minVersion"] {
            let Some(version) = asset.get(name)? else {
                if name == "version" {
                    asset.need(name)?;
                }
                continue;
            };
            let text = version.as_text()?;
            let is_read = match name {
                "version" => text.starts_with("2."),
                _ => text == "2.0",
            };
            if !is_read {
                let error = version.error(format!("glTF of version {text} is not supported"));
                return Err(error.help("export the model as glTF 2.0"));
            }
        }
        let required = self.unknown("extensionsRequired")?;
        if required.is_empty() {
            return Ok(());
        }
        let error = root.need("extensionsRequired")?.error(format!(
            "the file cannot be read without {}, which {} not supported",
            required.join(", "),
            if required.len() == 1 { "is" } else { "are" }
        ));
        Err(error.help(format!("export it without; supported are {}", EXTENSIONS.join(", "))))
    }

    /// The extensions of a list that are not known.
    fn unknown(&self, list: &str) -> Result<Vec<String>, SceneError> {
        let mut names = Vec::new();
        for item in self.root().items(list)? {
            let name = item.as_text()?;
            if !EXTENSIONS.contains(&name) && !FREE_EXTENSIONS.contains(&name) {
                names.push(name.to_string());
            }
        }
        Ok(names)
    }

    /// A warning about what the file uses and nobody here knows.
    pub(super) fn unknown_extensions(&self) -> Result<Option<Warning>, SceneError> {
        let unknown = self.unknown("extensionsUsed")?;
        if unknown.is_empty() {
            return Ok(None);
        }
        let message = format!("{} is not supported and left out", unknown.join(", "));
        Ok(self.root().get("extensionsUsed")?.map(|list| list.warning(message)))
    }

    /// The file.
    pub(super) fn file(&self) -> &Path {
        &self.file
    }

    /// Where the files that it names must lie.
    pub(super) fn sandbox(&self) -> &Sandbox {
        &self.sandbox
    }

    /// The buffer inside a binary container.
    pub(super) fn binary(&self) -> Option<&[u8]> {
        self.binary.as_deref()
    }

    /// The outermost value.
    pub(super) fn root(&self) -> Json<'_> {
        Json::root(&self.root, &self.file)
    }

    /// An object that says nothing, so that everything about it is as it is by default.
    pub(super) fn nothing(&self) -> Json<'_> {
        Json::root(&self.empty, &self.file)
    }

    /// The elements of one of the document's lists.
    pub(super) fn list(&self, name: &str) -> Result<Vec<Json<'_>>, SceneError> {
        self.root().items(name)
    }

    /// The element of a list of the document that a property names by its index, if it names one.
    ///
    /// # Errors
    /// An index beyond the list.
    pub(super) fn named<'a>(
        &'a self,
        by: &Json<'_>,
        property: &str,
        list: &str,
    ) -> Result<Option<(usize, Json<'a>)>, SceneError> {
        let Some(value) = by.get(property)? else { return Ok(None) };
        let index = value.as_index()?;
        self.element(&value, index, list).map(|element| Some((index, element)))
    }

    /// The element of a list that a value names.
    pub(super) fn element(
        &self,
        by: &Json<'_>,
        index: usize,
        list: &str,
    ) -> Result<Json<'_>, SceneError> {
        let found = self.root().get(list)?;
        let count = found.as_ref().map_or(Ok(0), Json::len)?;
        match found.map(|list| list.item(index)).transpose()?.flatten() {
            Some(element) => Ok(element),
            None => Err(by.error(format!("there is no {list}[{index}], the file has {count}"))),
        }
    }
}
