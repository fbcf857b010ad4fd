//! Maps from the square: their densities and inverses.

use etendue_math::{Real, Vec3, Vector3};
use etendue_sampling::warp::cone::Cone;
use etendue_sampling::warp::henyey_greenstein::HenyeyGreenstein;
use etendue_sampling::warp::linear::Linear;
use etendue_sampling::warp::rectangle::Rectangle;
use etendue_sampling::warp::seen_sphere::SeenSphere;
use etendue_sampling::warp::spherical_rectangle::SphericalRectangle;
use etendue_sampling::warp::spherical_triangle::SphericalTriangle;
use etendue_sampling::warp::{
    cosine_hemisphere, disk, rayleigh, triangle, uniform_hemisphere, uniform_sphere,
};

use super::ClosedForm;
use crate::budget::Budget;
use crate::generators::uniforms;
use crate::measure::{Outcome, Worst};
use crate::scalar::{Scalar, narrow, widen};

/// The density is the reciprocal of the area that a cell of the square becomes.
pub(super) const JACOBIAN: ClosedForm = ClosedForm {
    function: "warp",
    name: "density is the Jacobian",
    single: |_| Outcome::NotApplicable("differences are taken in f64"),
    double: jacobian,
};

/// `to_square` is the inverse of `from_square`.
pub(super) const ROUND_TRIP: ClosedForm = ClosedForm {
    function: "warp",
    name: "there and back",
    single: round_trip::<f32>,
    double: round_trip::<f64>,
};

/// A warp by its three functions, its points as vectors.
struct Warp<T: Real> {
    name: &'static str,
    map: Box<dyn Fn([T; 2]) -> Option<Vec3<T>>>,
    inverse: Box<dyn Fn(Vec3<T>) -> [T; 2]>,
    pdf: Box<dyn Fn(Vec3<T>) -> T>,
}

impl<T: Real> Warp<T> {
    fn new(
        name: &'static str,
        map: impl Fn([T; 2]) -> Option<Vec3<T>> + 'static,
        inverse: impl Fn(Vec3<T>) -> [T; 2] + 'static,
        pdf: impl Fn(Vec3<T>) -> T + 'static,
    ) -> Self {
        Self { name, map: Box::new(map), inverse: Box::new(inverse), pdf: Box::new(pdf) }
    }
}

fn directions<T: Scalar>() -> Vec<Warp<T>> {
    let cone = Cone::from_one_minus_cos(T::lit(0.3));
    vec![
        Warp::new(
            "cosine hemisphere",
            |u| Some(cosine_hemisphere::from_square(u)),
            cosine_hemisphere::to_square,
            cosine_hemisphere::pdf::<T>,
        ),
        Warp::new(
            "cosine hemisphere, polar",
            |u| Some(cosine_hemisphere::from_square_polar(u)),
            cosine_hemisphere::to_square_polar,
            cosine_hemisphere::pdf::<T>,
        ),
        Warp::new(
            "uniform hemisphere",
            |u| Some(uniform_hemisphere::from_square(u)),
            uniform_hemisphere::to_square,
            uniform_hemisphere::pdf::<T>,
        ),
        Warp::new(
            "uniform sphere",
            |u| Some(uniform_sphere::from_square(u)),
            uniform_sphere::to_square,
            |_| uniform_sphere::pdf::<T>(),
        ),
        Warp::new(
            "cone",
            move |u| Some(cone.from_square(u)),
            move |w| cone.to_square(w),
            move |w| cone.pdf(w),
        ),
        Warp::new(
            "Rayleigh",
            |u| Some(rayleigh::from_square(u)),
            rayleigh::to_square,
            |w: Vec3<T>| rayleigh::pdf(w.z()),
        ),
        Warp::new(
            "disk",
            |u| {
                let [x, y] = disk::from_square(u);
                Some(Vec3::<T>::new(x, y, T::ZERO))
            },
            |p| disk::to_square([p.x(), p.y()]),
            |p| disk::pdf([p.x(), p.y()]),
        ),
    ]
}

