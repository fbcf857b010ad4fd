//! Inputs: directions and uniforms, ordinary and hostile, all from fixed hashes.

mod directions;
mod hostile;
mod sweep;
mod uniforms;

pub use directions::{from_angles, pair, unit_pair, viewers};
pub use hostile::{HOSTILE_UNIFORMS, poisoned, unit_grid, unnormalised};
pub use sweep::{SweepPair, SweepPairs};
pub use uniforms::uniforms;
