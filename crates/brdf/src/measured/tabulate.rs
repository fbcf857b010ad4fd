//! Tables of models.

use etendue_math::glam::DVec3;
use etendue_math::{Real, Spectrum, Vec3, Vector3};

use super::MerlError;
use super::half_difference::HalfDifference;
use super::table::{SCALE, SIZE, write};
use crate::{Bsdf, BsdfReal};

/// Writes what a measurement of `model` would give into `file`, of length
/// [`MerlTable::BYTES`](crate::MerlTable::BYTES): its values at the centres of the bins, −1 where a direction of
/// the pair is below the surface.
///
/// A model with one channel has the same in all three. Anisotropy cannot be represented: the half vector is
/// taken along the x axis.
///
/// # Errors
/// [`MerlError::Length`] where `file` has another length.
pub fn tabulate<B: Bsdf>(model: &B, file: &mut [u8]) -> Result<(), MerlError> {
    let lit = <BsdfReal<B> as Real>::lit;
    let narrow = |w: DVec3| Vec3::<BsdfReal<B>>::new(lit(w.x), lit(w.y), lit(w.z));
    write(file, |channel, [h, d, phi]| {
        let [h, d, phi] =
            [(h, SIZE[0]), (d, SIZE[1]), (phi, SIZE[2])].map(|(i, n)| (i as f64 + 0.5) / n as f64);
        let coordinates = HalfDifference {
            theta_h: h * h * f64::PI * 0.5,
            theta_d: d * f64::PI * 0.5,
            phi_d: phi * f64::PI,
        };
        let [wo, wi] = coordinates.pair();
        if wo.z > 0.0 && wi.z > 0.0 {
            model.eval(narrow(wo), narrow(wi)).channel(channel).to_f64() / SCALE[channel]
        } else {
            -1.0
        }
    })
}
