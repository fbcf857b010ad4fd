//! Distances along a ray, evenly spaced in the angle under which a point sees them.

use etendue_math::{Real, Vec3, Vector3};

use super::into_unit;

/// Distances s along a ray with a density as the inverse square of the distance from a point.
///
/// ```text
/// p(s) = D / (Δ (D² + (a + s)²)),   0 ≤ s ≤ length
/// Δ = atan2(D (b − a), D² + a b),   b = a + length
/// ```
///
/// D is the point's distance from the line, −a that of its foot from the ray's origin, and Δ the angle under which the
/// point sees the ray. A point on the line, or so near to it that the density would be a spike, counts as standing a
/// thousandth of |a| aside.
///
/// # Source
/// Kulla, Fajardo, "Importance Sampling Techniques for Path Tracing in Participating Media", EGSR 2012. Angles are
/// differences there; here each is one arc tangent, which keeps its digits where all of the ray is far away.
///
/// # Examples
/// ```
/// use etendue_math::glam::DVec3;
/// use etendue_sampling::warp::equiangular::Equiangular;
/// // From beside the point to infinity: half of the angle at the point's distance.
/// let ray = Equiangular::new(DVec3::X * 3.0, DVec3::Z, f64::INFINITY).expect("not at the point");
/// assert!((ray.from_unit(0.5) - 3.0).abs() < 1e-14);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equiangular<T> {
    /// D.
    aside: T,
    /// a.
    start: T,
    length: T,
    /// Δ.
    angle: T,
}

impl<T: Real> Equiangular<T> {
    /// Along a ray.
    ///
    /// * `to_point`: from its origin to the point.
    /// * `along`: its direction, a unit vector.
    /// * `length`: positive, may be infinite.
    ///
    /// `None` where there is nothing to choose from: the point is the origin, or one of them is not finite, or the length
    /// is not positive.
    #[inline]
    pub fn new(to_point: Vec3<T>, along: Vec3<T>, length: T) -> Option<Self> {
        let start = -to_point.dot(along);
        let aside = to_point.cross(along).length().max(T::lit(1e-3) * start.abs());
        let angle = if length.is_finite() {
            (aside * length).atan2(aside * aside + start * (start + length))
        } else {
            aside.atan2(start)
        };
        let valid = aside > T::ZERO && aside.is_finite() && length > T::ZERO && angle > T::ZERO;
        valid.then_some(Self { aside, start, length, angle })
    }

    /// A distance by its density.
    ///
    /// ```text
    /// s = (D² + a²) sin φ / (D cos φ − a sin φ),   φ = Δ u
    /// ```
    #[inline]
    pub fn from_unit(&self, u: T) -> T {
        let (sin, cos) = (self.angle * u).sin_cos();
        let Self { aside, start, length, .. } = *self;
        let s = (aside * aside + start * start) * sin / (aside * cos - start * sin);
        // Rounded away over an end that is infinite, the quotient is negative.
        if s >= T::ZERO { s.min(length) } else { length }
    }

    /// The uniform that [`from_unit`](Self::from_unit) maps to `s`.
    #[inline]
    pub fn to_unit(&self, s: T) -> T {
        let Self { aside, start, angle, .. } = *self;
        let phi = (aside * s).atan2(aside * aside + start * (start + s));
        into_unit(phi / angle)
    }

