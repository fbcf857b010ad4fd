//! Maps from the unit square, each with its inverse and its density.
//!
//! `from_square` maps uniforms in `[0, 1)²` to points or directions, `to_square` undoes it, `pdf`
//! is the density of the results. Local directions have `z` along the axis.
//!
//! | module | support | measure | density |
//! | --- | --- | --- | --- |
//! | [`disk`] | unit disk | area | 1/π |
//! | [`uniform_sphere`] | all directions | solid angle | 1/4π |
//! | [`uniform_hemisphere`] | z ≥ 0 | solid angle | 1/2π |
//! | [`cosine_hemisphere`] | z ≥ 0, concentric and polar | solid angle | z/π |
//! | [`cone`] | directions within a cap | solid angle | 1/Ω |
//! | [`henyey_greenstein`] | all directions, around ±z | solid angle | (1 − g²)/(4π q^³ᐟ²) |
//! | [`rayleigh`] | all directions, around ±z | solid angle | 3(1 + z²)/16π |
//! | [`linear`] | `[0, 1)`, from one uniform | length | 2(a(1 − x) + bx)/(a + b) |
//! | [`equiangular`] | distances along a ray, from one uniform | length | D/(Δ(D² + (a + s)²)) |
//! | [`seen_sphere`] | directions that hit a sphere | solid angle | 1/Ω outside, from area inside |
//! | [`triangle`] | barycentric coordinates | area | 1/A |
//! | [`spherical_triangle`] | directions that hit a triangle | solid angle | 1/Ω |
//! | [`rectangle`] | parallelogram | area | 1/A |
//! | [`spherical_rectangle`] | directions that hit a rectangle | solid angle | 1/Ω |
//!
//! Shapes seen under a solid angle too small or too large for their solid-angle map refuse at
//! construction; [`area`] converts the density of the area map that takes over.

pub mod area;
pub mod cone;
pub mod cosine_hemisphere;
pub mod disk;
pub mod equiangular;
pub mod henyey_greenstein;
pub mod linear;
pub mod rayleigh;
pub mod rectangle;
pub mod seen_sphere;
pub mod spherical_rectangle;
pub mod spherical_triangle;
pub mod triangle;
pub mod turn;
pub mod uniform_hemisphere;
pub mod uniform_sphere;

use etendue_math::{Real, Vec3, Vector3};

/// `a × b`, each component within 1.5 ulp where the plain products would cancel.
#[inline]
fn accurate_cross<V: Vector3>(a: V, b: V) -> V {
    V::new(
        Real::difference_of_products(a.y(), b.z(), a.z(), b.y()),
        Real::difference_of_products(a.z(), b.x(), a.x(), b.z()),
        Real::difference_of_products(a.x(), b.y(), a.y(), b.x()),
    )
}

/// `1 − z` and `1 + z` of a unit vector without cancellation.
#[inline]
fn from_poles<T: Real>(w: Vec3<T>) -> [T; 2] {
    let far = T::ONE + w.z().abs();
    let near = (w.x() * w.x() + w.y() * w.y()) / far;
    if w.z() > T::ZERO { [near, far] } else { [far, near] }
}

/// A coordinate of the square brought back into `[0, 1)` after rounding; 0 for NaN.
#[inline]
pub(crate) fn into_unit<T: Real>(u: T) -> T {
    u.clamp_to(T::ZERO, T::ONE_MINUS_EPSILON)
}
