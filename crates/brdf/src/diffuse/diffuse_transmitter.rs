//! A thin sheet that scatters to both sides: a leaf, a sheet of paper, a lamp shade.

use etendue_math::{Real, Spectrum, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use crate::bsdf::above;
use crate::param::{at_most_all_together, scaled_to_all_together};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Density, Lobes, ParameterError, Reflectance, Sample};

/// Ideal diffuse reflection and transmission by a sheet without thickness, the same from both sides.
///
/// ```text
/// f = ρr/π   (wo, wi on one side),   ρt/π   (on different sides)
/// ```
///
/// * Laws: reciprocal (the media on both sides are the same, η = 1); directional albedo, both sides together,
///   exactly ρr + ρt ≤ 1, which the constructor checks.
/// * Sampling: `u_lobe` chooses transmission with probability `mean(ρt) / (mean(ρr) + mean(ρt))`, then cosine-weighted
///   on that side; `None` where both are black or `wo` lies in the surface.
///
/// # Precision
/// 1 ulp.
///
/// # Source
/// Two Lambertian lobes, as the translucent materials of production renderers have them.
///
/// # Examples
/// ```
/// use etendue_brdf::{Bsdf, DiffuseTransmitter, Reflectance};
/// use etendue_math::glam::DVec3;
/// let leaf = DiffuseTransmitter::new(Reflectance::new(0.1_f64)?, Reflectance::new(0.3)?)?;
/// let [front, behind] = [DVec3::Z, DVec3::NEG_Z].map(|wi| leaf.eval(DVec3::Z, wi));
/// assert!((behind / front - 3.0).abs() < 1e-15);
/// assert!(DiffuseTransmitter::new(Reflectance::new(0.6_f64)?, Reflectance::new(0.5)?).is_err());
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiffuseTransmitter<C: Spectrum> {
    /// ρr and ρt
    colour: [C; 2],
    /// Probabilities of choosing reflection and transmission: both, since one from the other would cancel.
    probability: [C::Real; 2],
}

impl<C: Spectrum> DiffuseTransmitter<C> {
    /// The sheet with these shares of reflected and transmitted light.
    ///
    /// # Errors
    /// [`ParameterError`] where ρr + ρt > 1 in a channel.
    pub fn new(
        reflectance: Reflectance<C>,
        transmittance: Reflectance<C>,
    ) -> Result<Self, ParameterError> {
        at_most_all_together("reflectance + transmittance", reflectance, transmittance)?;
        Ok(Self::of_shares([reflectance, transmittance]))
    }

    /// The same with ρr and ρt made smaller by one factor where they exceed 1 together in a channel: for values read from
    /// textures.
    #[inline]
    pub fn clamped(reflectance: Reflectance<C>, transmittance: Reflectance<C>) -> Self {
        Self::of_shares(scaled_to_all_together(reflectance, transmittance))
    }

    #[inline]
    fn of_shares(shares: [Reflectance<C>; 2]) -> Self {
        let colour = shares.map(Reflectance::value);
        let [r, t] = colour.map(Spectrum::mean);
        let share = |x| if r + t > C::Real::ZERO { x / (r + t) } else { C::Real::ZERO };
        Self { colour, probability: [share(r), share(t)] }
    }
}

/// The direction seen from the side it is on.
#[inline(always)]
fn upright<V: Vector3>(w: V) -> V {
    if w.z() < V::Scalar::ZERO { w.flip_z() } else { w }
}

