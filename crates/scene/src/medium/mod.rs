//! What fills space: participating media.
//!
//! A [`Medium`] takes light away (extinction σt per unit of length), and gives a share of it (the
//! albedo) back in other directions (its [`Phase`] function). Shapes bound media: a [`Boundary`] says
//! what lies on either side of one.

mod density;
mod grid;
mod majorants;
mod phase;
mod volume;

use alloc::boxed::Box;
use alloc::vec::Vec;

use etendue_math::Spectrum;
use etendue_math::glam::Vec3;

pub use density::Density;
pub use grid::{GridError, VolumeGrid};
pub use majorants::Stretch;
pub use phase::{BlendPhase, Phase, TabulatedPhase};
pub use volume::{GridFilter, PlacedGrid, Volume};

use crate::Color;
use crate::color::{Channels, Curve};

/// Names a medium of [`Media`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MediumId(pub u32);

/// Matter that scatters and absorbs light wherever it is.
///
/// ```text
/// dL/ds = −σt L + σt albedo ∫ p(ω·ω') L(ω') dω'
/// ```
///
/// # Source
/// Chandrasekhar, "Radiative Transfer", 1950; parameters as of Mitsuba 3's `homogeneous` and
/// `heterogeneous`.
#[derive(Clone, Debug)]
pub struct Medium {
    /// How much light is taken away.
    pub extinction: Extinction,
    /// The share of it that is scattered; values above 1 count as 1.
    pub albedo: Volume,
    /// What of these was given by wavelength.
    pub curves: MediumCurves,
    /// Where it is scattered to.
    pub phase: Phase,
    /// Whether points of the medium look for lights. Without, light is found by scattering alone,
    /// which takes less time where refracting surfaces hide all lights.
    pub samples_lights: bool,
}

/// Properties of a medium as curves over the wavelengths; their colours stand beside them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MediumCurves {
    /// Of an extinction that is the same everywhere.
    pub extinction: Option<Curve>,
    /// Of an albedo that is the same everywhere.
    pub albedo: Option<Curve>,
}

/// Extinction σt per unit of length.
#[derive(Clone, Debug)]
pub enum Extinction {
    /// The same everywhere, finite and not negative.
    Homogeneous(Color),
    /// Differs from place to place.
    Heterogeneous(Box<Density>),
}

impl Extinction {
    /// Takes no light away.
    const NOTHING: Self = Self::Homogeneous(Color::new(0.0, 0.0, 0.0));
}

impl Medium {
    /// Whether extinction differs between the channels somewhere.
    pub fn is_coloured(&self) -> bool {
        match &self.extinction {
            Extinction::Homogeneous(sigma) => {
                self.curves.extinction.is_some() || !(sigma.r == sigma.g && sigma.g == sigma.b)
            }
            Extinction::Heterogeneous(density) => density.is_coloured(),
        }
    }

    /// Takes as much of every colour: the mean of the channels.
    pub(crate) fn lose_colour(&mut self) {
        self.curves.extinction = None;
        self.extinction = match core::mem::replace(&mut self.extinction, Extinction::NOTHING) {
            Extinction::Homogeneous(sigma) => Extinction::Homogeneous(Color::splat(sigma.mean())),
            Extinction::Heterogeneous(density) => {
                Extinction::Heterogeneous(Box::new(density.grey()))
            }
        };
    }

    /// An extinction of this medium, in the channels of a path.
    #[inline]
    pub fn extinction_in<C: Channels>(&self, sigma: Color, channels: C) -> C::Color {
        match (C::FIXED, &self.curves.extinction) {
            (None, Some(curve)) => channels.curve(curve, sigma),
            _ => channels.matter(sigma),
        }
    }

    /// The share of light that is scattered at a point and not absorbed, in [0, 1], in the channels of a path.
    #[inline]
    pub fn albedo_at<C: Channels>(&self, position: Vec3, channels: C) -> C::Color {
        let albedo = match (C::FIXED, &self.curves.albedo) {
            (None, Some(curve)) => channels.curve(curve, self.albedo.at(position)),
            _ => channels.matter(self.albedo.at(position)),
        };
        albedo.map(|albedo| albedo.min(1.0))
    }
}

/// What lies on either side of a surface; none is empty space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Boundary {
    /// Behind the surface: on the other side than its normal points to.
    pub interior: Option<MediumId>,
    /// In front of it.
    pub exterior: Option<MediumId>,
}

/// The media of a scene.
#[derive(Clone, Debug, Default)]
pub struct Media {
    /// In the order of [`MediumId`].
    pub list: Vec<Medium>,
    /// Where the camera stands; none in empty space.
    pub around_camera: Option<MediumId>,
}

impl Media {
    /// A medium, or `None` for an unknown `id`.
    #[inline]
    pub fn get(&self, id: MediumId) -> Option<&Medium> {
        self.list.get(id.0 as usize)
    }
}
