//! From the text of a scene file to its description.

use alloc::borrow::ToOwned;
use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use std::path::{Path, PathBuf};

use etendue_math::glam::DMat4;
use roxmltree::Node as Element;

use super::definitions::{Definitions, SubstitutionError};
use super::description::{Child, Description, Keyframe, Kind, Node, NodeId, Property, Value};
use super::names::{parse_version, snake_case, upgrade};
use super::nearest::nearest;
use super::resolve::{Reference, resolve};
use super::source::Source;
use super::{SearchPath, property, source};
use crate::load::Sandbox;
use crate::{Location, SceneError, Warning};

/// What to do with what is not understood but can be left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Leniency {
    /// It is an error.
    #[default]
    Strict,
    /// It is a warning.
    Lenient,
}

/// Plugins inside plugins, and includes inside includes, beyond which a file is refused.
const DEEPEST_NESTING: usize = 64;
const DEEPEST_INCLUDE: usize = 15;
/// Files that one scene may include, counting repetitions.
const MOST_INCLUDES: usize = 4096;

/// Bytes of all scene files of a scene together, counting repetitions.
const MOST_TEXT: usize = source::LARGEST_FILE;
/// Folders that are searched for files.
const MOST_FOLDERS: usize = 64;

/// Reads a scene file and everything it includes, which must lie in the sandbox.
///
/// `definitions` replace `$name` in attribute values and win over `<default>`.
///
/// # Errors
/// A file that cannot be read or is not XML; elements, attributes or values that a scene file does
/// not have; names that are not defined or defined twice; includes or references in a circle; files outside of the sandbox.
pub fn parse_file(
    path: &Path,
    definitions: &[(String, String)],
    leniency: Leniency,
    sandbox: &Sandbox,
) -> Result<Description, SceneError> {
    let text = source::read(path)?;
    parse(&text, path, definitions, leniency, sandbox)
}

/// Reads a scene from a text; `path` is its name in messages and the place relative file names start
/// from.
///
/// # Errors
/// As [`parse_file`].
pub fn parse_text(
    text: &str,
    path: &Path,
    definitions: &[(String, String)],
    leniency: Leniency,
) -> Result<Description, SceneError> {
    parse(text, path, definitions, leniency, &Sandbox::default())
}

fn parse(
    text: &str,
    path: &Path,
    definitions: &[(String, String)],
    leniency: Leniency,
    sandbox: &Sandbox,
) -> Result<Description, SceneError> {
    let mut parser = Parser {
        nodes: Vec::new(),
        ids: BTreeMap::new(),
        references: Vec::new(),
        definitions: Definitions::new(definitions),
        files: Vec::new(),
        warnings: Vec::new(),
        chain: Vec::new(),
        text: 0,
    };
    let root = parser.root(text, path, &SearchPath::within(sandbox))?;
    let unused = parser.definitions.unused();
    if !unused.is_empty() {
        let message = format!("nothing in the scene uses the definition {}", unused.join(", "));
        parser.forgive(leniency, SceneError::scene(Location::file(path), message))?;
    }
    resolve(&mut parser, leniency)?;
    let Parser { nodes, ids, files, warnings, .. } = parser;
    Ok(Description { nodes, root, ids, files, warnings })
}

/// The description under construction.
pub(super) struct Parser {
    pub(super) nodes: Vec<Node>,
    pub(super) ids: BTreeMap<String, NodeId>,
    pub(super) references: Vec<Reference>,
    definitions: Definitions,
    files: Vec<PathBuf>,
    warnings: Vec<Warning>,
    /// The file being read and those that include it, outermost first.
    chain: Vec<PathBuf>,
    /// Bytes of the files read so far.
    text: usize,
}

/// An element's attributes after substitution.
pub(super) type Attributes<'a> = Vec<(&'a str, String)>;

impl Parser {
    /// Returns the error, or keeps it as a warning.
    pub(super) fn forgive(&mut self, to: Leniency, e: SceneError) -> Result<(), SceneError> {
        match to {
            Leniency::Strict => Err(e),
            Leniency::Lenient => {
                self.warnings.push(Warning::new(e.location, e.message));
                Ok(())
            }
        }
    }

