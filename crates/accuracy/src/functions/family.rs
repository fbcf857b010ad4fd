//! Ways of computing one quantity.

use super::reference::{Effort, Reference};
use super::variant::Variant;

/// What a family is called and how it is set up.
pub struct FamilyInfo {
    /// Its name for programs: lower-case words joined by hyphens.
    pub name: &'static str,
    /// Its name for people.
    pub title: &'static str,
    /// Sets it up; the reference is not computed yet.
    pub build: fn(Effort) -> Setup,
}

/// What the file of a family says.
pub struct Setup {
    /// What is computed, with its symbol and its unit.
    pub quantity: &'static str,
    /// By which error variants are judged in the chart and on the front.
    pub judged_by: ErrorKind,
    /// The variants, first the exact one: the one whose error the audit bounds. Times are ratios to its time.
    pub variants: Vec<Variant>,
    /// What the error of the exact one, as [`judged_by`](Self::judged_by), may be against the reference.
    pub bound: f64,
    /// The domain.
    pub ground: Box<dyn Ground>,
    /// What the reference is.
    pub reference: &'static str,
    /// Computes the reference.
    pub compute: Box<dyn Fn() -> Reference>,
    /// Paragraphs that explain the variants.
    pub prose: Vec<&'static str>,
    /// Which to choose when.
    pub advice: &'static str,
}

/// A domain without the type of its points.
pub trait Ground {
    /// The domain in words.
    fn words(&self) -> &str;
    /// How many points it has.
    fn len(&self) -> usize;
    /// Whether it has none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Point `i` in the quantities of the domain.
    fn place(&self, i: usize) -> String;
    /// Where energy `i` is taken.
    fn energy_place(&self, i: usize) -> &str;
}

impl<P> Ground for std::rc::Rc<super::Domain<P>> {
    fn words(&self) -> &str {
        &self.words
    }
    fn len(&self) -> usize {
        self.points.len()
    }
    fn place(&self, i: usize) -> String {
        (self.place)(&self.points[i])
    }
    fn energy_place(&self, i: usize) -> &str {
        &self.probes[i].place
    }
}

/// How differences over a domain become one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorKind {
    /// Root of the mean square of the differences.
    RmsAbsolute,
    /// The same of the differences divided by the reference.
    RmsRelative,
}

impl ErrorKind {
    /// For the axis of a chart.
    pub fn label(self) -> &'static str {
        match self {
            Self::RmsAbsolute => "RMS absolute error",
            Self::RmsRelative => "RMS relative error",
        }
    }
}

/// A family, set up.
pub struct Family {
    /// Its name for programs.
    pub name: &'static str,
    /// Its name for people.
    pub title: &'static str,
    /// What its file says.
    pub setup: Setup,
}

impl FamilyInfo {
    /// The family with as many points as `effort` allows.
    pub fn family(&self, effort: Effort) -> Family {
        Family { name: self.name, title: self.title, setup: (self.build)(effort) }
    }
}
