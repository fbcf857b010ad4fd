//! Linear RGB with Rec. 709 primaries.

use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use crate::Real;

/// Linear RGB, Rec. 709 (sRGB) primaries and white point D65.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rgb<T> {
    /// Red.
    pub r: T,
    /// Green.
    pub g: T,
    /// Blue.
    pub b: T,
}

impl<T> Rgb<T> {
    /// The colour (r, g, b).
    pub const fn new(r: T, g: T, b: T) -> Self {
        Self { r, g, b }
    }
}

impl<T: Real> Rgb<T> {
    /// Relative luminance Y.
    ///
    /// ```text
    /// Y = 0.212671 r + 0.715160 g + 0.072169 b
    /// ```
    ///
    /// # Source
    /// ITU-R BT.709-6, item 3.2, with the six digits Mitsuba and pbrt use.
    #[inline]
    pub fn luminance(self) -> T {
        self.r * T::lit(0.212671) + self.g * T::lit(0.715160) + self.b * T::lit(0.072169)
    }

    /// The channels as an array.
    #[inline]
    pub fn to_array(self) -> [T; 3] {
        [self.r, self.g, self.b]
    }
}

impl<T> From<[T; 3]> for Rgb<T> {
    fn from([r, g, b]: [T; 3]) -> Self {
        Self { r, g, b }
    }
}

macro_rules! per_channel {
    ($($operator:ident $method:ident),*) => {$(
        impl<T: Real> $operator for Rgb<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                Self { r: self.r.$method(o.r), g: self.g.$method(o.g), b: self.b.$method(o.b) }
            }
        }
    )*};
}
per_channel!(Add add, Sub sub, Mul mul, Div div);

impl<T: Real> Mul<T> for Rgb<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, x: T) -> Self {
        Self { r: self.r * x, g: self.g * x, b: self.b * x }
    }
}

impl<T: Real> Neg for Rgb<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { r: -self.r, g: -self.g, b: -self.b }
    }
}

impl<T: Real> AddAssign for Rgb<T> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_has_luminance_one() {
        // The three published weights sum to 1 exactly in decimal.
        assert!((Rgb::new(1.0_f64, 1.0, 1.0).luminance() - 1.0).abs() < 1e-15);
    }
}
