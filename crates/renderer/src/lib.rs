//! Path tracing of étendue scenes.
//!
//! [`Renderer`] turns an [`etendue_scene::Scene`] and [`RenderSettings`] into an [`Image`] by
//! unidirectional path tracing of the rendering equation: emission, light sampling and scattering
//! combined by multiple importance sampling, Russian roulette, paths of given or any length.
//!
//! # Examples
//! ```
//! use core::sync::atomic::AtomicBool;
//! use etendue_renderer::{RenderSettings, Renderer};
//! # use etendue_math::glam::DVec3;
//! # use etendue_scene::{Scene, camera::*, film::Film, geometry::*, light::*, scene::*};
//! # let fov = FieldOfView::Angle { degrees: 40.0, axis: FovAxis::X };
//! # let pinhole = Projection::Perspective { field_of_view: fov, principal_point_offset: [0.0; 2] };
//! # let view = Transform::look_at(DVec3::ZERO, DVec3::Y, DVec3::Z)?;
//! # let radiance = [0.25, 0.5, 1.0].into();
//! # let scene = Scene::new(SceneParts {
//! #     geometry: GeometryBuilder::new().build(),
//! #     surfaces: Vec::new(),
//! #     materials: Default::default(),
//! #     textures: Default::default(),
//! #     lights: vec![Light::Constant(ConstantLight { radiance })],
//! #     media: Default::default(),
//! #     camera: Camera::new(pinhole, view, 0.01, 1e4, [8, 8])?,
//! #     film: Film::new([8, 8]),
//! #     sampling: SamplingSettings::default(),
//! #     path: PathSettings::default(),
//! # })?;
//! // A scene that is nothing but a bluish sky.
//! let settings = RenderSettings { samples_per_pixel: 4, ..RenderSettings::of_scene(&scene) };
//! let renderer = Renderer::new(&scene, settings)?;
//! let rendering = renderer.render(&|progress| drop(progress), &AtomicBool::new(false));
//! assert_eq!(rendering.image.size(), [8, 8]);
//! assert!((rendering.image.mean().b - 1.0).abs() < 0.01);
//! assert_eq!(rendering.statistics.non_finite.count(), 0);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! # Invariants
//! - The same scene, settings and version give the same bits for any number of threads and any
//!   order of tiles: random numbers are addressed by (seed, pixel, sample, decision), pixels own
//!   their samples, and statistics merge in any order.
//! - Nothing is clamped and nothing dropped in silence: a sample that is NaN or infinite is counted
//!   and located in [`Statistics`], and [`Renderer::sample`] computes it again.
//! - No allocation and no dynamic dispatch per sample.
//!
//! # Modules of interest
//! | type | what it decides |
//! | --- | --- |
//! | [`FilterSampler`] | where in a pixel's neighbourhood a sample lies |
//! | [`LightSampler`] | which light is sampled for a point: a light tree |
//! | [`Strategy`] | how light is found: both ways, or one of them |
//! | [`Renderer::render_with_reuse`] | what neighbouring paths lend each other, how many samples a pixel is worth |
//! | [`Accumulation`] | what a render knows that is stopped, stored, continued, divided and joined |
//! | [`Renderer::replay`] | what happened along the path of one sample |
//! | [`progressive`] | how many samples a pixel gets, when a picture is accurate enough |
//! | [`Features`] | what pixels show, for compositing and denoising |
//! | [`image_metrics`] | how far two pictures are apart |
//!
//! # Non-goals
//! No bidirectional methods, no denoising, no tone mapping, no files: pictures leave as linear
//! radiance.

extern crate alloc;

mod accumulation;
mod bad_samples;
mod canvas;
mod codec;
mod configuration;
mod features;
mod film;
pub mod image_metrics;
#[cfg(test)]
mod laws;
mod light_sampler;
mod path;
mod pilot;
pub mod progressive;
mod render;
mod renderer_error;
mod replay;
mod settings;
mod statistics;
mod tile;

pub use accumulation::Accumulation;
pub use bad_samples::{BadSamples, SampleAddress};
pub use codec::StateError;
pub use configuration::Configuration;
pub use features::Features;
pub use film::{FilmSample, FilterSampler, Image, PixelFilter, PixelSum};
pub use light_sampler::{LightChoice, LightSampler, Receiver, Sides};
pub use pilot::ReuseState;
pub use render::{Progress, Renderer, Rendering};
pub use renderer_error::RendererError;
pub use replay::{Cut, Found, Replay, Step, TracedRay};
pub use settings::{Airlight, RenderSettings, Strategy};
pub use statistics::{RayCounts, Statistics};

/// The examples of the project's README, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
