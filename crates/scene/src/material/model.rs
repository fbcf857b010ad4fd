//! One reflection model, whichever it is.

use etendue_brdf::{
    Bsdf, DiffuseTransmitter, Lambert, Lobes, Null, OrenNayar, OrenNayarQualitative, Phong,
    Plastic, Principled, PrincipledParameters, PrincipledThin, PrincipledThinParameters,
    RoughConductor, RoughDielectric, RoughPlastic, Sample, SmoothConductor, SmoothDielectric,
    ThinDielectric,
};
use etendue_math::Spectrum;
use etendue_math::glam::Vec3;

use super::{Compensated, Composed, Dispersive};
use crate::color::{Channels, Primaries};

/// A reflection model with its parameters at one point.
///
/// An enumeration, because a call through a table of functions cannot be inlined.
#[derive(Clone, Copy, Debug)]
pub enum Model<'a, C: Channels = Primaries> {
    /// Ideal diffuse.
    Lambert(Lambert<C::Color>),
    /// Rough diffuse with interreflection.
    OrenNayar(OrenNayar<C::Color>),
    /// Rough diffuse, simplified.
    OrenNayarQualitative(OrenNayarQualitative<C::Color>),
    /// A thin sheet that scatters to both sides.
    DiffuseTransmitter(DiffuseTransmitter<C::Color>),
    /// A diffuse part and a lobe around the mirror direction.
    Phong(Phong<C::Color>),
    /// A smooth interface of transparent media.
    SmoothDielectric(SmoothDielectric<C::Color>),
    /// A rough interface of transparent media.
    RoughDielectric(RoughDielectric<C::Color>),
    /// A smooth or rough interface whose index depends on the wavelength.
    Dispersive(Dispersive<C::Color>),
    /// A rough metal or rough glass with a compensation.
    Compensated(Compensated<'a, C::Color>),
    /// A pane without thickness.
    ThinDielectric(ThinDielectric<C::Color>),
    /// A polished metal.
    SmoothConductor(SmoothConductor<C::Color>),
    /// A rough metal.
    RoughConductor(RoughConductor<C::Color>),
    /// A diffuse base under a smooth interface.
    Plastic(Plastic<C::Color>),
    /// A diffuse base under a rough interface.
    RoughPlastic(RoughPlastic<'a, C::Color>),
    /// Disney's material.
    Principled(PrincipledModel<C::Color>),
    /// Disney's sheet.
    PrincipledThin(PrincipledThinModel<C::Color>),
    /// Made of other materials.
    Composed(Composed<'a, C>),
    /// Nothing.
    Null(Null<C::Color>),
}

/// [`Principled`] as its parameters.
///
/// The lobes take twice the memory of any other model. They are put together in each call, so that what the others
/// are moved and stored as stays small.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipledModel<S: Spectrum>(pub PrincipledParameters<S>);

/// [`PrincipledThin`] as its parameters, like [`PrincipledModel`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipledThinModel<S: Spectrum>(pub PrincipledThinParameters<S>);

/// Implements [`Bsdf`] for the parameters of a model by making the model.
macro_rules! made_in_each_call {
    ($parameters:ident: $model:ident) => {
        impl<S: Spectrum<Real = f32>> Bsdf for $parameters<S> {
            type Color = S;

            #[inline]
            fn lobes(&self) -> Lobes {
                $model::clamped(self.0).lobes()
            }

            #[inline]
            fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (S, f32) {
                $model::clamped(self.0).eval_pdf(wo, wi)
            }

            #[inline]
            fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Option<Sample<S>> {
                $model::clamped(self.0).sample(wo, u_lobe, u)
            }

            #[inline]
            fn albedo(&self, wo: Vec3) -> Option<S> {
                $model::clamped(self.0).albedo(wo)
            }
        }
    };
}

made_in_each_call!(PrincipledModel: Principled);
made_in_each_call!(PrincipledThinModel: PrincipledThin);

impl<C: Channels> Model<'_, C> {
    /// Whether sampling chooses among several lobes.
    #[inline]
    pub(super) fn chooses_lobe(&self) -> bool {
        match self {
            Self::Lambert(_)
            | Self::OrenNayar(_)
            | Self::OrenNayarQualitative(_)
            | Self::SmoothConductor(_)
            | Self::RoughConductor(_)
            | Self::Null(_) => false,
            Self::DiffuseTransmitter(_)
            | Self::Phong(_)
            | Self::SmoothDielectric(_)
            | Self::RoughDielectric(_)
            | Self::Dispersive(_)
            | Self::Compensated(_)
            | Self::ThinDielectric(_)
            | Self::Plastic(_)
            | Self::RoughPlastic(_)
            | Self::Principled(_)
            | Self::PrincipledThin(_)
            | Self::Composed(_) => true,
        }
    }
}

/// Implements [`Bsdf`] for an enumeration by handing every call to whichever variant is there.
///
/// The first variant's `eval_pdf` and `sample` are inlined, those of the others called: a diffuse
/// surface takes a handful of instructions, and what surrounds it should not make room for the
/// longer ones. A variant whose family the program is compiled without is never made, and does nothing.
macro_rules! forward_bsdf {
    ($enum:ident: $first:ident, $($variant:ident $(if $compiled:expr)?),+) => {
        impl<C: Channels> Bsdf for $enum<'_, C> {
            type Color = C::Color;

            #[inline]
            fn lobes(&self) -> Lobes {
                match self {
                    Self::$first(model) => model.lobes(),
                    $(Self::$variant(model) if true $(&& $compiled)? => model.lobes(),)+
                    _ => Lobes::default(),
                }
            }

            #[inline(always)]
            fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (C::Color, f32) {
                // Taken apart and put together again, here and by `?` below: what is returned from
                // here is not where the calls return it, and need not be in memory.
                let (f, pdf) = match self {
                    Self::$first(model) => model.eval_pdf(wo, wi),
                    others => others.eval_pdf_of_others(wo, wi),
                };
                (f, pdf)
            }

            #[inline(always)]
            fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Option<Sample<C::Color>> {
                Some(match self {
                    Self::$first(model) => model.sample(wo, u_lobe, u)?,
                    others => others.sample_of_others(wo, u_lobe, u)?,
                })
            }

            #[inline]
            fn albedo(&self, wo: Vec3) -> Option<C::Color> {
                match self {
                    Self::$first(model) => model.albedo(wo),
                    $(Self::$variant(model) if true $(&& $compiled)? => model.albedo(wo),)+
                    _ => None,
                }
            }

            #[inline]
            fn pass_through(&self, wo: Vec3) -> C::Color {
                match self {
                    Self::$first(model) => model.pass_through(wo),
                    $(Self::$variant(model) if true $(&& $compiled)? => model.pass_through(wo),)+
                    _ => C::Color::black(),
                }
            }
        }

        impl<C: Channels> $enum<'_, C> {
            #[inline(never)]
            fn eval_pdf_of_others(&self, wo: Vec3, wi: Vec3) -> (C::Color, f32) {
                match self {
                    $(Self::$variant(model) if true $(&& $compiled)? => model.eval_pdf(wo, wi),)+
                    _ => (C::Color::black(), 0.0),
                }
            }

            #[inline(never)]
            fn sample_of_others(
                &self,
                wo: Vec3,
                u_lobe: f32,
                u: [f32; 2],
            ) -> Option<Sample<C::Color>> {
                match self {
                    $(Self::$variant(model) if true $(&& $compiled)? => {
                        model.sample(wo, u_lobe, u)
                    })+
                    _ => None,
                }
            }
        }
    };
}

forward_bsdf!(
    Model: Lambert,
    OrenNayar,
    OrenNayarQualitative,
    Null,
    DiffuseTransmitter,
    Phong if cfg!(feature = "phong"),
    SmoothDielectric if cfg!(feature = "smooth"),
    ThinDielectric if cfg!(feature = "smooth"),
    SmoothConductor if cfg!(feature = "smooth"),
    RoughDielectric if cfg!(feature = "rough"),
    RoughConductor if cfg!(feature = "rough"),
    Compensated if cfg!(feature = "rough"),
    Dispersive if cfg!(feature = "dispersion"),
    Plastic if cfg!(feature = "layered"),
    RoughPlastic if cfg!(feature = "layered"),
    Principled if cfg!(feature = "principled"),
    PrincipledThin if cfg!(feature = "principled"),
    Composed if cfg!(feature = "composed")
);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Color;

    #[test]
    fn a_model_is_no_larger_than_rough_glass() {
        // Models are returned and stored by value at every textured surface.
        assert!(size_of::<Model>() <= size_of::<RoughDielectric<Color>>() + size_of::<u32>());
    }
}
