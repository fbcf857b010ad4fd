//! Rough glass with what single scattering loses, in the manner of Kulla and Conty.

use etendue_math::{Real, Spectrum, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use crate::bsdf::above;
use crate::microfacet::{InterfaceAlbedo, InterfaceLoss, isotropic_width};
use crate::mixture::limited_mixture_sample;
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{
    BeckmannLambda, Bsdf, BsdfReal, BsdfVec, Distribution, Ior, Lobes, Microfacets, ParameterError,
    Reflectance, RoughDielectric, Sample,
};

/// Rough dielectric with diffuse lobes on both sides for light that leaves after several facets.
///
/// With a the side of `wo`, b the other and η the index of b relative to a:
///
/// ```text
/// reflection   f = f₁ + ks (La − Ma) l_a(θo) l_a(θi) / (π La²)
/// refraction   f = f₁ + kt Ma l_a(θo) l_b(θi) / (π η² La Lb)
/// ```
///
/// with f₁ of [`RoughDielectric`], and l, L (its average) and T_avg/(R_avg + T_avg) of [`InterfaceLoss`]. Ma, the flux
/// that is transmitted after several facets, is chosen on the side of the thinner medium, where light that is lost
/// divides as the rest does:
///
/// ```text
/// M = min(L T_avg/(R_avg + T_avg), η² L_other),  seen from the other side M/η²
/// ```
///
/// * Laws: reflection is reciprocal, refraction up to η². White furnace: reflected and transmitted flux sum to 1
///   within 5e-3, and 1.3e-2 at grazing angles from the denser side, the error of the integrated loss. Two-sided.
/// * Domain: η ≠ 1, isotropic α in `[1e-8, 1]`, GGX or exact Beckmann facets with either masking.
/// * Sampling: `u_lobe` chooses the single lobes with probability `1 − l(θo)`, else cosine-weighted reflection or
///   refraction by their shares; the density is that of the mixture.
/// * Cost: the losses are integrated at construction, 32 768 facets, half of what a
///   [`TransmittanceTable`](crate::TransmittanceTable) takes: for one material, not for one point of a texture. An
///   evaluation has two look-ups with a root each more than f₁.
///
/// # Precision
/// A few ulp of the formula with the interpolated l.
///
/// # Source
/// C. Kulla and A. Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 course, for the lobes;
/// M is ours, and holds reciprocity and energy together. Against the random walk of
/// [`microfacet::walk`](crate::microfacet::walk), GGX with η from 1.5 to 2.4: the reflected flux from the thinner medium
/// is within 0.016 at all angles; from the denser one, where l is large, within 0.02 for α = 0.3, 0.07 for
/// 0.6 and 0.14 for 1, too much at normal and too little at grazing angles. The single lobes alone lose up to 0.3 of
/// the light from the thinner and 0.7 from the denser medium.
///
/// # Examples
/// ```
/// use etendue_brdf::{Alpha, Bsdf, Ior, KullaContyDielectric, Microfacets};
/// use etendue_math::glam::DVec3;
/// let facets = Microfacets::ggx(Alpha::new(0.6_f64)?);
/// let frosted = KullaContyDielectric::<f64>::new(Ior::new(1.5)?, facets)?;
/// let (above, below) = (DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.0, -0.6, -0.8));
/// let (into, back) = (frosted.eval(above, below), frosted.eval(below, above));
/// assert!((into * 1.5 * 1.5 - back).abs() < 1e-12 * back);
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KullaContyDielectric<C: Spectrum> {
    single: RoughDielectric<C>,
    from_above: Side<C>,
    from_below: Side<C>,
}

/// The surface as seen from one of its sides.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Side<C: Spectrum> {
    loss: InterfaceLoss<C::Real>,
    /// η of the other side.
    eta: C::Real,
    /// Share of the reflection in what is lost at first, `1 − M/L`.
    reflected: C::Real,
    /// `ks (L − M) / (π L²)`
    reflection: C,
    /// `kt M / (π η² L L_other)`
    transmission: C,
}

