//! Energy-preserving Oren–Nayar.

use etendue_math::{Real, Spectrum, Vector3};
use etendue_sampling::warp::{cosine_hemisphere, uniform_hemisphere};

use super::cltc::ClippedCosine;
use super::cosine::cosine_sample;
use super::fon;
use crate::bsdf::{above, both_above};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Density, Lobes, Reflectance, Roughness, Sample};

/// The albedo of the single-scattering lobe that [`Eon`] compensates with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EonAlbedo {
    /// In closed form: no energy is gained or lost. A square root and an arc tangent per direction.
    #[default]
    Exact,
    /// A quartic fit: energy is right to 6e-4, evaluation needs no function beyond a division.
    Approximate,
}

/// How [`Eon`] is sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EonSampling {
    /// Cosine-weighted: cheap, and good for small roughness or views from above.
    #[default]
    Cosine,
    /// [`ClippedCosine`] and a little of the uniform hemisphere: less noise at grazing views of rough surfaces, where
    /// the lobe leans back towards the viewer.
    Cltc,
}

/// Rough diffuse reflection with all orders of scattering between the facets: no energy is lost.
///
/// ```text
/// f  = ρ/π A (1 + r s/t) + ρm/π (1 − E(μo)) (1 − E(μi)) / (1 − Ē)
/// ρm = ρ² Ē / (1 − ρ (1 − Ē))
/// ```
///
/// with the lobe of [`OrenNayarFujii`](crate::OrenNayarFujii), its albedo `E` ([`fon::albedo`] or
/// [`fon::albedo_fit`]) and average albedo `Ē`. The fit is used as published: each of the three differences is at
/// least 1e-7.
///
/// * Shape: that of Fujii's model, filled up by light that facets scatter more than once, which is more saturated.
/// * Laws: reciprocal; directional albedo `ρ E + ρm (1 − E)`, exactly 1 for ρ = 1. With the approximate albedo it
///   is within 6e-4 of that: 0.99945 to 1.00015 for ρ = 1, r = 1.
/// * Sampling: cosine-weighted or with a clipped transformed cosine ([`EonSampling`]); `u_lobe` and two uniforms;
///   `None` from below and where f = 0.
///
/// # Precision
/// A few ulp times the condition of the problem: `1 − E` is computed without cancellation, in particular at grazing,
/// and `(1 − E)²/(1 − Ē)` is proportional to r, without a quotient of small numbers.
///
/// # Source
/// J. Portsmouth, P. Kutz and S. Hill, "EON: A Practical Energy-Preserving Rough Diffuse BRDF", JCGT 14(1), 2025,
/// listing 1. Departure: the exact variant has no clamps.
///
/// # Examples
/// ```
/// use etendue_brdf::{Bsdf, Eon, Reflectance, Roughness};
/// use etendue_math::glam::DVec3;
/// let white = Eon::new(Reflectance::white(), Roughness::new(1.0)?);
/// assert_eq!(white.albedo(DVec3::new(0.8, 0.0, 0.6)), Some(1.0));
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eon<C: Spectrum> {
    reflectance: C,
    roughness: Roughness<C::Real>,
    albedo: EonAlbedo,
    sampling: EonSampling,
    /// ρ A/π
    single: C,
    /// ρm
    multiple: C,
    /// r A, of which the deficits `1 − E` are multiples.
    deficit_scale: C::Real,
    /// r^0.1, by which the share of uniform samples grows; 0 where there are none.
    uniform_scale: C::Real,
}

/// The least difference `1 − E` of the approximate variant.
const LEAST_DEFICIT: f64 = 1e-7;

impl<C: Spectrum> Eon<C> {
    /// The reflector with single-scattering albedo ρ and roughness r: exact, and sampled by the cosine.
    pub fn new(reflectance: Reflectance<C>, roughness: Roughness<C::Real>) -> Self {
        let reflectance = reflectance.value();
        let normal = fon::normal_albedo(roughness);
        let average = fon::average_albedo(roughness);
        let one = <C::Real as Real>::ONE;
        Self {
            reflectance,
            roughness,
            albedo: EonAlbedo::Exact,
            sampling: EonSampling::Cosine,
            single: reflectance.scale(normal * C::Real::FRAC_1_PI),
            // (1 − ρ) + ρ Ē is ρ Ē to the last bit for ρ = 1, which makes ρm exactly 1 there.
            multiple: reflectance.map(|rho| {
                let surviving = (one - rho) + rho * average;
                rho * (rho * average / surviving)
            }),
            deficit_scale: roughness.value() * normal,
            uniform_scale: C::Real::ZERO,
        }
    }

