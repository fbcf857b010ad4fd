//! What owns a model and forwards the interface to it.

use alloc::boxed::Box;

use etendue_math::Spectrum;

use crate::{
    Bsdf, BsdfReal, BsdfVec, InternalScattering, Lobes, Reflectance, RoughPlastic, Sample,
    TransmittanceTable,
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
}

/// A [`RoughPlastic`] together with the table it borrows.
pub(super) struct OwnedRoughPlastic<C: Spectrum> {
    pub(super) table: TransmittanceTable<C::Real>,
    pub(super) diffuse: Reflectance<C>,
    pub(super) scattering: InternalScattering,
    pub(super) specular: Reflectance<C>,
}

impl<C: Spectrum> OwnedRoughPlastic<C> {
    /// Building it anew costs a few products beside the evaluation that follows.
    fn model(&self) -> RoughPlastic<'_, C> {
        RoughPlastic::new(&self.table, self.diffuse, self.scattering)
            .with_specular_reflectance(self.specular)
    }
}

impl<C: Spectrum> Bsdf for OwnedRoughPlastic<C> {
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
}
