//! What owns a model and forwards the interface to it.

use alloc::boxed::Box;

use etendue_math::Spectrum;

use crate::{
    AnyPlastic, Bsdf, BsdfReal, BsdfVec, InternalScattering, Lobes, PlasticSurface, Reflectance,
    Sample,
};

impl<B: Bsdf + ?Sized> Bsdf for Box<B> {
    type Color = B::Color;

    fn lobes(&self) -> Lobes {
        (**self).lobes()
    }
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (B::Color, BsdfReal<Self>) {
        (**self).eval_pdf(wo, wi)
    }
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<B::Color>> {
        (**self).sample(wo, u_lobe, u)
    }
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<B::Color> {
        (**self).albedo(wo)
    }
    fn pass_through(&self, wo: BsdfVec<Self>) -> B::Color {
        (**self).pass_through(wo)
    }
}

/// A plastic together with the table it borrows.
pub(super) struct OwnedPlastic<C: Spectrum> {
    pub(super) surface: PlasticSurface<C::Real>,
    pub(super) diffuse: Reflectance<C>,
    pub(super) scattering: InternalScattering,
    pub(super) specular: Reflectance<C>,
}

impl<C: Spectrum> OwnedPlastic<C> {
    /// Building it anew costs a few products beside the evaluation that follows.
    fn model(&self) -> AnyPlastic<'_, C> {
        AnyPlastic::new(&self.surface, self.diffuse, self.scattering)
            .with_specular_reflectance(self.specular)
    }
}

impl<C: Spectrum> Bsdf for OwnedPlastic<C> {
    type Color = C;

    fn lobes(&self) -> Lobes {
        self.model().lobes()
    }
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        self.model().eval_pdf(wo, wi)
    }
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        self.model().sample(wo, u_lobe, u)
    }
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        self.model().albedo(wo)
    }
}
