//! What a picture says about its own making.

use etendue_renderer::progressive::ImageError;
use etendue_renderer::{SampleAddress, Statistics};

/// Facts stored in the picture's header where the format has room for them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Metadata {
    /// The scene file as given on the command line.
    pub(crate) scene: String,
    /// Samples per pixel, in the mean over the picture.
    pub(crate) samples_per_pixel: f64,
    /// What was done.
    pub(crate) statistics: Statistics,
    /// Seed.
    pub(crate) seed: u64,
    /// Seconds of rendering.
    pub(crate) seconds: f64,
    /// Where samples that are no light come from, and light that is cut, as far as that is known: names and values of entries.
    pub(crate) sources: Vec<(&'static str, String)>,
    /// What was compiled in.
    pub(crate) configuration: String,
    /// The relative error of the picture, where it is known.
    pub(crate) error: Option<ImageError>,
    /// The stored render of which this is a part, as [`Stored`](crate::checkpoint::Stored) has it: it follows the picture.
    pub(crate) part: Option<Vec<u8>>,
}

/// Name of the number of bytes of a part of a render.
pub(super) const PART: &str = "etendue.part";

impl Metadata {
    /// Most samples of one defect that are named one by one.
    pub(crate) const NAMED: usize = 16;

    /// Name and value of every entry.
    pub(crate) fn entries(&self) -> Vec<(&'static str, String)> {
        let Statistics { samples, rays, non_finite, negative } = &self.statistics;
        let mut entries = vec![
            ("etendue.version", env!("CARGO_PKG_VERSION").to_owned()),
            ("etendue.scene", self.scene.clone()),
            ("etendue.spp", self.samples_per_pixel.to_string()),
            ("etendue.samples", samples.to_string()),
            ("etendue.seed", self.seed.to_string()),
            ("etendue.seconds", format!("{:.3}", self.seconds)),
            ("etendue.non_finite", non_finite.count().to_string()),
            ("etendue.negative", negative.count().to_string()),
            ("etendue.cut_paths", rays.cut.to_string()),
            ("etendue.cut_throughput", rays.cut_share(*samples).to_string()),
            ("etendue.configuration", self.configuration.clone()),
        ];
        if let Some(part) = &self.part {
            entries.push((PART, part.len().to_string()));
        }
        for (name, samples) in
            [("etendue.first_non_finite", non_finite), ("etendue.first_negative", negative)]
        {
            let first = samples.some().into_iter().take(Self::NAMED).map(|address| {
                let SampleAddress { column, row, sample } = address;
                format!("{column},{row},{sample}")
            });
            let first: Vec<String> = first.collect();
            if !first.is_empty() {
                entries.push((name, first.join("; ")));
            }
        }
        entries.extend(self.sources.iter().cloned());
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
