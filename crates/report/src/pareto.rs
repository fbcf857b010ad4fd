//! Which of many are not beaten.

/// Which points `[cost, error]` lie on the Pareto front: no other point is at least as good in both and better in one.
///
/// A point with a coordinate that is NaN is never on the front and beats nothing. Equal points are both on it.
///
/// # Examples
/// ```
/// use etendue_report::pareto_front;
/// let front = pareto_front(&[[1.0, 0.1], [2.0, 0.01], [2.5, 0.02]]);
/// assert_eq!(front, [true, true, false]);
/// ```
pub fn pareto_front(points: &[[f64; 2]]) -> Vec<bool> {
    let beats = |a: &[f64; 2], b: &[f64; 2]| a[0] <= b[0] && a[1] <= b[1] && a != b;
    points
        .iter()
        .map(|p| p.iter().all(|x| !x.is_nan()) && !points.iter().any(|other| beats(other, p)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_worse_in_one_and_equal_in_the_other_is_beaten() {
        let points = [[1.0, 1.0], [1.0, 2.0], [0.5, 1.0], [0.5, 1.0], [f64::NAN, 0.0]];
        assert_eq!(pareto_front(&points), [false, false, true, true, false]);
    }
}
