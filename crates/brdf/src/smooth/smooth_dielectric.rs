//! Smooth glass.

use etendue_math::{Real, Spectrum, Vector3};

use crate::bsdf::above;
use crate::direction::reflect;
use crate::fresnel::{Refraction, RelativeIndex};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Density, Ior, Lobes, Reflectance, Sample};

/// Smooth interface between two dielectrics: reflection and refraction.
///
/// ```text
/// reflection:  wi = (−x, −y, z),       weight = ks,        probability F
/// refraction:  wi = refract(wo, η),    weight = kt / η²,   probability 1 − F
/// ```
///
/// with η the index on the far side of `wo` relative to the near side, so `1/η` when `wo` is below.
///
/// * Laws: conserves energy (albedo `ks F + kt (1 − F)` in flux); radiance is scaled by `1/η²`
///   across the interface, so `f/η²` and not `f` is symmetric. Delta, two-sided. Under total
///   internal reflection everything is reflected; for η = 1 everything passes straight on.
/// * Sampling: `u_lobe` chooses between the two; `None` at `wo.z = 0` and for zero weights.
///
/// # Source
/// Fresnel's equations and Snell's law; E. Veach, thesis, 1997, section 5.2 for `1/η²`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothDielectric<C: Spectrum> {
    eta: C::Real,
    specular_reflectance: C,
    specular_transmittance: C,
}

impl<C: Spectrum> SmoothDielectric<C> {
    /// The interface to a medium below with relative index `eta`.
    #[inline]
    pub fn new(eta: Ior<C::Real>) -> Self {
        Self {
            eta: eta.value(),
            specular_reflectance: C::white(),
            specular_transmittance: C::white(),
        }
    }

    /// The same with reflection scaled by `ks` and transmission by `kt`, factors without physical meaning.
    #[inline]
    pub fn with_factors(self, ks: Reflectance<C>, kt: Reflectance<C>) -> Self {
        Self { specular_reflectance: ks.value(), specular_transmittance: kt.value(), ..self }
    }

    /// `wo` mirrored to the upper side, and the index as seen from where it came.
    #[inline(always)]
    fn upright(&self, wo: BsdfVec<Self>) -> (BsdfVec<Self>, RelativeIndex<C::Real>) {
        if wo.z() < C::Real::ZERO {
            (wo.flip_z(), RelativeIndex::from_below(self.eta))
        } else {
            (wo, RelativeIndex::from_above(self.eta))
        }
    }
}

