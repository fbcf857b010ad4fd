//! What variants are compared with.

mod double_double;
mod v_cavity;

pub use double_double::DoubleDouble;
pub use v_cavity::VCavities;

/// How long a reference may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Seconds per family.
    Full,
    /// Fewer points and samples: a glance.
    Quick,
}

impl Effort {
    /// One number for a full run and one for a quick one.
    pub fn choose<T>(self, full: T, quick: T) -> T {
        match self {
            Self::Full => full,
            Self::Quick => quick,
        }
    }
}

/// The true values at all points of a domain, and the true energies.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reference {
    /// Values at the points.
    pub values: Vec<f64>,
    /// Energies of the probes.
    pub energies: Vec<f64>,
    /// How far values and energies can be trusted, where that is not to the last digits.
    pub uncertainty: Option<Uncertainty>,
}

/// The error of a reference itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertainty {
    /// Root of the mean square over all points, as the family judges errors.
    pub rms: f64,
    /// The largest of the energies, absolute.
    pub energy: f64,
    /// Where the numbers come from.
    pub method: &'static str,
}
