//! Roots between two points at which a function has different signs.

use etendue_math::Real;

/// Newton's steps before only halves are taken: more than from a good start, few enough where they creep.
const NEWTON_STEPS: usize = 12;

/// Halves until nothing is left of an interval in `f64`, at most.
const HALVES: usize = 60;

/// A root of a function between `a` and `b`, at which its signs differ; one of them may be a root itself.
///
/// Newton's method in what is left of the interval, which is halved where a step leaves it. Ends where a step is not
/// larger than the rounding of the interval's length, and after [`NEWTON_STEPS`] + [`HALVES`] steps in any case.
///
/// * `function`: value and derivative. * `guess`: where to begin; in the middle where it is not inside.
/// * `is_negative`: whether the function is negative at `a`.
#[inline]
pub(super) fn bracketed(
    function: impl Fn(f64) -> [f64; 2],
    [a, b]: [f64; 2],
    guess: f64,
    is_negative: bool,
) -> f64 {
    let tolerance = f64::EPSILON * (b - a);
    let [mut low, mut high] = [a, b];
    let mut x = if guess > a && guess < b { guess } else { 0.5 * (a + b) };
    for step in 0..NEWTON_STEPS + HALVES {
        let [value, slope] = function(x);
        if value == 0.0 {
            return x;
        }
        if (value < 0.0) == is_negative {
            low = x;
        } else {
            high = x;
        }
        let newton = x - value / slope;
        // Written so that NaN is not inside.
        let is_inside = newton > low && newton < high;
        let next = if is_inside && step < NEWTON_STEPS { newton } else { 0.5 * (low + high) };
        if Real::abs(next - x) <= tolerance {
            return next;
        }
        x = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_found_whatever_newton_does() {
        let close = |found: f64, root: f64| {
            // Of intervals of length 2 or less.
            assert!(Real::abs(found - root) <= 2.0 * f64::EPSILON, "{found} {root}");
        };
        close(bracketed(|x| [x * x - 0.25, 2.0 * x], [0.0, 1.0], 0.9, true), 0.5);
        close(bracketed(|x| [0.25 - x * x, -2.0 * x], [0.0, 1.0], f64::NAN, false), 0.5);
        // A step from the middle, at which the slope vanishes, leads nowhere.
        close(bracketed(|x| [x * x * x - 1e-3, 3.0 * x * x], [-1.0, 1.0], 0.0, true), 0.1);
        // No slope is known at all.
        close(bracketed(|x| [x - 0.3, f64::NAN], [0.0, 1.0], 0.5, true), 0.3);
        // An end that is a root.
        close(bracketed(|x| [x - 1.0, 1.0], [0.0, 1.0], 0.5, true), 1.0);
    }
}
