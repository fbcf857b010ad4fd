//! How much work a run spends.

/// Sizes of the generators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// Name in the report.
    pub name: &'static str,
    /// View directions per case for checks that integrate or count samples.
    pub viewers: usize,
    /// Samples per χ² test.
    pub samples: usize,
    /// Samples that shape the cells of an integral.
    pub pilot: usize,
    /// Pairs of directions per case for pointwise laws.
    pub pairs: usize,
    /// Samples per case for pointwise laws of samplers.
    pub draws: usize,
    /// Inputs per model of the comparison of `f32` with `f64`, over all its cases together.
    pub swept: u64,
}

impl Budget {
    /// For `cargo test`: every check on every case, in seconds on a debug-like build.
    pub const TEST: Self = Self {
        name: "test",
        viewers: 1,
        samples: 1 << 11,
        pilot: 1 << 9,
        pairs: 200,
        draws: 200,
        swept: 1 << 15,
    };
    /// The default of the command: less than two minutes on two cores.
    pub const SMOKE: Self = Self {
        name: "smoke",
        viewers: 3,
        samples: 1 << 16,
        pilot: 1 << 12,
        pairs: 10_000,
        draws: 10_000,
        swept: 1 << 19,
    };
    /// `--exhaustive`: a long run that looks for what the smoke run has too few points to meet.
    pub const EXHAUSTIVE: Self = Self {
        name: "exhaustive",
        viewers: 24,
        samples: 1 << 18,
        pilot: 1 << 13,
        pairs: 100_000,
        draws: 100_000,
        swept: 110_000_000,
    };
}
