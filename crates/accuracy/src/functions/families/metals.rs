//! The complex indices of metals.

use crate::functions::domain::{logarithmic, narrow};
use crate::functions::reference::{DoubleDouble, Effort};

/// The set of [`metals`] in words.
pub(super) const WORDS: &str = "complex indices η + ik with η from 0.05 to 4 and k from 1 to 10, by their logarithms, whose \
                                reflectance at normal incidence is at least 0.4: where metals lie";

/// Indices `[η, k]`.
pub(super) fn metals(effort: Effort) -> Vec<[f64; 2]> {
    let count = effort.choose(12, 4);
    let pairs = logarithmic([0.05, 4.0], count)
        .flat_map(|eta| logarithmic([1.0, 10.0], count).map(move |k| [narrow(eta), narrow(k)]));
    pairs.filter(|&index| reflectance(1.0, index) >= 0.4).collect()
}

/// The reflectance of a conductor in the common form of textbooks, in 106 bits.
pub(super) fn reflectance(cos: f64, [eta, k]: [f64; 2]) -> f64 {
    let [c, eta, k] = [cos, eta, k].map(DoubleDouble::from);
    let [half, one, two, four] = [0.5, 1.0, 2.0, 4.0].map(DoubleDouble::from);
    let c2 = c.sqr();
    let s2 = one - c2;
    let t0 = eta.sqr() - k.sqr() - s2;
    let sum = (t0.sqr() + four * eta.sqr() * k.sqr()).sqrt();
    let a = (half * (sum + t0)).sqrt();
    let (t1, t2) = (sum + c2, two * a * c);
    let rs = (t1 - t2) / (t1 + t2);
    let (t3, t4) = (c2 * sum + s2.sqr(), t2 * s2);
    (half * (rs + rs * (t3 - t4) / (t3 + t4))).to_f64()
}
