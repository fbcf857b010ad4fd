//! The subcommands.

pub(crate) mod accuracy;
pub(crate) mod brdf;
pub(crate) mod compare;
pub(crate) mod convert;
pub(crate) mod effects;
mod encoding_arguments;
pub(crate) mod info;
pub(crate) mod merge;
pub(crate) mod render;
pub(crate) mod resume;
mod scene_arguments;
mod selection;
pub(crate) mod values;
