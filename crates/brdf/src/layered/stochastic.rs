//! The reference for layered models: light followed between interface and base, bounce by bounce.

use etendue_math::{Real, Spectrum, Vec3, Vector3};
use etendue_sampling::mis;

use crate::bsdf::{above, both_above};
use crate::{Bsdf, BsdfReal, BsdfVec, Density, OpticalDepth, Sample};

/// Two surfaces on top of each other, the room between them absorbing: all of its light, by a random walk.
///
/// Closed-form layered models ([`Plastic`](crate::Plastic), the coupled ones) approximate how often
/// light goes back and forth between interface and base. This one follows it: `eval` and
/// `sample` are unbiased *estimates* that consume any number of uniforms, so it is no [`Bsdf`]; it is what
/// the closed forms are measured against.
///
/// ```text
/// f(wo, wi) = f_top(wo, wi) + Σₙ ∫ f_top(wo, ·) a (f_base a f_top a)ⁿ f_base a f_top(·, wi)
/// a(w) = exp(−τ / |cos θ|)
/// ```
///
/// The layer is thin against its extent: a path leaves where it entered, so that only directions
/// matter and no position (hence "position-free").
///
/// * `top`: the interface; the layer lies below it. Its transmission must follow radiance, as that
///   of every [`Bsdf`] here does.
/// * `base`: the surface below, seen from inside the layer, opaque: what it transmits is lost.
/// * Laws: reciprocal if both surfaces are; conserves energy if both do.
/// * Sampling: the walk itself, [`sample`](Self::sample). [`eval`](Self::eval) connects every bounce to `wi` in
///   two ways, through the interface sampled from `wi` and through the base, combined by the power
///   heuristic; delta interfaces and delta bases are met by the one that can.
///
/// # Source
/// Y. Guo, M. Hašan, S. Zhao, "Position-Free Monte Carlo Simulation for Arbitrary Layered BSDFs",
/// SIGGRAPH Asia 2018, section 5; without scattering between the surfaces.
///
/// # Examples
/// ```
/// use etendue_brdf::*;
/// use etendue_math::glam::DVec3;
/// use etendue_sampling::{Pcg32, uniform};
/// let mut rng = Pcg32::new(1, 1);
/// let mut uniforms = || uniform::<f64>(&mut rng);
/// let glass = SmoothDielectric::<f64>::new(Ior::new(1.5)?);
/// let layers = StochasticLayers::new(glass, Lambert::new(Reflectance::new(0.5)?), OpticalDepth::clear());
/// let wo = DVec3::new(0.6, 0.0, 0.8);
/// let f = (0..1000).map(|_| layers.eval(wo, DVec3::Z, &mut uniforms)).sum::<f64>() / 1000.0;
/// assert!(f > 0.05 && f < 0.12);
/// # Ok::<(), ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StochasticLayers<A: Bsdf, B> {
    top: A,
    base: B,
    depth: OpticalDepth<A::Color>,
}

/// Where a path is after it met the interface.
enum Place<C: Spectrum> {
    /// In the layer, on its way down.
    Inside(Path<C>),
    /// Outside again, for good.
    Outside(Path<C>),
    /// Nowhere: absorbed.
    Lost,
}

/// The end of a path and what has become of its light.
struct Path<C: Spectrum> {
    direction: Vec3<C::Real>,
    throughput: C,
}

impl<A: Bsdf, B: Bsdf<Color = A::Color>> StochasticLayers<A, B> {
    /// `base` under `top`, with what `depth` absorbs on a perpendicular crossing between them.
    #[inline]
    pub fn new(top: A, base: B, depth: OpticalDepth<A::Color>) -> Self {
        Self { top, base, depth }
    }

    /// An unbiased estimate of `f(wo, wi)`, without the cosine, in sr⁻¹. 0 outside the domain; delta
    /// reflection at the interface has no value.
    pub fn eval(
        &self,
        wo: BsdfVec<A>,
        wi: BsdfVec<A>,
        uniforms: &mut impl FnMut() -> BsdfReal<A>,
    ) -> A::Color {
        if !both_above(wo, wi) {
            return A::Color::black();
        }
        let mut sum = self.top.eval(wo, wi);
        let mut place = self.meet_interface(wo, A::Color::white(), uniforms);
        // Paths that leave the layer count as nothing here: every bounce has been connected to `wi`.
        while let Place::Inside(path) = place {
            let throughput = path.throughput * self.transmittance(path.direction);
            sum += self.through_the_interface(path.direction, wi, uniforms) * throughput;
            let Some(bounce) = self.bounce(path.direction, uniforms) else { break };
            let throughput = throughput * bounce.weight * self.transmittance(bounce.wi);
            sum += self.through_the_base(&bounce, wi) * throughput;
            place = self.meet_interface(-bounce.wi, throughput, uniforms);
        }
        sum
    }