impl<C: Spectrum> Bsdf for SmoothDielectric<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::DELTA_THROUGH
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        _u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        let one = <C::Real as Real>::ONE;
        let below = wo.z() < C::Real::ZERO;
        let (w, index) = self.upright(wo);
        if !above(w) {
            return None;
        }
        let eta = index.eta();
        let Refraction { reflectance, direction } = Refraction::new(w, index);
        let sample = match direction {
            Some(wi) if u_lobe >= reflectance => Sample {
                wi,
                weight: self.specular_transmittance.scale(one / (eta * eta)),
                density: Density::Delta(one - reflectance),
                eta,
            },
            _ => Sample {
                wi: reflect(w),
                weight: self.specular_reflectance,
                density: Density::Delta(reflectance),
                eta: one,
            },
        };
        // A uniform outside [0, 1) may choose what has no probability.
        if sample.weight.is_black() || sample.density == Density::Delta(C::Real::ZERO) {
            return None;
        }
        Some(if below { Sample { wi: sample.wi.flip_z(), ..sample } } else { sample })
    }

    /// In radiance, as everywhere: `ks F + kt (1 − F) / η²`.
    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        let one = <C::Real as Real>::ONE;
        let (w, index) = self.upright(wo);
        if !above(w) {
            return Some(C::black());
        }
        let r = Refraction::new(w, index).reflectance;
        let t = (one - r) / (index.eta() * index.eta());
        Some(self.specular_reflectance.scale(r) + self.specular_transmittance.scale(t))
    }

    /// Everything that is transmitted where the indices are equal, else nothing.
    #[inline]
    fn pass_through(&self, wo: BsdfVec<Self>) -> C {
        let is_matched = self.eta == <C::Real as Real>::ONE;
        if is_matched && (above(wo) || above(-wo)) {
            self.specular_transmittance
        } else {
            C::black()
        }
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "smooth-dielectric",
    type_name: "SmoothDielectric",
    parameters: &[parameter::ETA, parameter::KS, parameter::KT],
    reciprocity: Reciprocity::UpToSquaredIndex,
    energy: Energy::Conserves,
    lobes: Lobes::DELTA_THROUGH,
    albedo: Albedo::ClosedForm,
    density: "delta, reflection with probability F",
    source: "Born and Wolf, section 1.5",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use etendue_math::glam::DVec3;

    fn glass(eta: f64) -> SmoothDielectric<f64> {
        SmoothDielectric::new(Ior::new(eta).unwrap())
    }

    #[test]
    fn the_two_probabilities_sum_to_one_from_both_sides() {
        for z in [0.9_f64, 0.3, -0.3, -0.9] {
            let wo = DVec3::new((1.0 - z * z).sqrt(), 0.0, z);
            let mut sum = 0.0;
            for u in [0.0, 0.999_999] {
                let s = glass(1.5).sample(wo, u, [0.0; 2]).unwrap();
                if let Density::Delta(p) = s.density {
                    sum += if u == 0.0 || s.eta != 1.0 { p } else { 0.0 };
                }
            }
            // F + (1 − F), each a few roundings.
            assert!((sum - 1.0).abs() < 1e-14, "{z} {sum}");
        }
    }

    #[test]
    fn what_has_no_probability_is_not_sampled() {
        // A matched index reflects nothing; uniforms are not negative, but what a caller passes may be.
        assert!(glass(1.0).sample(DVec3::Z, -1.0, [0.0; 2]).is_none());
        assert!(glass(1.0).sample(DVec3::Z, 0.0, [0.0; 2]).is_some());
    }

    #[test]
    fn refraction_scales_radiance_and_is_undone_on_the_way_back() {
        let wo = DVec3::new(0.6, 0.0, 0.8);
        let into = glass(1.5).sample(wo, 0.999, [0.0; 2]).unwrap();
        let back = glass(1.5).sample(into.wi, 0.999, [0.0; 2]).unwrap();
        assert!((into.weight * back.weight - 1.0).abs() < 1e-15);
        assert!((into.eta * back.eta - 1.0).abs() < 1e-15 && (back.wi - wo).length() < 1e-15);
    }

    #[test]
    fn a_matched_index_passes_straight_on() {
        let wo = DVec3::new(0.6, 0.0, 0.8);
        for u in [0.0, 0.5] {
            let s = glass(1.0).sample(wo, u, [0.0; 2]).unwrap();
            assert_eq!((s.wi, s.weight, s.density), (-wo, 1.0, Density::Delta(1.0)));
        }
    }

    #[test]
    fn around_the_critical_angle_something_is_always_sampled() {
        let model = SmoothDielectric::<f32>::new(Ior::new(1.5).unwrap());
        let mut c = (1.0_f32 - 1.0 / 2.25).sqrt() - 1e-5;
        for _ in 0..400 {
            let wo = etendue_math::glam::Vec3::new((1.0 - c * c).sqrt(), 0.0, -c);
            for u in [0.0, f32::ONE_MINUS_EPSILON] {
                assert!(model.sample(wo, u, [0.0; 2]).is_some(), "{c} {u}");
            }
            c = c.next_up();
        }
    }

    #[test]
    fn no_input_is_a_nan() {
        for eta in [0.5, 1.0, 1.5] {
            laws::total(&glass(eta));
        }
        laws::total(&SmoothDielectric::<f32>::new(Ior::new(1.000_000_1).unwrap()));
    }
}
