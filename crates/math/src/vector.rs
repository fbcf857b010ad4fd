//! What generic code may do with glam's three-component vectors.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::Real;

/// glam's `Vec3` or `DVec3`, by precision.
pub type Vec3<T> = <T as Real>::Vec3;

/// A three-component vector: `glam::Vec3` or `glam::DVec3`.
///
/// Only operations whose bits are the same on every target are offered (`dot` sums x, y, z in
/// this order). Components are methods because traits have no fields.
pub trait Vector3:
    Copy
    + Debug
    + Default
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<Self::Scalar, Output = Self>
    + Div<Self::Scalar, Output = Self>
    + Send
    + Sync
    + 'static
{
    /// The component type.
    type Scalar: Real<Vec3 = Self>;

    /// The vector (x, y, z).
    fn new(x: Self::Scalar, y: Self::Scalar, z: Self::Scalar) -> Self;
    /// First component.
    fn x(self) -> Self::Scalar;
    /// Second component.
    fn y(self) -> Self::Scalar;
    /// Third component; the cosine to the normal in a local shading frame.
    fn z(self) -> Self::Scalar;
    /// Cross product.
    fn cross(self, other: Self) -> Self;

    /// Dot product, summed in the order x, y, z.
    #[inline(always)]
    fn dot(self, other: Self) -> Self::Scalar {
        self.x() * other.x() + self.y() * other.y() + self.z() * other.z()
    }
    /// Squared Euclidean length.
    #[inline(always)]
    fn length_squared(self) -> Self::Scalar {
        self.dot(self)
    }
    /// Euclidean length.
    #[inline(always)]
    fn length(self) -> Self::Scalar {
        self.length_squared().sqrt()
    }
    /// The unit vector of the same direction, or `None` where the squared length is 0, infinite or NaN.
    #[inline(always)]
    fn try_normalize(self) -> Option<Self> {
        let squared = self.length_squared();
        if squared > Self::Scalar::ZERO && squared.is_finite() {
            Some(self / squared.sqrt())
        } else {
            None
        }
    }
    /// The same vector with the third component negated: mirrored in the surface.
    #[inline(always)]
    fn flip_z(self) -> Self {
        Self::new(self.x(), self.y(), -self.z())
    }
    /// Every component is finite.
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.x().is_finite() && self.y().is_finite() && self.z().is_finite()
    }
}

macro_rules! vector3 {
    ($vec3:ty, $float:ty) => {
        impl Vector3 for $vec3 {
            type Scalar = $float;

            #[inline(always)]
            fn new(x: $float, y: $float, z: $float) -> Self {
                <$vec3>::new(x, y, z)
            }
            #[inline(always)]
            fn x(self) -> $float {
                self.x
            }
            #[inline(always)]
            fn y(self) -> $float {
                self.y
            }
            #[inline(always)]
            fn z(self) -> $float {
                self.z
            }
            #[inline(always)]
            fn cross(self, other: Self) -> Self {
                <$vec3>::cross(self, other)
            }
        }
    };
}

vector3!(glam::Vec3, f32);
vector3!(glam::DVec3, f64);
