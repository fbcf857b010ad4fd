//! Why a scene cannot be rendered here.

use core::error::Error;
use core::fmt::{Display, Formatter, Result};

use crate::Configuration;

/// Why a scene cannot be rendered by this program on this machine.
#[derive(Debug)]
pub enum RendererError {
    /// The threads that a render needs could not be started.
    Threads(rayon::ThreadPoolBuildError),
    /// The program was compiled without what the scene calls for.
    NotCompiled(Configuration),
    /// There is no memory for a picture of so many pixels.
    Memory {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
}

impl Display for RendererError {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Threads(error) => {
                write!(f, "the threads for rendering could not be started: {error}")
            }
            Self::Memory { width, height } => {
                write!(f, "a picture of {width} × {height} pixels does not fit in memory")
            }
            Self::NotCompiled(configuration) => {
                let name = configuration.name();
                write!(
                    f,
                    "this program was compiled without the feature “{name}” of etendue-renderer, which the scene calls for"
                )
            }
        }
    }
}

impl Error for RendererError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Threads(error) => Some(error),
            Self::NotCompiled(_) | Self::Memory { .. } => None,
        }
    }
}
