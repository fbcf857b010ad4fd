//! What is odd about a scene before it is rendered.

use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use etendue_math::Spectrum;

use crate::Scene;
use crate::light::Light;
use crate::material::{Material, MaterialId};
use crate::printable::printable;
use crate::scene::Shows;

/// Something that makes a picture other than its author expects.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Diagnosis {
    /// No light emits anything.
    NoLight,
    /// Emitters are hidden and paths too short to reach them by way of a surface.
    NoPath,
    /// There is nothing to be seen but lights.
    NoShape,
    /// Surfaces that reflect only into single directions, lit only by points and single directions.
    SpecularUnderDeltaLights {
        /// The first such shape.
        shape: String,
        /// How many there are.
        count: usize,
    },
}

impl fmt::Display for Diagnosis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoLight => f.write_str("no light can be seen: the image will be black"),
            Self::NoPath => f.write_str(
                "paths end before any light can be seen (max_depth is too small): the image will be black",
            ),
            Self::NoShape => f.write_str("there are no shapes: only the background can be seen"),
            Self::SpecularUnderDeltaLights { shape, count } => write!(
                f,
                "{} (of {count} such) is perfectly specular and all lights are points or parallel \
                 light: it reflects none of them; make the material rough or a light extended",
                printable(shape.clone())
            ),
        }
    }
}

impl Scene {
    /// What is odd about the scene, most serious first.
    pub fn diagnose(&self) -> Vec<Diagnosis> {
        let mut found = Vec::new();
        let emits = |light: &Light| match light {
            Light::Area(area) => !self.textures.max(area.radiance).is_black(),
            Light::Beam(beam) => !self.textures.max(beam.exitance).is_black(),
            Light::Point(light) => !light.intensity.is_black(),
            Light::Spot(light) => light.power(&self.textures) > 0.0,
            Light::Projector(light) => light.power(&self.textures) > 0.0,
            Light::Directional(light) => !light.irradiance.is_black(),
            Light::Constant(light) => !light.radiance.is_black(),
            Light::Environment(light) => light.power(1.0) > 0.0,
        };
        let shortest =
            if self.path.hide_emitters || self.lights.iter().all(Light::is_delta) { 2 } else { 1 };
        if self.path.shows == Shows::Distance {
            // Light does not matter.
        } else if !self.lights.iter().any(emits) {
            found.push(Diagnosis::NoLight);
        } else if self.path.max_depth.is_some_and(|depth| depth < shortest) {
            found.push(Diagnosis::NoPath);
        }
        if self.surfaces.is_empty() {
            found.push(Diagnosis::NoShape);
        }
        if self.path.shows == Shows::Light
            && !self.lights.is_empty()
            && self.lights.iter().all(Light::is_delta)
        {
            let mut specular = self.surfaces.iter().filter(|s| self.is_specular(s.material));
            if let Some(first) = specular.next() {
                found.push(Diagnosis::SpecularUnderDeltaLights {
                    shape: first.name.clone(),
                    count: 1 + specular.count(),
                });
            }
        }
        found
    }

    /// Scatters only into directions of its own.
    fn is_specular(&self, id: MaterialId) -> bool {
        match self.materials.get(id) {
            Some(
                Material::Dielectric { roughness, .. } | Material::Conductor { roughness, .. },
            ) => roughness.is_none(),
            Some(Material::ThinDielectric { .. }) => true,
            Some(Material::Mask { nested, .. }) => self.is_specular(*nested),
            Some(Material::TwoSided { front, back }) => {
                self.is_specular(*front) && self.is_specular(*back)
            }
            _ => false,
        }
    }
}
