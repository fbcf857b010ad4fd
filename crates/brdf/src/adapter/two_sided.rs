//! One-sided models used on both sides of a surface.

use etendue_math::{Real, Spectrum, Vector3};

use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Lobes, Sample};

/// A reflection model for each side of an opaque surface.
///
/// ```text
/// f(wo, wi) = front(wo, wi)                  wo.z ≥ 0
///           = back(flip wo, flip wi)         wo.z < 0,   flip w = (x, y, −z)
/// ```
///
/// Nothing passes: values for directions on different sides are 0, and transmitted samples of a
/// model that has them are dropped. Laws and sampling are those of the two models.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoSided<F, B> {
    front: F,
    back: B,
}

impl<F: Bsdf, B: Bsdf<Color = F::Color>> TwoSided<F, B> {
    /// `front` above the surface, `back` below it.
    #[inline]
    pub fn new(front: F, back: B) -> Self {
        Self { front, back }
    }
}

impl<M: Bsdf + Copy> TwoSided<M, M> {
    /// The same model on both sides.
    #[inline]
    pub fn same(model: M) -> Self {
        Self { front: model, back: model }
    }
}

/// Both on one side of the surface; false for NaN.
#[inline(always)]
fn same_side<V: Vector3>(wo: V, wi: V) -> bool {
    let zero = V::Scalar::ZERO;
    // Signs, not the product: that one underflows.
    (wo.z() > zero && wi.z() > zero) || (wo.z() < zero && wi.z() < zero)
}

impl<F: Bsdf, B: Bsdf<Color = F::Color>> Bsdf for TwoSided<F, B> {
    type Color = F::Color;

    #[inline]
    fn lobes(&self) -> Lobes {
        let (front, back) = (self.front.lobes(), self.back.lobes());
        Lobes {
            continuous: front.continuous || back.continuous,
            delta: front.delta || back.delta,
            transmission: false,
        }
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (F::Color, BsdfReal<Self>) {
        if !same_side(wo, wi) {
            (F::Color::black(), BsdfReal::<Self>::ZERO)
        } else if wo.z() < BsdfReal::<Self>::ZERO {
            self.back.eval_pdf(wo.flip_z(), wi.flip_z())
        } else {
            self.front.eval_pdf(wo, wi)
        }
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<F::Color>> {
        let sample = if wo.z() < BsdfReal::<Self>::ZERO {
            let sample = self.back.sample(wo.flip_z(), u_lobe, u)?;
            Sample { wi: sample.wi.flip_z(), ..sample }
        } else {
            self.front.sample(wo, u_lobe, u)?
        };
        same_side(wo, sample.wi).then_some(sample)
    }

    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<F::Color> {
        if self.front.lobes().transmission || self.back.lobes().transmission {
            None // the inner albedo counts what is dropped here
        } else if wo.z() < BsdfReal::<Self>::ZERO {
            self.back.albedo(wo.flip_z())
        } else {
            self.front.albedo(wo)
        }
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "two-sided",
    type_name: "TwoSided",
    parameters: &[parameter::named("front", "any model"), parameter::named("back", "any model")],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes { continuous: true, delta: true, transmission: false },
    albedo: Albedo::Inner,
    density: "that of the side",
    source: "Mitsuba, twosided",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Lambert, Null, Reflectance, laws};
    use etendue_math::glam::DVec3;

    #[test]
    fn each_side_has_its_own_model() {
        let paper = |rho: f64| Lambert::new(Reflectance::new(rho).unwrap());
        let model = TwoSided::new(paper(0.5), paper(0.25));
        let (up, down) = (DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.6, 0.0, -0.8));
        assert_eq!(model.eval(up, up), 0.5 * f64::FRAC_1_PI);
        assert_eq!(model.eval(down, down), 0.25 * f64::FRAC_1_PI);
        assert_eq!(model.eval(up, down), 0.0);
        assert!(model.sample(down, 0.5, [0.5; 2]).unwrap().wi.z < 0.0);
        laws::reciprocal(&model, 1e-15);
        laws::sampling_matches_density(&model, 1e-14);
        laws::total(&model);
    }

    #[test]
    fn nothing_passes() {
        assert!(TwoSided::same(Null::<f64>::new()).sample(DVec3::Z, 0.5, [0.5; 2]).is_none());
    }
}
