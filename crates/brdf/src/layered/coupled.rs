//! Shirley's coupled matte and specular reflection.

use etendue_math::Spectrum;

use super::coupled_interface::CoupledInterface;
use super::mirror_over_matte::{self, MirrorOverMatte};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity};
use crate::{Bsdf, BsdfReal, BsdfVec, Lobes, Reflectance, Sample};

/// A mirror coupled to a matte term that has exactly what the mirror leaves: polished matte surfaces, wood,
/// ceramics, plastic.
///
/// ```text
/// f = F(θo) δ(wi − mirror(wo)) + k Rm (1 − F(θo)) (1 − F(θi))
/// k = 1 / (π (1 − F_avg)),  for Schlick's F: 21 / (20 π (1 − R0))
/// ```
///
/// with one F in both shares, that of the [`CoupledInterface`].
///
/// * Parameters: `rm`, the matte reflectance per channel in `[0, 1]`; the interface.
/// * Laws: reciprocal; directional albedo exactly `F(θo) + Rm (1 − F(θo))`, 1 at every angle for Rm = 1.
///   The matte term is black at R0 = 1.
/// * Sampling: mirror or cosine, see [`MirrorOverMatte`]; `None` from below.
///
/// # Precision
/// A few ulp; `1 − F` does not cancel near grazing.
///
/// # Source
/// P. Shirley, B. Smits, H. Hu, E. Lafortune, "A Practitioners' Assessment of Light Reflection Models",
/// Pacific Graphics 1997, section 3. Where texts print `k = 21 (1 − R0)/(20 π)` they mean the
/// product of `1 − (1 − cos θ)⁵` without the factors `1 − R0`.
///
/// # Examples
/// ```
/// use etendue_brdf::{Bsdf, Coupled, CoupledInterface, Reflectance};
/// use etendue_math::glam::DVec3;
/// let interface = CoupledInterface::schlick(Reflectance::new(0.05_f64)?);
/// let white = Coupled::new(interface, Reflectance::white());
/// assert!((white.albedo(DVec3::new(0.8, 0.0, 0.6)).unwrap() - 1.0).abs() < 1e-15);
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupled<C: Spectrum> {
    interface: CoupledInterface<C>,
    matte: C,
}

impl<C: Spectrum> Coupled<C> {
    /// A base of reflectance `rm` under the interface.
    #[inline]
    pub fn new(interface: CoupledInterface<C>, rm: Reflectance<C>) -> Self {
        Self { interface, matte: rm.value() }
    }
}

impl<C: Spectrum> MirrorOverMatte for Coupled<C> {
    #[inline(always)]
    fn mirror(&self, cos_o: C::Real) -> C {
        self.interface.reflectance(cos_o)
    }
    #[inline(always)]
    fn matte(&self, cos_o: C::Real, cos_i: C::Real) -> C {
        self.interface.matte(cos_o, cos_i) * self.matte
    }
    #[inline(always)]
    fn matte_albedo(&self, cos_o: C::Real) -> C {
        self.interface.transmittance(cos_o) * self.matte
    }
}

impl<C: Spectrum> Bsdf for Coupled<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        mirror_over_matte::LOBES
    }
    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        mirror_over_matte::eval_pdf(self, wo, wi)
    }
    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        mirror_over_matte::sample(self, wo, u_lobe, u)
    }
    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        Some(mirror_over_matte::albedo(self, wo))
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "coupled",
    type_name: "Coupled",
    parameters: &[super::coupled_interface::PARAMETER, super::coupled_interface::MATTE],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: mirror_over_matte::LOBES,
    albedo: Albedo::ClosedForm,
    density: "mirror or cosine, by mean albedos",
    source: "Shirley et al. 1997, section 3",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ior, laws};
    use etendue_math::Real;
    use etendue_math::glam::DVec3;
    use etendue_math::quadrature::gauss_legendre;

    fn schlick(r0: f64, rm: f64) -> Coupled<f64> {
        let interface = CoupledInterface::schlick(Reflectance::new(r0).unwrap());
        Coupled::new(interface, Reflectance::new(rm).unwrap())
    }

    fn glass(eta: f64, rm: f64) -> Coupled<f64> {
        let interface = CoupledInterface::dielectric(Ior::new(eta).unwrap()).unwrap();
        Coupled::new(interface, Reflectance::new(rm).unwrap())
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        for model in [schlick(0.04, 0.7), glass(1.5, 0.7)] {
            laws::reciprocal(&model, 1e-14);
            laws::sampling_matches_density(&model, 1e-13);
            laws::total(&model);
        }
        for (r0, rm) in [(0.0, 1.0), (1.0, 1.0), (0.5, 0.0), (1.0, 0.0)] {
            laws::total(&schlick(r0, rm));
        }
        for eta in [1.0, 1.000_001, 1e4] {
            laws::total(&glass(eta, 1.0));
        }
    }

    /// `F(θ) + ∫ matte cos = 1` at Rm = 1.
    fn imbalance(model: Coupled<f64>, cos: f64) -> f64 {
        let matte: f64 = gauss_legendre::<f64, 96>()
            .iter()
            // c = t² where the exact F has its root.
            .map(|&(t, w)| w * 4.0 * f64::PI * t * t * t * model.matte(cos, t * t))
            .sum();
        model.mirror(cos) + matte - 1.0
    }

    #[test]
    fn a_white_base_reflects_exactly_everything_at_every_angle() {
        for cos in [1.0, 0.9, 0.5, 0.1, 1e-3, 1e-6] {
            for r0 in [0.0, 1e-4, 0.04, 0.5, 0.99, 1.0 - 1e-9] {
                // A polynomial in t of degree 13: exact but for rounding.
                let error = imbalance(schlick(r0, 1.0), cos);
                assert!(error.abs() < 1e-14, "R0 {r0}, cos {cos}: {error}");
            }
            for eta in [1.000_001, 1.01, 1.33, 1.5, 2.4, 10.0] {
                // Both quadratures resolve the root √(η² − 1 + c²) to 1e-9.
                let error = imbalance(glass(eta, 1.0), cos);
                assert!(error.abs() < 1e-9, "η {eta}, cos {cos}: {error}");
            }
            let model = schlick(0.3, 1.0);
            let wo = DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
            assert!((model.albedo(wo).unwrap() - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn a_perfect_mirror_leaves_nothing_to_scatter() {
        assert_eq!(schlick(1.0, 1.0).eval(DVec3::Z, DVec3::Z), 0.0);
        assert_eq!(schlick(1.0, 1.0).pdf(DVec3::Z, DVec3::Z), 0.0);
    }

    #[test]
    fn without_an_interface_it_is_lambert() {
        let wi = DVec3::new(0.6, 0.0, 0.8);
        let f = glass(1.0, 0.5).eval(DVec3::Z, wi);
        assert!((f - 0.5 * f64::FRAC_1_PI).abs() < 1e-15, "{f}");
    }
}
