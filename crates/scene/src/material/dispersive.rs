//! Interfaces whose index depends on the wavelength.

use etendue_brdf::fresnel::Dispersion;
use etendue_brdf::{
    Bsdf, Density, Ior, Lobes, Microfacets, ParameterError, Reflectance, RoughDielectric, Sample,
    SmoothDielectric,
};
use etendue_math::glam::Vec3;
use etendue_math::{Real, Spectrum};

/// An index of refraction by wavelength, relative to surroundings without dispersion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelativeDispersion {
    /// Of the medium behind the surface.
    pub interior: Dispersion,
    /// Of the one in front.
    pub exterior: f64,
}

impl RelativeDispersion {
    /// The relative index at a wavelength in nm.
    pub fn index(&self, wavelength: f32) -> f32 {
        (self.interior.index(f64::from(wavelength)) / self.exterior) as f32
    }

    /// The index of the yellow line of helium, for which catalogues state indices, if every wavelength that is seen has a usable
    /// one.
    ///
    /// # Errors
    /// A wavelength in nm whose index lies outside the domain of [`Ior`], and how.
    pub fn checked(&self) -> Result<Ior<f32>, (f32, ParameterError)> {
        let index = |nm: f32| Ior::new(self.index(nm)).map_err(|error| (nm, error));
        SEEN.step_by(5).try_for_each(|nm| index(f32::from(nm)).map(drop))?;
        index(D_LINE)
    }
}

/// The yellow line of helium, in nm.
const D_LINE: f32 = 587.5618;

/// The wavelengths that are seen, in nm.
const SEEN: core::ops::RangeInclusive<u16> = 360..=830;

/// A smooth or rough dielectric interface with an index per channel.
///
/// Every channel is a [`SmoothDielectric`] or [`RoughDielectric`] of its own. A direction is drawn by one of them, the leading
/// channel; what it is worth to the others, and how likely each would have drawn it, is known: so a path can be weighted as if
/// it had been drawn from the mixture of all. A refracted ray of a smooth interface belongs to the leading channel alone, a
/// mirrored one to all.
///
/// Where nobody knows of channels (in blends and behind masks), [`Bsdf::sample`] lets every channel lead as often as any other.
///
/// # Source
/// A. Wilkie et al., "Hero Wavelength Spectral Sampling", CGF 33(4), 2014.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dispersive<S: Spectrum<Real = f32>> {
    indices: S,
    facets: Option<Microfacets<f32>>,
    specular_reflectance: S,
    specular_transmittance: S,
}

/// A direction drawn by one channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dispersed<S: Spectrum<Real = f32>> {
    /// As if only the leading channel could have drawn it: what every channel scatters, over the density of the leading one.
    pub sample: Sample<S>,
    /// The density of each channel over that of the leading one.
    pub densities: S,
}

/// The interface for one channel.
enum Interface {
    Smooth(SmoothDielectric<f32>),
    Rough(RoughDielectric<f32>),
}

impl<S: Spectrum<Real = f32>> Dispersive<S> {
    /// An interface with an index per channel, smooth without `facets`.
    ///
    /// A channel whose index is outside the domain of [`Ior`] is black.
    pub fn new(indices: S, facets: Option<Microfacets<f32>>) -> Self {
        let white = S::white();
        Self { indices, facets, specular_reflectance: white, specular_transmittance: white }
    }

    /// The same with reflection scaled by `ks` and transmission by `kt`, factors without physical meaning.
    #[must_use]
    pub fn with_factors(self, ks: Reflectance<S>, kt: Reflectance<S>) -> Self {
        Self { specular_reflectance: ks.value(), specular_transmittance: kt.value(), ..self }
    }

    fn interface(&self, index: f32) -> Option<Interface> {
        let eta = Ior::new(index).ok()?;
        // Equal indices have no rough interface: no facet refracts.
        let rough = self.facets.and_then(|facets| RoughDielectric::new(eta, facets).ok());
        Some(match rough {
            Some(rough) => Interface::Rough(rough),
            None => Interface::Smooth(SmoothDielectric::new(eta)),
        })
    }

    /// The artists' factor of light between two directions.
    fn factor(&self, wo: Vec3, wi: Vec3) -> S {
        if same_side(wo, wi) { self.specular_reflectance } else { self.specular_transmittance }
    }

    /// Value in sr⁻¹ and density per steradian of every channel, of what is not smooth.
    pub fn eval_pdfs(&self, wo: Vec3, wi: Vec3) -> (S, S) {
        if self.facets.is_none() {
            return (S::black(), S::black());
        }
        let (values, densities) = self.indices.map_to_pair(|index| match self.interface(index) {
            Some(Interface::Rough(rough)) => rough.eval_pdf(wo, wi),
            _ => (0.0, 0.0),
        });
        (values * self.factor(wo, wi), densities)
    }

