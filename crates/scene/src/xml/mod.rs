//! Scene files as a description: elements, parameters and references, without their meaning.
//!
//! The format is the scene XML of Mitsuba 0.5, 0.6, 2.x and 3.x. Files of versions before 2 are brought
//! up to date while they are read (see [`parse_file`]), so that a [`Description`] knows one spelling.
//! `<include>`, `<ref>`, `<alias>`, `<default>` and `$name` are resolved here; what plugins and
//! parameters there are is not known here, but in [`crate::mitsuba`].

mod definitions;
mod description;
mod names;
mod nearest;
mod numbers;
mod parse;
mod places;
mod property;
mod resolve;
mod search;
mod source;
mod transform;

pub use description::{
    Child, Description, Keyframe, Kind, Node, NodeId, Property, SpectrumValue, Value,
};
pub(crate) use nearest::nearest;
pub(crate) use numbers::{parse_float, parse_list};
pub use parse::{Leniency, parse_file, parse_text};
pub(crate) use property::increasing;
pub use search::SearchPath;

#[cfg(test)]
mod tests;
