//! The point for which a light is chosen.

use etendue_math::glam::Vec3;

/// A point that light is to be brought to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Receiver {
    /// World position.
    pub position: Vec3,
    /// Unit shading normal, on the viewer's side; of no consequence for [`Sides::Around`].
    pub normal: Vec3,
    /// Which sides can bring light to the viewer.
    pub sides: Sides,
}

/// From where a point scatters light to its viewer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sides {
    /// From the side of the normal only: it reflects.
    Front,
    /// From both sides: it transmits, too.
    Both,
    /// From everywhere alike: it is a point of a medium, and has no normal.
    Around,
}
