//! Choosing the light to sample: by power, distance and orientation.

mod build;
mod cluster;
mod cone;
mod node;
mod receiver;
mod tree;
pub use receiver::{Receiver, Sides};
