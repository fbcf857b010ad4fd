//! Directions of refracted rays.

use etendue_math::{Real, Vector3};

use super::dielectric::scaled_cos_t;

/// The direction a ray leaves along after refraction at the surface `z = 0`.
///
/// ```text
/// wt = (−x / η, −y / η, −√((η − 1)(η + 1) + z²) / η)
/// ```
///
/// * `w`: unit vector away from the surface on the incident side, `w.z > 0`.
/// * `eta`: η = n(transmitted side) / n(incident side).
///
/// Returns a unit vector below the surface; `None` under total internal reflection and outside the domain.
///
/// # Precision
/// A few ulp times the condition of the problem. [`dielectric`](super::dielectric) is 1 exactly where
/// this is `None`: both test the same number.
///
/// # Source
/// Snell's law.
#[inline]
pub fn refract<V: Vector3>(w: V, eta: V::Scalar) -> Option<V> {
    let (zero, one) = (V::Scalar::ZERO, V::Scalar::ONE);
    if !(w.z() > zero && eta > zero && eta < V::Scalar::INFINITY && w.is_finite()) {
        return None;
    }
    let g = scaled_cos_t(w.z(), (eta - one) * (eta + one))?;
    Some(V::new(-w.x(), -w.y(), -g) / eta)
}

/// As [`refract`], at a facet with unit normal `h`.
///
/// ```text
/// wt = (h (c − g) − w) / η,  c = w·h,  g = √(k + c²),  c − g = −k / (g + c),  k = (η − 1)(η + 1)
/// ```
///
/// `None` under total internal reflection and where `w·h` is not positive.
///
/// # Source
/// B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, eq. 40,
/// with the difference of cosines rewritten so that it does not cancel for η → 1.
#[inline]
pub fn refract_about<V: Vector3>(w: V, h: V, eta: V::Scalar) -> Option<V> {
    let c = w.dot(h);
    if !(c > V::Scalar::ZERO) {
        return None;
    }
    let k = (eta - V::Scalar::ONE) * (eta + V::Scalar::ONE);
    let g = scaled_cos_t(c, k)?;
    Some((h * (-k / (g + c)) - w) / eta)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::dielectric;
    use etendue_math::glam::{DVec3, Vec3};

    #[test]
    fn total_reflection_and_no_refraction_are_the_same_event() {
        // Around the critical angle, one ulp of the cosine at a time.
        for eta in [0.3_f32, 0.5, 0.66667, 0.99] {
            let mut c = ((1.0 - eta) * (1.0 + eta)).sqrt();
            for _ in 0..50 {
                c = c.next_down();
            }
            for _ in 0..100 {
                let w = Vec3::new((1.0 - c * c).sqrt(), 0.0, c);
                assert_eq!(refract(w, eta).is_none(), dielectric(c, eta) == 1.0, "{eta} {c}");
                c = c.next_up();
            }
        }
    }

    #[test]
    fn refraction_about_the_normal_is_refraction() {
        let w = DVec3::new(0.36, 0.48, 0.8);
        let a = refract(w, 1.5).unwrap();
        let b = refract_about(w, DVec3::Z, 1.5).unwrap();
        // Two different orders of a few roundings.
        assert!((a - b).length() < 1e-15 && (a.length() - 1.0).abs() < 1e-15);
        assert!((a.x + w.x / 1.5).abs() < 1e-16);
    }
}
