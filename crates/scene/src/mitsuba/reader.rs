//! Reading the parameters of one plugin, and noticing those that nobody reads.

use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use etendue_math::glam::{DMat4, DVec3};

use super::Context;
use crate::geometry::{Animation, Placement, Transform, TransformError};
use crate::texture::UvTransform;
use crate::xml::{Child, Keyframe, Kind, Leniency, Node, Property, Value, nearest, parse_list};
use crate::{Location, SceneError, Warning};

/// The parameters of a plugin, each of which counts as read once it was asked for.
pub(super) struct PluginReader<'a> {
    node: &'a Node,
    properties_read: Vec<bool>,
    children_read: Vec<bool>,
    /// What was asked for: the parameters the plugin supports.
    supported: Vec<&'static str>,
}

impl<'a> PluginReader<'a> {
    pub(super) fn new(node: &'a Node) -> Self {
        Self {
            node,
            properties_read: vec![false; node.properties.len()],
            children_read: vec![false; node.children.len()],
            supported: Vec::new(),
        }
    }

    /// The plugin.
    pub(super) fn node(&self) -> &'a Node {
        self.node
    }

    /// Where the parameter `name` stands, or the plugin where it is not given.
    pub(super) fn location(&self, name: &str) -> Location {
        let properties = self.node.properties.iter().map(|p| (&p.name, &p.location));
        let mut all = properties.chain(self.node.children.iter().map(|c| (&c.name, &c.location)));
        all.find(|(n, _)| *n == name).map_or(&self.node.location, |(_, l)| l).clone()
    }

    /// An error at the parameter `name`.
    pub(super) fn error(&self, name: &str, message: impl Into<String>) -> SceneError {
        SceneError::scene(self.location(name), message)
    }

    /// Whether a parameter is given, by value or by plugin.
    pub(super) fn has(&self, name: &str) -> bool {
        self.node.properties.iter().any(|p| p.name == name)
            || self.node.children.iter().any(|c| c.name == name)
    }

    /// The parameter `name` as it stands.
    pub(super) fn property(&mut self, name: &'static str) -> Option<&'a Property> {
        self.supported.push(name);
        let at = self.node.properties.iter().position(|p| p.name == name)?;
        self.properties_read[at] = true;
        Some(&self.node.properties[at])
    }

    /// Parameters that have no influence on what is computed here.
    pub(super) fn ignore(&mut self, names: &[&'static str]) {
        for name in names {
            self.property(name);
        }
    }

    fn read<T>(
        &mut self,
        name: &'static str,
        noun: &str,
        get: impl FnOnce(&'a Value) -> Option<T>,
    ) -> Result<Option<T>, SceneError> {
        let Some(property) = self.property(name) else { return Ok(None) };
        get(&property.value).map(Some).ok_or_else(|| {
            let found = property.value.noun();
            self.error(name, format!("“{name}” must be a {noun}, not a {found}"))
        })
    }

    pub(super) fn float(&mut self, name: &'static str) -> Result<Option<f64>, SceneError> {
        self.read(name, "float", |value| match value {
            Value::Float(x) => Some(*x),
            Value::Integer(n) => Some(*n as f64),
            _ => None,
        })
    }

    /// A float for which `valid` holds; `domain` describes those in messages.
    pub(super) fn float_in(
        &mut self,
        name: &'static str,
        default: f64,
        domain: &str,
        valid: impl FnOnce(f64) -> bool,
    ) -> Result<f64, SceneError> {
        let value = self.float(name)?.unwrap_or(default);
        if valid(value) {
            Ok(value)
        } else {
            Err(self.error(name, format!("“{name}” must be {domain}, not {value}")))
        }
    }

    pub(super) fn integer(&mut self, name: &'static str) -> Result<Option<i64>, SceneError> {
        self.read(name, "whole number", |value| match value {
            Value::Integer(n) => Some(*n),
            _ => None,
        })
    }

    pub(super) fn boolean(
        &mut self,
        name: &'static str,
        default: bool,
    ) -> Result<bool, SceneError> {
        let read = self.read(name, "boolean", |value| match value {
            Value::Boolean(b) => Some(*b),
            _ => None,
        });
        Ok(read?.unwrap_or(default))
    }

    pub(super) fn string(&mut self, name: &'static str) -> Result<Option<&'a str>, SceneError> {
        self.read(name, "string", |value| match value {
            Value::String(text) => Some(text.as_str()),
            _ => None,
        })
    }

    /// The numbers of a string, separated by commas or blanks.
    pub(super) fn numbers(&mut self, name: &'static str) -> Result<Option<Vec<f64>>, SceneError> {
        let Some(text) = self.string(name)? else { return Ok(None) };
        let numbers = parse_list(text);
        let numbers = numbers.map_err(|item| format!("“{item}” in “{name}” is no number"));
        numbers.map(Some).map_err(|message| self.error(name, message))
    }

    /// One of a few words, letter case aside; the first where the parameter is missing.
    pub(super) fn choice<T: Copy>(
        &mut self,
        name: &'static str,
        choices: &[(&str, T)],
    ) -> Result<T, SceneError> {
        let text = self.string(name)?.unwrap_or(choices[0].0);
        let found = choices.iter().find(|(word, _)| word.eq_ignore_ascii_case(text));
        found.map(|&(_, choice)| choice).ok_or_else(|| {
            let words: Vec<_> = choices.iter().map(|(word, _)| *word).collect();
            let message = format!("“{text}” is no {name}");
            self.error(name, message).help(format!("known are {}", words.join(", ")))
        })
    }

    pub(super) fn vector(&mut self, name: &'static str) -> Result<Option<DVec3>, SceneError> {
        self.read(name, "vector", |value| match value {
            Value::Vector(v) => Some(*v),
            _ => None,
        })
    }

    fn matrix(&mut self, name: &'static str) -> Result<DMat4, SceneError> {
        if let Some(Property { value: Value::Animation(_), .. }) = self.property(name) {
            let message = format!("{} cannot move", self.title());
            return Err(self.error(name, message).help("shapes, instances and sensors can"));
        }
        let read = self.read(name, "transform", |value| match value {
            Value::Transform(matrix) => Some(*matrix),
            _ => None,
        });
        Ok(read?.unwrap_or(DMat4::IDENTITY))
    }

    /// A transform of space, the identity where the parameter is missing.
    pub(super) fn transform(&mut self, name: &'static str) -> Result<Transform, SceneError> {
        let matrix = self.matrix(name)?;
        transform(&matrix).map_err(|e| self.error(name, format!("“{name}”: {e}")))
    }

    /// A transform of space or an animation of it, as it is while the shutter is open.
    pub(super) fn placement(
        &mut self,
        name: &'static str,
        context: &mut Context<'_>,
    ) -> Result<Placement, SceneError> {
        let Some(Property { value: Value::Animation(keyframes), location, .. }) =
            self.property(name)
        else {
            return self.transform(name).map(Placement::Still);
        };
        let at = |keyframe: usize| {
            keyframes.get(keyframe).map_or(location, |keyframe| &keyframe.location).clone()
        };
        let placements = keyframes.iter().map(|Keyframe { time, matrix, location }| {
            let refused = |e| SceneError::scene(location.clone(), format!("“{name}”: {e}"));
            Ok((*time, transform(matrix).map_err(refused)?))
        });
        let animation = Animation::new(placements.collect::<Result<_, _>>()?).map_err(|e| {
            let at = e.keyframe().map_or_else(|| location.clone(), at);
            SceneError::scene(at, format!("“{name}”: {e}"))
        })?;
        let placement = animation.during(context.shutter);
        if let (Placement::Moving(_), Some(keyframe)) = (&placement, animation.half_turn()) {
            let message = format!(
                "“{name}” turns by 180°, which leaves open which way round: a keyframe between says it"
            );
            context.warn(at(keyframe), message);
        }
        Ok(placement)
    }

    /// A transform of texture coordinates, the identity where the parameter is missing.
    pub(super) fn uv_transform(&mut self, name: &'static str) -> Result<UvTransform, SceneError> {
        let matrix = self.matrix(name)?;
        UvTransform::from_matrix4(matrix)
            .ok_or_else(|| self.error(name, format!("“{name}” has an entry that is out of range")))
    }

    /// The plugin that stands for the parameter `name`.
    pub(super) fn named_child(&mut self, name: &'static str) -> Option<&'a Child> {
        self.supported.push(name);
        let at = self.node.children.iter().position(|c| c.name == name)?;
        self.children_read[at] = true;
        Some(&self.node.children[at])
    }

    /// All plugins inside that are of one kind and were not read yet.
    pub(super) fn children(&mut self, kind: Kind, context: &Context<'a>) -> Vec<&'a Child> {
        let of_kind = |(at, child): (usize, &'a Child)| {
            let unread = !self.children_read[at];
            (unread && context.description.node(child.node).kind == kind).then_some((at, child))
        };
        let found: Vec<_> = self.node.children.iter().enumerate().filter_map(of_kind).collect();
        found
            .into_iter()
            .map(|(at, child)| {
                self.children_read[at] = true;
                child
            })
            .collect()
    }

    /// The only plugin inside of one kind, or none.
    pub(super) fn child(
        &mut self,
        kind: Kind,
        context: &Context<'a>,
    ) -> Result<Option<&'a Child>, SceneError> {
        match self.children(kind, context)[..] {
            [] => Ok(None),
            [child] => Ok(Some(child)),
            [_, second, ..] => {
                let message = format!("{} has more than one {}", self.title(), kind.tag());
                Err(SceneError::scene(second.location.clone(), message))
            }
        }
    }

    /// What the plugin is called in messages.
    pub(super) fn title(&self) -> String {
        format!("{} “{}”", self.node.kind.tag(), self.node.plugin)
    }

    /// Refuses parameters and plugins inside that were not read, or warns about them.
    pub(super) fn finish(self, context: &mut Context<'_>) -> Result<(), SceneError> {
        let properties = self.node.properties.iter().zip(&self.properties_read);
        let properties = properties.filter(|(_, read)| !**read).map(|(p, _)| {
            (&p.location, format!("{} has no parameter “{}”", self.title(), p.name), &p.name)
        });
        let children = self.node.children.iter().zip(&self.children_read);
        let children = children.filter(|(_, read)| !**read).map(|(c, _)| {
            let inner = context.description.node(c.node);
            let message =
                format!("{} cannot use a {} “{}”", self.title(), inner.kind.tag(), inner.plugin);
            (&c.location, message, &c.name)
        });
        let mut unread: Vec<_> = properties.chain(children).collect();
        unread.sort_by_key(|(location, ..)| (location.line, location.column));
        for (location, message, name) in unread {
            match context.options.leniency {
                Leniency::Lenient => {
                    context.warnings.push(Warning::new(location.clone(), message));
                }
                Leniency::Strict => return Err(self.unknown(location, message, name)),
            }
        }
        Ok(())
    }

    fn unknown(&self, location: &Location, message: String, name: &str) -> SceneError {
        let error = SceneError::scene(location.clone(), message);
        let mut supported = self.supported.clone();
        supported.sort_unstable();
        supported.dedup();
        let list = supported.join(", ");
        match nearest(name, supported) {
            Some(known) => error.help(format!("did you mean “{known}”? It has {list}")),
            None if list.is_empty() => error.help("it has no parameters"),
            None => error.help(format!("it has {list}")),
        }
    }
}

fn transform(matrix: &DMat4) -> Result<Transform, TransformError> {
    Transform::from_rows(matrix.transpose().to_cols_array_2d())
}