    /// The same with this albedo of the single-scattering lobe.
    #[inline]
    pub fn with_albedo(self, albedo: EonAlbedo) -> Self {
        Self { albedo, ..self }
    }

    /// The same, sampled in this way.
    #[inline]
    pub fn with_sampling(self, sampling: EonSampling) -> Self {
        let uniform_scale = match sampling {
            EonSampling::Cosine => C::Real::ZERO,
            EonSampling::Cltc => self.roughness.value().powf(C::Real::lit(0.1)),
        };
        Self { sampling, uniform_scale, ..self }
    }

    /// `(1 − E(μo)) (1 − E(μi)) / (1 − Ē)`
    #[inline(always)]
    fn compensation(&self, cos_o: C::Real, cos_i: C::Real) -> C::Real {
        match self.albedo {
            EonAlbedo::Exact => {
                let deficits = fon::deficit(cos_o) * fon::deficit(cos_i);
                self.deficit_scale * deficits * C::Real::lit(1.0 / fon::AVERAGE_DEFICIT)
            }
            EonAlbedo::Approximate => {
                self.clamped_deficit(cos_o)
                    * (self.clamped_deficit(cos_i) / self.clamped_average_deficit())
            }
        }
    }

    #[inline(always)]
    fn clamped_deficit(&self, cos: C::Real) -> C::Real {
        (self.deficit_scale * fon::deficit_fit(cos)).max(C::Real::lit(LEAST_DEFICIT))
    }

    #[inline(always)]
    fn clamped_average_deficit(&self) -> C::Real {
        (self.deficit_scale * C::Real::lit(fon::AVERAGE_DEFICIT)).max(C::Real::lit(LEAST_DEFICIT))
    }

    /// `2 ∫₀¹ max(1e-7, 1 − E(μ)) μ dμ` for the fit, in closed form.
    fn average_of_clamped_deficit(&self) -> C::Real {
        let scale = self.deficit_scale;
        let threshold = C::Real::lit(LEAST_DEFICIT) / scale;
        let slope = |mu: C::Real| {
            let [_, c1, c2, c3, c4] = fon::FIT_DEFICIT.map(C::Real::lit);
            let [two, three, four] = [2.0, 3.0, 4.0].map(C::Real::lit);
            c1 + mu * (two * c2 + mu * (three * c3 + mu * four * c4))
        };
        if !(fon::deficit_fit(C::Real::ONE) > threshold) {
            return C::Real::lit(LEAST_DEFICIT);
        }
        // The fit grows with μ, by at least 0.05: Newton's method finds where the clamp ends.
        let mut end = C::Real::ZERO;
        for _ in 0..8 {
            end = end - (fon::deficit_fit(end) - threshold) / slope(end);
            end = end.clamp_to(C::Real::ZERO, C::Real::ONE);
        }
        let (mut sum, mut power) = (threshold * end * end, end * end);
        for (k, c) in fon::FIT_DEFICIT.into_iter().enumerate() {
            let share = C::Real::TWO / C::Real::lit(k as f64 + 2.0);
            sum += C::Real::lit(c) * share * (C::Real::ONE - power);
            power *= end;
        }
        scale * sum
    }

    /// Probability of a sample from the uniform hemisphere.
    #[inline(always)]
    fn uniform_probability(&self, mu: C::Real) -> C::Real {
        let mu = mu.clamp_to(C::Real::ZERO, C::Real::ONE);
        let [c0, c1, c2, c3] = [0.162_925, -0.372_058, 0.538_233, -0.290_822].map(C::Real::lit);
        self.uniform_scale * (c0 + mu * (c1 + mu * (c2 + mu * c3)))
    }
}

