//! glTF 2.0: a translation into our vocabulary.
//!
//! A document is JSON, by itself or in a binary container, that describes what its buffers and images are. [`load`] gives a
//! [`Model`]: what the file describes and nothing else. What a scene needs beyond that, such as light and a camera where there
//! are none, is added by whoever asked for it.
//!
//! Files are not trusted: whatever they say is checked before it is used, indices and lengths before memory is allocated for
//! them, and what is wrong is an error that names the file and the place in the document.
//!
//! # Source
//! Khronos Group, "glTF 2.0 Specification", 2.0.1, 2021, and its registered extensions.

mod accessor;
mod base64;
mod buffers;
mod builder;
mod camera;
mod document;
mod glass;
mod glb;
mod image;
mod instances;
mod json;
mod light;
mod material;
mod mesh;
mod node;
mod principled;
mod shapes;
mod skin;
mod texture;
mod topology;
mod uri;

#[cfg(test)]
mod tests;

use alloc::vec::Vec;
use std::path::Path;

pub(crate) use builder::Model;
pub(crate) use camera::View;

use buffers::Buffers;
use builder::Builder;
use document::Document;
use json::Json;

use crate::effect::Element;
use crate::light::LightId;
use crate::load::Sandbox;
use crate::{Color, SceneError};

/// Reads a file and those that it names, which must lie in the sandbox.
///
/// # Errors
/// Files that cannot be read, content that is wrong or not supported, and demands for too much memory, each with its place.
pub(crate) fn load(path: &Path, sandbox: &Sandbox) -> Result<Model, SceneError> {
    translate(&Document::read(path, sandbox)?)
}

/// Translates everything that the scene of a document holds.
fn translate(document: &Document) -> Result<Model, SceneError> {
    let mut files = Vec::new();
    let buffers = Buffers::load(document, &mut files)?;
    let mut builder = Builder::new(&buffers);
    builder.model.files = files;
    if let Some(warning) = document.unknown_extensions()? {
        builder.warn(&warning);
    }
    if !document.list("animations")?.is_empty() {
        let message = "animations are not read: everything is where it is at rest";
        builder.warn(&document.root().need("animations")?.warning(message));
    }
    let nodes = node::all(document)?;
    builder.model.view = camera::first(document, &nodes)?;
    shapes::add(&mut builder, &nodes)?;
    for node in &nodes {
        if let Some((light, json)) = light::of(document, node)? {
            let id = LightId(builder.model.lights.len() as u32);
            builder.note(Element::Light(id), &json)?;
            builder.model.lights.push(light);
        }
    }
    Ok(builder.model)
}

/// A colour: three numbers that are not negative.
fn color(json: &Json<'_>, name: &str, default: [f32; 3]) -> Result<Color, SceneError> {
    let Some(numbers) = json.numbers::<3>(name)? else { return Ok(default.into()) };
    if numbers.iter().all(|x| *x >= 0.0) {
        Ok(numbers.map(|x| x as f32).into())
    } else {
        Err(json.error(alloc::format!("“{name}” must be three numbers that are not negative")))
    }
}
