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

/// The unit half vector of two unit directions and the cosine between it and either of them.
///
/// ```text
/// h = (wo + wi) / |wo + wi|,  wo·h = |wo + wi| / 2
/// ```
///
/// The cosine is taken from the length because `wo·h` cancels for nearly opposite directions.
/// `None` where the sum vanishes.
#[inline(always)]
pub fn half_vector<V: Vector3>(wo: V, wi: V) -> Option<(V, V::Scalar)> {
    let sum = wo + wi;
    let squared = sum.length_squared();
    if !(squared > V::Scalar::ZERO) {
        return None;
    }
    let length = squared.sqrt();
    Some((sum / length, (length * V::Scalar::HALF).min(V::Scalar::ONE)))
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
    fn reflecting_about_the_normal_is_the_plain_mirror() {
        let w = DVec3::new(0.6, 0.0, 0.8);
        assert!((reflect(w) - reflect_about(w, DVec3::Z)).length() < 1e-15);
    }
}
