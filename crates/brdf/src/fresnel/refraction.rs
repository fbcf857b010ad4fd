//! Directions of refracted rays.

use etendue_math::{Real, Vector3};

use super::RelativeIndex;
use super::dielectric::checked_index;
use super::relative_index::{product, sum};

/// A smooth interface met by a ray: reflectance, and the refracted direction where there is one.
///
/// Both come from one `g = η cos θt`, so that total internal reflection is one event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Refraction<V: Vector3> {
    pub(crate) reflectance: V::Scalar,
    pub(crate) direction: Option<V>,
}

impl<V: Vector3> Refraction<V> {
    /// `w` a unit vector above the surface.
    #[inline(always)]
    pub(crate) fn new(w: V, index: RelativeIndex<V::Scalar>) -> Self {
        let c = w.z().min(V::Scalar::ONE);
        if index.is_matched() {
            return Self { reflectance: V::Scalar::ZERO, direction: Some(-w) };
        }
        match index.scaled_cos_t(c) {
            None => Self { reflectance: V::Scalar::ONE, direction: None },
            Some(g) => Self {
                reflectance: index.reflectance_of_pair(c, g),
                // Of length η but for rounding, which a small η would amplify.
                direction: V::new(-w.x(), -w.y(), -g).try_normalize(),
            },
        }
    }
}

/// The direction a ray leaves along after refraction at the surface `z = 0`.
///
/// ```text
/// wt = normalize(−x, −y, −√((η − 1)(η + 1) + z²))   for |w| = 1
/// ```
///
/// * `w`: direction away from the surface on the incident side, `w.z > 0`. It need not be of unit
///   length: near the critical angle even the rounding of a normalisation would show.
/// * `eta`: η = n(transmitted side) / n(incident side).
///
/// Returns a unit vector below the surface, or along it within rounding of the critical angle; `None`
/// under total internal reflection and outside the domain. Whether the reflection is total is
/// decided by the rounded cosine (`w.z` where `|w|` is 1 to rounding, otherwise `w.z / |w|`), as
/// [`dielectric`](super::dielectric) does: there is no direction exactly where F is 1.
///
/// # Precision
/// A few ulp of 1 in each component; near the critical angle too, where the root amplifies the
/// rounding of a plain `z²` without bound (3e-4 in `f32`): there the radicand is summed in twice
/// the precision from the given coordinates.
///
/// # Source
/// Snell's law.
#[inline]
pub fn refract<V: Vector3>(w: V, eta: V::Scalar) -> Option<V> {
    let (zero, one) = (V::Scalar::ZERO, V::Scalar::ONE);
    let squared = w.length_squared();
    let index = checked_index(eta)?;
    if !(w.z() > zero && squared >= V::Scalar::MIN_POSITIVE && squared < V::Scalar::INFINITY) {
        return None;
    }
    let unit = (squared - one).abs() <= V::Scalar::lit(4.0) * V::Scalar::EPSILON;
    let length = if unit { one } else { squared.sqrt() };
    let c = (w.z() / length).min(one);
    if index.is_matched() {
        return (-w).try_normalize();
    }
    let mut g = index.scaled_cos_t(c)?;
    // The rounded cosine has decided; of a small g the coordinates know more digits than it does.
    if eta < one && g * g <= V::Scalar::lit(1.0 / 256.0) {
        g = critical_radicand(w, eta).max(zero).sqrt();
    }
    V::new(-w.x(), -w.y(), -g * length).try_normalize()
}

/// `η² − (x² + y²) / |w|²` in twice the working precision.
///
/// ```text
/// (η² n − s) / n,  s = x² + y²,  n = s + z²,  products and sums as unevaluated pairs
/// ```
///
/// # Source
/// T. Dekker, "A Floating-Point Technique for Extending the Available Precision", Numer. Math. 18, 1971.
#[cold]
fn critical_radicand<V: Vector3>(w: V, eta: V::Scalar) -> V::Scalar {
    let [(x, x_low), (y, y_low), (z, z_low)] = [w.x(), w.y(), w.z()].map(|c| product(c, c));
    let (s, s_error) = sum(x, y);
    let s_low = s_error + (x_low + y_low);
    let (n, n_error) = sum(s, z);
    let n_low = n_error + (s_low + z_low);
    let (eta2, eta2_low) = product(eta, eta);
    let (m, m_error) = product(eta2, n);
    let m_low = m_error + (eta2 * n_low + eta2_low * n);
    ((m - s) + (m_low - s_low)) / n
}

/// As [`refract`], at a facet with unit normal `h`.
///
/// ```text
/// wt = normalize(h (c − g) − w),  c = w·h,  g = √(k + c²),  c − g = −k / (g + c),  k = (η − 1)(η + 1)
/// ```
///
/// `None` under total internal reflection and where `w·h` is not positive.
///
/// # Source
/// B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, eq. 40,
/// with the difference of cosines rewritten so that it does not cancel for η → 1.
#[inline]
pub fn refract_about<V: Vector3>(w: V, h: V, eta: V::Scalar) -> Option<V> {
    let (c, index) = (w.dot(h), checked_index(eta)?);
    if !(c > V::Scalar::ZERO) {
        return None;
    }
    refract_at(w, h, index, c, index.scaled_cos_t(c)?)
}

/// [`refract_about`] where both angles are known: `c = w·h`, `g = η cos θt`.
#[inline(always)]
pub(crate) fn refract_at<V: Vector3>(
    w: V,
    h: V,
    index: RelativeIndex<V::Scalar>,
    c: V::Scalar,
    g: V::Scalar,
) -> Option<V> {
    // Of length η but for rounding, which a small η would amplify.
    (h * index.cosine_difference(c, g) - w).try_normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::glam::{DVec3, Vec3};

    #[test]
    fn near_the_critical_angle_the_direction_keeps_its_digits() {
        // Around the critical angle, one ulp of the cosine at a time; f64 as the reference.
        for eta in [0.3_f32, 0.5, 0.66667, 0.99] {
            let mut c = ((1.0 - eta) * (1.0 + eta)).sqrt();
            for _ in 0..50 {
                c = c.next_down();
            }
            for _ in 0..100 {
                let w = Vec3::new((1.0 - c * c).sqrt(), 0.0, c);
                let d = w.as_dvec3();
                let g2 = Real::sqr(f64::from(eta)) - d.x * d.x / d.length_squared();
                let cos_t = g2.max(0.0).sqrt() / f64::from(eta);
                let got = refract(w, eta).map_or(0.0, |t| f64::from(-t.z));
                // Two roundings of a number below 1.
                assert!(
                    (got - cos_t).abs() <= 2.0 * f64::from(f32::EPSILON),
                    "{eta} {c} {got} {cos_t}"
                );
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
