//! Surfaces under a smooth, clear or coloured, dielectric layer.

use etendue_brdf::fresnel::{dielectric, dielectric_transmittance, refract};
use etendue_brdf::{Bsdf, Density, Ior, Sample};
use etendue_math::glam::Vec3;
use etendue_math::{Real, Spectrum};

/// A smooth layer on a one-sided surface: what its interface reflects, and what the surface does to light refracted into the
/// layer and out again.
///
/// ```text
/// f = δ-lobe ks F(wo) + T(wo) T(wi) f'(wo', wi') exp(−a (1/cos wo' + 1/cos wi')) / η²
/// w': w refracted into the layer, T = 1 − F(w), a: absorption times thickness
/// ```
///
/// Light that the interface sends back to the surface is lost, so that the layer darkens; what remains is reciprocal.
/// Sampling chooses the interface with probability `F m / (F m + (1 − F)(1 − m))`, `m = 1 / (1 + mean exp(−2a))`.
///
/// # Source
/// Mitsuba 0.6, `coating`; A. Weidlich, A. Wilkie, "Arbitrarily Layered Micro-Facet Surfaces", GRAPHITE 2007.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Coated<S: Spectrum<Real = f32>> {
    /// Of the layer relative to what is above it.
    pub(super) eta: Ior<f32>,
    /// Absorption times thickness, not negative.
    pub(super) absorption: S,
    /// Factor ks of what the interface reflects.
    pub(super) specular_reflectance: S,
}

impl<S: Spectrum<Real = f32>> Coated<S> {
    /// A direction above the surface as it goes on inside the layer, mirrored back to the upper side, and what the interface
    /// lets through; `None` from below and where nothing enters.
    fn inside(&self, w: Vec3) -> Option<(Vec3, f32)> {
        let eta = self.eta.value();
        let transmittance = dielectric_transmittance(w.z, eta);
        let refracted = -refract(w, eta)?;
        // A direction within rounding of the surface has no length inside the layer that could be told.
        (transmittance > 0.0 && refracted.z > 0.0).then_some((refracted, transmittance))
    }

    /// What the layer leaves of light along two directions inside it.
    fn transmittance(&self, wo: Vec3, wi: Vec3) -> S {
        let length = 1.0 / wo.z + 1.0 / wi.z;
        // Without absorption exactly 1, however long the way.
        self.absorption.map(|a| if a > 0.0 { Real::exp(-a * length) } else { 1.0 })
    }

    /// The probability of choosing the interface where it reflects a share of light.
    fn interface_probability(&self, reflectance: f32) -> f32 {
        if self.specular_reflectance.is_black() {
            return 0.0;
        }
        let below = self.absorption.map(|a| Real::exp(-2.0 * a)).mean();
        let m = 1.0 / (1.0 + below);
        let (interface, surface) = (reflectance * m, (1.0 - reflectance) * (1.0 - m));
        if interface > 0.0 { interface / (interface + surface) } else { 0.0 }
    }

    /// Value and density for the surface `part` below.
    pub(super) fn eval_pdf(&self, part: &impl Bsdf<Color = S>, wo: Vec3, wi: Vec3) -> (S, f32) {
        let (Some((wo_in, to)), Some((wi_in, ti))) = (self.inside(wo), self.inside(wi)) else {
            return (S::black(), 0.0);
        };
        let (f, pdf) = part.eval_pdf(wo_in, wi_in);
        let eta = self.eta.value();
        let scale = to * ti / (eta * eta);
        let f = (f * self.transmittance(wo_in, wi_in)).scale(scale);
        let rest = 1.0 - self.interface_probability(dielectric(wo.z, eta));
        (f, pdf * rest * wi.z / (eta * eta * wi_in.z))
    }

