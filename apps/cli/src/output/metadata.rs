//! What a picture says about its own making.

/// Facts stored in the picture's header where the format has room for them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Metadata {
    /// The scene file as given on the command line.
    pub(crate) scene: String,
    /// Samples per pixel.
    pub(crate) samples_per_pixel: u32,
    /// Seed.
    pub(crate) seed: u64,
    /// Seconds of rendering.
    pub(crate) seconds: f64,
    /// Samples left out because they were NaN or infinite.
    pub(crate) non_finite: u64,
}

impl Metadata {
    /// Name and value of every entry.
    pub(crate) fn entries(&self) -> [(&'static str, String); 6] {
        [
            ("etendue.version", env!("CARGO_PKG_VERSION").to_owned()),
            ("etendue.scene", self.scene.clone()),
            ("etendue.spp", self.samples_per_pixel.to_string()),
            ("etendue.seed", self.seed.to_string()),
            ("etendue.seconds", format!("{:.3}", self.seconds)),
            ("etendue.non_finite", self.non_finite.to_string()),
        ]
    }
}
