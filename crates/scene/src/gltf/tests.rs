//! Small documents, built here, and what they become.

mod documents;
mod geometry;
mod hostile;
mod lights;
mod materials;
mod textures;

use alloc::string::String;
use alloc::vec::Vec;
use std::path::Path;

use etendue_math::glam::Vec3;
use serde_json::{Value, json};

use super::document::Document;
use super::{Model, glb, translate};
use crate::SceneError;
use crate::geometry::{Shape, TriangleMesh};

/// A document in the making: lists of objects, and the buffer that they are about.
struct Draft {
    root: Value,
    bytes: Vec<u8>,
}

impl Draft {
    fn new() -> Self {
        let root = json!({
            "asset": { "version": "2.0" },
            "accessors": [],
            "bufferViews": [],
            "buffers": [],
            "images": [],
            "materials": [],
            "meshes": [],
            "nodes": [],
            "textures": [],
        });
        Self { root, bytes: Vec::new() }
    }

    /// Adds an object to a list and returns its index.
    fn add(&mut self, list: &str, object: Value) -> usize {
        let list = self.root[list].as_array_mut().expect("a list");
        list.push(object);
        list.len() - 1
    }

    /// Adds a view of new bytes.
    fn view(&mut self, bytes: &[u8]) -> usize {
        let start = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        // Components stand at multiples of their size.
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let (start, length) = (start as u64, bytes.len() as u64);
        self.add("bufferViews", json!({ "buffer": 0, "byteOffset": start, "byteLength": length }))
    }

    /// Adds an accessor of numbers as bytes.
    fn accessor(&mut self, component: u32, kind: &str, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        let accessor =
            json!({ "bufferView": view, "componentType": component, "type": kind, "count": count });
        self.add("accessors", accessor)
    }

    /// Adds vectors of floats.
    fn floats<const N: usize>(&mut self, vectors: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = vectors.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        self.accessor(5126, kind, vectors.len(), &bytes)
    }

    /// Adds indices of 16 bits.
    fn indices(&mut self, indices: &[u16]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|x| x.to_le_bytes()).collect();
        self.accessor(5123, "SCALAR", indices.len(), &bytes)
    }

    /// Adds an image of bytes, as PNG.
    fn image(&mut self, size: [u32; 2], color: ::image::ExtendedColorType, bytes: &[u8]) -> usize {
        let mut png = Vec::new();
        let encoder = ::image::codecs::png::PngEncoder::new(&mut png);
        ::image::ImageEncoder::write_image(encoder, bytes, size[0], size[1], color)
            .expect("an image of this size");
        let view = self.view(&png);
        let image = self.add("images", json!({ "bufferView": view, "mimeType": "image/png" }));
        self.add("textures", json!({ "source": image }))
    }

    /// A square between −1 and 1 in the plane z = 0, whose front is seen from +z, as a primitive; the top left corner of its
    /// texture is its own.
    fn square(&mut self) -> Value {
        let position = self.floats(&[[-1., -1., 0.], [1., -1., 0.], [1., 1., 0.], [-1., 1., 0.]]);
        let uv = self.floats(&[[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]);
        let indices = self.indices(&[0, 1, 2, 0, 2, 3]);
        json!({
            "attributes": { "POSITION": position, "TEXCOORD_0": uv },
            "indices": indices,
        })
    }

    /// Adds a node with a mesh of these primitives.
    fn node(&mut self, primitives: &[Value]) -> usize {
        let mesh = self.add("meshes", json!({ "primitives": primitives }));
        self.add("nodes", json!({ "mesh": mesh }))
    }

    /// A square of a material, by itself.
    fn of_material(material: Value) -> Self {
        let mut draft = Self::new();
        draft.wear(material);
        draft
    }

    /// Adds a square of a material.
    fn wear(&mut self, material: Value) {
        let mut square = self.square();
        square["material"] = self.add("materials", material).into();
        self.node(&[square]);
    }

    /// The file: a binary container.
    fn glb(&self) -> Vec<u8> {
        let mut root = self.root.clone();
        if !self.bytes.is_empty() {
            root["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
        }
        container(&serde_json::to_vec(&root).expect("JSON"), &self.bytes)
    }

    fn load(&self) -> Result<Model, SceneError> {
        load(&self.glb())
    }

    fn model(&self) -> Model {
        self.load().unwrap_or_else(|error| panic!("{error}"))
    }

    /// The message of the error that there must be.
    fn error(&self) -> String {
        match self.load() {
            Ok(_) => panic!("no error of {}", self.root),
            Err(error) => alloc::format!("{error}"),
        }
    }
}

/// A binary container of a text and a buffer.
fn container(text: &[u8], buffer: &[u8]) -> Vec<u8> {
    let mut chunks = Vec::new();
    for (kind, content, filler) in [(b"JSON", text, b' '), (b"BIN\0", buffer, 0)] {
        let mut content = content.to_vec();
        content.resize(content.len().next_multiple_of(4), filler);
        chunks.extend_from_slice(&(content.len() as u32).to_le_bytes());
        chunks.extend_from_slice(kind);
        chunks.extend_from_slice(&content);
    }
    let mut file = glb::MAGIC.to_vec();
    file.extend_from_slice(&2_u32.to_le_bytes());
    file.extend_from_slice(&(chunks.len() as u32 + 12).to_le_bytes());
    file.extend_from_slice(&chunks);
    file
}

fn load(bytes: &[u8]) -> Result<Model, SceneError> {
    translate(&Document::parse(bytes, Path::new("model.glb"))?)
}

/// The meshes of all shapes.
fn meshes(model: &Model) -> Vec<TriangleMesh> {
    let geometry = model.geometry.clone().build();
    let mesh = |shape: &Shape| match shape {
        Shape::Mesh(mesh) => mesh.clone(),
        other => panic!("{other:?} is no mesh"),
    };
    geometry.shapes().iter().map(mesh).collect()
}

fn warnings(model: &Model) -> Vec<&str> {
    model.warnings.iter().map(|warning| warning.message.as_str()).collect()
}

/// The corners of all triangles.
fn corners(mesh: &TriangleMesh) -> Vec<[Vec3; 3]> {
    let corner = |vertex: u32| mesh.positions()[vertex as usize];
    mesh.triangles().iter().map(|triangle| triangle.map(corner)).collect()
}