impl<C: Spectrum> KullaContyDielectric<C> {
    /// The interface to a medium below with relative index `eta`.
    ///
    /// # Errors
    /// [`ParameterError`] for η = 1, as for [`RoughDielectric`]; for anisotropic facets, α > 1 and Walter's fit.
    pub fn new(eta: Ior<C::Real>, facets: Microfacets<C::Real>) -> Result<Self, ParameterError> {
        let single = RoughDielectric::new(eta, facets)?;
        isotropic_width(&facets)?;
        if facets.distribution() == (Distribution::Beckmann { lambda: BeckmannLambda::Walter }) {
            let domain = "ggx or beckmann, whose sampled weights do not exceed 1";
            return Err(ParameterError::choice("distribution", "beckmann-walter", domain));
        }
        let interface = InterfaceAlbedo::new(&facets.in_double());
        let eta = eta.value().to_f64();
        let [above, below] = [eta, 1.0 / eta].map(|eta| InterfaceLoss::new(&interface, eta));
        let flux = if eta > 1.0 {
            transmitted(&above, &below, eta)
        } else {
            transmitted(&below, &above, 1.0 / eta) * eta * eta
        };
        Ok(Self {
            single,
            from_above: Side::new(above, &below, eta, flux),
            from_below: Side::new(below, &above, 1.0 / eta, flux / (eta * eta)),
        })
    }

    /// The same with reflection scaled by `ks` and transmission by `kt`, factors without physical meaning.
    #[inline]
    pub fn with_factors(self, ks: Reflectance<C>, kt: Reflectance<C>) -> Self {
        let scaled = |side: Side<C>| Side {
            reflection: side.reflection * ks.value(),
            transmission: side.transmission * kt.value(),
            ..side
        };
        Self {
            single: self.single.with_factors(ks, kt),
            from_above: scaled(self.from_above),
            from_below: scaled(self.from_below),
        }
    }

    /// The side of `w` and the other one.
    #[inline(always)]
    fn sides(&self, w: BsdfVec<Self>) -> (&Side<C>, &Side<C>) {
        if w.z() < C::Real::ZERO {
            (&self.from_below, &self.from_above)
        } else {
            (&self.from_above, &self.from_below)
        }
    }
}

/// M as seen from the thinner medium, in which the index of the denser one is `eta`.
fn transmitted<T: Real>(thin: &InterfaceLoss<T>, dense: &InterfaceLoss<T>, eta: f64) -> f64 {
    (thin.average() * thin.transmitted_share()).min(eta * eta * dense.average())
}

impl<C: Spectrum> Side<C> {
    fn new(
        loss: InterfaceLoss<C::Real>,
        other: &InterfaceLoss<C::Real>,
        eta: f64,
        transmitted: f64,
    ) -> Self {
        let (own, far) = (loss.average(), other.average());
        // Of a nearly smooth surface nothing may be lost to the last digit: then there is nothing to add.
        let quotient = |x: f64, y: f64| if y > 0.0 { x / y } else { 0.0 };
        let reflected = (own - transmitted).max(0.0);
        let lit = |x: f64| C::splat(C::Real::lit(x * core::f64::consts::FRAC_1_PI));
        Self {
            loss,
            eta: C::Real::lit(eta),
            reflected: C::Real::lit(quotient(reflected, own)),
            reflection: lit(quotient(quotient(reflected, own), own)),
            transmission: lit(quotient(quotient(transmitted, own), far) / (eta * eta)),
        }
    }
}

