//! The lights of a scene, as a renderer asks for them.

use alloc::vec::Vec;

use etendue_math::Spectrum;
use etendue_math::glam::Vec3;

use super::Scene;
use crate::Color;
use crate::color::Channels;
use crate::geometry::{Shape, ShapeId, SurfacePoint};
use crate::light::{Light, LightBounds, LightId, LightSample};

impl Scene {
    /// The shape of an area light, which `new` has found to exist.
    #[inline(always)]
    fn shape_of(&self, shape: ShapeId) -> &Shape {
        &self.geometry.shapes()[shape.0 as usize]
    }

    /// Light of one source arriving at the point `from`, drawn with two uniforms in `[0, 1)`.
    ///
    /// * `primitive`: which triangle of an area light's mesh; 0 for everything else.
    ///
    /// `None` where nothing arrives: the light shows its back, the drawn point is black, or there is
    /// no such light.
    #[inline(always)]
    pub fn sample_light<C: Channels>(
        &self,
        light: LightId,
        primitive: u32,
        from: Vec3,
        u: [f32; 2],
        channels: C,
    ) -> Option<LightSample<C::Color>> {
        // `?` takes apart what the longer way returns, so that the result need not be in memory.
        Some(match self.lights.get(light.0 as usize)? {
            Light::Area(area) => {
                let shape = self.shape_of(area.shape);
                area.sample(shape, &self.textures, primitive, from, u, channels)?
            }
            light => {
                let LightSample { direction, target, radiance, density } =
                    self.sample_without_surface(light, from, u)?;
                LightSample { direction, target, radiance: channels.light(radiance), density }
            }
        })
    }

    /// The same for a light that is no shape; out of line, so that area lights do not pay for it.
    #[inline(never)]
    fn sample_without_surface(
        &self,
        light: &Light,
        from: Vec3,
        u: [f32; 2],
    ) -> Option<LightSample> {
        match light {
            Light::Area(_) => None,
            Light::Beam(light) => light.sample(self.shape_of(light.shape), &self.textures, from),
            Light::Point(light) => light.sample(from),
            Light::Spot(light) => light.sample(from, &self.textures),
            Light::Projector(light) => light.sample(from, &self.textures),
            Light::Directional(light) => light.sample(),
            Light::Constant(light) => light.sample(u),
            Light::Environment(light) => light.sample(u),
        }
    }

    /// Density per steradian at `from` with which [`sample_light`](Self::sample_light) draws a point
    /// that a ray has hit, given the light and its primitive; 0 for a light that is no shape.
    #[inline(always)]
    pub fn light_pdf_hit(&self, light: LightId, from: Vec3, hit: &SurfacePoint) -> f32 {
        match self.lights.get(light.0 as usize) {
            Some(Light::Area(area)) => self.shape_of(area.shape).pdf_from(from, hit),
            _ => 0.0,
        }
    }

    /// Radiance from a unit direction of one light infinitely far away, and the density per steradian with which
    /// [`sample_light`](Self::sample_light) draws that direction for it; nothing of every other light, and of a directional one.
    #[inline]
    pub fn escaped(&self, light: LightId, direction: Vec3) -> (Color, f32) {
        match self.lights.get(light.0 as usize) {
            Some(Light::Constant(light)) => (light.radiance, light.pdf()),
            Some(Light::Environment(light)) => light.radiance_and_pdf(direction),
            _ => (Color::black(), 0.0),
        }
    }

    /// The light that a surface is, and the radiance that leaves it towards `direction`; `None` for
    /// a surface that does not emit, and from behind.
    #[inline(always)]
    pub fn emitted<C: Channels>(
        &self,
        hit: &SurfacePoint,
        direction: Vec3,
        channels: C,
    ) -> Option<(LightId, C::Color)> {
        let id = self.surfaces[hit.shape.0 as usize].light?;
        match self.lights.get(id.0 as usize)? {
            Light::Area(area) => {
                Some((id, area.emitted(&self.textures, hit, direction, channels)?))
            }
            _ => None,
        }
    }

    /// Radiance from infinitely far away, from a unit direction: the sum over all lights there.
    pub fn background(&self, direction: Vec3) -> Color {
        self.infinite_lights.iter().fold(Color::black(), |sum, &id| {
            sum + match &self.lights[id.0 as usize] {
                Light::Constant(light) => light.radiance,
                Light::Environment(light) => light.radiance(direction),
                _ => Color::black(),
            }
        })
    }

    /// The lights infinitely far away, directional ones included.
    pub fn infinite_lights(&self) -> &[LightId] {
        &self.infinite_lights
    }

    /// Every light with a place, area lights primitive by primitive; those that emit nothing are
    /// left out.
    pub fn finite_lights(&self) -> Vec<(LightId, u32, LightBounds)> {
        let mut list = Vec::new();
        for (index, light) in self.lights.iter().enumerate() {
            let id = LightId(index as u32);
            match light {
                Light::Area(area) => {
                    let shape = self.shape_of(area.shape);
                    let of = |i| LightBounds::of_primitive(*area, shape, &self.textures, i);
                    let primitives = 0..shape.primitive_count();
                    list.extend(primitives.filter_map(|i| Some((id, i, of(i)?))));
                }
                Light::Beam(light) => {
                    let shape = self.shape_of(light.shape);
                    list.push((id, 0, LightBounds::of_beam(*light, shape, &self.textures)));
                }
                Light::Point(light) => list.push((id, 0, LightBounds::of_point(light))),
                Light::Spot(light) => {
                    list.push((id, 0, LightBounds::of_spot(light, &self.textures)));
                }
                Light::Projector(light) => {
                    list.push((id, 0, LightBounds::of_projector(light, &self.textures)));
                }
                Light::Directional(_) | Light::Constant(_) | Light::Environment(_) => {}
            }
        }
        list.retain(|(_, _, bounds)| bounds.power > 0.0);
        list
    }

    /// Power Φ in W: of a light with a place all that it emits, of one infinitely far away what
    /// passes through a sphere around the shapes; 0 for a light that does not exist.
    pub fn light_power(&self, light: LightId) -> f32 {
        match self.lights.get(light.0 as usize) {
            Some(Light::Area(area)) => {
                area.power(&self.textures, self.shape_of(area.shape).area_total())
            }
            Some(Light::Beam(light)) => {
                light.power(&self.textures, self.shape_of(light.shape).area_total())
            }
            Some(Light::Point(light)) => light.power(),
            Some(Light::Spot(light)) => light.power(&self.textures),
            Some(Light::Projector(light)) => light.power(&self.textures),
            Some(Light::Directional(light)) => light.power(self.radius),
            Some(Light::Constant(light)) => light.power(self.radius),
            Some(Light::Environment(light)) => light.power(self.radius),
            None => 0.0,
        }
    }
}