    /// A direction drawn by following the light, and its weight, the mean of which is the directional
    /// albedo: `E[weight g(wi)] = ∫ f(wo, wi) |cos θi| g(wi) dωi` for every `g`. Its density is unknown.
    ///
    /// `None` where the light is absorbed, and outside the domain.
    pub fn sample(
        &self,
        wo: BsdfVec<A>,
        uniforms: &mut impl FnMut() -> BsdfReal<A>,
    ) -> Option<(BsdfVec<A>, A::Color)> {
        if !above(wo) {
            return None;
        }
        let mut place = self.meet_interface(wo, A::Color::white(), uniforms);
        loop {
            match place {
                Place::Outside(path) => return Some((path.direction, path.throughput)),
                Place::Lost => return None,
                Place::Inside(path) => {
                    let throughput = path.throughput * self.transmittance(path.direction);
                    let bounce = self.bounce(path.direction, uniforms)?;
                    let throughput = throughput * bounce.weight * self.transmittance(bounce.wi);
                    place = self.meet_interface(-bounce.wi, throughput, uniforms);
                }
            }
        }
    }

    /// A path that comes from `w` (pointing away from the interface) goes on at the interface; dim ones
    /// are ended by roulette.
    fn meet_interface(
        &self,
        w: BsdfVec<A>,
        throughput: A::Color,
        uniforms: &mut impl FnMut() -> BsdfReal<A>,
    ) -> Place<A::Color> {
        let survival = (throughput.max_channel() * BsdfReal::<A>::lit(4.0)).min(BsdfReal::<A>::ONE);
        if !(uniforms() < survival) {
            return Place::Lost;
        }
        let Some(sample) = draw(&self.top, w, uniforms) else { return Place::Lost };
        let throughput = throughput.scale(BsdfReal::<A>::ONE / survival) * sample.weight;
        let path = Path { direction: sample.wi, throughput };
        if sample.wi.z() > BsdfReal::<A>::ZERO { Place::Outside(path) } else { Place::Inside(path) }
    }

    /// A path going `down` is reflected by the base.
    fn bounce(
        &self,
        down: BsdfVec<A>,
        uniforms: &mut impl FnMut() -> BsdfReal<A>,
    ) -> Option<Sample<A::Color>> {
        draw(&self.base, -down, uniforms).filter(|sample| above(sample.wi))
    }

    /// Light from `wi` that a random refraction brings to the base, scattered there towards where a
    /// path going `down` came from.
    fn through_the_interface(
        &self,
        down: BsdfVec<A>,
        wi: BsdfVec<A>,
        uniforms: &mut impl FnMut() -> BsdfReal<A>,
    ) -> A::Color {
        let light = match draw(&self.top, wi, uniforms) {
            Some(sample) if sample.wi.z() < BsdfReal::<A>::ZERO => sample,
            _ => return A::Color::black(),
        };
        let (f, density) = self.base.eval_pdf(-down, -light.wi);
        let share = match light.density {
            Density::Continuous(own) => mis::power(own, density),
            Density::Delta(_) => BsdfReal::<A>::ONE,
        };
        // Sampled as if radiance went from the layer to the outside; it goes the other way.
        let adjoint = light.eta * light.eta;
        f * light.weight.scale(adjoint * share) * self.transmittance(light.wi)
    }

    /// Light from `wi` that the interface scatters into the direction of a bounce off the base.
    fn through_the_base(&self, bounce: &Sample<A::Color>, wi: BsdfVec<A>) -> A::Color {
        let share = match bounce.density {
            Density::Continuous(own) => mis::power(own, self.top.pdf(wi, -bounce.wi)),
            Density::Delta(_) => BsdfReal::<A>::ONE,
        };
        self.top.eval(-bounce.wi, wi).scale(share)
    }

    /// What of the light is left after crossing the layer along `w`.
    fn transmittance(&self, w: BsdfVec<A>) -> A::Color {
        self.depth.transmittance(w.z())
    }
}