impl<C: Spectrum> Bsdf for KullaContyDielectric<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        self.single.lobes()
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        let one = <C::Real as Real>::ONE;
        let (near, far) = self.sides(wo);
        let (cos_o, cos_i) = (wo.z().abs(), wi.z().abs());
        let upper = |w: BsdfVec<Self>| if w.z() < C::Real::ZERO { w.flip_z() } else { w };
        if !(above(upper(wo)) && above(upper(wi))) {
            return (C::black(), C::Real::ZERO);
        }
        let lost = near.loss.at(cos_o);
        let (multiple, share) = if (wo.z() < C::Real::ZERO) == (wi.z() < C::Real::ZERO) {
            (near.reflection.scale(lost * near.loss.at(cos_i)), near.reflected)
        } else {
            (near.transmission.scale(lost * far.loss.at(cos_i)), one - near.reflected)
        };
        let (f, pdf) = self.single.eval_pdf(wo, wi);
        let diffuse = cosine_hemisphere::pdf::<C::Real>(upper(wi));
        let pdf = (one - lost) * pdf + lost * share * diffuse;
        ((f + multiple).map(|x| x.min(C::Real::MAX)), pdf.min(C::Real::MAX))
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        let (near, _) = self.sides(wo);
        let lost = near.loss.at(wo.z().abs());
        let kept = C::Real::ONE - lost;
        let (wi, eta) = if u_lobe < kept {
            let u_lobe = (u_lobe / kept).min(C::Real::ONE_MINUS_EPSILON);
            let sample = self.single.sample(wo, u_lobe, u)?;
            (sample.wi, sample.eta)
        } else {
            let wi = cosine_hemisphere::from_square(u);
            let reflected = u_lobe - kept < lost * near.reflected;
            let wi = if reflected == (wo.z() < C::Real::ZERO) { wi.flip_z() } else { wi };
            (wi, if reflected { C::Real::ONE } else { near.eta })
        };
        limited_mixture_sample(self, wo, wi, eta)
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "kulla-conty-dielectric",
    type_name: "KullaContyDielectric",
    parameters: &[
        parameter::ROUGH_ETA,
        parameter::DISTRIBUTION,
        parameter::UNIT_ALPHA,
        parameter::MASKING,
        parameter::KS,
        parameter::KT,
    ],
    reciprocity: Reciprocity::UpToSquaredIndex,
    energy: Energy::Gains {
        maximum: 1.013,
        at: "GGX α 1, η 1.5, cos 0.05 from the denser side: the error of the integral",
    },
    lobes: Lobes { continuous: true, delta: false, transmission: true },
    albedo: Albedo::Quadrature,
    density: "mixture of visible normals and cosine on either side",
    source: "Kulla and Conty 2017, with shares by energy",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::microfacet::walk::DielectricWalk;
    use crate::{Alpha, Masking, laws};
    use etendue_math::glam::DVec3;
    use etendue_math::quadrature::gauss_legendre;
    use etendue_sampling::{Pcg32, uniform};

    const BECKMANN: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Exact };

    fn facets(distribution: Distribution, alpha: f64) -> Microfacets<f64> {
        let alpha = Alpha::new(alpha).unwrap();
        Microfacets::new(distribution, alpha, alpha, Masking::HeightCorrelated)
    }

    fn glass(distribution: Distribution, alpha: f64, eta: f64) -> KullaContyDielectric<f64> {
        KullaContyDielectric::new(Ior::new(eta).unwrap(), facets(distribution, alpha)).unwrap()
    }

    fn direction(z: f64) -> DVec3 {
        DVec3::new((1.0 - z * z).sqrt(), 0.0, z)
    }

    /// Reflected and transmitted flux of the single lobes, by strata of samples, and of the others, by panels that
    /// shrink towards grazing, where they live for small α.
    fn flux(model: &KullaContyDielectric<f64>, wo: DVec3) -> [[f64; 2]; 2] {
        const SIDE: u32 = 40;
        let (mut single, mut multiple) = ([0.0; 2], [0.0; 2]);
        for i in 0..SIDE * SIDE * SIDE {
            let u = [i % SIDE, i / SIDE % SIDE, i / (SIDE * SIDE)]
                .map(|i| (f64::from(i) + 0.5) / f64::from(SIDE));
            if let Some(s) = model.single.sample(wo, u[0], [u[1], u[2]]) {
                let strata = f64::from(SIDE * SIDE * SIDE);
                single[usize::from(s.wi.z * wo.z < 0.0)] += s.weight * s.eta * s.eta / strata;
            }
        }
        let (near, far) = model.sides(wo);
        let lost = near.loss.at(wo.z.abs());
        for k in 0..40 {
            let (a, b) = (Real::powf(0.7, f64::from(k + 1)), Real::powf(0.7, f64::from(k)));
            for (t, w) in gauss_legendre::<f64, 16>() {
                let mu = a + (b - a) * t;
                let w = w * (b - a) * 2.0 * f64::PI * mu * lost;
                multiple[0] += w * near.reflection * near.loss.at(mu);
                multiple[1] += w * near.transmission * near.eta * near.eta * far.loss.at(mu);
            }
        }
        [single, multiple]
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        for (distribution, eta) in [(Distribution::Ggx, 1.5), (BECKMANN, 1.0 / 1.5)] {
            let model = glass(distribution, 0.4, eta);
            laws::sampling_matches_density(&model, 1e-8);
            laws::density_integrates_to_at_most_one(&model);
            laws::total(&model);
            laws::total(&glass(distribution, 1e-8, eta));
        }
    }

    #[test]
    fn exchanging_the_directions_changes_it_by_the_squared_index_alone() {
        for eta in [1.5, 1.0 / 2.4] {
            let model = glass(Distribution::Ggx, 0.8, eta);
            let (a, b) = (direction(0.3), DVec3::new(0.0, 0.6, -0.8));
            let (into, back) = (model.eval(a, b), model.eval(b, a));
            assert!(into > 0.0 && (into * eta * eta - back).abs() < 1e-13 * back, "{into} {back}");
            for (a, b) in [(a, direction(0.9)), (b, direction(-0.2))] {
                let (there, back) = (model.eval(a, b), model.eval(b, a));
                assert!((there - back).abs() < 1e-12 * back, "{there} {back}");
            }
        }
    }

    #[test]
    fn a_white_furnace_stays_white_on_both_sides() {
        for distribution in [Distribution::Ggx, BECKMANN] {
            for alpha in [0.05, 0.3, 1.0] {
                for eta in [1.01, 1.5, 1.0 / 2.4] {
                    let model = glass(distribution, alpha, eta);
                    for z in [1.0, 0.3, 0.05, -1.0, -0.5, -0.05] {
                        let [[r1, t1], [r, t]] = flux(&model, direction(z));
                        let albedo = r1 + t1 + r + t;
                        // As documented, and what 40 strata make of the horizon and of total reflection.
                        assert!((albedo - 1.0).abs() < 2e-2, "{alpha} {eta} {z} {albedo}");
                    }
                }
            }
        }
    }

    #[test]
    fn light_divides_nearly_as_on_a_walk_from_facet_to_facet() {
        const PATHS: u32 = 20_000;
        let mut generator = Pcg32::new(11, 1);
        let mut next = || uniform::<f64>(&mut generator);
        // The last number is the documented error from the denser side.
        for (alpha, eta, dense) in
            [(0.3, 1.5, 0.02), (0.6, 1.5, 0.07), (1.0, 1.5, 0.14), (1.0, 2.4, 0.04)]
        {
            let facets = facets(Distribution::Ggx, alpha);
            let model = glass(Distribution::Ggx, alpha, eta);
            let walk = DielectricWalk::new(Ior::new(eta).unwrap(), facets).unwrap();
            for z in [1.0, 0.5, 0.1, -1.0, -0.5, -0.1] {
                let wo = direction(z);
                let paths = (0..PATHS).map(|_| walk.sample(wo, &mut next).unwrap());
                let want = paths.map(|path| f64::from(u8::from(path.wi.z * z > 0.0))).sum::<f64>();
                let want = want / f64::from(PATHS);
                let [[single, _], [multiple, _]] = flux(&model, wo);
                let error = single + multiple - want;
                // And four standard errors of the walk.
                let deviation = (want * (1.0 - want) / f64::from(PATHS)).sqrt();
                let bound = if z > 0.0 { 0.016 } else { dense } + 4.0 * deviation;
                assert!(error.abs() < bound, "{alpha} {eta} {z}: {single} + {multiple}, {want}");
            }
        }
    }

    #[test]
    fn surfaces_without_a_loss_are_refused() {
        let eta = Ior::new(1.5).unwrap();
        let [a, b] = [0.3, 0.4].map(|a| Alpha::new(a).unwrap());
        let walter = Distribution::Beckmann { lambda: BeckmannLambda::Walter };
        for facets in [
            Microfacets::new(Distribution::Ggx, a, b, Masking::Separable),
            facets(Distribution::Ggx, 1.1),
            facets(walter, 0.3),
        ] {
            assert!(KullaContyDielectric::<f64>::new(eta, facets).is_err());
        }
        let matched = Ior::new(1.0).unwrap();
        assert!(KullaContyDielectric::<f64>::new(matched, facets(BECKMANN, 0.3)).is_err());
    }
}
