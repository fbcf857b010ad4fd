//! A quantity at a few wavelengths.

use core::array::from_fn;
use core::ops::{Add, AddAssign, Mul, Sub};

use crate::{Real, Spectrum};

/// A quantity at `N` wavelengths, which whoever carries it knows.
///
/// # Examples
/// ```
/// use etendue_math::{Sampled, Spectrum};
/// let glass = Sampled([1.0_f32, 0.9, 0.8, 0.5]);
/// let twice = glass * glass;
/// assert_eq!(twice.channel(3), 0.25);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled<T, const N: usize>(pub [T; N]);

macro_rules! per_wavelength {
    ($($operator:ident $method:ident),*) => {$(
        impl<T: Real, const N: usize> $operator for Sampled<T, N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.zip(other, $operator::$method)
            }
        }
    )*};
}
per_wavelength!(Add add, Sub sub, Mul mul);

impl<T: Real, const N: usize> AddAssign for Sampled<T, N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<T: Real, const N: usize> Spectrum for Sampled<T, N> {
    type Real = T;
    const CHANNELS: usize = N;

    #[inline(always)]
    fn splat(x: T) -> Self {
        Self([x; N])
    }
    #[inline(always)]
    fn channel(self, i: usize) -> T {
        self.0[i.min(N - 1)]
    }
    #[inline(always)]
    fn map(self, f: impl FnMut(T) -> T) -> Self {
        Self(self.0.map(f))
    }
    #[inline(always)]
    fn zip(self, other: Self, mut f: impl FnMut(T, T) -> T) -> Self {
        Self(from_fn(|i| f(self.0[i], other.0[i])))
    }
    #[inline(always)]
    fn map_to_pair(self, f: impl FnMut(T) -> (T, T)) -> (Self, Self) {
        let pairs = self.0.map(f);
        (Self(pairs.map(|pair| pair.0)), Self(pairs.map(|pair| pair.1)))
    }
    /// The mean: which wavelengths are the bright ones is not known here.
    #[inline(always)]
    fn luminance(self) -> T {
        self.mean()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operators_work_wavelength_by_wavelength() {
        let (a, b) = (Sampled([1.0_f64, 2.0, 4.0, 8.0]), Sampled([3.0, 5.0, 7.0, 9.0]));
        assert_eq!(a + b, Sampled([4.0, 7.0, 11.0, 17.0]));
        assert_eq!(b - a, Sampled([2.0, 3.0, 3.0, 1.0]));
        assert_eq!(a * b, Sampled([3.0, 10.0, 28.0, 72.0]));
        let mut sum = a;
        sum += b;
        assert_eq!(sum, a + b);
    }

    #[test]
    fn what_spectra_have_in_common_holds_here_too() {
        let a = Sampled([1.0_f32, 2.0, 4.0, 9.0]);
        assert_eq!((a.max_channel(), a.mean(), a.luminance()), (9.0, 4.0, 4.0));
        assert_eq!((a.channel(1), a.channel(7)), (2.0, 9.0));
        assert_eq!(a.map_to_pair(|x| (x, 2.0 * x)), (a, a + a));
        let rgb = crate::Rgb::new(1.0_f64, 2.0, 4.0);
        assert_eq!(rgb.map_to_pair(|x| (x, 2.0 * x)), (rgb, rgb + rgb));
        assert!(Sampled::<f32, 4>::black().is_black() && !a.is_black());
        assert!(!Sampled([1.0_f32, f32::NAN, 0.0, 0.0]).is_finite());
    }
}