    fn root(&mut self, text: &str, path: &Path, search: &SearchPath) -> Result<NodeId, SceneError> {
        self.enter(path, &Location::file(path))?;
        self.text = text.len();
        let document = source::document(text, path)?;
        let mut source = Source::new(text, path, document.root_element(), search)?;
        let root = document.root_element();
        if root.tag_name().name() != "scene" {
            let message = format!("the outermost element is <{}>", root.tag_name().name());
            return Err(
                SceneError::scene(source.location(root), message).help("it must be <scene>")
            );
        }
        let (id, _) = self.object(&mut source, root, Kind::Scene, 0)?;
        self.chain.pop();
        Ok(id)
    }

    /// Notes that a file is being read, unless it is being read already.
    fn enter(&mut self, path: &Path, location: &Location) -> Result<(), SceneError> {
        let key = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let circle = self.chain.contains(&key);
        self.chain.push(key);
        self.files.push(path.to_owned());
        let problem = if circle {
            "a file includes itself"
        } else if self.chain.len() > DEEPEST_INCLUDE {
            "files include each other too deeply"
        } else if self.files.len() > MOST_INCLUDES {
            return Err(SceneError::resource(
                location.clone(),
                format!("more than {MOST_INCLUDES} files are included"),
            ));
        } else {
            return Ok(());
        };
        let chain: Vec<String> = self.chain.iter().map(|p| p.display().to_string()).collect();
        let message = format!("{problem}: {}", chain.join(" → "));
        Err(SceneError::scene(location.clone(), message))
    }