fn validated<T: Scalar>() -> Vec<Warp<T>> {
    let corners: [Vec3<T>; 3] =
        [[0.2, -0.4, 1.0], [1.1, 0.3, 1.4], [-0.3, 0.8, 0.9]].map(narrow::<T>);
    let rectangle: Rectangle<T> = Rectangle {
        corner: narrow::<T>([-0.3, -0.5, 0.8]),
        edges: [narrow::<T>([1.1, 0.0, 0.0]), narrow::<T>([0.0, 1.3, 0.2])],
    };
    let mut warps = vec![
        Warp::new(
            "triangle",
            move |u| {
                let [a, b, c] = triangle::from_square(u);
                Some(corners[0] * a + corners[1] * b + corners[2] * c)
            },
            move |p| {
                let [a, b, c] = corners;
                let (n, whole) = ((b - a).cross(c - a), (b - a).cross(c - a).length_squared());
                let share = |u: Vec3<T>, v: Vec3<T>| (u - p).cross(v - p).dot(n) / whole;
                triangle::to_square([share(b, c), share(c, a), share(a, b)])
            },
            move |_| triangle::pdf(corners),
        ),
        Warp::new(
            "rectangle",
            move |u| Some(rectangle.from_square(u)),
            move |p| rectangle.to_square(p),
            move |_| rectangle.pdf(),
        ),
    ];
    if let Some(lobe) = HenyeyGreenstein::new(T::lit(0.6)) {
        warps.push(Warp::new(
            "Henyey–Greenstein",
            move |u| Some(lobe.from_square(u)),
            move |w| lobe.to_square(w),
            move |w| lobe.pdf(w),
        ));
    }
    if let Some(linear) = Linear::new(T::lit(0.3), T::ONE) {
        warps.push(Warp::new(
            "linear density",
            move |[u, v]| Some(Vec3::<T>::new(linear.from_unit(u), v, T::ZERO)),
            move |p| [linear.to_unit(p.x()), p.y()],
            move |p| linear.pdf(p.x()),
        ));
    }
    if let Some(seen) = SphericalTriangle::new(corners) {
        warps.push(Warp::new(
            "spherical triangle",
            move |u| Some(seen.from_square(u)),
            move |w| seen.to_square(w),
            move |_| seen.pdf(),
        ));
    }
    if let Some(seen) = SphericalRectangle::new(rectangle) {
        warps.push(Warp::new(
            "spherical rectangle",
            move |u| Some(seen.from_square(u)),
            move |w| seen.to_square(w),
            move |_| seen.pdf(),
        ));
    }
    for (name, center) in [
        ("sphere from outside", narrow::<T>([0.6, 1.0, 2.0])),
        ("sphere from inside", narrow::<T>([0.2, 0.3, 0.4])),
    ] {
        if let Some(seen) = SeenSphere::new(center, T::ONE) {
            warps.push(Warp::new(
                name,
                move |u| seen.from_square(u).map(|point| point.direction),
                move |w| seen.to_square(w),
                move |w| seen.pdf(w),
            ));
        }
    }
    warps
}

/// Fifteen, or a constructor has refused what it should not.
fn all<T: Scalar>() -> Vec<Warp<T>> {
    directions().into_iter().chain(validated()).collect()
}

/// `|∂w/∂u × ∂w/∂v| p(w) = 1` by central differences. Bound: 1e-6; steps of 1e-5 leave their square times third
/// derivatives of some hundred.
fn jacobian(budget: Budget) -> Outcome {
    const STEP: f64 = 1e-5;
    let mut worst = Worst::default();
    for warp in all::<f64>() {
        for i in 0..budget.draws as u64 {
            let [a, b, _] = uniforms::<f64>(331, i);
            let u = [0.02 + 0.96 * a, 0.02 + 0.96 * b];
            // On the diagonals of concentric squares maps have a kink, at their centre a pole.
            let [x, y] = u.map(|u| u - 0.5);
            if (x.abs() - y.abs()).abs() < 1e-4 || x * x + y * y < 1e-3 {
                continue;
            }
            let along = |k: usize| {
                let moved = |step: f64| {
                    let mut u = u;
                    u[k] += step;
                    (warp.map)(u)
                };
                Some((moved(STEP)? - moved(-STEP)?) / (2.0 * STEP))
            };
            let area = along(0).zip(along(1)).map(|(x, y)| x.cross(y).length());
            let density = (warp.map)(u).map(&warp.pdf);
            let error = area.zip(density).map_or(f64::INFINITY, |(a, p)| (a * p - 1.0).abs());
            worst.observe(error, || format!("{}, u {u:?}", warp.name));
        }
    }
    worst.within(1e-6, "relative")
}

/// Bound: 64 ulp of 1: spherical triangles and the sphere's rim have quotients of differences.
fn round_trip<T: Scalar>(budget: Budget) -> Outcome {
    let mut worst = Worst::default();
    let warps = all::<T>();
    worst.observe(if warps.len() == 15 { 0.0 } else { f64::INFINITY }, || "refused".to_owned());
    for warp in warps {
        for i in 0..budget.draws as u64 {
            let [a, b, _] = uniforms::<T>(332, i);
            let u = [a, b].map(|x| T::lit(0.02) + T::lit(0.96) * x);
            let back = (warp.map)(u).map(&warp.inverse);
            let error = back.map_or(f64::INFINITY, |back| {
                let off = [0, 1].map(|k| (back[k] - u[k]).abs().to_f64());
                off[0].max(off[1]) / T::EPSILON.to_f64()
            });
            worst.observe(error, || {
                let w = (warp.map)(u).map(widen::<T>);
                format!("{}, u {u:?}, w {w:?}, back {back:?}", warp.name)
            });
        }
    }
    worst.within(64.0, "ulp of 1")
}
