//! A mirror and a matte term in fixed shares.

use etendue_math::{Real, Spectrum};

use super::mirror_over_matte::{self, MirrorOverMatte};
use crate::param::at_most_all_together;
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Lobes, ParameterError, Reflectance, Sample};

/// A mirror and a Lambertian term in shares that do not depend on the angle.
///
/// ```text
/// f = rs δ(wi − mirror(wo)) + rd / π,   rd + rs ≤ 1
/// ```
///
/// * Parameters: reflectances `rd` and `rs` per channel in `[0, 1]`, their sum at most 1.
/// * Laws: reciprocal; directional albedo exactly `rd + rs`.
/// * Sampling: mirror or cosine, see [`MirrorOverMatte`]; `None` from below.
/// * What it lacks: real surfaces turn to mirrors at grazing incidence, at the expense of their matte
///   share; [`Coupled`](crate::Coupled) does both.
///
/// # Precision
/// 1 ulp.
///
/// # Source
/// The baseline of P. Shirley, B. Smits, H. Hu, E. Lafortune, "A Practitioners' Assessment of Light Reflection Models",
/// Pacific Graphics 1997.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayeredLinear<C> {
    matte: C,
    mirror: C,
}

impl<C: Spectrum> LayeredLinear<C> {
    /// The shares of the matte term and of the mirror.
    ///
    /// # Errors
    /// [`ParameterError`] where a channel of the sum exceeds 1.
    pub fn new(rd: Reflectance<C>, rs: Reflectance<C>) -> Result<Self, ParameterError> {
        let (matte, mirror) = (rd.value(), rs.value());
        at_most_all_together("rd + rs", rd, rs)?;
        Ok(Self { matte, mirror })
    }
}

impl<C: Spectrum> MirrorOverMatte for LayeredLinear<C> {
    #[inline(always)]
    fn mirror(&self, _cos_o: C::Real) -> C {
        self.mirror
    }
    #[inline(always)]
    fn matte(&self, _cos_o: C::Real, _cos_i: C::Real) -> C {
        self.matte.scale(C::Real::FRAC_1_PI)
    }
    #[inline(always)]
    fn matte_albedo(&self, _cos_o: C::Real) -> C {
        self.matte
    }
}

impl<C: Spectrum> Bsdf for LayeredLinear<C> {
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
    name: "layered-linear",
    type_name: "LayeredLinear",
    parameters: &[
        parameter::named("rd", "each channel in [0, 1]"),
        parameter::named("rs", "each channel in [0, 1], rd + rs at most 1"),
    ],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: mirror_over_matte::LOBES,
    albedo: Albedo::ClosedForm,
    density: "mirror or cosine, by mean shares",
    source: "Shirley et al. 1997, section 2",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use etendue_math::Rgb;
    use etendue_math::glam::DVec3;

    fn model(rd: f64, rs: f64) -> LayeredLinear<f64> {
        LayeredLinear::new(Reflectance::new(rd).unwrap(), Reflectance::new(rs).unwrap()).unwrap()
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        laws::reciprocal(&model(0.6, 0.3), 1e-15);
        laws::sampling_matches_density(&model(0.6, 0.3), 1e-14);
        for (rd, rs) in [(0.6, 0.3), (0.0, 1.0), (1.0, 0.0), (0.0, 0.0)] {
            laws::total(&model(rd, rs));
            assert_eq!(model(rd, rs).albedo(DVec3::Z), Some(rd + rs));
        }
        laws::albedo_is_closed_form(&model(0.6, 0.0), 1e-13);
    }

    #[test]
    fn shares_beyond_the_whole_are_refused() {
        let [rd, rs] = [Rgb::new(0.5_f32, 0.5, 0.5), Rgb::new(0.5_f32, 0.6, 0.5)];
        let error =
            LayeredLinear::new(Reflectance::clamped(rd), Reflectance::clamped(rs)).unwrap_err();
        assert_eq!(error.parameter, "rd + rs");
    }
}
