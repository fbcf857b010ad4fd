//! The two precisions as colours of one channel.

use etendue_math::{Real, Spectrum, Vec3, Vector3};

/// `f32` or `f64`, used both as a real number and as a colour of one channel.
///
/// Models treat channels independently, so that one channel shows all there is to see.
pub trait Scalar: Real + Spectrum<Real = Self> {
    /// `"f32"` or `"f64"`, as the report prints it.
    const NAME: &'static str;
}

impl Scalar for f32 {
    const NAME: &'static str = "f32";
}

impl Scalar for f64 {
    const NAME: &'static str = "f64";
}

/// A vector in `f64`, exact.
pub fn widen<T: Real>(w: Vec3<T>) -> [f64; 3] {
    [w.x().to_f64(), w.y().to_f64(), w.z().to_f64()]
}

/// The vector nearest to `w`.
pub fn narrow<T: Real>([x, y, z]: [f64; 3]) -> Vec3<T> {
    Vec3::<T>::new(T::lit(x), T::lit(y), T::lit(z))
}

/// The number nearest to `x` that `f32` and `f64` both hold: a parameter that is the same in both.
pub fn shared<T: Real>(x: f64) -> T {
    T::lit(f64::from(x as f32))
}

/// A vector as the report prints it: the shortest digits that read back as the same bits.
pub fn show<T: Real>(w: Vec3<T>) -> String {
    format!("({:?}, {:?}, {:?})", w.x(), w.y(), w.z())
}
