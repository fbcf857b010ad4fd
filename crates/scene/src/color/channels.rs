//! What the channels of a colour stand for on a path.

use core::fmt::Debug;

use etendue_math::Spectrum;

use super::Curve;
use crate::Color;

/// The meaning of the channels of what a path carries: three primaries, or a few wavelengths.
///
/// Scenes are stated in linear RGB, some of their values by spectra as well; this translates them. For [`Primaries`] that is
/// nothing, and costs nothing.
pub trait Channels: Copy + Debug + Send + Sync + 'static {
    /// A quantity per channel.
    type Color: Spectrum<Real = f32>;

    /// The channels where they are the same for all paths; none where each path has its own.
    const FIXED: Option<Self>;

    /// The channels of one path; `number` gives a uniform number in [0, 1), which is asked for where it is needed.
    fn of_path(number: impl FnOnce() -> f32) -> Self;

    /// The channel by which distances and directions are drawn that differ from channel to channel; `number` as for
    /// [`of_path`](Self::of_path).
    fn leading(number: impl FnOnce() -> f32) -> usize;

    /// A share of light, or a property of matter: between the least and the largest channel of `rgb`.
    fn matter(self, rgb: Color) -> Self::Color;

    /// Light of a colour: that of daylight for white.
    fn light(self, rgb: Color) -> Self::Color;

    /// What is given as a curve over the wavelengths, whose colour is `rgb`.
    fn curve(self, curve: &Curve, rgb: Color) -> Self::Color;

    /// The index of refraction of each channel; `None` where channels are no wavelengths.
    fn indices(self, index: impl FnMut(f32) -> f32) -> Option<Self::Color>;

    /// What a sensor sees: an estimate of the colour by these channels.
    fn seen(self, color: Self::Color) -> Color;
}

/// Linear RGB, Rec. 709.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Primaries;

impl Channels for Primaries {
    type Color = Color;

    const FIXED: Option<Self> = Some(Self);

    #[inline(always)]
    fn of_path(_number: impl FnOnce() -> f32) -> Self {
        Self
    }

    #[inline]
    fn leading(number: impl FnOnce() -> f32) -> usize {
        ((number() * Color::CHANNELS as f32) as usize).min(Color::CHANNELS - 1)
    }

    #[inline(always)]
    fn matter(self, rgb: Color) -> Color {
        rgb
    }

    #[inline(always)]
    fn light(self, rgb: Color) -> Color {
        rgb
    }

    #[inline(always)]
    fn curve(self, _curve: &Curve, rgb: Color) -> Color {
        rgb
    }

    #[inline(always)]
    fn indices(self, _index: impl FnMut(f32) -> f32) -> Option<Color> {
        None
    }

    #[inline(always)]
    fn seen(self, color: Color) -> Color {
        color
    }
}
