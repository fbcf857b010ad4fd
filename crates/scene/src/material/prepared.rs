//! What a surface does to light at one point.

use etendue_brdf::{Bsdf, Lobes, Mask, Opacity, Sample};
use etendue_math::glam::Vec3;

use super::{Dispersive, Model};
use crate::color::{Channels, Primaries};

/// The side of a surface from which it is looked at: that of `wo`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// That of the shading normal.
    Front,
    /// The other.
    Back,
}

impl Side {
    /// The side of a direction in the shading frame.
    #[inline]
    pub fn of(wo: Vec3) -> Self {
        if wo.z < 0.0 { Self::Back } else { Self::Front }
    }
}

/// The scattering function of a material at one point, in the local shading frame, looked at from
/// one side.
///
/// Sides and opacity are inside: `wo` lies on the side it was prepared for, `wi` anywhere. From the
/// other side, two-sided materials are black.
#[derive(Clone, Copy, Debug)]
pub struct PreparedBsdf<'a, C: Channels = Primaries> {
    cover: Cover<'a, C>,
    lobes: Lobes,
    chooses_lobe: bool,
}

/// How much of the surface is there.
#[derive(Clone, Copy, Debug)]
enum Cover<'a, C: Channels> {
    Whole(Placed<'a, C>),
    Partial(Placed<'a, C>, Opacity<f32>),
}

/// A model with its own front on one side of the surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed<'a, C: Channels> {
    pub(super) model: Model<'a, C>,
    /// 1 where the model's front is that of the surface, −1 where it is its back.
    up: f32,
}

impl<'a, C: Channels> Placed<'a, C> {
    #[inline]
    pub(super) fn new(model: Model<'a, C>, front: Side) -> Self {
        let up = match front {
            Side::Front => 1.0,
            Side::Back => -1.0,
        };
        Self { model, up }
    }

    /// A direction as the model sees it, or the other way round.
    #[inline(always)]
    fn place(&self, w: Vec3) -> Vec3 {
        // An exact product instead of a branch.
        Vec3::new(w.x, w.y, w.z * self.up)
    }
}

impl<C: Channels> Bsdf for Placed<'_, C> {
    type Color = C::Color;

    #[inline]
    fn lobes(&self) -> Lobes {
        self.model.lobes()
    }

    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (C::Color, f32) {
        self.model.eval_pdf(self.place(wo), self.place(wi))
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Option<Sample<C::Color>> {
        let sample = self.model.sample(self.place(wo), u_lobe, u)?;
        Some(Sample { wi: self.place(sample.wi), ..sample })
    }

    #[inline]
    fn albedo(&self, wo: Vec3) -> Option<C::Color> {
        self.model.albedo(self.place(wo))
    }

    #[inline]
    fn pass_through(&self, wo: Vec3) -> C::Color {
        self.model.pass_through(self.place(wo))
    }
}

/// A reference, for models that hold another: one that holds the model itself would tie what it is prepared from to a single
/// lifetime.
impl<C: Channels> Bsdf for &Placed<'_, C> {
    type Color = C::Color;

    #[inline]
    fn lobes(&self) -> Lobes {
        (**self).lobes()
    }

    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (C::Color, f32) {
        (**self).eval_pdf(wo, wi)
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Option<Sample<C::Color>> {
        (**self).sample(wo, u_lobe, u)
    }

    #[inline]
    fn albedo(&self, wo: Vec3) -> Option<C::Color> {
        (**self).albedo(wo)
    }

    #[inline]
    fn pass_through(&self, wo: Vec3) -> C::Color {
        (**self).pass_through(wo)
    }
}

impl<'a, C: Channels> PreparedBsdf<'a, C> {
    #[inline]
    pub(super) fn new(placed: Placed<'a, C>, opacity: f32) -> Self {
        if opacity < 1.0 {
            let opacity = Opacity::clamped(opacity);
            return Self {
                lobes: Mask::new(&placed, opacity).lobes(),
                chooses_lobe: true,
                cover: Cover::Partial(placed, opacity),
            };
        }
        let chooses_lobe = placed.model.chooses_lobe();
        Self { lobes: placed.lobes(), chooses_lobe, cover: Cover::Whole(placed) }
    }

    /// The interface whose index depends on the wavelength, where the surface is nothing else.
    #[inline(always)]
    pub fn dispersive(&self) -> Option<&Dispersive<C::Color>> {
        match &self.cover {
            Cover::Whole(Placed { model: Model::Dispersive(interface), .. }) => Some(interface),
            _ => None,
        }
    }

    /// The albedo of an ideal diffuse surface looked at from its front; `None` for all others.
    #[inline(always)]
    pub fn lambertian(&self, wo: Vec3) -> Option<C::Color> {
        match &self.cover {
            Cover::Whole(Placed { model: Model::Lambert(model), up }) if wo.z * up > 0.0 => {
                model.albedo(Vec3::Z)
            }
            _ => None,
        }
    }

    /// Whether [`sample`](Bsdf::sample) depends on `u_lobe`; where not, no number need be drawn for
    /// it.
    #[inline(always)]
    pub fn chooses_lobe(&self) -> bool {
        self.chooses_lobe
    }
}

impl<C: Channels> Bsdf for PreparedBsdf<'_, C> {
    type Color = C::Color;

    #[inline(always)]
    fn lobes(&self) -> Lobes {
        self.lobes
    }

    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (C::Color, f32) {
        match &self.cover {
            Cover::Whole(placed) => placed.eval_pdf(wo, wi),
            Cover::Partial(placed, opacity) => eval_pdf_of_partial(placed, *opacity, wo, wi),
        }
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Option<Sample<C::Color>> {
        Some(match &self.cover {
            Cover::Whole(placed) => placed.sample(wo, u_lobe, u)?,
            Cover::Partial(placed, opacity) => sample_partial(placed, *opacity, wo, u_lobe, u)?,
        })
    }

    #[inline]
    fn albedo(&self, wo: Vec3) -> Option<C::Color> {
        match &self.cover {
            Cover::Whole(placed) => placed.albedo(wo),
            Cover::Partial(placed, opacity) => Mask::new(placed, *opacity).albedo(wo),
        }
    }

    #[inline]
    fn pass_through(&self, wo: Vec3) -> C::Color {
        match &self.cover {
            Cover::Whole(placed) => placed.pass_through(wo),
            Cover::Partial(placed, opacity) => Mask::new(placed, *opacity).pass_through(wo),
        }
    }
}

/// Out of line, as the longer models are.
#[inline(never)]
fn eval_pdf_of_partial<C: Channels>(
    placed: &Placed<'_, C>,
    opacity: Opacity<f32>,
    wo: Vec3,
    wi: Vec3,
) -> (C::Color, f32) {
    Mask::new(placed, opacity).eval_pdf(wo, wi)
}

#[inline(never)]
fn sample_partial<C: Channels>(
    placed: &Placed<'_, C>,
    opacity: Opacity<f32>,
    wo: Vec3,
    u_lobe: f32,
    u: [f32; 2],
) -> Option<Sample<C::Color>> {
    Mask::new(placed, opacity).sample(wo, u_lobe, u)
}
