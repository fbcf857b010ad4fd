//! Groups on their way.

use super::{Motion, ShapeId};

/// A group that is somewhere else at every moment while the shutter is open.
#[derive(Clone, Debug)]
pub(super) struct Moving {
    pub(super) group: u32,
    pub(super) motion: Motion,
    pub(super) origin: Origin,
}

/// What moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Origin {
    /// A shape, the only one of its group.
    Shape(ShapeId),
    /// An instance of a group.
    Instance,
}
