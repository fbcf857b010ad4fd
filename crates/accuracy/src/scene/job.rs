//! Pairs of pictures: the unit of work, and what is kept of one.

use serde::{Deserialize, Serialize};

use super::errors::PairErrors;

/// What one pair of pictures came to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Name of the variant.
    pub variant: String,
    /// Samples per pixel.
    pub samples_per_pixel: u32,
    /// Which pair.
    pub pair: u32,
    /// Seconds of either picture.
    pub seconds: [f64; 2],
    /// Their errors.
    pub errors: PairErrors,
}
