//! Roots of a cubic between 0 and 1.

use etendue_math::Real;

use crate::geometry::root::bracketed;

/// The roots of a cubic in `[0, 1]` in ascending order; a double root may come twice.
///
/// Cut at its extrema, the cubic has at most one root in each piece, which has one if and only if the signs of its ends
/// differ: nothing depends on a tolerance.
///
/// * `c`: the coefficients, that of the highest power last. * `end`: the value at 1, which may be known better than the
///   coefficients give it.
///
/// # Source
/// Marmitt, Kleer, Wald, Friedrich, "Fast and Accurate Ray-Voxel Intersection Techniques for Iso-Surface Ray Tracing",
/// VMV 2004.
pub(super) fn roots(c: [f64; 4], end: f64) -> impl Iterator<Item = f64> {
    let function = move |s: f64| {
        let [c0, c1, c2, c3] = c;
        [((c3 * s + c2) * s + c1) * s + c0, (3.0 * c3 * s + 2.0 * c2) * s + c1]
    };
    let knot = move |s: Option<f64>| s.map_or((1.0, end), |s| (s, function(s)[0]));
    let [first, second] = extrema(c);
    let knots = [(0.0, c[0]), knot(first), knot(second), (1.0, end)];
    let pieces = [[knots[0], knots[1]], [knots[1], knots[2]], [knots[2], knots[3]]];
    pieces.into_iter().filter_map(move |[(a, value), (b, other)]| {
        if value == 0.0 {
            Some(a)
        } else if other == 0.0 {
            Some(b)
        } else {
            let is_cut = (value < 0.0) != (other < 0.0);
            // Where the chord is 0.
            let guess = a + (b - a) * (value / (value - other));
            is_cut.then(|| bracketed(function, [a, b], guess, value < 0.0))
        }
    })
}

/// Where the derivative vanishes strictly between 0 and 1, in ascending order.
fn extrema([_, c1, c2, c3]: [f64; 4]) -> [Option<f64>; 2] {
    // 3 c₃ s² + 2 c₂ s + c₁, the root without cancellation first, the other one from the product.
    let discriminant = c2 * c2 - 3.0 * c3 * c1;
    if discriminant.is_nan() || discriminant < 0.0 {
        return [None; 2];
    }
    let q = -(c2 + Real::sqrt(discriminant).copysign(c2));
    let (a, b) = (q / (3.0 * c3), c1 / q);
    // Written so that NaN and infinity are no extrema.
    let within = |s: f64| (s > 0.0 && s < 1.0).then_some(s);
    match (within(a.min(b)), within(a.max(b))) {
        (None, second) => [second, None],
        both => [both.0, both.1],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    fn found(c: [f64; 4]) -> Vec<f64> {
        roots(c, c.iter().sum()).collect()
    }

    #[test]
    fn all_roots_between_0_and_1_are_found_in_order() {
        // (s − 0.2)(s − 0.5)(s − 0.9) and the same upside down.
        let three = [-0.09, 0.73, -1.6, 1.0];
        for c in [three, three.map(|c: f64| -c)] {
            let found = found(c);
            assert_eq!(found.len(), 3);
            for (s, root) in found.into_iter().zip([0.2, 0.5, 0.9]) {
                // The coefficients have sixteen digits, slopes at the roots are 0.1 or more.
                assert!(Real::abs(s - root) < 1e-14, "{s} {root}");
            }
        }
        assert_eq!(found([-1.0, 2.0, 0.0, 0.0]), [0.5]);
        assert_eq!(found([-0.25, 0.0, 1.0, 0.0]), [0.5]);
        assert_eq!(found([0.25, 0.0, 1.0, 0.0]), [0.0_f64; 0]);
        assert_eq!(found([1.0, 0.0, 0.0, 0.0]), [0.0_f64; 0]);
        assert_eq!(found([2.0, -1.0, 0.0, 0.0]), [0.0_f64; 0]);
    }

    #[test]
    fn a_double_root_is_touched() {
        // (s − 1/2)², exact in binary.
        let found = found([0.25, -1.0, 1.0, 0.0]);
        assert!(!found.is_empty() && found.iter().all(|&s| s == 0.5), "{found:?}");
    }

    #[test]
    fn signs_at_the_ends_decide() {
        // The value at the end says that there is a root, the coefficients do not.
        assert_eq!(roots([1.0, -1.0 + 1e-16, 0.0, 0.0], -1e-20).count(), 1);
        assert_eq!(roots([1.0, -1.0, 0.0, 0.0], 1e-20).count(), 0);
        assert_eq!(found([f64::NAN; 4]), [0.0_f64; 0]);
    }
}