    /// Density per unit of length; 0 outside the ray and for NaN.
    #[inline]
    pub fn pdf(&self, s: T) -> T {
        let Self { aside, start, length, angle } = *self;
        let beyond = start + s;
        if s >= T::ZERO && s <= length {
            aside / (angle * (aside * aside + beyond * beyond))
        } else {
            T::ZERO
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::uniforms;
    use etendue_math::glam::{DVec3, Vec3};

    /// Beside, before, behind, far away and on the line.
    const POINTS: [[f64; 3]; 7] = [
        [0.3, 0.4, 2.0],
        [0.5, 0.0, 0.0],
        [1.0, -2.0, -5.0],
        [0.1, 0.1, 300.0],
        [2e3, 1.0, 0.5],
        [0.0, 0.0, 1.5],
        [0.0, 1e-9, -1.0],
    ];
    const LENGTHS: [f64; 3] = [1e-3, 4.0, f64::INFINITY];

    fn rays() -> impl Iterator<Item = Equiangular<f64>> {
        POINTS.into_iter().flat_map(|point| {
            LENGTHS.map(|length| Equiangular::new(point.into(), DVec3::Z, length).expect("a ray"))
        })
    }

    #[test]
    fn inverse_undoes_the_map_and_the_density_is_its_slope() {
        for ray in rays() {
            for [u, _] in uniforms::<f64>(200) {
                let s = ray.from_unit(u);
                assert!(s >= 0.0 && s <= ray.length, "{ray:?} {u}: {s}");
                // Distances from a foot a thousand times as far away as the point lose three digits.
                assert!((ray.to_unit(s) - u).abs() < 1e-12, "{ray:?} {u}");
                let h = 1e-5 * s;
                let slope = (ray.to_unit(s + h) - ray.to_unit(s - h)) / (2.0 * h);
                let inside = s + h < ray.length && slope > 0.0;
                // Of second order in a step that is 1e-2 of the width where that is a thousandth of the distance;
                // rounding of 1e-12 over 1e-5 u.
                let bound = 1e-4 + 1e-6 / u;
                assert!(!inside || (slope / ray.pdf(s) - 1.0).abs() < bound, "{ray:?} {u} {s}");
            }
        }
    }

    #[test]
    fn the_density_falls_with_the_square_of_the_distance_and_integrates_to_one() {
        for ray in rays() {
            let (first, last) = (ray.from_unit(0.25), ray.from_unit(0.75));
            let square = |s: f64| ray.aside * ray.aside + (ray.start + s) * (ray.start + s);
            let ratio = ray.pdf(first) * square(first) / (ray.pdf(last) * square(last));
            // A few roundings.
            assert!((ratio - 1.0).abs() < 1e-14, "{ray:?}");
            assert_eq!([ray.pdf(-1e-9), ray.pdf(f64::NAN)], [0.0; 2]);
            assert!(ray.length.is_infinite() || ray.pdf(ray.length.next_up()) == 0.0);
            assert!((ray.to_unit(ray.length.min(1e300)) - 1.0).abs() < 1e-12, "{ray:?}");
        }
    }

    #[test]
    fn single_precision_loses_no_more_than_its_input_allows() {
        for point in POINTS {
            for length in LENGTHS {
                let point = Vec3::from(point.map(|x| x as f32));
                let narrow = Equiangular::new(point, Vec3::Z, length as f32).expect("a ray");
                let length = f64::from(length as f32);
                let wide = Equiangular::new(point.as_dvec3(), DVec3::Z, length).expect("a ray");
                for [u, _] in uniforms::<f32>(200) {
                    let (s, exact) = (narrow.from_unit(u), wide.from_unit(f64::from(u)));
                    let found = wide.to_unit(f64::from(s));
                    // Compared by the angle: 64 ε of it, times a thousand where a thousandth of it is of interest.
                    let error = (found - wide.to_unit(exact)).abs();
                    assert!(
                        error < 64e3 * f64::from(f32::EPSILON),
                        "{point} {length} {u}: {error}"
                    );
                    // Weights sum to one only if both techniques agree about the density.
                    let density = f64::from(narrow.pdf(s)) / wide.pdf(f64::from(s).min(length));
                    assert!((density - 1.0).abs() < 1e-3, "{point} {length} {u}: {density}");
                }
            }
        }
    }

    #[test]
    fn rays_without_a_density_are_refused() {
        let new = |point, length| Equiangular::new(point, DVec3::Z, length);
        assert_eq!(new(DVec3::ZERO, 1.0), None);
        for bad in [0.0, -1.0, f64::NAN] {
            assert_eq!(new(DVec3::ONE, bad), None);
        }
        for bad in [f64::NAN, f64::INFINITY] {
            assert_eq!(new(DVec3::new(bad, 1.0, 1.0), 1.0), None);
        }
    }
}
