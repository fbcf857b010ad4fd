//! Renders on disk: checkpoints that are never lost, and parts of renders.
//!
//! | file | what it does |
//! | --- | --- |
//! | `store` | the operations of a file system that a checkpoint needs |
//! | `generations` | the order of them in which no crash costs anything |
//! | `envelope` | the bytes of a stored render, with a checksum |
//! | `identity` | what it is a render of, and how that differs from another |
//! | `recipe` | the command line that made it |
//! | `keeper` | writes a checkpoint now and then, on a thread of its own |
//! | `shard` | a part of the samples |
//! | `part` | what was drawn of it, behind its picture |

mod content;
mod envelope;
mod generations;
mod identity;
mod keeper;
mod lock;
mod part;
mod recipe;
mod shard;
#[cfg(test)]
mod simulated;
mod store;

pub(crate) use envelope::{Header, State, Stored};
pub(crate) use generations::folder;
pub(crate) use identity::Identity;
pub(crate) use keeper::{Keeper, Target};
pub(crate) use part::Part;
pub(crate) use recipe::{Changes, Recipe};
pub(crate) use shard::Shard;
