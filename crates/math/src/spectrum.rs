//! What a reflection model needs of a colour.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Mul, Sub};

use crate::{Real, Rgb};

/// A quantity per channel: one number, RGB, or a set of wavelengths.
///
/// Reflection models are generic over this trait and so work on scalars (tables, audits, golden
/// values), on [`Rgb`] (renderers) and on whatever a spectral renderer carries. Products are per
/// channel.
pub trait Spectrum:
    Copy
    + Debug
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + AddAssign
    + Send
    + Sync
    + 'static
{
    /// The component type.
    type Real: Real;

    /// How many channels there are.
    const CHANNELS: usize;

    /// The same value in every channel.
    fn splat(x: Self::Real) -> Self;
    /// Channel `i`; the last one for larger `i`.
    fn channel(self, i: usize) -> Self::Real;
    /// A function applied to every channel.
    fn map(self, f: impl FnMut(Self::Real) -> Self::Real) -> Self;
    /// A function applied to every pair of channels.
    fn zip(self, other: Self, f: impl FnMut(Self::Real, Self::Real) -> Self::Real) -> Self;

    /// A function with two results applied to every channel.
    fn map_to_pair(self, f: impl FnMut(Self::Real) -> (Self::Real, Self::Real)) -> (Self, Self);

    /// Every channel multiplied by `x`.
    #[inline(always)]
    fn scale(self, x: Self::Real) -> Self {
        self.map(|c| c * x)
    }
    /// All channels 0.
    #[inline(always)]
    fn black() -> Self {
        Self::splat(Self::Real::ZERO)
    }
    /// All channels 1.
    #[inline(always)]
    fn white() -> Self {
        Self::splat(Self::Real::ONE)
    }
    /// The largest channel.
    #[inline(always)]
    fn max_channel(self) -> Self::Real {
        (1..Self::CHANNELS).fold(self.channel(0), |m, i| m.max(self.channel(i)))
    }
    /// The mean over the channels: what probabilities of lobes are weighted by.
    #[inline(always)]
    fn mean(self) -> Self::Real {
        (1..Self::CHANNELS).fold(self.channel(0), |m, i| m + self.channel(i))
            / Self::Real::lit(Self::CHANNELS as f64)
    }
    /// How bright the colour is: the number itself, or the relative luminance Y of [`Rgb`].
    fn luminance(self) -> Self::Real;
    /// All channels are exactly 0.
    #[inline(always)]
    fn is_black(self) -> bool {
        (0..Self::CHANNELS).all(|i| self.channel(i) == Self::Real::ZERO)
    }
    /// No channel is NaN or infinite.
    #[inline(always)]
    fn is_finite(self) -> bool {
        (0..Self::CHANNELS).all(|i| self.channel(i).is_finite())
    }
}

macro_rules! scalar_spectrum {
    ($float:ty) => {
        impl Spectrum for $float {
            type Real = $float;
            const CHANNELS: usize = 1;

            #[inline(always)]
            fn splat(x: $float) -> Self {
                x
            }
            #[inline(always)]
            fn channel(self, _: usize) -> $float {
                self
            }
            #[inline(always)]
            fn map(self, mut f: impl FnMut($float) -> $float) -> Self {
                f(self)
            }
            #[inline(always)]
            fn zip(self, other: Self, mut f: impl FnMut($float, $float) -> $float) -> Self {
                f(self, other)
            }
            #[inline(always)]
            fn map_to_pair(self, mut f: impl FnMut($float) -> ($float, $float)) -> (Self, Self) {
                f(self)
            }
            #[inline(always)]
            fn luminance(self) -> $float {
                self
            }
        }
    };
}

scalar_spectrum!(f32);
scalar_spectrum!(f64);

impl<T: Real> Spectrum for Rgb<T> {
    type Real = T;
    const CHANNELS: usize = 3;

    #[inline(always)]
    fn splat(x: T) -> Self {
        Self { r: x, g: x, b: x }
    }
    #[inline(always)]
    fn channel(self, i: usize) -> T {
        match i {
            0 => self.r,
            1 => self.g,
            _ => self.b,
        }
    }
    #[inline(always)]
    fn map(self, mut f: impl FnMut(T) -> T) -> Self {
        Self { r: f(self.r), g: f(self.g), b: f(self.b) }
    }
    #[inline(always)]
    fn zip(self, other: Self, mut f: impl FnMut(T, T) -> T) -> Self {
        Self { r: f(self.r, other.r), g: f(self.g, other.g), b: f(self.b, other.b) }
    }
    #[inline(always)]
    fn map_to_pair(self, mut f: impl FnMut(T) -> (T, T)) -> (Self, Self) {
        let (r, g, b) = (f(self.r), f(self.g), f(self.b));
        (Self { r: r.0, g: g.0, b: b.0 }, Self { r: r.1, g: g.1, b: b.1 })
    }
    #[inline(always)]
    fn luminance(self) -> T {
        Self::luminance(self)
    }
}
