//! Writing pictures: the format by extension, checked before rendering, replaced atomically.

use std::path::Path;

use etendue_renderer::Image;

use crate::failure::Failure;

mod aov;
mod destination;
mod exr;
mod hdr;
mod metadata;
mod pfm;
mod png;

pub(crate) use self::exr::{Precision, part_length};
pub(crate) use aov::{Aov, Channel, Sources, of_bad_samples, of_part};
pub(crate) use destination::Destination;
pub(crate) use metadata::Metadata;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Exr,
    Hdr,
    Png,
    Pfm,
}

impl Format {
    fn of(path: &Path) -> Result<Self, Failure> {
        let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        match extension.as_deref() {
            Some("exr") => Ok(Self::Exr),
            Some("hdr") => Ok(Self::Hdr),
            Some("png") => Ok(Self::Png),
            Some("pfm") => Ok(Self::Pfm),
            _ => Err(Failure::usage(format!(
                "{}: unknown picture format; name the output *.exr, *.hdr, *.png or *.pfm",
                path.display()
            ))),
        }
    }
}

/// How a picture is written where the format leaves a choice.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Encoding {
    /// Sample type of EXR files.
    pub(crate) precision: Precision,
    /// Stops by which 8-bit pictures are brightened.
    pub(crate) exposure: f32,
}

/// A picture's destination, found writable, and its format.
#[derive(Debug)]
pub(crate) struct Output {
    destination: Destination,
    format: Format,
}

impl Output {
    /// Checks the extension and that a file can be created beside the destination.
    pub(crate) fn check(path: &Path) -> Result<Self, Failure> {
        let format = Format::of(path)?;
        Ok(Self { destination: Destination::check(path)?, format })
    }

    /// Whether the format has room for layers.
    pub(crate) fn has_layers(&self) -> bool {
        self.format == Format::Exr
    }

    /// Refuses a format that has no room for layers.
    pub(crate) fn check_layers(&self) -> Result<(), Failure> {
        if self.has_layers() {
            return Ok(());
        }
        Err(Failure::usage(format!(
            "{}: only EXR pictures have layers; name the output *.exr or leave out --aov",
            self.path().display()
        )))
    }

    pub(crate) fn path(&self) -> &Path {
        self.destination.path()
    }

    /// Refuses a format that has no room for a part of a render.
    pub(crate) fn check_part(&self) -> Result<(), Failure> {
        if self.has_layers() {
            return Ok(());
        }
        Err(Failure::usage(format!(
            "{}: parts of renders are EXR pictures; name the output *.exr",
            self.path().display()
        )))
    }

    /// Encodes and writes the picture, with layers where the format has them; the destination is either untouched or complete.
    pub(crate) fn write(
        &self,
        image: &Image,
        layers: &[Channel],
        encoding: Encoding,
        metadata: &Metadata,
    ) -> Result<(), Failure> {
        let mut bytes = Vec::new();
        match self.format {
            Format::Exr => exr::encode(&mut bytes, image, layers, encoding.precision, metadata),
            Format::Hdr => hdr::encode(&mut bytes, image),
            Format::Png => png::encode(&mut bytes, image, encoding.exposure),
            Format::Pfm => pfm::encode(&mut bytes, image),
        }
        .map_err(|error| Failure::write(self.path(), error))?;
        // Readers of pictures do not look beyond the end that the header tells.
        bytes.extend_from_slice(metadata.part.as_deref().unwrap_or_default());
        self.destination.write(&bytes)
    }
}

/// Writing elsewhere what cannot be written where it was to be.
impl Output {
    /// As [`write`](Self::write); where that fails, a picture of the same name is written beside the checkpoint, in the current folder or in
    /// that of temporary files, whichever is possible first, and the failure says where.
    pub(crate) fn write_or_rescue(
        &self,
        image: &Image,
        layers: &[Channel],
        encoding: Encoding,
        metadata: &Metadata,
        elsewhere: Option<&Path>,
    ) -> Result<(), Failure> {
        let Err(failure) = self.write(image, layers, encoding, metadata) else { return Ok(()) };
        let temporary = std::env::temp_dir();
        let folders = elsewhere.into_iter().chain([Path::new("."), temporary.as_path()]);
        for folder in folders {
            let path = folder.join(self.path().file_name().unwrap_or_default());
            // Nothing that is there is replaced.
            if path.exists() {
                continue;
            }
            let rescued = Self::check(&path)
                .and_then(|output| output.write(image, layers, encoding, metadata));
            if rescued.is_ok() {
                return Err(
                    failure.adding(&format!("; the picture is in {} instead", path.display()))
                );
            }
        }
        Err(failure.adding("; nor could the picture be written anywhere else"))
    }
}

/// What an encoder may fail with.
type EncodeResult = Result<(), Box<dyn std::error::Error>>;

#[cfg(test)]
mod tests {
    use super::*;

    fn written(name: &str) -> Vec<u8> {
        let directory = tempfile::tempdir().expect("a temporary directory");
        let path = directory.path().join(name);
        let output = Output::check(&path).expect("writable");
        let encoding = Encoding { precision: Precision::Float, exposure: 0.0 };
        let pixels = vec![[0.25, 0.5, 1.0].into(), [0.0, 2.0, 1e-3].into()];
        let image = Image::from_pixels([2, 1], pixels).expect("two pixels");
        output.write(&image, &[], encoding, &Metadata::default()).expect("written");
        let left: Vec<_> = std::fs::read_dir(directory.path()).expect("listing").collect();
        assert_eq!(left.len(), 1, "no temporary file stays behind");
        std::fs::read(path).expect("readable")
    }

    #[test]
    fn every_format_starts_with_its_signature() {
        assert_eq!(written("a.exr")[..4], [0x76, 0x2f, 0x31, 0x01]);
        assert_eq!(written("a.png")[..4], *b"\x89PNG");
        assert_eq!(written("a.hdr")[..10], *b"#?RADIANCE");
        assert_eq!(written("a.pfm")[..3], *b"PF\n");
    }

    #[test]
    fn unknown_extensions_and_missing_directories_are_refused_before_rendering() {
        let usage = Output::check(Path::new("a.gif")).expect_err("unknown format");
        assert_eq!(usage.exit, crate::failure::Exit::Usage);
        let missing =
            Output::check(Path::new("no/such/directory/a.exr")).expect_err("no directory");
        assert_eq!(missing.exit, crate::failure::Exit::InputOutput);
    }
}
