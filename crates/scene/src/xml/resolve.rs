//! References from plugin to plugin.

use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use super::description::{Child, Node, NodeId};
use super::nearest::nearest;
use super::parse::{Leniency, Parser};
use crate::{Location, SceneError};

/// A `<ref>` whose target may come later in the file.
#[derive(Clone, Debug)]
pub(super) struct Reference {
    /// The plugin that holds it.
    pub(super) from: NodeId,
    /// The id it names.
    pub(super) to: String,
    /// The parameter it stands for.
    pub(super) name: String,
    /// How many children come before it in the plugin, other references not counted.
    pub(super) position: usize,
    /// Where it stands.
    pub(super) location: Location,
}

/// Plugins that contain each other, by nesting or reference, beyond which a scene is refused.
const LONGEST_CHAIN: usize = 128;

/// Replaces references by children of the plugins that hold them.
///
/// # Errors
/// A name that no plugin has (a warning when lenient), a plugin that contains itself.
pub(super) fn resolve(parser: &mut Parser, leniency: Leniency) -> Result<(), SceneError> {
    // By plugin; those of one stand in the order of the file.
    let mut references = core::mem::take(&mut parser.references);
    references.sort_by_key(|reference| reference.from);
    let mut references = references.into_iter().peekable();
    while let Some(from) = references.peek().map(|reference| reference.from) {
        let mut own = core::mem::take(&mut parser.nodes[from.0].children).into_iter();
        let mut children = Vec::new();
        let mut before = 0;
        while let Some(reference) = references.next_if(|reference| reference.from == from) {
            let Reference { to, name, position, location, .. } = reference;
            children.extend(own.by_ref().take(position - before));
            before = position;
            match parser.ids.get(&to) {
                Some(&node) => children.push(Child { name, node, location }),
                None => parser.dangling(leniency, &to, location)?,
            }
        }
        children.extend(own);
        parser.nodes[from.0].children = children;
    }
    check_chains(&parser.nodes)
}

impl Parser {
    /// Refuses a reference to nothing, or leaves it out with a warning.
    fn dangling(
        &mut self,
        leniency: Leniency,
        to: &str,
        location: Location,
    ) -> Result<(), SceneError> {
        let error = SceneError::scene(location, format!("nothing has the id “{to}”"));
        // A warning has no advice, which takes a look at all names.
        let ids = (leniency == Leniency::Strict).then_some(&self.ids);
        let known = ids.and_then(|ids| nearest(to, ids.keys().map(String::as_str)));
        let error = match known {
            Some(known) => error.help(format!("did you mean “{known}”?")),
            None => error,
        };
        self.forgive(leniency, error)
    }
}

/// Refuses plugins that contain themselves, and chains of plugins so long that walking them could
/// exhaust the stack.
fn check_chains(nodes: &[Node]) -> Result<(), SceneError> {
    let mut heights = vec![None; nodes.len()];
    (0..nodes.len()).try_for_each(|i| height(nodes, i, &mut Vec::new(), &mut heights).map(drop))
}

fn height(
    nodes: &[Node],
    node: usize,
    path: &mut Vec<usize>,
    heights: &mut [Option<usize>],
) -> Result<usize, SceneError> {
    if let Some(known) = heights[node] {
        return Ok(known);
    }
    let location = || nodes[node].location.clone();
    if let Some(start) = path.iter().position(|&n| n == node) {
        let names = path[start..].iter().chain([&node]).map(|&n| name(&nodes[n]));
        let circle = names.collect::<Vec<_>>().join(" → ");
        let message = format!("plugins contain each other in a circle: {circle}");
        return Err(SceneError::scene(location(), message));
    }
    path.push(node);
    let mut highest = 0;
    if path.len() <= LONGEST_CHAIN {
        for child in &nodes[node].children {
            highest = highest.max(1 + height(nodes, child.node.0, path, heights)?);
        }
    }
    if path.len() + highest > LONGEST_CHAIN {
        let message = format!("more than {LONGEST_CHAIN} plugins contain each other");
        return Err(SceneError::resource(location(), message));
    }
    path.pop();
    heights[node] = Some(highest);
    Ok(highest)
}

fn name(node: &Node) -> String {
    node.id.clone().unwrap_or_else(|| format!("<{} type=\"{}\">", node.kind.tag(), node.plugin))
}
