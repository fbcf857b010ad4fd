//! What a surface does to light at one point.

use etendue_brdf::{Bsdf, Lobes, Mask, Opacity, Sample};
use etendue_math::Vector3;
use etendue_math::glam::Vec3;

use super::Model;
use crate::Color;

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
pub struct PreparedBsdf<'a> {
    inner: Mask<Placed<'a>>,
    chooses_lobe: bool,
}

/// A model with its own front on one side of the surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed<'a> {
    pub(super) model: Model<'a>,
    /// Where the model's front is.
    pub(super) front: Side,
}

impl Placed<'_> {
    #[inline(always)]
    fn place(&self, w: Vec3) -> Vec3 {
        match self.front {
            Side::Front => w,
            Side::Back => w.flip_z(),
        }
    }
}

impl Bsdf for Placed<'_> {
    type Color = Color;

    #[inline]
    fn lobes(&self) -> Lobes {
        self.model.lobes()
    }

    #[inline]
    fn eval(&self, wo: Vec3, wi: Vec3) -> Color {
        self.model.eval(self.place(wo), self.place(wi))
    }

    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.model.pdf(self.place(wo), self.place(wi))
    }

    #[inline]
    fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Color, f32) {
        self.model.eval_pdf(self.place(wo), self.place(wi))
    }

    #[inline]
    fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Option<Sample<Color>> {
        let sample = self.model.sample(self.place(wo), u_lobe, u)?;
        Some(Sample { wi: self.place(sample.wi), ..sample })
    }

    #[inline]
    fn albedo(&self, wo: Vec3) -> Option<Color> {
        self.model.albedo(self.place(wo))
    }
}

impl<'a> PreparedBsdf<'a> {
    #[inline]
    pub(super) fn new(inner: Placed<'a>, opacity: f32) -> Self {
        let chooses_lobe = opacity < 1.0 || inner.model.chooses_lobe();
        Self { inner: Mask::new(inner, Opacity::clamped(opacity)), chooses_lobe }
    }

    /// Whether [`sample`](Bsdf::sample) depends on `u_lobe`; where not, no number need be drawn for
    /// it.
    #[inline]
    pub fn chooses_lobe(&self) -> bool {
        self.chooses_lobe
    }
}

impl Bsdf for PreparedBsdf<'_> {
    type Color = Color;

    #[inline]
    fn lobes(&self) -> Lobes {
        self.inner.lobes()
    }

    #[inline]
    fn eval(&self, wo: Vec3, wi: Vec3) -> Color {
        self.inner.eval(wo, wi)
    }

    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.inner.pdf(wo, wi)
    }

    #[inline]
    fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Color, f32) {
        self.inner.eval_pdf(wo, wi)
    }

    #[inline]
    fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Option<Sample<Color>> {
        self.inner.sample(wo, u_lobe, u)
    }

    #[inline]
    fn albedo(&self, wo: Vec3) -> Option<Color> {
        self.inner.albedo(wo)
    }
}
