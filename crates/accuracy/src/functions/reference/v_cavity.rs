//! A rough matte surface, by integration over its facets.

use etendue_math::Real;
use etendue_math::glam::DVec3;
use etendue_math::quadrature::gauss_legendre;

/// Symmetric V-cavities with Lambertian facets, shadowing, masking and one interreflection: the surface that Oren and Nayar
/// fitted their model to, integrated numerically.
///
/// ```text
/// f = ρ/π ∫ P(θa) [(a·wi)⁺ (a·wo)⁺ min(mi, mo) + ρ (a'·wi)⁺ (a·wo)⁺ H(1 − mo, 1 − m'i)] / (cos θa cos θi cos θo) dωa
/// P ∝ exp(−θa²/(2σ²)),  ∫ P dωa = 1       share of the mean surface under facets with the normal a
/// m = min(1, 2 cos θa cos θ/(a·w))          lit or seen share of a facet, from its upper edge
/// a' = 2 cos θa n − a                       normal of the opposite facet, m'i its lit share
/// H(x, y) = ½ (r(x, 1) + r(1, y) − r(x, y) − r(1, 1)),  r(x, y)² = x² + y² + 2 x y cos 2θa
/// ```
///
/// H is the exchange between the seen part of a facet, from x to its edge, and the lit part of the opposite one, from y
/// to its edge, by Hottel's crossed strings: the integral of the kernel of a cavity of infinite length in closed form. Light
/// that is reflected three times or more is not followed, as in the paper.
///
/// * σ: deviation of the facets' slope angle θa in radians; ρ: their albedo. For σ → 0 the surface is Lambert's.
/// * Where both directions leave part of a facet in the dark, the smaller share counts: both begin at the same edge.
///
/// # Precision
/// The integrand has kinks where shadows begin; with the nodes of a full run the error is some 10⁻⁴ of f, which the report
/// states.
///
/// # Source
/// M. Oren and S. Nayar, "Generalization of Lambert's Reflectance Model", SIGGRAPH 1994, section 4; H. Hottel and
/// A. Sarofim, Radiative Transfer, 1967, for crossed strings.
pub struct VCavities {
    albedo: f64,
    facets: Vec<Facet>,
}

/// Facets around one normal.
struct Facet {
    normal: DVec3,
    /// Share of the mean surface, over cos θa.
    weight: f64,
    /// `cos 2θa` and `r(1, 1) = 2 cos θa`
    cos_2: f64,
}

impl VCavities {
    /// Facets of deviation `sigma`, positive, and albedo `albedo`; `N` polar angles and `2 N` azimuths.
    pub fn new<const N: usize>(sigma: f64, albedo: f64) -> Self {
        // Seven deviations leave e⁻²⁴ out.
        let last = (7.0 * sigma).min(core::f64::consts::FRAC_PI_2);
        let mut facets = Vec::with_capacity(2 * N * N);
        let mut total = 0.0;
        for (t, w) in gauss_legendre::<f64, N>() {
            let theta = last * t;
            let (sin, cos) = Real::sin_cos(theta);
            let share = w * Real::exp(-0.5 * Real::sqr(theta / sigma)) * sin;
            total += share;
            for i in 0..2 * N {
                let (y, x) = Real::sin_cos(f64::PI * (i as f64 + 0.5) / N as f64);
                let normal = DVec3::new(sin * x, sin * y, cos);
                facets.push(Facet { normal, weight: share / cos, cos_2: 2.0 * cos * cos - 1.0 });
            }
        }
        for facet in &mut facets {
            facet.weight /= total * 2.0 * N as f64;
        }
        Self { albedo, facets }
    }

    /// Value in sr⁻¹, without the cosine; 0 where a direction is not above the surface.
    pub fn eval(&self, wo: DVec3, wi: DVec3) -> f64 {
        if !(wo.z > 0.0 && wi.z > 0.0) {
            return 0.0;
        }
        let sum: f64 = self.facets.iter().map(|facet| self.facet(facet, wo, wi)).sum();
        self.albedo * f64::FRAC_1_PI * sum / (wo.z * wi.z)
    }

    fn facet(&self, facet: &Facet, wo: DVec3, wi: DVec3) -> f64 {
        let cos_a = facet.normal.z;
        let (seen, lit) = (facet.normal.dot(wo), facet.normal.dot(wi));
        if !(seen > 0.0) {
            return 0.0;
        }
        let share = |cosine: f64, z: f64| (2.0 * cos_a * z / cosine).min(1.0);
        let seen_share = share(seen, wo.z);
        let direct = if lit > 0.0 { lit * seen_share.min(share(lit, wi.z)) } else { 0.0 };
        let opposite = 2.0 * cos_a * wi.z - lit;
        let indirect = if opposite > 0.0 {
            let lit_share = share(opposite, wi.z);
            self.albedo * opposite * exchange(facet.cos_2, 1.0 - seen_share, 1.0 - lit_share)
        } else {
            0.0
        };
        facet.weight * seen * (direct + indirect)
    }
}

