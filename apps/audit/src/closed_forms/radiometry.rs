//! Quantities of lights.

use etendue_brdf::radiometry as r;
use etendue_math::{Real, Vec3, Vector3};

use super::{ClosedForm, ulps};
use crate::budget::Budget;
use crate::measure::{Outcome, Worst};
use crate::scalar::{Scalar, narrow, shared};

/// Every conversion against its definition.
pub(super) const CASE: ClosedForm = ClosedForm {
    function: "radiometry",
    name: "by definition",
    single: check::<f32>,
    double: check::<f64>,
};

const PI: f64 = core::f64::consts::PI;

/// Bound: 16 ulp; a handful of roundings, and for the spot light those of a smooth step between angles.
fn check<T: Scalar>(_: Budget) -> Outcome {
    let mut worst = Worst::default();
    let [x, cos, other, d] = [2.7, 0.6, 0.3, 1.7].map(shared::<T>);
    let [x_, cos_, other_, d_] = [x, cos, other, d].map(Real::to_f64);
    let quantities = [
        ("irradiance of a point", r::irradiance_of_point(x, cos, d), x_ * cos_ / (d_ * d_)),
        ("irradiance of a light's colour", r::irradiance_of_light_color(x), PI * x_),
        ("light's colour of an irradiance", r::light_color_of_irradiance(x), x_ / PI),
        ("solid angle per area", r::solid_angle_per_area(-cos, d), cos_ / (d_ * d_)),
        ("density per area", r::area_pdf(x, -cos, d), x_ * cos_ / (d_ * d_)),
        ("density per solid angle", r::solid_angle_pdf(x, -cos, d), x_ * d_ * d_ / cos_),
        ("geometry term", r::geometry_term(cos, other, d), cos_ * other_ / (d_ * d_)),
        ("flux of a point", r::flux_of_point(x), 4.0 * PI * x_),
        ("intensity of a point", r::intensity_of_point(x), x_ / (4.0 * PI)),
        ("exitance", r::exitance_of_radiance(x), PI * x_),
        ("radiance of an exitance", r::radiance_of_exitance(x), x_ / PI),
        ("flux of an area", r::flux_of_area(x, d), PI * x_ * d_),
        ("radiance of an area", r::radiance_of_area(x, d), x_ / (PI * d_)),
        ("intensity of an area", r::intensity_of_area(x, d, cos), x_ * d_ * cos_),
    ];
    for (what, got, want) in quantities {
        worst.observe(ulps(got, want), || format!("{what}: {got:?}, not {want:e}"));
    }
    for [beam, cutoff] in [[0.3, 0.9], [0.0, 1.4], [1.0, 3.0]].map(|spot| spot.map(shared::<T>)) {
        let Some(cone) = r::SpotCone::new(beam, cutoff) else { return worst.within(0.0, "") };
        let [inner, outer] = [beam, cutoff].map(|angle| 1.0 - Real::cos(angle.to_f64()));
        // The cubic's mean is a half.
        let solid_angle = PI * (inner + outer);
        let (flux, intensity) = (cone.flux(x), cone.intensity(x));
        for (what, got, want) in
            [("flux", flux, x_ * solid_angle), ("intensity", intensity, x_ / solid_angle)]
        {
            worst.observe(ulps(got, want), || format!("{what} of a spot: {got:?}, not {want:e}"));
        }
        for share in [0.25, 0.5, 0.8] {
            let angle = beam.to_f64() + share * (cutoff.to_f64() - beam.to_f64());
            let off = narrow::<T>([Real::sin(angle), 0.0, Real::cos(angle)]);
            let got = cone.falloff(r::one_minus_cos(Vec3::<T>::new(T::ZERO, T::ZERO, T::ONE), off));
            let t = (outer - (1.0 - Real::cos(angle))) / (outer - inner);
            // Of 1: t is a difference.
            let error = (got.to_f64() - t * t * (3.0 - 2.0 * t)).abs() / T::EPSILON.to_f64();
            worst.observe(error, || format!("falloff at {angle}: {got:?}"));
        }
    }
    worst.within(16.0, "ulp")
}