impl<C: Spectrum> Bsdf for Eon<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::CONTINUOUS
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        if !both_above(wo, wi) {
            return (C::black(), C::Real::ZERO);
        }
        let compensation = C::Real::FRAC_1_PI * self.compensation(wo.z(), wi.z());
        let single = self.single.scale(fon::shape(wo, wi, self.roughness.value()));
        let pdf = match self.sampling {
            EonSampling::Cosine => cosine_hemisphere::pdf::<C::Real>(wi),
            EonSampling::Cltc => {
                let uniform = self.uniform_probability(wo.z());
                uniform * uniform_hemisphere::pdf::<C::Real>(wi)
                    + (C::Real::ONE - uniform) * ClippedCosine::new(wo, self.roughness).pdf(wi)
            }
        };
        (single + self.multiple.scale(compensation), pdf)
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        if self.sampling == EonSampling::Cosine {
            return cosine_sample(self, wo, u);
        }
        if !above(wo) {
            return None;
        }
        let wi = if u_lobe < self.uniform_probability(wo.z()) {
            uniform_hemisphere::from_square(u)
        } else {
            ClippedCosine::new(wo, self.roughness).sample(u)?
        };
        let (f, pdf) = self.eval_pdf(wo, wi);
        if f.is_black() || !(pdf > C::Real::ZERO) {
            return None;
        }
        // p ≥ cos θi/20 for every r: no large number in the quotient.
        let weight = f.scale(wi.z() / pdf);
        Some(Sample { wi, weight, density: Density::Continuous(pdf), eta: C::Real::ONE })
    }

    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        if !above(wo) {
            return Some(C::black());
        }
        let single = fon::albedo(wo.z(), self.roughness);
        Some(match self.albedo {
            EonAlbedo::Exact => self.multiple + (self.reflectance - self.multiple).scale(single),
            EonAlbedo::Approximate => {
                let returned = self.average_of_clamped_deficit() / self.clamped_average_deficit();
                self.reflectance.scale(single)
                    + self.multiple.scale(self.clamped_deficit(wo.z()) * returned)
            }
        })
    }
}

const fn info(name: &'static str, energy: Energy) -> ModelInfo {
    ModelInfo {
        name,
        type_name: "Eon",
        parameters: &[parameter::REFLECTANCE, parameter::ROUGHNESS, parameter::SAMPLING],
        reciprocity: Reciprocity::Reciprocal,
        energy,
        lobes: Lobes::CONTINUOUS,
        albedo: Albedo::ClosedForm,
        density: "cosine, or clipped linearly transformed cosine",
        source: "Portsmouth, Kutz and Hill 2025",
    }
}

/// The entry of the exact variant in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = info("eon", Energy::Conserves);

