//! What a surface does to light at one point.

use etendue_brdf::{Bsdf, Lobes, Mask, Opacity, Sample, TwoSided};
use etendue_math::glam::Vec3;

use super::Model;
use super::model::forward_bsdf;
use crate::Color;

/// The scattering function of a material at one point, in the local shading frame.
///
/// Sides and opacity are inside: the directions may lie on either side of the surface.
#[derive(Clone, Copy, Debug)]
pub struct PreparedBsdf<'a> {
    inner: Mask<Sides<'a>>,
}

/// Which model is met from which side.
#[derive(Clone, Copy, Debug)]
pub(super) enum Sides<'a> {
    /// One that knows about both sides, or is black from behind.
    Model(Model<'a>),
    /// One-sided models, one for each side.
    Two(TwoSided<Model<'a>, Model<'a>>),
}

forward_bsdf!(Sides: Model, Two);

impl<'a> PreparedBsdf<'a> {
    #[inline]
    pub(super) fn new(sides: Sides<'a>, opacity: f32) -> Self {
        Self { inner: Mask::new(sides, Opacity::clamped(opacity)) }
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
