//! Loading: from a scene file or a bare mesh to a [`Scene`](crate::Scene).
//!
//! Scene files are Mitsuba's; [`crate::xml`] reads them into a description and this module gives it a
//! meaning. Every plugin is one function that asks a reader for its parameters; parameters that
//! nobody asks for are errors that list those that exist, or warnings when
//! [lenient](crate::xml::Leniency::Lenient). Each family of plugins has one table of names and functions, from
//! which messages about unknown plugins are made as well: adding a plugin is one function and one
//! line.
//!
//! Plugins keep Mitsuba's definitions, so that pictures agree. Where this project has an exact form,
//! it is a further parameter of the same plugin: `masking`, `smith_lambda`, `internal_reflectance`.

mod bare;
mod bsdf;
mod conductors;
mod context;
mod dispersion;
mod emitter;
mod field_of_view;
mod film;
mod framing;
mod image;
mod integrator;
mod ior;
mod load;
mod medium;
mod mtl;
mod origins;
mod reader;
mod sampler;
mod scene;
mod sensor;
mod shape;
mod spectrum;
mod texture;
mod value;

#[cfg(test)]
mod tests;

use context::{Context, Family};
pub use load::{LoadOptions, LoadedScene, load_scene};
pub use origins::{Origin, Origins};