    /// The attributes of an element, with every `$name` replaced.
    fn attributes<'a>(
        &mut self,
        source: &Source<'_>,
        element: Element<'a, '_>,
    ) -> Result<Attributes<'a>, SceneError> {
        let mut attributes = Attributes::new();
        for attribute in element.attributes() {
            let value = self.definitions.substitute(attribute.value()).map_err(|error| {
                let location = source.at(attribute.range().start);
                let name = match error {
                    SubstitutionError::Undefined(name) => name,
                    SubstitutionError::TooLong(most) => {
                        let message =
                            format!("the values that names stand for grow beyond {most} bytes");
                        return SceneError::resource(location, message);
                    }
                };
                let error = SceneError::scene(location, format!("${name} is not defined"));
                match nearest(&name, self.definitions.names()) {
                    Some(known) => error.help(format!("did you mean ${known}?")),
                    None => error.help(format!(
                        "write <default name=\"{name}\" value=\"…\"/> before it, or pass -D {name}=…"
                    )),
                }
            })?;
            attributes.push((attribute.name(), value));
        }
        Ok(attributes)
    }

    /// A plugin and everything in it; also the parameter name it was given.
    fn object(
        &mut self,
        source: &mut Source<'_>,
        element: Element<'_, '_>,
        kind: Kind,
        depth: usize,
    ) -> Result<(NodeId, String), SceneError> {
        let location = source.location(element);
        if depth > DEEPEST_NESTING {
            let message = format!("plugins are nested more than {DEEPEST_NESTING} deep");
            return Err(SceneError::resource(location, message));
        }
        let attributes = self.attributes(source, element)?;
        let is_root = element.parent_element().is_none();
        let allowed: &[&str] =
            if is_root { &["version", "type", "id", "name"] } else { &["type", "id", "name"] };
        source.check_attributes(element, allowed)?;
        let get = |name| attributes.iter().find(|(n, _)| *n == name).map(|(_, v)| v.clone());
        let plugin = match (get("type"), kind) {
            (Some(plugin), _) => plugin,
            (None, Kind::Scene) => "scene".into(),
            (None, _) => return Err(source.missing_attribute(element, "type")),
        };
        let node = NodeId(self.nodes.len());
        let id = get("id");
        if let Some(id) = &id {
            self.name(id, node, &location)?;
        }
        let name = snake_case(&get("name").unwrap_or_default());
        self.nodes.push(Node {
            kind,
            plugin,
            id,
            location,
            properties: Vec::new(),
            children: Vec::new(),
            search: source.search.clone(),
        });
        self.content(source, element, node, depth)?;
        self.check_names(node)?;
        if source.is_before_version_2() {
            upgrade(&mut self.nodes[node.0])?;
        }
        // `<path>` may have come after the opening tag.
        self.nodes[node.0].search.clone_from(&source.search);
        Ok((node, name))
    }

    fn name(&mut self, id: &str, node: NodeId, location: &Location) -> Result<(), SceneError> {
        match self.ids.insert(id.into(), node) {
            None => Ok(()),
            Some(previous) => {
                let first = &self.nodes[previous.0].location;
                let message = format!("the id “{id}” is taken already, at {first}");
                Err(SceneError::scene(location.clone(), message))
            }
        }
    }

    /// Everything inside `element`, as the content of `node`.
    fn content(
        &mut self,
        source: &mut Source<'_>,
        element: Element<'_, '_>,
        node: NodeId,
        depth: usize,
    ) -> Result<(), SceneError> {
        for child in element.children().filter(Element::is_element) {
            self.element(source, child, node, depth)?;
        }
        Ok(())
    }

    fn element(
        &mut self,
        source: &mut Source<'_>,
        element: Element<'_, '_>,
        parent: NodeId,
        depth: usize,
    ) -> Result<(), SceneError> {
        let tag = element.tag_name().name();
        let is_plugin = tag != "spectrum" || element.has_attribute("type");
        let kind = if tag == "spectrum" { Some(Kind::Texture) } else { Kind::from_tag(tag) };
        if let (Some(kind), true) = (kind, is_plugin) {
            let (node, name) = self.object(source, element, kind, depth + 1)?;
            let location = source.location(element);
            self.nodes[parent.0].children.push(Child { name, node, location });
            return Ok(());
        }
        let attributes = self.attributes(source, element)?;
        let location = source.location(element);
        let required = |name: &str| {
            let found = attributes.iter().find(|(n, _)| *n == name).map(|(_, v)| v.as_str());
            found.ok_or_else(|| source.missing_attribute(element, name))
        };
        match tag {
            "default" => {
                source.check_attributes(element, &["name", "value"])?;
                source.check_empty(element)?;
                self.definitions.define_default(required("name")?, required("value")?);
            }
            "path" => {
                source.check_attributes(element, &["value"])?;
                source.check_empty(element)?;
                let folder = source.search.resolve(required("value")?);
                let folder = folder.map_err(|error| source.named(element, error))?;
                if source.search.len() >= MOST_FOLDERS {
                    let message = format!("more than {MOST_FOLDERS} folders are searched");
                    return Err(SceneError::resource(location, message));
                }
                if !folder.is_dir() {
                    let message = format!("there is no folder {}", folder.display());
                    return Err(SceneError::scene(location, message));
                }
                source.search.prepend(folder);
            }
            "ref" => {
                source.check_attributes(element, &["id", "name"])?;
                source.check_empty(element)?;
                let name = snake_case(required("name").unwrap_or_default());
                self.references.push(Reference {
                    from: parent,
                    to: required("id")?.into(),
                    name,
                    position: self.nodes[parent.0].children.len(),
                    location,
                });
            }
            "alias" => {
                source.check_attributes(element, &["id", "as"])?;
                source.check_empty(element)?;
                let id = required("id")?;
                let Some(&node) = self.ids.get(id) else {
                    let message = format!("there is no “{id}” before this alias");
                    return Err(SceneError::scene(location, message));
                };
                self.name(required("as")?, node, &location)?;
            }
            "include" => {
                source.check_attributes(element, &["filename", "name"])?;
                source.check_empty(element)?;
                let path = source.search.resolve(required("filename")?);
                let path = path.map_err(|error| source.named(element, error))?;
                let name = snake_case(required("name").unwrap_or_default());
                self.include(source, &path, parent, (&name, location), depth)?;
            }
            // Stands for the absence of a plugin.
            "null" => source.check_empty(element)?,
            "transform" => {
                source.check_attributes(element, &["name"])?;
                let name = snake_case(required("name")?);
                let value = Value::Transform(self.matrix(source, element)?);
                self.set(parent, Property { name, value, location });
            }
            "animation" => {
                source.check_attributes(element, &["name"])?;
                let name = snake_case(required("name")?);
                let keyframes = element.children().filter(Element::is_element);
                let keyframes = keyframes.map(|child| self.keyframe(source, child));
                let value = Value::Animation(keyframes.collect::<Result<_, _>>()?);
                self.set(parent, Property { name, value, location });
            }
            _ => {
                let (name, value) = property::value(source, element, &attributes)?;
                self.set(parent, Property { name: snake_case(name), value, location });
            }
        }
        Ok(())
    }

    /// The product of the operations inside a `<transform>`.
    fn matrix(
        &mut self,
        source: &Source<'_>,
        element: Element<'_, '_>,
    ) -> Result<DMat4, SceneError> {
        let mut operations = Vec::new();
        for child in element.children().filter(Element::is_element) {
            operations.push((child, self.attributes(source, child)?));
        }
        property::transform(source, &operations)
    }

    /// A `<transform time="…">` inside an `<animation>`.
    fn keyframe(
        &mut self,
        source: &Source<'_>,
        element: Element<'_, '_>,
    ) -> Result<Keyframe, SceneError> {
        let tag = element.tag_name().name();
        if tag != "transform" {
            let message = format!("<{tag}> cannot stand inside <animation>");
            return Err(source.error(element, message).help("write <transform time=\"…\">"));
        }
        let attributes = self.attributes(source, element)?;
        source.check_attributes(element, &["time"])?;
        let time = property::time(source, element, &attributes)?;
        let matrix = self.matrix(source, element)?;
        Ok(Keyframe { time, matrix, location: source.location(element) })
    }

    fn include(
        &mut self,
        source: &Source<'_>,
        path: &Path,
        parent: NodeId,
        (name, location): (&str, Location),
        depth: usize,
    ) -> Result<(), SceneError> {
        self.enter(path, &location)?;
        let through = |mut e: SceneError| {
            if e.location.line.is_none() {
                e.message = format!("{} (included at {location})", e.message);
            }
            e
        };
        let text = source::read(path).map_err(through)?;
        self.text = self.text.saturating_add(text.len());
        if self.text > MOST_TEXT {
            let message = format!(
                "with the files that it includes, the scene has more than {MOST_TEXT} bytes"
            );
            return Err(SceneError::resource(location, message).help(
                "keep meshes in files of their own, and make instances of what is repeated",
            ));
        }
        let document = source::document(&text, path)?;
        let root = document.root_element();
        let mut included = Source::new(&text, path, root, &source.search)?;
        let tag = root.tag_name().name();
        match Kind::from_tag(tag) {
            Some(Kind::Scene) => {
                included.check_attributes(root, &["version", "type", "id", "name"])?;
                self.content(&mut included, root, parent, depth + 1)?;
            }
            Some(kind) => {
                let (node, _) = self.object(&mut included, root, kind, depth + 1)?;
                self.nodes[parent.0].children.push(Child { name: name.into(), node, location });
            }
            None => return Err(included.unknown_element(root)),
        }
        self.chain.pop();
        Ok(())
    }

    fn set(&mut self, parent: NodeId, property: Property) {
        self.nodes[parent.0].properties.push(property);
    }

    /// Refuses names that are given twice.
    fn check_names(&self, node: NodeId) -> Result<(), SceneError> {
        let node = &self.nodes[node.0];
        // Plugins of a scene are many, and their names mean nothing there.
        if node.kind == Kind::Scene {
            return Ok(());
        }
        let properties = node.properties.iter().map(|p| (&p.name, &p.location));
        let children = node.children.iter().map(|c| (&c.name, &c.location));
        let mut named: Vec<_> =
            properties.chain(children).filter(|(name, _)| !name.is_empty()).collect();
        let place = |location: &Location| (location.line, location.column);
        named.sort_by(|(a, at), (b, bt)| a.cmp(b).then_with(|| place(at).cmp(&place(bt))));
        match named.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            None => Ok(()),
            Some(pair) => {
                let [(name, first), (_, second)] = [pair[0], pair[1]];
                let message = format!("“{name}” is given twice, the first time at {first}");
                Err(SceneError::scene(second.clone(), message))
            }
        }
    }
}

impl Source<'_> {
    fn is_before_version_2(&self) -> bool {
        self.version[0] < 2
    }

    /// The version the root element states.
    pub(super) fn parse_version(
        location: Location,
        root: Element<'_, '_>,
    ) -> Result<[u32; 3], SceneError> {
        let help = "write <scene version=\"3.0.0\">";
        let Some(text) = root.attribute("version") else {
            let message = format!("<{}> has no version", root.tag_name().name());
            return Err(SceneError::scene(location, message).help(help));
        };
        parse_version(text).ok_or_else(|| {
            SceneError::scene(location, format!("“{text}” is not a version")).help(help)
        })
    }
}
