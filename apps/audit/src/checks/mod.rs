//! The laws, one per file. Each says what it asserts, its tolerance and the reason for it.

mod albedo;
mod chi_square;
mod delta;
mod density;
mod energy;
mod hostile;
mod normalisation;
mod published_albedo;
mod reciprocity;
mod strong_furnace;
mod textbook;
mod weight;

use crate::budget::Budget;
use crate::measure::Outcome;
use crate::scalar::Scalar;
use crate::subject::Subject;

/// What a check needs besides its subject.
#[derive(Clone, Copy, Debug)]
pub struct Context {
    /// How much work to do.
    pub budget: Budget,
    /// Significance of one statistical test, corrected for their number.
    pub significance: f64,
}

/// A law and the name the report gives it.
pub struct Check<T: Scalar> {
    /// Name, as `--filter` matches it.
    pub name: &'static str,
    /// The check itself.
    pub run: fn(&Subject<T>, &Context) -> Outcome,
}

/// Every law that is asked of one precision at a time, in the order of the report.
pub fn all<T: Scalar>() -> [Check<T>; 12] {
    [
        Check { name: "textbook", run: textbook::check },
        Check { name: "reciprocity", run: reciprocity::check },
        Check { name: "energy", run: energy::check },
        Check { name: "strong-furnace", run: strong_furnace::check },
        Check { name: "albedo", run: albedo::check },
        Check { name: "published-albedo", run: published_albedo::check },
        Check { name: "normalisation", run: normalisation::check },
        Check { name: "chi-square", run: chi_square::check },
        Check { name: "weight", run: weight::check },
        Check { name: "density", run: density::check },
        Check { name: "delta", run: delta::check },
        Check { name: "hostile", run: hostile::check },
    ]
}

/// Names of the checks of [`sweep`](crate::sweep), which compare the two precisions.
pub const SWEPT: [&str; 2] = ["precision", "finite"];
