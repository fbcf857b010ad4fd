//! Choosing among the lights that are single points.

use etendue_math::glam::Vec3;
use etendue_sampling::Tabulated1d;
use etendue_scene::Scene;
use etendue_scene::light::LightId;

/// Chooses a light of a single point for a whole ray, by power alone: where along the ray it is near is not known yet.
#[derive(Clone, Debug, Default)]
pub(crate) struct PointLights {
    lights: Vec<PointLight>,
    cdf: Vec<f32>,
    /// Place in `lights` of each light of the scene.
    place_of: Vec<Option<usize>>,
}

/// A light of a single point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PointLight {
    pub(crate) light: LightId,
    pub(crate) position: Vec3,
    /// With which it is chosen.
    pub(crate) probability: f32,
}

impl PointLights {
    /// Those of a scene that have power.
    pub(crate) fn new(scene: &Scene) -> Self {
        let mut lights = Vec::new();
        let mut powers = Vec::new();
        let mut place_of = vec![None; scene.lights.len()];
        for (id, light) in (0..).map(LightId).zip(&scene.lights) {
            let power = scene.light_power(id);
            if let Some(position) = light.position()
                && power > 0.0
                && power.is_finite()
            {
                place_of[id.0 as usize] = Some(lights.len());
                lights.push(PointLight { light: id, position, probability: 0.0 });
                powers.push(power);
            }
        }
        let mut cdf = vec![0.0; lights.len() + 1];
        let Ok(table) = Tabulated1d::build(&powers, &mut cdf) else { return Self::default() };
        for (place, light) in lights.iter_mut().enumerate() {
            light.probability = table.probability(place);
        }
        Self { lights, cdf, place_of }
    }

    /// Whether there is none.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.lights.is_empty()
    }

    /// One of them by a uniform number in `[0, 1)`; `None` where there is none.
    #[inline]
    pub(crate) fn choose(&self, u: f32) -> Option<PointLight> {
        let table = Tabulated1d::from_cdf(&self.cdf)?;
        Some(self.lights[table.choose(u).index])
    }

    /// The one of this name; `None` for every other light.
    #[inline]
    pub(crate) fn get(&self, light: LightId) -> Option<PointLight> {
        let place = *self.place_of.get(light.0 as usize)?;
        place.map(|place| self.lights[place])
    }
}