    /// A direction drawn by the channel `leading`; `None` as [`Bsdf::sample`].
    pub fn sample_by(
        &self,
        leading: usize,
        wo: Vec3,
        u_lobe: f32,
        u: [f32; 2],
    ) -> Option<Dispersed<S>> {
        let index = self.indices.channel(leading);
        let drawn = match self.interface(index)? {
            Interface::Smooth(smooth) => smooth.sample(wo, u_lobe, u)?,
            Interface::Rough(rough) => rough.sample(wo, u_lobe, u)?,
        };
        let Sample { wi, weight, density, eta } = drawn;
        let factor = self.factor(wo, wi);
        let (weight, densities) = match density {
            Density::Delta(probability) => {
                let densities = self.delta_densities(index, wo, wi, probability);
                (factor * densities.scale(weight), densities)
            }
            Density::Continuous(density) => {
                let (values, densities) = self.eval_pdfs(wo, wi);
                (values.scale(Real::abs(wi.z) / density), densities.scale(1.0 / density))
            }
        };
        let usable = !weight.is_black() && weight.is_finite() && densities.is_finite();
        usable.then_some(Dispersed { sample: Sample { wi, weight, density, eta }, densities })
    }

    /// The probability of a direction of the smooth interface in every channel, over that in the one of index `leading`.
    fn delta_densities(&self, leading: f32, wo: Vec3, wi: Vec3, probability: f32) -> S {
        self.indices.map(|index| {
            if index == leading {
                return 1.0;
            }
            if !same_side(wo, wi) {
                return 0.0;
            }
            let Some(Interface::Smooth(smooth)) = self.interface(index) else { return 0.0 };
            // The least number chooses reflection wherever there is any.
            match smooth.sample(wo, 0.0, [0.0; 2]) {
                Some(Sample { wi: mirrored, density: Density::Delta(other), .. })
                    if same_side(wo, mirrored) =>
                {
                    other / probability
                }
                _ => 0.0,
            }
        })
    }
}

fn same_side(wo: Vec3, wi: Vec3) -> bool {
    wo.z * wi.z > 0.0
}

impl<S: Spectrum<Real = f32>> Bsdf for Dispersive<S> {
    type Color = S;

    fn lobes(&self) -> Lobes {
        let is_rough = self.facets.is_some();
        Lobes { continuous: is_rough, delta: !is_rough, transmission: true }
    }

    fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (S, f32) {
        let (values, densities) = self.eval_pdfs(wo, wi);
        (values, densities.mean())
    }

    fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Option<Sample<S>> {
        let scaled = u_lobe * S::CHANNELS as f32;
        let leading = (scaled as usize).min(S::CHANNELS - 1);
        let Dispersed { sample, densities } =
            self.sample_by(leading, wo, scaled - leading as f32, u)?;
        let mean = densities.mean();
        let density = match sample.density {
            Density::Delta(probability) => Density::Delta(probability * mean),
            Density::Continuous(density) => Density::Continuous(density * mean),
        };
        Some(Sample { weight: sample.weight.scale(1.0 / mean), density, ..sample })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_brdf::{Alpha, Distribution, Masking};
    use etendue_math::{Sampled, hash_u32};

    type Four = Sampled<f32, 4>;

    const INDICES: Four = Sampled([1.5, 1.52, 1.54, 1.58]);
    const WO: Vec3 = Vec3::new(0.6, 0.0, 0.8);

    fn facets(alpha: f32) -> Microfacets<f32> {
        let alpha = Alpha::clamped(alpha);
        Microfacets::new(Distribution::Ggx, alpha, alpha, Masking::Separable)
    }

    #[test]
    fn smooth_glass_refracts_each_channel_by_its_own_index_and_mirrors_all() {
        let glass = Dispersive::new(INDICES, None);
        for leading in 0..4 {
            let single = SmoothDielectric::<f32>::new(
                Ior::new(INDICES.channel(leading)).expect("an index of glass"),
            );
            let through = glass.sample_by(leading, WO, 0.9, [0.5; 2]).expect("it refracts");
            let alone = single.sample(WO, 0.9, [0.5; 2]).expect("it refracts");
            assert_eq!(through.sample.wi, alone.wi);
            // Snell's law, to the rounding of a root.
            let sine = f64::from((through.sample.wi.x.sqr() + through.sample.wi.y.sqr()).sqrt());
            assert!((sine - 0.6 / f64::from(INDICES.channel(leading))).abs() < 1e-7);
            for channel in 0..4 {
                let own = channel == leading;
                assert_eq!(through.densities.channel(channel), if own { 1.0 } else { 0.0 });
                let weight = through.sample.weight.channel(channel);
                assert_eq!(weight, if own { alone.weight } else { 0.0 });
            }
            let mirrored = glass.sample_by(leading, WO, 0.0, [0.5; 2]).expect("it reflects");
            assert_eq!(mirrored.sample.wi, Vec3::new(-0.6, -0.0, 0.8));
            assert_eq!(mirrored.sample.weight, mirrored.densities);
            assert!(mirrored.densities.channel(3) >= mirrored.densities.channel(0));
        }
    }

    #[test]
    fn with_one_index_for_all_it_is_the_interface_itself() {
        let equal = Sampled([1.5; 4]);
        let eta = Ior::new(1.5).expect("an index of glass");
        let (smooth, rough) =
            (Dispersive::new(equal, None), Dispersive::new(equal, Some(facets(0.3))));
        let single = RoughDielectric::<f32>::new(eta, facets(0.3)).expect("not matched");
        for (u_lobe, u) in [(0.01, [0.2, 0.7]), (0.6, [0.5, 0.1]), (0.99, [0.9, 0.4])] {
            let [a, b] = [0, 3].map(|leading| smooth.sample_by(leading, WO, u_lobe, u));
            assert_eq!(a, b);
            assert_eq!(a.map(|s| s.densities), Some(Four::white()));
            let (all, one) = (rough.sample_by(2, WO, u_lobe, u), single.sample(WO, u_lobe, u));
            let (all, one) = (all.expect("it scatters"), one.expect("it scatters"));
            assert_eq!(all.sample.wi, one.wi);
            for channel in 0..4 {
                // The weight by itself, and as value over density of a lobe a tenth of a steradian wide.
                assert!((all.sample.weight.channel(channel) / one.weight - 1.0).abs() < 1e-4);
                assert!((all.densities.channel(channel) - 1.0).abs() < 1e-4);
            }
        }
    }

    /// Mean over many samples of what each channel scatters into the halves of the sphere.
    fn scattered(sample: impl Fn(f32, [f32; 2]) -> Option<(Vec3, Four)>) -> [[f64; 4]; 2] {
        const COUNT: u32 = 1 << 16;
        let mut sum = [[0.0; 4]; 2];
        for i in 0..COUNT {
            let uniform = |k| (hash_u32(3 * i + k) >> 8) as f32 / (1 << 24) as f32;
            let Some((wi, weight)) = sample(uniform(0), [uniform(1), uniform(2)]) else { continue };
            for (channel, sum) in sum[usize::from(wi.z < 0.0)].iter_mut().enumerate() {
                *sum += f64::from(weight.channel(channel)) / f64::from(COUNT);
            }
        }
        sum
    }

    #[test]
    fn every_channel_scatters_what_its_own_interface_does_whichever_leads() {
        let indices = Sampled([1.3, 1.4, 1.5, 1.7]);
        let glass = Dispersive::new(indices, Some(facets(0.4)));
        for wo in [WO, Vec3::new(0.3, 0.2, -0.932_737_9)] {
            let mixed =
                scattered(|u_lobe, u| glass.sample(wo, u_lobe, u).map(|s| (s.wi, s.weight)));
            for channel in 0..4 {
                let eta = Ior::new(indices.channel(channel)).expect("an index of glass");
                let single = RoughDielectric::<f32>::new(eta, facets(0.4)).expect("not matched");
                let alone = scattered(|u_lobe, u| {
                    single.sample(wo, u_lobe, u).map(|s| (s.wi, Four::splat(s.weight)))
                });
                for half in 0..2 {
                    // Weights of variance about 1, and 65 536 samples: four standard errors of the difference.
                    let (a, b) = (mixed[half][channel], alone[half][channel]);
                    assert!((a - b).abs() < 0.022, "{wo} {channel} {half}: {a} {b}");
                }
            }
        }
    }

    #[test]
    fn an_impossible_index_is_black() {
        let glass = Dispersive::new(Sampled([f32::NAN, 1.5, 1.5, 1.5]), None);
        assert_eq!(glass.sample_by(0, WO, 0.5, [0.5; 2]), None);
        let through = glass.sample_by(1, WO, 0.9, [0.5; 2]).expect("it refracts");
        assert_eq!(through.densities.channel(0), 0.0);
    }
}
