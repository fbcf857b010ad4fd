//! Names of the random decisions of a path.

/// What a random number decides.
///
/// The numeric ids are part of every picture's bits: an id is never changed or reused, new
/// decisions get new ids. Ids leave room between the groups.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
#[repr(u16)]
pub enum Decision {
    /// Position within the pixel's filter.
    Film = 0,
    /// Position on the lens.
    Lens = 1,
    /// Instant within the shutter interval.
    Time = 2,
    /// Wavelength of a spectral path.
    Wavelength = 3,
    /// Whether a partly transparent surface is there at all.
    Opacity = 16,
    /// Which light is sampled.
    LightChoice = 17,
    /// Which point of the chosen light.
    LightPoint = 18,
    /// Which lobe of the scattering function.
    LobeChoice = 19,
    /// Direction within the chosen lobe.
    Direction = 20,
    /// Whether the path goes on.
    Roulette = 21,
    /// Distance to the next collision in a medium.
    Distance = 32,
    /// Direction of scattering in a medium.
    Phase = 33,
    /// Tentative collisions on the way through a medium of varying density.
    Tracking = 34,
    /// The same along a shadow ray.
    ShadowTracking = 35,
    /// Which light is scattered towards the ray, and where along it.
    Airlight = 36,
}

/// One random decision of a path: which vertex takes it, and what it is about.
///
/// Random numbers are *addressed* by dimension, not drawn in sequence: a decision that is not taken
/// (an effect left out, a delta lobe that needs no direction) shifts no other number.
///
/// # Examples
/// ```
/// use etendue_sampling::{Decision, Dimension};
/// let lens = Dimension::camera(Decision::Lens);
/// let first_bounce = Dimension::vertex(1, Decision::Direction);
/// assert_ne!(lens.id(), first_bounce.id());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Dimension {
    vertex: u16,
    decision: Decision,
}

impl Dimension {
    /// A decision taken at the camera, vertex 0 of every path.
    pub const fn camera(decision: Decision) -> Self {
        Self::vertex(0, decision)
    }

    /// A decision taken at vertex `vertex` of the path, counted from the camera (vertex 0).
    pub const fn vertex(vertex: u16, decision: Decision) -> Self {
        Self { vertex, decision }
    }

    /// The number that stands for this dimension in an address; different for every dimension.
    ///
    /// ```text
    /// id = 2¹⁶ · vertex + decision
    /// ```
    pub const fn id(self) -> u32 {
        (self.vertex as u32) << 16 | self.decision as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_are_the_published_ones() {
        // Changing any of these changes every picture.
        assert_eq!(Dimension::camera(Decision::Film).id(), 0);
        assert_eq!(Dimension::camera(Decision::Wavelength).id(), 3);
        assert_eq!(Dimension::vertex(0, Decision::Opacity).id(), 16);
        assert_eq!(Dimension::vertex(2, Decision::Roulette).id(), 0x2_0015);
        assert_eq!(Dimension::vertex(u16::MAX, Decision::Phase).id(), 0xffff_0021);
    }
}
