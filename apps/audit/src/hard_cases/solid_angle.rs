//! Triangles and rectangles seen under tiny solid angles.

use etendue_math::glam::{DVec3, Vec3};
use etendue_sampling::warp::rectangle::Rectangle;
use etendue_sampling::warp::spherical_rectangle::SphericalRectangle;
use etendue_sampling::warp::spherical_triangle::SphericalTriangle;
use etendue_sampling::warp::{area, triangle};

use super::{HardCase, decades};
use crate::measure::{Outcome, Worst};

/// The spherical excess, the sum of the inner angles less π, is a difference of numbers of the size of π: below
/// 1e-6 sr nothing is left of it.
pub(super) const TRIANGLE: HardCase = HardCase {
    name: "tiny triangles",
    function: "SphericalTriangle",
    problem: "the spherical excess is a difference of angles of the size of π: nothing is left below 1e-6 sr",
    remedy: "the tangent of half the excess, from products of the corners",
    sound: || sweep(seen_triangle, exact_triangle),
    naive: || sweep(|h, s| excess(&corners(h, s).map(Vec3::normalize)[..3], 1.0), exact_triangle),
};

/// The same for the four angles of a rectangle less 2π.
pub(super) const RECTANGLE: HardCase = HardCase {
    name: "tiny rectangles",
    function: "SphericalRectangle",
    problem: "four angles less 2π cancel: nothing is left below 1e-6 sr",
    remedy: "two triangles, each by the tangent of half its excess",
    sound: || sweep(seen_rectangle, exact_rectangle),
    naive: || sweep(|h, s| excess(&corners(h, s).map(Vec3::normalize), 2.0), exact_rectangle),
};

/// Solid angle of a light of the given size and height above the point, off to the side: from the warp where it
/// accepts the light, below as area sampling has it, `1/p(ω)` at the light's middle.
///
/// Bound: 2e-4 relative. The warps keep ten ulp; area sampling takes `cos θ'/d²` of the middle for that of all
/// points, whose second-order term is a few tenths of (size / distance)², at most 7e-4 where the warp takes over.
fn sweep(solid_angle: fn(f32, f32) -> f32, exact: fn([DVec3; 4]) -> f64) -> Outcome {
    let mut worst = Worst::default();
    for height in [0.5_f32, 1.0, 4.0] {
        for size in decades(-6.0, 0.0, 60) {
            let exact = exact(corners(height, size).map(Vec3::as_dvec3));
            let got = f64::from(solid_angle(height, size));
            worst
                .observe((got / exact - 1.0).abs(), || format!("height {height:?}, size {size:?}"));
        }
    }
    worst.within(2e-4, "relative")
}

/// Two edges of length `size` from a corner that is seen under an oblique angle.
fn corners(height: f32, size: f32) -> [Vec3; 4] {
    let corner = Vec3::new(0.25, -0.5, height);
    let [x, y] = [Vec3::new(size, 0.0, 0.0), Vec3::new(0.0, size, 0.0)];
    [corner, corner + x, corner + y, corner + x + y]
}

fn seen_triangle(height: f32, size: f32) -> f32 {
    let [a, b, c, _] = corners(height, size);
    let far = || by_area(triangle::pdf::<f32>([a, b, c]), (a + b + c) / 3.0);
    SphericalTriangle::<f32>::new([a, b, c]).map_or_else(far, |t| t.solid_angle())
}

fn seen_rectangle(height: f32, size: f32) -> f32 {
    let [a, b, c, d] = corners(height, size);
    let rectangle = Rectangle { corner: a, edges: [b - a, c - a] };
    let far = || by_area(rectangle.pdf(), (a + d) * 0.5);
    SphericalRectangle::<f32>::new(rectangle).map_or_else(far, |r| r.solid_angle())
}

fn by_area(pdf: f32, point: Vec3) -> f32 {
    let squared = point.length_squared();
    1.0 / area::to_solid_angle(pdf, squared, point.z / squared.sqrt())
}

/// By van Oosterom and Strackee in `f64`, of the very corners `f32` has.
fn exact_triangle([a, b, c, _]: [DVec3; 4]) -> f64 {
    let volume = a.dot((b - a).cross(c - a)).abs();
    let [x, y, z] = [a, b, c].map(DVec3::length);
    let sum = x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
    2.0 * etendue_math::Real::atan2(volume, sum)
}

fn exact_rectangle([a, b, c, d]: [DVec3; 4]) -> f64 {
    exact_triangle([a, b, c, d]) + exact_triangle([d, c, b, a])
}

/// Inner angles of the spherical polygon less `straight` times π. The corners of a rectangle come in the order
/// of its rows.
fn excess(corners: &[Vec3], straight: f32) -> f32 {
    let order: &[usize] = if corners.len() == 3 { &[0, 1, 2] } else { &[0, 1, 3, 2] };
    let n = order.len();
    let angles: f32 = (0..n)
        .map(|i| {
            let [before, here, after] = [i + n - 1, i, i + 1].map(|j| corners[order[j % n]]);
            let (a, b) = (here.cross(before).normalize(), here.cross(after).normalize());
            etendue_math::Real::acos(a.dot(b).clamp(-1.0, 1.0))
        })
        .sum();
    angles - straight * core::f32::consts::PI
}
