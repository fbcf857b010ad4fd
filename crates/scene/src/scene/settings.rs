//! How a scene is to be rendered.

/// Which source of random numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SamplerKind {
    /// Independent numbers.
    Independent,
    /// Owen-scrambled Sobol' points.
    #[default]
    Sobol,
}

/// How often a pixel is sampled, and by what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SamplingSettings {
    /// Source of random numbers.
    pub sampler: SamplerKind,
    /// Samples per pixel.
    pub samples_per_pixel: u32,
    /// Another seed gives another picture of the same scene.
    pub seed: u64,
}

impl Default for SamplingSettings {
    fn default() -> Self {
        Self { sampler: SamplerKind::default(), samples_per_pixel: 16, seed: 0 }
    }
}

/// What a picture shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shows {
    /// Radiance, in W sr⁻¹ m⁻².
    #[default]
    Light,
    /// How far the surfaces that are seen are from the near clipping plane, along the rays of the camera and in units of the
    /// scene; 0 where there is none.
    Distance,
}

/// What is known of a pixel beside its colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// Directional albedo of what is seen first.
    Albedo,
    /// Its shading normal.
    Normal,
    /// Its depth along the camera's axis.
    Depth,
    /// Its position.
    Position,
    /// Its texture coordinates.
    Uv,
    /// The number of its shape.
    Shape,
}

/// How far paths go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a question that a scene answers by itself"
)]
pub struct PathSettings {
    /// Largest number of edges: 1 shows emitters only, 2 adds direct light; `None` is unlimited.
    pub max_depth: Option<u32>,
    /// From which number of edges on paths are ended by chance.
    pub roulette_depth: u32,
    /// Whether emitters are invisible to the camera.
    pub hide_emitters: bool,
    /// Whether a direction must lie on the same side of the geometric normal as of the shading
    /// normal.
    pub strict_normals: bool,
    /// Whether paths know media, and shadow rays and counts of edges do not notice where light passes
    /// a surface straight on: Mitsuba's `volpath` instead of its `path`.
    pub volumes: bool,
    /// Whether paths carry wavelengths instead of RGB also where nothing in the scene disperses light.
    pub spectral: bool,
    /// What the picture shows: where it is no light, nothing above matters.
    pub shows: Shows,
}

impl Default for PathSettings {
    /// Mitsuba's defaults.
    fn default() -> Self {
        Self {
            max_depth: None,
            roulette_depth: 5,
            hide_emitters: false,
            strict_normals: false,
            volumes: false,
            spectral: false,
            shows: Shows::default(),
        }
    }
}
