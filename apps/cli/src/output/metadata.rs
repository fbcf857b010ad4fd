//! What a picture says about its own making.

use etendue_renderer::progressive::ImageError;

/// Facts stored in the picture's header where the format has room for them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Metadata {
    /// The scene file as given on the command line.
    pub(crate) scene: String,
    /// Samples per pixel, in the mean over the picture.
    pub(crate) samples_per_pixel: f64,
    /// Samples in all.
    pub(crate) samples: u64,
    /// Seed.
    pub(crate) seed: u64,
    /// Seconds of rendering.
    pub(crate) seconds: f64,
    /// Samples left out because they were NaN or infinite.
    pub(crate) non_finite: u64,
    /// Column, row and number of the first of them, and where each comes from.
    pub(crate) first_non_finite: Vec<String>,
    /// Samples that found less than no light.
    pub(crate) negative: u64,
    /// Paths that were cut for their number of edges, and what they carried of what the camera's rays do.
    pub(crate) cut_paths: u64,
    pub(crate) cut_throughput: f64,
    /// What was compiled in.
    pub(crate) configuration: String,
    /// The relative error of the picture, where it is known.
    pub(crate) error: Option<ImageError>,
    /// The stored render of which this is a part, as [`Stored`](crate::checkpoint::Stored) has it.
    pub(crate) part: Option<Vec<u8>>,
}

/// The attribute of an EXR picture that holds a part of a render.
pub(super) const PART: &str = "etendue.part";

impl Metadata {
    /// Name and value of every entry.
    pub(crate) fn entries(&self) -> Vec<(&'static str, String)> {
        let mut entries = vec![
            ("etendue.version", env!("CARGO_PKG_VERSION").to_owned()),
            ("etendue.scene", self.scene.clone()),
            ("etendue.spp", self.samples_per_pixel.to_string()),
            ("etendue.samples", self.samples.to_string()),
            ("etendue.seed", self.seed.to_string()),
            ("etendue.seconds", format!("{:.3}", self.seconds)),
            ("etendue.non_finite", self.non_finite.to_string()),
            ("etendue.negative", self.negative.to_string()),
            ("etendue.cut_paths", self.cut_paths.to_string()),
            ("etendue.cut_throughput", self.cut_throughput.to_string()),
            ("etendue.configuration", self.configuration.clone()),
        ];
        if !self.first_non_finite.is_empty() {
            entries.push(("etendue.first_non_finite", self.first_non_finite.join("; ")));
        }
        if let Some(error) = self.error {
            entries.extend([
                ("etendue.error", error.estimate.to_string()),
                ("etendue.error_lower", error.lower.to_string()),
                ("etendue.error_upper", error.upper.to_string()),
            ]);
        }
        entries
    }
}
