//! Clipped linearly transformed cosine: a cosine lobe bent towards the viewer's retro-reflection.

use etendue_math::{Real, Vec3, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use crate::Roughness;

/// The lobe that follows a rough diffuse surface seen from one direction.
///
/// ```text
/// wi = M w / |M w|,   M = | a 0 b |    in the frame whose x axis is the azimuth of wo
///                         | 0 c 0 |
///                         | d 0 1 |
/// p(wi) = (|M| / |adj(M) wi|²)² max(w.z, 0) / (π s),   s = ½ (1 + 1/√(1 + d²))
/// ```
///
/// `w` is cosine-distributed on the part of the hemisphere that M keeps above the surface, whose projection is half a
/// disk and half an ellipse; no sample is lost. `a … d` are fits in the cosine of the viewer and the roughness;
/// r = 0 gives the plain cosine. For r > 0 there are directions
/// near the horizon that it never draws: a mixture with a lobe that does must cover them.
///
/// # Precision
/// Directions and densities within a few ulp times the condition of M, which is at most 4: heights come from the
/// uniforms, not from `1 − x² − y²`.
///
/// # Source
/// J. Portsmouth, P. Kutz and S. Hill, "EON: A Practical Energy-Preserving Rough Diffuse BRDF", JCGT 14(1), 2025,
/// listings 2 and 3, after E. Heitz et al., "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines",
/// 2016.
///
/// # Examples
/// ```
/// use etendue_brdf::{ClippedCosine, Roughness};
/// use etendue_math::glam::DVec3;
/// let lobe = ClippedCosine::<f64>::new(DVec3::new(0.6, 0.0, 0.8), Roughness::new(0.5)?);
/// let wi = lobe.sample([0.3, 0.7]).expect("hardly ever lost to rounding");
/// assert!(wi.z >= 0.0 && lobe.pdf(wi) > 0.0);
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClippedCosine<T> {
    /// Cosine and sine of the viewer's azimuth.
    azimuth: [T; 2],
    a: T,
    b: T,
    c: T,
    d: T,
    /// `s` and `1 − s`
    share: [T; 2],
}

impl<T: Real> ClippedCosine<T> {
    /// The lobe for the viewer `wo`, a unit vector above the surface.
    #[inline]
    pub fn new(wo: Vec3<T>, roughness: Roughness<T>) -> Self {
        let (mu, r) = (wo.z().clamp_to(T::ZERO, T::ONE), roughness.value());
        let lit = T::lit;
        let a_mu = lit(0.303_392) + (lit(-0.518_982) + lit(0.111_709) * mu) * mu;
        let a = T::ONE + r * (a_mu + (lit(-0.276_266) + lit(0.335_918) * mu) * r);
        // b and d almost vanish for a viewer at the normal: in powers of 1 − μ they keep their digits there.
        let t = T::ONE - mu;
        let b_mu = lit(-0.005_48) - lit(1.158_59) * t;
        let b_r = lit(0.000_71) + lit(0.150_105) * t;
        let b = r * (b_mu + b_r * r) / (mu * mu * mu - lit(1.435_45));
        let c = T::ONE + r * (lit(0.200_13) + (lit(-0.506_373) + lit(0.261_777) * mu) * mu);
        let d = r * (lit(-0.000_006) + (lit(0.065_466) + lit(0.475_392) * t) * t)
            / (lit(-1.074_3) + (lit(0.072_562_8) + mu) * mu);
        let hypotenuse = (T::ONE + d * d).sqrt();
        let clipped = d * d * T::HALF / (hypotenuse * (T::ONE + hypotenuse));
        Self { azimuth: azimuth::<T>(wo), a, b, c, d, share: [T::ONE - clipped, clipped] }
    }

    /// A direction with density [`pdf`](Self::pdf); `u`: uniforms in `[0, 1)`. `None` where nothing is left to
    /// normalise.
    #[inline]
    pub fn sample(&self, u: [T; 2]) -> Option<Vec3<T>> {
        let cosine = cosine_hemisphere::from_square(u);
        let (x, y) = (cosine.x(), cosine.y());
        // 1 − r² on the disk, and the half width of the disk at this y.
        let rim = cosine.z() * cosine.z();
        let width = (x * x + rim).sqrt();
        let [share, clipped] = self.share;
        // Distance from the edge x = width, which the map turns into the edge of the disk.
        let inset = if x > T::ZERO { rim / (width + x) } else { width - x };
        let z = (share * (T::TWO * clipped * width * inset + share * rim)).sqrt();
        let x = -(clipped * width + share * x);
        let bent = Vec3::<T>::new(self.a * x + self.b * z, self.c * y, self.d * x + z);
        let [cos, sin] = self.azimuth;
        let turned = Vec3::<T>::new(
            cos * bent.x() - sin * bent.y(),
            sin * bent.x() + cos * bent.y(),
            bent.z(),
        );
        turned.try_normalize()
    }

    /// Density per steradian of [`sample`](Self::sample) at the unit vector `wi` on the upper hemisphere, a finite number
    /// for every vector.
    #[inline]
    pub fn pdf(&self, wi: Vec3<T>) -> T {
        let [cos, sin] = self.azimuth;
        let (x, y) = (cos * wi.x() + sin * wi.y(), cos * wi.y() - sin * wi.x());
        let minor = self.a - self.b * self.d;
        // adj(M) wi
        let w = Vec3::<T>::new(
            self.c * (x - self.b * wi.z()),
            minor * y,
            self.c * (self.a * wi.z() - self.d * x),
        );
        if !(w.z() > T::ZERO) {
            return T::ZERO;
        }
        let ratio = self.c * minor / w.length_squared();
        (ratio * ratio * w.z() * T::FRAC_1_PI / self.share[0]).min(T::MAX)
    }
}

/// Cosine and sine of the azimuth of `w`; those of 0 along the normal.
#[inline]
fn azimuth<T: Real>(w: Vec3<T>) -> [T; 2] {
    let scale = w.x().abs().max(w.y().abs());
    if !(scale > T::ZERO) {
        return [T::ONE, T::ZERO];
    }
    // Scaled first: the squares of a direction close to the normal may underflow.
    let (x, y) = (w.x() / scale, w.y() / scale);
    let length = (x * x + y * y).sqrt();
    [x / length, y / length]
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::glam::DVec3;

    fn viewer(z: f64, phi: f64) -> DVec3 {
        let sin = (1.0 - z * z).sqrt();
        DVec3::new(sin * Real::cos(phi), sin * Real::sin(phi), z)
    }

    #[test]
    fn the_density_is_that_of_the_samples() {
        // The Jacobian of the map, by central differences, is 1/p. Points keep off the kinks on the diagonals.
        let step = 1e-5;
        for z in [0.01, 0.3, 1.0] {
            for r in [0.2, 1.0] {
                let lobe = ClippedCosine::new(viewer(z, 0.7), Roughness::new(r).unwrap());
                for [a, b] in [[0.1, 0.4], [0.3, 0.9], [0.55, 0.47], [0.93, 0.2], [0.7, 0.05]] {
                    let along = |d: [f64; 2]| {
                        let at = |s: f64| lobe.sample([a + s * d[0], b + s * d[1]]).unwrap();
                        (at(step) - at(-step)) / (2.0 * step)
                    };
                    let area = along([1.0, 0.0]).cross(along([0.0, 1.0])).length();
                    let wi = lobe.sample([a, b]).unwrap();
                    // The third derivative of the map times step².
                    assert!((area * lobe.pdf(wi) - 1.0).abs() < 1e-6, "z {z}, r {r}: {wi}");
                }
            }
        }
    }

    #[test]
    fn without_roughness_it_is_the_cosine() {
        let lobe = ClippedCosine::new(viewer(0.3, 2.0), Roughness::new(0.0).unwrap());
        for wi in [viewer(0.9, 1.0), viewer(0.01, 4.0)] {
            assert!((lobe.pdf(wi) - cosine_hemisphere::pdf::<f64>(wi)).abs() < 1e-15);
        }
    }

    #[test]
    fn heights_keep_their_digits_at_the_rim_in_single_precision() {
        let wo = viewer(0.4, 0.3);
        let wide = ClippedCosine::new(wo, Roughness::new(1.0).unwrap());
        let narrow = ClippedCosine::new(wo.as_vec3(), Roughness::new(1.0).unwrap());
        for k in 2..20 {
            let rim = Real::powi(0.5_f32, k);
            for u in [[rim, 0.3], [1.0 - rim, 0.4], [0.3, rim], [0.6, 1.0 - rim]] {
                let want = wide.sample(u.map(f64::from)).unwrap();
                let got = narrow.sample(u).unwrap().as_dvec3();
                // The height above the surface, where one side of the lobe ends, is a difference of numbers of
                // size 1 there: absolute error.
                assert!((got - want).length() < 16.0 * f64::from(f32::EPSILON), "{u:?}");
            }
        }
    }
}