/// Hottel's crossed strings between the parts of two facets from `x` and `y` to their edges at 1; `cos_2` is minus the
/// cosine of the angle between them.
fn exchange(cos_2: f64, x: f64, y: f64) -> f64 {
    let r = |x: f64, y: f64| (x * x + y * y + 2.0 * x * y * cos_2).max(0.0).sqrt();
    0.5 * (r(x, 1.0) + r(1.0, y) - r(x, y) - r(1.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_brdf::{Bsdf, OrenNayar, Reflectance, Sigma};

    fn polar(degrees: f64, azimuth: f64) -> DVec3 {
        let [theta, phi] = [degrees, azimuth].map(f64::to_radians);
        let ((s, c), (y, x)) = (Real::sin_cos(theta), Real::sin_cos(phi));
        DVec3::new(s * x, s * y, c)
    }

    /// `∫ f cos θ dω` over the hemisphere.
    fn albedo(surface: &VCavities, wo: DVec3) -> f64 {
        let mut sum = 0.0;
        for (t, w) in gauss_legendre::<f64, 12>() {
            for i in 0..24 {
                let z = t.sqrt();
                let (y, x) = Real::sin_cos(f64::PI * (f64::from(i) + 0.5) / 12.0);
                let s = (1.0 - t).sqrt();
                // cos θ dω = dt dφ / 2 with t = cos² θ
                sum += w * surface.eval(wo, DVec3::new(s * x, s * y, z)) * f64::PI / 24.0;
            }
        }
        sum
    }

    #[test]
    fn the_exchange_is_the_integral_of_the_kernel() {
        for (theta, x, y) in [(0.3, 0.0, 0.2), (0.9, 0.4, 0.1), (1.3, 0.7, 0.0)] {
            let (cos_2, sin_2) = (Real::cos(2.0 * theta), Real::sin(2.0 * theta));
            let mut sum = 0.0;
            for (s, ws) in gauss_legendre::<f64, 200>() {
                for (t, wt) in gauss_legendre::<f64, 200>() {
                    let (a, b) = (x + (1.0 - x) * s, y + (1.0 - y) * t);
                    let r2 = a * a + b * b + 2.0 * a * b * cos_2;
                    let kernel = 0.5 * sin_2 * sin_2 * a * b / (r2 * r2.sqrt());
                    sum += ws * wt * (1.0 - x) * (1.0 - y) * kernel;
                }
            }
            // The kernel peaks where both facets meet, if both parts reach there.
            assert!((sum / exchange(cos_2, x, y) - 1.0).abs() < 1e-4, "{theta} {x} {y} {sum}");
        }
        // The view factor of a groove.
        assert!((exchange(Real::cos(1.4), 0.0, 0.0) - (1.0 - Real::cos(0.7))).abs() < 1e-15);
    }

    #[test]
    fn flat_cavities_are_lamberts_reflector() {
        let surface = VCavities::new::<16>(1e-4, 0.7);
        for (o, i, phi) in [(0.0, 50.0, 0.0), (30.0, 70.0, 90.0), (60.0, 60.0, 180.0)] {
            let f = surface.eval(polar(o, 0.0), polar(i, phi));
            // cos changes by σ tan θ to first order, which averages out, and σ² to second.
            assert!((f * f64::PI / 0.7 - 1.0).abs() < 1e-6, "{o} {i} {f}");
        }
    }

    #[test]
    fn exchanging_light_and_viewer_changes_nothing() {
        let surface = VCavities::new::<24>(0.6, 0.9);
        for (o, i, phi) in [(10.0, 70.0, 20.0), (40.0, 80.0, 170.0), (75.0, 30.0, 90.0)] {
            let (wo, wi) = (polar(o, 0.0), polar(i, phi));
            // The same sum with opposite facets exchanged.
            assert!((surface.eval(wo, wi) / surface.eval(wi, wo) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn no_more_light_leaves_than_arrives_and_the_second_bounce_adds_some() {
        for sigma in [0.2, 0.5, 1.0] {
            for angle in [0.0, 40.0, 75.0] {
                let wo = polar(angle, 0.0);
                let white = albedo(&VCavities::new::<24>(sigma, 1.0), wo);
                let grey = albedo(&VCavities::new::<24>(sigma, 0.5), wo);
                // The quadrature over directions is good to 1e-3 with this many nodes.
                assert!(white < 1.0 + 1e-3 && grey < 0.5 + 1e-3, "{sigma} {angle} {white} {grey}");
                assert!(white > 2.0 * grey, "{sigma} {angle} {white} {grey}");
            }
        }
    }

    #[test]
    fn the_published_fit_is_near() {
        for sigma in [0.2, 0.4] {
            let surface = VCavities::new::<48>(sigma, 0.8);
            let fit = OrenNayar::new(Reflectance::new(0.8).unwrap(), Sigma::new(sigma).unwrap());
            for (o, i, phi) in
                [(0.0, 0.0, 0.0), (30.0, 50.0, 0.0), (50.0, 20.0, 180.0), (60.0, 60.0, 0.0)]
            {
                let (wo, wi) = (polar(o, 0.0), polar(i, phi));
                let (want, got) = (surface.eval(wo, wi), fit.eval(wo, wi));
                // The paper shows curves of both on top of each other; 8 % are the largest difference here.
                assert!((got / want - 1.0).abs() < 0.08, "{sigma} {o} {i} {phi}: {got} {want}");
            }
        }
    }
}
