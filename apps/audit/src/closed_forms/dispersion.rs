//! Colours part at the angles that their indices say.

use etendue_brdf::fresnel::{Dispersion, GLASSES};
use etendue_brdf::{Bsdf, Ior, SmoothDielectric};
use etendue_math::{Real, Vector3};

use super::ClosedForm;
use crate::budget::Budget;
use crate::generators::from_angles;
use crate::measure::{Outcome, Worst};
use crate::scalar::{Scalar, shared};

/// The refracted direction of every medium of the catalogue, from outside and from inside.
pub(super) const ANGLES: ClosedForm = ClosedForm {
    function: "Dispersion",
    name: "angles of Snell's law",
    single: angles::<f32>,
    double: angles::<f64>,
};

/// Bound: a millionth of a radian, or 64 ε where that is less. The sine of the refracted angle stays below 0.95: the angle itself
/// is three times as uncertain as its sine there, and without bound at the critical one.
fn angles<T: Scalar>(_: Budget) -> Outcome {
    let mut worst = Worst::default();
    for glass in GLASSES {
        for nm in (380..=780_u16).step_by(20) {
            let wavelength = shared::<T>(f64::from(nm));
            let literal = published(glass.dispersion, f64::from(nm));
            let Ok(eta) = Ior::new(glass.dispersion.index(wavelength)) else {
                return worst.within(0.0, "");
            };
            let surface = SmoothDielectric::<T>::new(eta);
            for step in 1..20_u8 {
                let sin = 0.05 * f64::from(step);
                for (side, ratio) in [(1.0, 1.0 / literal), (-1.0, literal)] {
                    let refracted = sin * ratio;
                    if refracted > 0.95 {
                        continue;
                    }
                    let wo = from_angles::<T>(side * (1.0 - sin * sin).sqrt(), 0.7);
                    // The sine that the direction has after its own rounding.
                    let [x, y, z] = [wo.x(), wo.y(), wo.z()].map(Real::to_f64);
                    let sin = (x * x + y * y).sqrt() / (x * x + y * y + z * z).sqrt();
                    let want = Real::asin(sin * ratio);
                    let sample = surface.sample(wo, T::ONE_MINUS_EPSILON, [T::HALF; 2]);
                    let got = sample.map_or(f64::NAN, |sample| {
                        let [x, y, z] =
                            [sample.wi.x(), sample.wi.y(), sample.wi.z()].map(Real::to_f64);
                        Real::atan2((x * x + y * y).sqrt(), z.abs())
                    });
                    worst.observe((got - want).abs(), || {
                        format!("{} at {nm} nm, sine {sin}: {got}, not {want}", glass.name)
                    });
                }
            }
        }
    }
    worst.within(1e-6_f64.min(64.0 * T::EPSILON.to_f64()), "rad")
}

/// The published formula, read literally.
fn published(dispersion: Dispersion, nm: f64) -> f64 {
    let squared = (nm / 1000.0) * (nm / 1000.0);
    match dispersion {
        Dispersion::Constant(index) => index,
        Dispersion::Cauchy([a, b, c]) => a + b / squared + c / (squared * squared),
        Dispersion::Sellmeier(resonances) => {
            let sum: f64 = resonances.iter().map(|[b, c]| b * squared / (squared - c)).sum();
            (1.0 + sum).sqrt()
        }
    }
}
