//! What a scene file says, before it means anything.

use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;
use std::path::PathBuf;

use etendue_math::glam::{DMat4, DVec3};

use super::SearchPath;
use crate::{Location, Warning};

/// The kinds of plugins, one per element name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The root.
    Scene,
    /// Light transport algorithm.
    Integrator,
    /// Camera.
    Sensor,
    /// Source of sample positions.
    Sampler,
    /// Picture.
    Film,
    /// Reconstruction filter.
    ReconstructionFilter,
    /// Geometry.
    Shape,
    /// Surface scattering model.
    Bsdf,
    /// Texture, or `<spectrum type="…">`.
    Texture,
    /// Light source.
    Emitter,
    /// Participating medium.
    Medium,
    /// Phase function.
    Phase,
    /// Volume texture.
    Volume,
}

impl Kind {
    /// All kinds with their element names.
    pub(crate) const ALL: [(&'static str, Self); 13] = [
        ("scene", Self::Scene),
        ("integrator", Self::Integrator),
        ("sensor", Self::Sensor),
        ("sampler", Self::Sampler),
        ("film", Self::Film),
        ("rfilter", Self::ReconstructionFilter),
        ("shape", Self::Shape),
        ("bsdf", Self::Bsdf),
        ("texture", Self::Texture),
        ("emitter", Self::Emitter),
        ("medium", Self::Medium),
        ("phase", Self::Phase),
        ("volume", Self::Volume),
    ];

    /// The kind an element name stands for.
    pub fn from_tag(tag: &str) -> Option<Self> {
        Self::ALL.iter().find(|(name, _)| *name == tag).map(|&(_, kind)| kind)
    }

    /// The element name.
    pub fn tag(self) -> &'static str {
        Self::ALL.iter().find(|(_, kind)| *kind == self).map_or("", |(name, _)| name)
    }
}

/// A spectrum as a scene file gives it.
#[derive(Clone, Debug, PartialEq)]
pub enum SpectrumValue {
    /// The same value at every wavelength.
    Uniform(f64),
    /// Wavelengths in nanometres, increasing, and the values there; at least two.
    Samples(Vec<(f64, f64)>),
}

/// The value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// `<boolean>`
    Boolean(bool),
    /// `<integer>`
    Integer(i64),
    /// `<float>`, finite
    Float(f64),
    /// `<string>`
    String(String),
    /// `<vector>` or `<point>`, finite
    Vector(DVec3),
    /// `<rgb>`, linear, finite
    Rgb([f64; 3]),
    /// `<spectrum>`
    Spectrum(SpectrumValue),
    /// `<transform>`, finite, the product of its operations
    Transform(DMat4),
    /// `<animation>`
    Animation(Vec<Keyframe>),
}

/// A `<transform time="…">` of an animation.
#[derive(Clone, Debug, PartialEq)]
pub struct Keyframe {
    /// When, finite.
    pub time: f64,
    /// The product of its operations, finite.
    pub matrix: DMat4,
    /// Where.
    pub location: Location,
}

impl Value {
    /// What it is called in messages.
    pub(crate) fn noun(&self) -> &'static str {
        match self {
            Self::Boolean(_) => "boolean",
            Self::Integer(_) => "integer",
            Self::Float(_) => "float",
            Self::String(_) => "string",
            Self::Vector(_) => "vector",
            Self::Rgb(_) => "rgb colour",
            Self::Spectrum(_) => "spectrum",
            Self::Transform(_) => "transform",
            Self::Animation(_) => "animation",
        }
    }
}

/// A named parameter and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Property {
    /// Name, in snake_case.
    pub name: String,
    /// Value.
    pub value: Value,
    /// Where.
    pub location: Location,
}

/// Index of a [`Node`] in its [`Description`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub(crate) usize);

/// A plugin inside another, in place or by reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Child {
    /// The parameter it stands for; empty where the kind alone says it.
    pub name: String,
    /// The plugin.
    pub node: NodeId,
    /// Where it stands, or where the reference to it stands.
    pub location: Location,
}

/// One plugin with its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Kind.
    pub kind: Kind,
    /// Plugin type, `scene` for the root.
    pub plugin: String,
    /// The name by which others refer to it.
    pub id: Option<String>,
    /// Where.
    pub location: Location,
    /// Parameters, in order.
    pub properties: Vec<Property>,
    /// Plugins inside, in order.
    pub children: Vec<Child>,
    /// Where the files it names are looked for.
    pub search: SearchPath,
}

/// A scene file with everything it includes.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    pub(crate) nodes: Vec<Node>,
    pub(crate) root: NodeId,
    /// The names plugins have, aliases included.
    pub ids: BTreeMap<String, NodeId>,
    /// Every file read.
    pub files: Vec<PathBuf>,
    /// What looks suspicious.
    pub warnings: Vec<Warning>,
}

impl Description {
    /// The outermost plugin.
    pub fn root(&self) -> &Node {
        &self.nodes[self.root.0]
    }

    /// A plugin. `id` comes from this description.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.0]
    }

    /// All plugins in the order in which they appear.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }
}
