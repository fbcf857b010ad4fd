//! Arguments of every command that writes a picture.

use super::values::exposure;
use crate::output::{Encoding, Precision};

/// How a picture is encoded.
#[derive(Debug, clap::Args)]
pub(crate) struct EncodingArguments {
    /// Brighten 8-bit pictures by this many stops.
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, value_parser = exposure, allow_hyphen_values = true)]
    exposure: f32,
    /// Sample type of EXR pictures.
    #[arg(long, value_name = "TYPE", default_value = "float")]
    precision: Precision,
}

impl EncodingArguments {
    pub(crate) fn encoding(&self) -> Encoding {
        Encoding { precision: self.precision, exposure: self.exposure }
    }
}
