//! Scenes: shapes, bounding volume hierarchy, materials, lights, cameras, and the files they come from.
#![no_std]
#![deny(unsafe_code)]

extern crate alloc;
#[cfg(any(feature = "std", test))]
extern crate std;

pub mod camera;
pub mod color;
pub mod effect;
#[cfg(feature = "std")]
pub mod export;
pub mod film;
pub mod geometry;
#[cfg(feature = "std")]
mod gltf;
pub mod light;
#[cfg(feature = "std")]
pub mod load;
pub mod material;
pub mod medium;
#[cfg(feature = "std")]
pub mod mitsuba;
pub mod scene;
pub mod texture;
#[cfg(feature = "std")]
pub mod xml;

mod diagnosis;
#[cfg(feature = "std")]
mod error;
mod parallel;
mod printable;

pub use diagnosis::Diagnosis;
pub use effect::Effect;
#[cfg(feature = "std")]
pub use error::{ErrorKind, Location, SceneError, Warning};
pub use light::{EmissionSides, Light, LightBounds, LightId, LightSample};
#[cfg(feature = "std")]
pub use mitsuba::{LoadOptions, LoadedScene, Origin, Origins, load_scene};
pub use printable::printable;
pub use scene::{PathSettings, SamplerKind, SamplingSettings, Scene, SceneParts, SurfaceInfo};

/// Linear RGB in the renderer's precision.
pub type Color = etendue_math::Rgb<f32>;