/// A sample of a surface, with three fresh uniforms.
fn draw<M: Bsdf>(
    surface: &M,
    w: BsdfVec<M>,
    uniforms: &mut impl FnMut() -> BsdfReal<M>,
) -> Option<Sample<M::Color>> {
    let (u_lobe, u) = (uniforms(), [uniforms(), uniforms()]);
    surface.sample(w, u_lobe, u)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Alpha, ComplexIor, Distribution, InternalReflectance, InternalScattering, Ior, Lambert,
        Masking, Microfacets, Null, Plastic, PlasticInterface, Reflectance, RoughConductor,
        RoughDielectric, SmoothDielectric,
    };
    use etendue_math::glam::DVec3;
    use etendue_sampling::{Pcg32, uniform};

    const WO: DVec3 = DVec3::new(0.6, 0.0, 0.8);
    const WI: DVec3 = DVec3::new(0.0, -0.28, 0.96);

    fn glass() -> SmoothDielectric<f64> {
        SmoothDielectric::new(Ior::new(1.5).unwrap())
    }

    fn paint(rho: f64) -> Lambert<f64> {
        Lambert::new(Reflectance::new(rho).unwrap())
    }

    fn facets(alpha: f64) -> Microfacets<f64> {
        let alpha = Alpha::new(alpha).unwrap();
        Microfacets::new(Distribution::Ggx, alpha, alpha, Masking::HeightCorrelated)
    }

    /// Mean of `n` estimates and its standard error.
    fn mean(
        n: u32,
        seed: u64,
        mut estimate: impl FnMut(&mut dyn FnMut() -> f64) -> f64,
    ) -> (f64, f64) {
        let mut rng = Pcg32::new(seed, 7);
        let mut next = || uniform::<f64>(&mut rng);
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..n {
            let x = estimate(&mut next);
            sum += x;
            squares += x * x;
        }
        let n = f64::from(n);
        let mean = sum / n;
        (mean, ((squares / n - mean * mean) / n).sqrt())
    }

    /// Five standard errors: 6e-7 of sound estimators fail, and the seeds are fixed.
    fn agrees((mean, error): (f64, f64), want: f64) -> bool {
        (mean - want).abs() <= 5.0 * error.max(1e-12)
    }

    fn energy<A: Bsdf<Color = f64>, B: Bsdf<Color = f64>>(
        layers: &StochasticLayers<A, B>,
        wo: DVec3,
    ) -> (f64, f64) {
        mean(40_000, 3, |mut u| layers.sample(wo, &mut u).map_or(0.0, |(_, weight)| weight))
    }

    #[test]
    fn glass_over_paint_is_plastic_with_non_linear_scattering() {
        let interface = PlasticInterface::new(Ior::new(1.5).unwrap(), InternalReflectance::Exact);
        for rho in [0.3, 0.9] {
            let layers = StochasticLayers::new(glass(), paint(rho), OpticalDepth::clear());
            let reflectance = Reflectance::new(rho).unwrap();
            let plastic = Plastic::new(interface, reflectance, InternalScattering::NonLinear);
            let got = mean(40_000, 1, |mut u| layers.eval(WO, WI, &mut u));
            assert!(agrees(got, plastic.eval(WO, WI)), "{got:?}");
            let got = energy(&layers, WO);
            assert!(agrees(got, plastic.albedo(WO).unwrap()), "{got:?}");
        }
    }

    #[test]
    fn white_paint_under_clear_glass_returns_everything() {
        let layers = StochasticLayers::new(glass(), paint(1.0), OpticalDepth::clear());
        for z in [1.0_f64, 0.5, 0.05] {
            let got = energy(&layers, DVec3::new((1.0 - z * z).sqrt(), 0.0, z));
            assert!(agrees(got, 1.0), "{z} {got:?}");
        }
    }

    #[test]
    fn under_nothing_the_base_is_what_it_is_and_absorption_is_beers_law() {
        let tau = 0.4;
        let depth = OpticalDepth::new(tau).unwrap();
        let layers = StochasticLayers::new(Null::<f64>::new(), paint(0.5), depth);
        let got = mean(4_000, 2, |mut u| layers.eval(WO, WI, &mut u));
        let want = 0.5 * f64::FRAC_1_PI * Real::exp(-tau / WO.z - tau / WI.z);
        assert!(agrees(got, want), "{got:?} {want}");
    }

    #[test]
    fn rough_layers_are_reciprocal_and_their_samples_follow_their_values() {
        let top = RoughDielectric::<f64>::new(Ior::new(1.5).unwrap(), facets(0.3)).unwrap();
        let metal = RoughConductor::new(ComplexIor::new(1.4, 1.6).unwrap(), facets(0.5));
        let layers = StochasticLayers::new(top, metal, OpticalDepth::new(0.1).unwrap());
        let (there, e1) = mean(200_000, 4, |mut u| layers.eval(WO, WI, &mut u));
        let (back, e2) = mean(200_000, 5, |mut u| layers.eval(WI, WO, &mut u));
        assert!((there - back).abs() < 5.0 * (e1 + e2), "{there} ± {e1}, {back} ± {e2}");
        // The share of light that goes into a cap, once by samples and once by values.
        let inside = |w: DVec3| w.dot(WI) > 0.9;
        let (sampled, e1) = mean(200_000, 6, |mut u| {
            layers
                .sample(WO, &mut u)
                .map_or(0.0, |(wi, weight)| if inside(wi) { weight } else { 0.0 })
        });
        let (valued, e2) = mean(200_000, 7, |mut u| {
            let (z, phi) = (u(), 2.0 * f64::PI * u());
            let (sin, cos) = Real::sin_cos(phi);
            let r = (1.0 - z * z).sqrt();
            let wi = DVec3::new(r * cos, r * sin, z);
            if inside(wi) { 2.0 * f64::PI * z * layers.eval(WO, wi, &mut u) } else { 0.0 }
        });
        assert!((sampled - valued).abs() < 5.0 * (e1 + e2), "{sampled} ± {e1}, {valued} ± {e2}");
    }

    #[test]
    fn outside_its_domain_nothing_is_scattered() {
        let layers = StochasticLayers::new(glass(), paint(1.0), OpticalDepth::clear());
        let mut u = || 0.5;
        for w in [DVec3::NAN, -WO, DVec3::ZERO] {
            assert_eq!(layers.eval(w, WI, &mut u), 0.0);
            assert_eq!(layers.eval(WI, w, &mut u), 0.0);
            assert!(layers.sample(w, &mut u).is_none());
        }
    }
}
