//! Opacity: a surface that is partly not there.

use etendue_math::{Real, Spectrum};

use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::smooth::null::exists;
use crate::{Bsdf, BsdfReal, BsdfVec, Density, Lobes, Opacity, Sample};

/// A model blended with straight pass-through.
///
/// ```text
/// f = a f_inner + (1 − a) δ(wi + wo),  a = opacity
/// ```
///
/// * Laws: those of the inner model; albedo `a R + (1 − a)`.
/// * Sampling: the inner model with probability a, with `u_lobe` stretched for its own use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mask<B: Bsdf> {
    inner: B,
    opacity: BsdfReal<B>,
}

impl<B: Bsdf> Mask<B> {
    /// `inner` seen with the given opacity.
    #[inline]
    pub fn new(inner: B, opacity: Opacity<BsdfReal<B>>) -> Self {
        Self { inner, opacity: opacity.value() }
    }
}

impl<B: Bsdf> Bsdf for Mask<B> {
    type Color = B::Color;

    #[inline]
    fn lobes(&self) -> Lobes {
        let inner = self.inner.lobes();
        if self.opacity < BsdfReal::<B>::ONE {
            Lobes { delta: true, transmission: true, ..inner }
        } else {
            inner
        }
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (B::Color, BsdfReal<Self>) {
        let (f, pdf) = self.inner.eval_pdf(wo, wi);
        (f.scale(self.opacity), pdf * self.opacity)
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<B::Color>> {
        let one = BsdfReal::<B>::ONE;
        let u_lobe = u_lobe.clamp_to(BsdfReal::<B>::ZERO, BsdfReal::<B>::ONE_MINUS_EPSILON);
        if u_lobe < self.opacity {
            let stretched = (u_lobe / self.opacity).min(BsdfReal::<B>::ONE_MINUS_EPSILON);
            let sample = self.inner.sample(wo, stretched, u)?;
            let (density, p) = match sample.density {
                Density::Continuous(pdf) => (Density::Continuous(pdf * self.opacity), pdf),
                Density::Delta(p) => (Density::Delta(p * self.opacity), p),
            };
            // The product underflows for an opacity of next to nothing.
            return (p * self.opacity > BsdfReal::<B>::ZERO)
                .then_some(Sample { density, ..sample });
        }
        exists(wo).then(|| Sample {
            wi: -wo,
            weight: B::Color::white(),
            density: Density::Delta(one - self.opacity),
            eta: one,
        })
    }

    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<B::Color> {
        let through =
            if exists(wo) { BsdfReal::<B>::ONE - self.opacity } else { BsdfReal::<B>::ZERO };
        Some(self.inner.albedo(wo)?.scale(self.opacity) + B::Color::splat(through))
    }

    #[inline]
    fn pass_through(&self, wo: BsdfVec<Self>) -> B::Color {
        let through =
            if exists(wo) { BsdfReal::<B>::ONE - self.opacity } else { BsdfReal::<B>::ZERO };
        self.inner.pass_through(wo).scale(self.opacity) + B::Color::splat(through)
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "mask",
    type_name: "Mask",
    parameters: &[parameter::named("opacity", "in [0, 1]"), parameter::named("inner", "any model")],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes { continuous: true, delta: true, transmission: true },
    albedo: Albedo::Inner,
    density: "the inner one with probability opacity",
    source: "Mitsuba, mask",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Blend, Ior, Lambert, Null, Reflectance, SmoothDielectric, ThinDielectric, laws};
    use etendue_math::glam::DVec3;

    fn leaf(opacity: f64) -> Mask<Lambert<f64>> {
        Mask::new(Lambert::new(Reflectance::white()), Opacity::new(opacity).unwrap())
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        laws::reciprocal(&leaf(0.3), 1e-15);
        laws::sampling_matches_density(&leaf(0.3), 1e-14);
        laws::total(&leaf(0.3));
        laws::total(&leaf(0.0));
        laws::total(&leaf(1.0));
    }

    #[test]
    fn shadow_rays_carry_what_sampling_lets_pass() {
        let pane = ThinDielectric::<f64>::new(Ior::new(1.5).unwrap());
        let matched = SmoothDielectric::<f64>::new(Ior::new(1.0).unwrap());
        let glass = SmoothDielectric::<f64>::new(Ior::new(1.5).unwrap());
        let half = Opacity::new(0.5).unwrap();
        for wo in [DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.0, 0.6, -0.8), DVec3::Z] {
            passes(&leaf(0.3), wo);
            passes(&pane, wo);
            passes(&matched, wo);
            passes(&glass, wo);
            passes(&Null::<f64>::new(), wo);
            passes(&Mask::new(pane, half), wo);
            passes(&Mask::new(matched, half), wo);
            passes(&Blend::new(pane, glass, half), wo);
        }
    }

    /// Compares with the mean over choices of a lobe of what goes straight on.
    fn passes<B: Bsdf<Color = f64>>(model: &B, wo: DVec3) {
        const N: u32 = 1000;
        let straight = |i| {
            let sample = model.sample(wo, (f64::from(i) + 0.5) / f64::from(N), [0.5; 2])?;
            let is_delta = matches!(sample.density, Density::Delta(_));
            (is_delta && sample.wi == -wo && sample.eta == 1.0).then_some(sample.weight)
        };
        let mean = (0..N).filter_map(straight).sum::<f64>() / f64::from(N);
        // Each of at most three ends of a lobe falls within one of N intervals.
        let found = model.pass_through(wo);
        assert!((found - mean).abs() < 3.0 / f64::from(N), "{found} {mean}");
    }

    #[test]
    fn what_is_not_met_goes_straight_on() {
        let wo = DVec3::new(0.6, 0.0, 0.8);
        let s = leaf(0.3).sample(wo, 0.31, [0.5; 2]).unwrap();
        assert_eq!((s.wi, s.weight, s.density), (-wo, 1.0, Density::Delta(0.7)));
        assert_eq!(leaf(0.3).albedo(wo), Some(1.0));
        assert!(!leaf(1.0).lobes().delta && leaf(0.999).lobes().delta);
    }
}
