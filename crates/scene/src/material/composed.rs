//! Materials that are made of others at every point.

use etendue_brdf::{Blend, Bsdf, Ior, Lobes, Opacity, Reflectance, Sample};
use etendue_math::Spectrum;
use etendue_math::glam::Vec3;

use super::coated::Coated;
use super::perturbed::Perturbed;
use super::{MaterialId, Materials, PreparedBsdf, Side};
use crate::color::Channels;
use crate::texture::{TextureId, TexturePoint, Textures};

/// A material made of others, with what they are to be looked up with.
///
/// The parts are prepared in each call: how deep they nest is up to the scene, and a model of fixed size cannot hold them.
#[derive(Clone, Copy, Debug)]
pub struct Composed<'a, C: Channels> {
    parts: Parts<'a, C>,
    how: Composition,
}

/// How parts make a whole.
#[derive(Clone, Copy, Debug)]
pub(super) enum Composition {
    /// Two in shares; the weight is that of the second.
    Blend { parts: [MaterialId; 2], weight: Opacity<f32> },
    /// One under a layer.
    Coated { nested: MaterialId, coat: Coat },
    /// One that is looked at in another frame.
    Perturbed { nested: MaterialId, perturbed: Perturbed },
}

/// A layer on a surface, before its textures are looked up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coat {
    pub(super) eta: Ior<f32>,
    pub(super) absorption: TextureId,
    pub(super) thickness: f32,
    pub(super) specular_reflectance: TextureId,
}

/// What parts are prepared from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts<'a, C: Channels> {
    pub(super) materials: &'a Materials,
    pub(super) textures: &'a Textures,
    pub(super) point: TexturePoint<'a>,
    pub(super) channels: C,
}

impl<'a, C: Channels> Parts<'a, C> {
    fn coated(&self, coat: Coat) -> Coated<C::Color> {
        let color = |id| self.textures.matter(id, self.point, self.channels);
        Coated {
            eta: coat.eta,
            absorption: color(coat.absorption).map(|a| (a * coat.thickness).min(f32::MAX)),
            specular_reflectance: Reflectance::clamped(color(coat.specular_reflectance)).value(),
        }
    }

    /// A part seen from the side of `wo`, a direction in its own frame.
    fn part(&self, id: MaterialId, wo: Vec3) -> PreparedBsdf<'a, C> {
        self.materials.prepare(id, self.textures, self.point, Side::of(wo), self.channels)
    }
}

impl<'a, C: Channels> Composed<'a, C> {
    pub(super) fn new(parts: Parts<'a, C>, how: Composition) -> Self {
        Self { parts, how }
    }

    /// Whether light may go to the other side though no part lets it.
    fn may_leak(&self) -> bool {
        matches!(self.how, Composition::Perturbed { perturbed, .. } if !perturbed.faces_every_viewer())
    }

    fn blend(
        &self,
        [first, second]: [MaterialId; 2],
        weight: Opacity<f32>,
        wo: Vec3,
    ) -> Blend<PreparedBsdf<'a, C>, PreparedBsdf<'a, C>> {
        Blend::new(self.parts.part(first, wo), self.parts.part(second, wo), weight)
    }
}

impl<C: Channels> Bsdf for Composed<'_, C> {
    type Color = C::Color;

    /// Those of either side: which one a part is seen from depends on the direction.
    fn lobes(&self) -> Lobes {
        let [front, back] = [Vec3::Z, -Vec3::Z].map(|wo| match self.how {
            Composition::Blend { parts, weight } => self.blend(parts, weight, wo).lobes(),
            Composition::Coated { nested, .. } | Composition::Perturbed { nested, .. } => {
                self.parts.part(nested, wo).lobes()
            }
        });
        Lobes {
            continuous: front.continuous || back.continuous,
            delta: front.delta || back.delta || matches!(self.how, Composition::Coated { .. }),
            transmission: front.transmission || back.transmission || self.may_leak(),
        }
    }

    fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (C::Color, f32) {
        match self.how {
            Composition::Blend { parts, weight } => self.blend(parts, weight, wo).eval_pdf(wo, wi),
            Composition::Coated { nested, coat } => {
                self.parts.coated(coat).eval_pdf(&self.parts.part(nested, wo), wo, wi)
            }
            Composition::Perturbed { nested, perturbed } => {
                let seen = perturbed.seen(wo);
                seen.eval_pdf(&self.parts.part(nested, seen.wo()), wi)
            }
        }
    }

    fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Option<Sample<C::Color>> {
        match self.how {
            Composition::Blend { parts, weight } => {
                self.blend(parts, weight, wo).sample(wo, u_lobe, u)
            }
            Composition::Coated { nested, coat } => {
                self.parts.coated(coat).sample(&self.parts.part(nested, wo), wo, u_lobe, u)
            }
            Composition::Perturbed { nested, perturbed } => {
                let seen = perturbed.seen(wo);
                seen.sample(&self.parts.part(nested, seen.wo()), u_lobe, u)
            }
        }
    }

    /// None under a layer, and in another frame, where part of the light goes to the wrong side.
    fn albedo(&self, wo: Vec3) -> Option<C::Color> {
        match self.how {
            Composition::Blend { parts, weight } => self.blend(parts, weight, wo).albedo(wo),
            Composition::Coated { .. } | Composition::Perturbed { .. } => None,
        }
    }

    /// What passes straight on does so whatever the normal.
    fn pass_through(&self, wo: Vec3) -> C::Color {
        match self.how {
            Composition::Blend { parts, weight } => self.blend(parts, weight, wo).pass_through(wo),
            Composition::Coated { .. } => C::Color::black(),
            Composition::Perturbed { nested, .. } => self.parts.part(nested, wo).pass_through(wo),
        }
    }
}
