//! The weak white furnace test, of microfacets by themselves.
//!
//! The strong one asks of a whole model that it loses nothing; see the check `strong-furnace`.

use etendue_brdf::{BeckmannLambda, Distribution};
use etendue_math::quadrature::gauss_legendre;
use etendue_math::{Real, Vec3, Vector3};

use crate::budget::Budget;
use crate::cases::Surface;
use crate::generators::viewers;
use crate::measure::{Outcome, Worst};
use crate::scalar::{Scalar, narrow, show};

/// Name in the report of what is checked.
pub const MODEL: &str = "microfacets";
/// Name of the check.
pub const CHECK: &str = "weak-furnace";

/// Asserts that the facets seen from a direction cover exactly what is seen of the surface: with all
/// facets white and no light lost between them, everything comes back.
///
/// ```text
/// ∫ D(h) G1(wo) max(0, wo·h) / cos θo dh = 1
/// ```
///
/// From along the normal it says that the facets cover the mean surface: `∫ D(h) (n·h) dh = 1`.
///
/// Tolerance: 1e-5, above the error of the quadrature and of a sum of thousands of `f32`; 4e-3 for
/// Walter's rational fit of G1, which is that far off by design.
///
/// # Source
/// E. Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2), 2014,
/// section 2.3.
pub fn weak_furnace<T: Scalar>(surface: &Surface<T>, budget: Budget) -> Outcome {
    let mut worst = Worst::default();
    // Half of the viewers are below the surface; a grazing one is among the first six.
    let upper = viewers::<T>((2 * budget.viewers).max(6)).into_iter().filter(|w| w.z() > T::ZERO);
    for wo in upper {
        let covered = covered(surface, wo);
        worst.observe((covered - 1.0).abs(), || {
            format!("{}, {}, wo {}: {covered}", surface.name, T::NAME, show::<T>(wo))
        });
    }
    let walter = Distribution::Beckmann { lambda: BeckmannLambda::Walter };
    worst.within(if surface.distribution == walter { 4e-3 } else { 1e-5 }, "of 1")
}

/// The integral, in the plane of slopes divided by their widths, polar about the viewer's azimuth.
///
/// ```text
/// h ∝ (αx r cos φ, αy r sin φ, 1),   dh = αx αy h.z³ r dr dφ,   r = t/(1 − t)
/// ```
///
/// There the lobe is round, whatever its width, and facets seen from behind begin at a known r.
fn covered<T: Scalar>(surface: &Surface<T>, wo: Vec3<T>) -> f64 {
    let rule = gauss_legendre::<f64, 96>();
    let [ax, ay] = surface.widths;
    let [x, y, z] = [wo.x().to_f64(), wo.y().to_f64(), wo.z().to_f64()];
    let (s, azimuth) = (Real::sqr(ax * x) + Real::sqr(ay * y), Real::atan2(ay * y, ax * x));
    let s = s.sqrt();
    let factor = surface.facets.g1(wo).to_f64() / z;
    let mut sum = 0.0;
    for quarter in 0..4 {
        for (v, weight_v) in rule {
            let angle = 0.5 * f64::PI * (f64::from(quarter) + v);
            let toward = s * Real::cos(angle);
            let end = if toward < 0.0 { z / (z - toward) } else { 1.0 };
            let (sin, cos) = Real::sin_cos(azimuth + angle);
            for (t, weight_t) in rule {
                let t = end * t;
                let r = t / (1.0 - t);
                let slopes = [ax * r * cos, ay * r * sin];
                let hz = 1.0 / (1.0 + slopes[0] * slopes[0] + slopes[1] * slopes[1]).sqrt();
                let h = narrow::<T>([slopes[0] * hz, slopes[1] * hz, hz]);
                let seen = (z + toward * r) * hz;
                let area = ax * ay * hz * hz * hz * r / Real::sqr(1.0 - t);
                let weight = weight_v * weight_t * end * 0.5 * f64::PI;
                sum += weight * area * surface.facets.ndf(h).to_f64() * seen * factor;
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::surfaces;

    #[test]
    fn surfaces_pass_and_a_masking_that_is_not_theirs_is_caught() {
        let mut all = surfaces::<f64>();
        assert!(all.iter().all(|s| weak_furnace(s, Budget::TEST).passed()));
        // Walter's fit held to what the exact form must do.
        let fitted = all.last_mut().unwrap();
        fitted.distribution = Distribution::Ggx;
        assert!(!weak_furnace(fitted, Budget::SMOKE).passed());
    }
}