    /// A direction for the surface `part` below; `None` where what it scatters does not leave the layer.
    pub(super) fn sample(
        &self,
        part: &impl Bsdf<Color = S>,
        wo: Vec3,
        u_lobe: f32,
        u: [f32; 2],
    ) -> Option<Sample<S>> {
        if wo.z <= 0.0 {
            return None;
        }
        let eta = self.eta.value();
        let reflectance = dielectric(wo.z, eta);
        let interface = self.interface_probability(reflectance);
        if u_lobe < interface {
            return Some(Sample {
                wi: Vec3::new(-wo.x, -wo.y, wo.z),
                weight: self.specular_reflectance.scale(reflectance / interface),
                density: Density::Delta(interface),
                eta: 1.0,
            });
        }
        let (wo_in, to) = self.inside(wo)?;
        let rest = 1.0 - interface;
        let u_lobe = ((u_lobe - interface) / rest).min(f32::ONE_MINUS_EPSILON);
        let sample = part.sample(wo_in, u_lobe, u)?;
        let wi = -refract(sample.wi, 1.0 / eta)?;
        let ti = dielectric_transmittance(wi.z, eta);
        if !(ti > 0.0 && wi.z > 0.0) {
            return None;
        }
        let weight = sample.weight * self.transmittance(wo_in, sample.wi);
        let density = match sample.density {
            Density::Delta(p) => Density::Delta(p * rest),
            Density::Continuous(pdf) => {
                Density::Continuous(pdf * rest * wi.z / (eta * eta * sample.wi.z))
            }
        };
        Some(Sample { wi, weight: weight.scale(to * ti / rest), density, eta: 1.0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_brdf::{Lambert, Reflectance};

    fn coated(eta: f32, absorption: f32) -> Coated<f32> {
        let eta = Ior::new(eta).expect("an index");
        Coated { eta, absorption, specular_reflectance: 1.0 }
    }

    fn white() -> Lambert<f32> {
        Lambert::new(Reflectance::white())
    }

    /// A viewer at an angle whose cosine is `z`.
    fn viewer(z: f32) -> Vec3 {
        Vec3::new(Real::sqrt(1.0 - z * z), 0.0, z)
    }

    #[test]
    fn values_are_reciprocal() {
        let coat = coated(1.5, 0.3);
        let (a, b) = (viewer(0.4), Vec3::new(-0.48, 0.6, 0.64));
        let (ab, ba) = (coat.eval_pdf(&white(), a, b).0, coat.eval_pdf(&white(), b, a).0);
        // A few roundings.
        assert!((ab / ba - 1.0).abs() < 1e-6, "{ab} {ba}");
    }

    #[test]
    fn a_layer_without_an_interface_only_absorbs() {
        let coat = coated(1.0, 0.25);
        let (wo, wi) = (viewer(0.5), viewer(0.8));
        let (f, pdf) = coat.eval_pdf(&white(), wo, wi);
        let expected = Real::exp(-0.25_f32 * (1.0 / 0.5 + 1.0 / 0.8)) / core::f32::consts::PI;
        assert!(
            (f / expected - 1.0).abs() < 1e-6 && (pdf - white().eval_pdf(wo, wi).1).abs() < 1e-7
        );
    }

    #[test]
    fn samples_weigh_what_values_and_densities_say() {
        for (eta, absorption) in [(1.5, 0.0), (1.33, 0.5), (0.8, 0.1)] {
            let coat = coated(eta, absorption);
            for z in [0.9, 0.5, 0.2] {
                let wo = viewer(z);
                let mut count = 0;
                for i in 0..200_u16 {
                    let u = [(f32::from(i) + 0.5) / 200.0, (f32::from(i) * 0.618) % 1.0];
                    let Some(s) = coat.sample(&white(), wo, 0.999, u) else { continue };
                    let (f, pdf) = coat.eval_pdf(&white(), wo, s.wi);
                    // All is reflected where the layer is thinner than what is above it.
                    let Density::Continuous(density) = s.density else { continue };
                    count += 1;
                    // Both refract once more, near the critical angle with some loss.
                    assert!((density / pdf - 1.0).abs() < 1e-3, "{eta} {z}: {density} {pdf}");
                    assert!((s.weight * pdf / (f * s.wi.z) - 1.0).abs() < 1e-3, "{eta} {z}");
                }
                assert!(count > 50 || eta < 1.0 && z < 0.6, "{eta} {z}: {count}");
            }
        }
    }

    #[test]
    fn the_mean_weight_is_what_leaves_the_layer() {
        // A white furnace: of what enters, the share that Lambert's law sends out of the layer.
        let coat = coated(1.5, 0.0);
        let wo = viewer(0.7);
        let n = 256_u16;
        let unit = |i: u16| (f32::from(i) + 0.5) / f32::from(n);
        let weights = (0..n).flat_map(|i| (0..n).map(move |j| [unit(i), unit(j)])).map(|u| {
            // Lambert's model does not choose; the number is beyond the interface.
            coat.sample(&white(), wo, 0.999, u).map_or(0.0, |s| f64::from(s.weight))
        });
        let mean = weights.sum::<f64>() / (f64::from(n) * f64::from(n));
        // Without absorption the interface is chosen as often as it reflects, so that the weight is that of what entered. The
        // diffuse transmittance of η = 1.5 from inside is (1 − 0.091778) / 1.5², which the one from outside gives.
        let expected = (1.0 - 0.091_778) / 2.25;
        // The midpoint rule with a jump at the critical angle.
        assert!((mean - expected).abs() < 2e-3, "{mean} {expected}");
    }

    #[test]
    fn nothing_is_seen_from_below() {
        let coat = coated(1.5, 0.0);
        let below = -viewer(0.5);
        assert!(coat.sample(&white(), below, 0.5, [0.5; 2]).is_none());
        assert_eq!(coat.eval_pdf(&white(), below, Vec3::Z), (0.0, 0.0));
        assert_eq!(coat.eval_pdf(&white(), Vec3::Z, below), (0.0, 0.0));
    }
}
