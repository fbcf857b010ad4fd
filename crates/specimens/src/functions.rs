//! The functions below the models.

use etendue_brdf::{fresnel, microfacet};
use etendue_math::{Real, Vec3, Vector3};
use etendue_sampling::warp;
use etendue_sampling::{Decision, Dimension, Independent, Sampler, Sobol};

use crate::bits::Results;
use crate::{Inputs, Scalar};

/// A function's name, and a call of it with given inputs whose results are handed over.
pub type Function<T> = (&'static str, fn(&Inputs<T>, &mut Results));

/// Every function, in the order of the crates.
#[expect(clippy::too_many_lines, reason = "a table, one row per function")]
pub fn functions<T: Scalar>() -> [Function<T>; 44] {
    // Arguments of elementary functions in [−8, 8) and [0, 16).
    [
        ("sqrt", |i, out| out.number(wide(i.u[0]).sqrt())),
        ("sin", |i, out| out.number(signed(i.u[0]).sin())),
        ("cos", |i, out| out.number(signed(i.u[0]).cos())),
        ("tan", |i, out| out.number(signed(i.u[0]).tan())),
        ("asin", |i, out| out.number(i.wo.z().asin())),
        ("acos", |i, out| out.number(i.wo.z().acos())),
        ("atan", |i, out| out.number(signed(i.u[0]).atan())),
        ("atan2", |i, out| out.number(i.wo.y().atan2(i.wo.x()))),
        ("exp", |i, out| out.number(signed(i.u[0]).exp())),
        ("exp_m1", |i, out| out.number((i.wo.z() * i.wi.z()).exp_m1())),
        ("ln", |i, out| out.number(wide(i.u[0]).ln())),
        ("ln_1p", |i, out| out.number((i.wo.z() * i.wi.z()).ln_1p())),
        ("powf", |i, out| out.number(wide(i.u[0]).powf(signed(i.u[1])))),
        ("erf", |i, out| out.number(signed(i.u[0]).erf())),
        ("erfc", |i, out| out.number(signed(i.u[0]).erfc())),
        ("difference_of_products", |i, out| {
            out.number(T::difference_of_products(i.wo.x(), i.wi.y(), i.wo.y(), i.wi.x()));
        }),
        ("turn", |i, out| {
            let (sin, cos) = warp::turn::sin_cos(i.u[0]);
            out.numbers([sin, cos, warp::turn::from_point(i.wo.x(), i.wo.y())]);
        }),
        ("disk", |i, out| {
            let point = warp::disk::from_square([i.u[0], i.u[1]]);
            out.numbers(point);
            out.numbers(warp::disk::to_square(point));
        }),
        ("uniform_sphere", |i, out| {
            warped::<T>(
                out,
                warp::uniform_sphere::from_square(pair(i)),
                warp::uniform_sphere::to_square,
            );
        }),
        ("uniform_hemisphere", |i, out| {
            let w = warp::uniform_hemisphere::from_square(pair(i));
            warped::<T>(out, w, warp::uniform_hemisphere::to_square);
        }),
        ("cosine_hemisphere", |i, out| {
            let w = warp::cosine_hemisphere::from_square(pair(i));
            warped::<T>(out, w, warp::cosine_hemisphere::to_square);
        }),
        ("cosine_hemisphere polar", |i, out| {
            let w = warp::cosine_hemisphere::from_square_polar(pair(i));
            warped::<T>(out, w, warp::cosine_hemisphere::to_square_polar);
        }),
        ("cone", |i, out| {
            let cone = warp::cone::Cone::from_one_minus_cos(i.u[2]);
            warped::<T>(out, cone.from_square(pair(i)), |w| cone.to_square(w));
        }),
        ("henyey_greenstein", |i, out| {
            let phase = warp::henyey_greenstein::HenyeyGreenstein::<T>::new(i.wo.z());
            if let Some(phase) = phase {
                warped::<T>(out, phase.from_square(pair(i)), |w| phase.to_square(w));
                out.number(phase.pdf(i.wi));
            }
        }),
        ("rayleigh", |i, out| {
            warped::<T>(out, warp::rayleigh::from_square(pair(i)), warp::rayleigh::to_square);
            out.number(warp::rayleigh::pdf(i.wi.z()));
        }),
        ("linear", |i, out| {
            if let Some(linear) = warp::linear::Linear::<T>::new(i.u[1], i.u[2]) {
                let x = linear.from_unit(i.u[0]);
                out.numbers([x, linear.to_unit(x), linear.pdf(x)]);
            }
        }),
        ("triangle", |i, out| {
            let barycentric = warp::triangle::from_square(pair(i));
            out.numbers(barycentric);
            out.numbers(warp::triangle::to_square(barycentric));
        }),
        ("spherical_triangle", |i, out| {
            let third = Vec3::<T>::new(i.u[0], i.u[1], i.u[2]);
            let triangle =
                warp::spherical_triangle::SphericalTriangle::<T>::new([i.wo, i.wi, third]);
            if let Some(triangle) = triangle {
                warped::<T>(out, triangle.from_square(pair(i)), |w| triangle.to_square(w));
            }
        }),
        ("seen_sphere", |i, out| {
            let sphere = warp::seen_sphere::SeenSphere::<T>::new(i.wo, i.u[2]);
            if let Some(point) = sphere.and_then(|s| s.from_square(pair(i))) {
                out.vector(point.direction);
                out.number(point.distance);
            }
        }),
        ("fresnel dielectric", |i, out| {
            let eta = wide(i.u[0]) + T::lit(0.01);
            out.numbers(fresnel::dielectric_polarized(i.wo.z().abs(), eta));
            out.number(fresnel::dielectric_transmittance(i.wo.z().abs(), eta));
        }),
        ("fresnel conductor", |i, out| {
            out.number(fresnel::conductor(i.wo.z().abs(), wide(i.u[0]), wide(i.u[1])));
        }),
        ("dispersion", |i, out| {
            let wavelength = T::lit(400.0) + T::lit(300.0) * i.u[0];
            for glass in fresnel::GLASSES {
                out.number(glass.dispersion.index(wavelength));
            }
        }),
        ("schlick", |i, out| out.number(fresnel::schlick(i.u[0], i.wo.z().abs()))),
        ("dielectric_average_fit", |i, out| {
            out.number(fresnel::dielectric_average_fit(wide(i.u[0]) + T::lit(0.01)));
        }),
        ("refract", |i, out| {
            let eta = wide(i.u[0]) + T::lit(0.01);
            out.vector(fresnel::refract(i.wo, eta).unwrap_or_default());
            out.vector(fresnel::refract_about(i.wo, i.wi, eta).unwrap_or_default());
        }),
        ("ggx ndf", |i, out| out.number(microfacet::ggx::ndf(i.wo, width(i.u[0]), width(i.u[1])))),
        ("ggx lambda", |i, out| {
            out.number(microfacet::ggx::lambda(i.wo, width(i.u[0]), width(i.u[1])));
        }),
        ("ggx projected_area", |i, out| {
            out.number(microfacet::ggx::projected_area(i.wo, width(i.u[0]), width(i.u[1])));
        }),
        ("ggx visible normal", |i, out| {
            let wo = upright::<T>(i.wo);
            let h =
                microfacet::ggx::sample_visible_normal(wo, width(i.u[2]), width(i.u[2]), pair(i));
            out.vector(h.unwrap_or_default());
        }),
        ("beckmann ndf", |i, out| {
            out.number(microfacet::beckmann::ndf(i.wo, width(i.u[0]), width(i.u[1])));
        }),
        ("beckmann lambda", |i, out| {
            out.number(microfacet::beckmann::lambda(i.wo, width(i.u[0]), width(i.u[1])));
        }),
        ("beckmann visible normal", |i, out| {
            let wo = upright::<T>(i.wo);
            let [x, y] = [width(i.u[2]); 2];
            let h = microfacet::beckmann::sample_visible_normal(wo, x, y, pair(i));
            out.vector(h.unwrap_or_default());
        }),
        ("independent", |i, out| out.numbers(drawn::<Independent, T>(i))),
        ("sobol", |i, out| out.numbers(drawn::<Sobol, T>(i))),
    ]
}

/// A number in [0, 16).
fn wide<T: Real>(u: T) -> T {
    u * T::lit(16.0)
}

/// A number in [−8, 8).
fn signed<T: Real>(u: T) -> T {
    wide(u) - T::lit(8.0)
}

/// A width α in [1e-3, 1).
fn width<T: Real>(u: T) -> T {
    u.max(T::lit(1e-3))
}

fn pair<T: Real>(inputs: &Inputs<T>) -> [T; 2] {
    [inputs.u[0], inputs.u[1]]
}

fn upright<T: Real>(w: Vec3<T>) -> Vec3<T> {
    if w.z() < T::ZERO { w.flip_z() } else { w }
}

/// A warped direction and where its inverse maps it.
fn warped<T: Real>(out: &mut Results, w: Vec3<T>, to_square: impl FnOnce(Vec3<T>) -> [T; 2]) {
    out.vector(w);
    out.numbers(to_square(w));
}

/// Numbers of one dimension, the sample index being that of the inputs.
fn drawn<S: Sampler, T: Real>(inputs: &Inputs<T>) -> [T; 3] {
    let sampler = S::at(7, [3, 5], inputs.index);
    let [x, y] = sampler.sample_2d(Dimension::camera(Decision::Film));
    [sampler.sample_1d(Dimension::camera(Decision::Lens)), x, y]
}