/// The entry of the approximate variant in the [registry](crate::registry).
pub(crate) const INFO_APPROXIMATE: ModelInfo =
    info("eon-approx", Energy::Gains { maximum: 1.000_147, at: "roughness = 1, cos = 0.13" });

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use etendue_math::Rgb;
    use etendue_math::glam::DVec3;
    use etendue_math::quadrature::gauss_legendre;

    const SAMPLINGS: [EonSampling; 2] = [EonSampling::Cosine, EonSampling::Cltc];
    const ALBEDOS: [EonAlbedo; 2] = [EonAlbedo::Exact, EonAlbedo::Approximate];

    fn model(rho: f64, r: f64) -> Eon<f64> {
        Eon::new(Reflectance::new(rho).unwrap(), Roughness::new(r).unwrap())
    }

    fn viewer(z: f64) -> DVec3 {
        DVec3::new((1.0 - z * z).sqrt(), 0.0, z)
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        for r in [0.0, 1e-7, 0.3, 1.0] {
            for (albedo, sampling) in ALBEDOS.into_iter().zip(SAMPLINGS) {
                let model = model(0.8, r).with_albedo(albedo).with_sampling(sampling);
                laws::reciprocal(&model, 1e-14);
                laws::sampling_matches_density(&model, 1e-13);
                laws::total(&model);
                let single = Eon::new(Reflectance::<f32>::white(), Roughness::clamped(r as f32));
                laws::total(&single.with_albedo(albedo).with_sampling(sampling));
            }
        }
    }

    #[test]
    fn densities_integrate_to_one() {
        laws::density_integrates_to_at_most_one(&model(1.0, 1.0).with_sampling(EonSampling::Cltc));
    }

    #[test]
    fn a_white_surface_reflects_everything_exactly() {
        for r in [0.0_f32, 1e-30, 1e-7, 0.1, 0.37, 1.0] {
            let model = Eon::new(Reflectance::<Rgb<f32>>::white(), Roughness::new(r).unwrap());
            for k in 0..40 {
                let w = viewer(Real::powi(0.6, k)).as_vec3();
                assert_eq!(model.albedo(w), Some(Rgb::white()), "{r} {w}");
            }
        }
    }

    #[test]
    fn the_albedo_is_its_closed_form() {
        for albedo in ALBEDOS {
            for r in [0.2, 1.0] {
                // The kink at s = 0 and the singularity at μ = 0 cost the rule three digits.
                laws::albedo_is_closed_form(&model(0.7, r).with_albedo(albedo), 1e-3);
            }
        }
    }

    #[test]
    fn the_average_of_the_clamped_deficit_is_its_integral() {
        for r in [0.0, 1e-7, 3e-7, 4e-7, 1e-6, 1e-3, 1.0] {
            let model = model(1.0, r).with_albedo(EonAlbedo::Approximate);
            let sum = gauss_legendre::<f64, 200>()
                .iter()
                .map(|&(t, w)| w * 4.0 * t * t * t * model.clamped_deficit(t * t))
                .fold(0.0, |sum, x| sum + x);
            let got = model.average_of_clamped_deficit();
            // The rule meets the kink where the clamp ends, at worst between two of 200 nodes.
            assert!((got / sum - 1.0).abs() < 1e-5, "{r} {got} {sum}");
        }
    }

    #[test]
    fn the_approximate_variant_gains_and_loses_what_is_documented() {
        let model = model(1.0, 1.0).with_albedo(EonAlbedo::Approximate);
        let albedos = (1..=1000).map(|i| model.albedo(viewer(f64::from(i) / 1000.0)).unwrap());
        let (low, high) = albedos.fold((2.0_f64, 0.0_f64), |(l, h), a| (l.min(a), h.max(a)));
        assert!((low - 0.999_457).abs() < 2e-6 && (high - 1.000_147).abs() < 1e-6, "{low} {high}");
    }

    #[test]
    fn no_roughness_may_have_either_sign() {
        let [none, minus] = [0.0, -0.0].map(|r| model(0.7, r).with_albedo(EonAlbedo::Approximate));
        for z in [1.0, 0.5, 5e-29, f64::MIN_POSITIVE] {
            let albedo = minus.albedo(viewer(z)).unwrap();
            assert!(
                albedo == none.albedo(viewer(z)).unwrap() && albedo.is_finite(),
                "{z} {albedo}"
            );
        }
    }

    #[test]
    fn without_roughness_it_is_lamberts() {
        let (wo, wi) = (DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.0, 0.8, 0.6));
        assert_eq!(model(1.0, 0.0).eval(wo, wi), f64::FRAC_1_PI);
    }

    #[test]
    fn the_transformed_cosine_follows_a_grazing_view_with_less_variance() {
        let variance = |sampling| {
            let model = model(0.9, 1.0).with_sampling(sampling);
            let n = 32;
            let unit = |k: i32| (f64::from(k) + 0.5) / f64::from(n);
            let weights = (0..n * n * n).map(|i| {
                let u = [unit(i % n), unit(i / n % n)];
                model.sample(viewer(0.02), unit(i / (n * n)), u).map_or(0.0, |s| s.weight)
            });
            let (sum, squares) = weights.fold((0.0, 0.0), |(s, q), w| (s + w, q + w * w));
            let mean = sum / f64::from(n * n * n);
            squares / f64::from(n * n * n) - mean * mean
        };
        let [cosine, cltc] = SAMPLINGS.map(variance);
        // Measured: 0.41 and 0.028.
        assert!(cosine > 10.0 * cltc, "{cosine} {cltc}");
    }
}
