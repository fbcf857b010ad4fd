//! Mirror directions and half vectors.

use etendue_math::{Real, Vector3};

/// The mirror direction of `w` about the normal `+z`: `(−x, −y, z)`.
#[inline(always)]
pub fn reflect<V: Vector3>(w: V) -> V {
    V::new(-w.x(), -w.y(), w.z())
}

/// The mirror direction of `w` about the unit facet normal `h`: `2 (w·h) h − w`.
#[inline(always)]
pub fn reflect_about<V: Vector3>(w: V, h: V) -> V {
    h * (V::Scalar::TWO * w.dot(h)) - w
}

/// Squared length of `wo + wi` below which the rounding of |wo| and |wi|, an ε, counts against it.
const NEARLY_OPPOSITE: f64 = 1e-3;

/// The unit half vector of two unit directions and the cosine between it and either of them.
///
/// ```text
/// h = (wo + wi) / |wo + wi|,  wo·h = |wo + wi| / 2
/// ```
///
/// The cosine is taken from the length because `wo·h` cancels for nearly opposite directions. There
/// the sum is so short that the rounding of the two lengths turns it: it is then taken of the
/// directions that the coordinates stand for, those of length 1. `None` where the sum vanishes.
#[inline(always)]
pub fn half_vector<V: Vector3>(wo: V, wi: V) -> Option<(V, V::Scalar)> {
    let mut sum = wo + wi;
    let mut squared = sum.length_squared();
    if squared < V::Scalar::lit(NEARLY_OPPOSITE) {
        sum = sum_of_units(wo, wi);
        squared = sum.length_squared();
    }
    if !(squared > V::Scalar::ZERO) {
        return None;
    }
    let length = squared.sqrt();
    Some((sum / length, (length * V::Scalar::HALF).min(V::Scalar::ONE)))
}

/// The sum of the unit vectors that the coordinates of `wo` and `wi` stand for: without the rounding of
/// their lengths, and without that of dividing by them.
///
/// Directions far from unit length are outside the domain; their sum stays as it is.
#[inline(always)]
pub(crate) fn sum_of_units<V: Vector3>(wo: V, wi: V) -> V {
    let sum = wo + wi;
    // w/|w| = w (1 − ½ (|w|² − 1)) but for squares of a rounding error.
    let excess = |w: V| V::Scalar::excess_of_squares(w.x(), w.y(), w.z()) * V::Scalar::HALF;
    let correction = wo * excess(wo) + wi * excess(wi);
    if correction.length_squared() < sum.length_squared() { sum - correction } else { sum }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::glam::DVec3;

    #[test]
    fn reflecting_about_the_half_vector_exchanges_the_pair() {
        let (wo, wi) = (DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.0, -0.28, 0.96));
        let (h, cos) = half_vector(wo, wi).unwrap();
        // A few roundings of unit numbers.
        assert!((reflect_about(wo, h) - wi).length() < 1e-15);
        assert!((cos - wo.dot(h)).abs() < 1e-15);
        assert!(half_vector(wo, -wo).is_none());
    }

    #[test]
    fn nearly_opposite_directions_keep_their_half_vector_in_single_precision() {
        use etendue_math::glam::Vec3;
        // Coordinates whose lengths miss 1 by less than an ulp, and by which their sum turns.
        let (wo, wi) = (
            Vec3::new(-1.0, 0.0, 3.598_581_8e-6),
            Vec3::new(0.999_999_94, 2.886_183_8e-5, 2.494_527_7e-4),
        );
        let exact = wo.as_dvec3().normalize() + wi.as_dvec3().normalize();
        let exact = exact.normalize();
        let (h, _) = half_vector(wo, wi).unwrap();
        // Relative, in each coordinate: a narrow lobe magnifies the small one. A few roundings.
        let error = (h.as_dvec3() - exact) / exact;
        assert!(error.abs().max_element() < 1e-6, "{error}");
        let naive = (wo + wi).normalize().as_dvec3();
        assert!(((naive - exact) / exact).abs().max_element() > 0.1);
    }

    #[test]
    fn reflecting_about_the_normal_is_the_plain_mirror() {
        let w = DVec3::new(0.6, 0.0, 0.8);
        assert!((reflect(w) - reflect_about(w, DVec3::Z)).length() < 1e-15);
    }
}