impl<C: Spectrum> Bsdf for DiffuseTransmitter<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes { continuous: true, delta: false, transmission: true }
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        if !above(upright(wo)) || !above(upright(wi)) {
            return (C::black(), C::Real::ZERO);
        }
        let across = (wo.z() < C::Real::ZERO) != (wi.z() < C::Real::ZERO);
        let side = usize::from(across);
        let (colour, probability) = (self.colour[side], self.probability[side]);
        let pdf = probability * cosine_hemisphere::pdf::<C::Real>(upright(wi));
        (colour.scale(C::Real::FRAC_1_PI), pdf)
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        let wi = cosine_hemisphere::from_square(u);
        if !above(upright(wo)) || !above(wi) {
            return None;
        }
        let one = <C::Real as Real>::ONE;
        let across = u_lobe < self.probability[1];
        let side = usize::from(across);
        let (colour, probability) = (self.colour[side], self.probability[side]);
        if colour.is_black() {
            return None;
        }
        let pdf = probability * cosine_hemisphere::pdf::<C::Real>(wi);
        if !(pdf > C::Real::ZERO) {
            return None; // a share of next to nothing
        }
        let below = across != (wo.z() < C::Real::ZERO);
        Some(Sample {
            wi: if below { wi.flip_z() } else { wi },
            // At most the number of channels, where the reciprocal of the share alone might overflow.
            weight: colour.map(|c| c / probability),
            density: Density::Continuous(pdf),
            eta: one,
        })
    }

    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        let seen = above(upright(wo));
        Some(if seen { self.colour[0] + self.colour[1] } else { C::black() })
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "diffuse-transmitter",
    type_name: "DiffuseTransmitter",
    parameters: &[
        parameter::REFLECTANCE,
        parameter::named("transmittance", "each channel in [0, 1], with the reflectance at most 1"),
    ],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes { continuous: true, delta: false, transmission: true },
    albedo: Albedo::ClosedForm,
    density: "cosine on the side chosen by mean colours",
    source: "two Lambertian lobes",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use etendue_math::Rgb;
    use etendue_math::glam::{DVec3, Vec3};

    fn sheet(r: f64, t: f64) -> DiffuseTransmitter<f64> {
        let [r, t] = [r, t].map(|x| Reflectance::new(x).unwrap());
        DiffuseTransmitter::new(r, t).unwrap()
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        for (r, t) in [(0.5, 0.2), (0.0, 1.0), (1.0, 0.0)] {
            laws::reciprocal(&sheet(r, t), 1e-15);
            laws::sampling_matches_density(&sheet(r, t), 1e-14);
            laws::total(&sheet(r, t));
        }
        let [r, t] = [0.25_f32, 0.75].map(|x| Reflectance::new(x).unwrap());
        laws::total(&DiffuseTransmitter::new(r, t).unwrap());
    }

    #[test]
    fn it_is_the_same_from_below() {
        let leaf = sheet(0.1, 0.3);
        let (wo, wi) = (DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.0, -0.8, 0.6));
        assert_eq!(leaf.eval_pdf(wo, wi), leaf.eval_pdf(wo.flip_z(), wi.flip_z()));
        assert_eq!(leaf.eval_pdf(wo, wi.flip_z()), leaf.eval_pdf(wo.flip_z(), wi));
        assert_eq!(leaf.albedo(wo), leaf.albedo(wo.flip_z()));
    }

    #[test]
    fn shares_that_exceed_the_light_in_one_channel_are_refused() {
        let red = Reflectance::new(Rgb::new(0.9_f32, 0.1, 0.1)).unwrap();
        let pink = Reflectance::new(Rgb::new(0.2_f32, 0.1, 0.1)).unwrap();
        let error = DiffuseTransmitter::new(red, pink).unwrap_err();
        assert_eq!(error.parameter, "reflectance + transmittance");
    }

    #[test]
    fn shares_that_exceed_the_light_can_be_scaled() {
        let [r, t] = [0.9_f64, 0.6].map(|x| Reflectance::new(x).unwrap());
        let sheet = DiffuseTransmitter::clamped(r, t);
        // One rounding of each share.
        assert!((sheet.albedo(DVec3::Z).unwrap() - 1.0).abs() < 1e-15);
        assert!((sheet.colour[0] / sheet.colour[1] - 1.5).abs() < 1e-15);
    }

    #[test]
    fn a_share_of_next_to_nothing_has_a_finite_weight() {
        let [r, t] = [0.5, 1e-43_f32].map(|x| Reflectance::new(x).unwrap());
        let sheet = DiffuseTransmitter::new(r, t).unwrap();
        let sample = sheet.sample(Vec3::Z, 1e-45, [0.3, 0.3]).unwrap();
        // r + t, within the few bits that the share has.
        assert!(sample.wi.z < 0.0 && (sample.weight - 0.5).abs() < 0.05, "{sample:?}");
    }

    #[test]
    fn a_black_sheet_has_no_samples() {
        assert!(sheet(0.0, 0.0).sample(DVec3::Z, 0.5, [0.3, 0.3]).is_none());
    }

    #[test]
    fn the_albedo_is_its_closed_form() {
        // A polynomial in μ of low degree: rounding of 16 384 terms.
        laws::albedo_is_closed_form(&sheet(0.2, 0.5), 1e-12);
    }
}
