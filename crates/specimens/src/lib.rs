//! One specimen of every model and function of the core crates, and streams of inputs for them.
//!
//! Benches, instruction counts, fuzz targets, firmware and the test of bits all want "every model": they
//! take it from here, so that a new model is one line in [`models`](mod@models) for all of them.
//!
//! - [`Specimen`]: a model's name and how it is built from [`Parameters`], typical or hostile ones;
//! - [`for_each`]: all of them, each as its own type, so that a program can contain just one;
//! - [`Inputs`]: directions and numbers addressed by index, the same bits on every target;
//! - [`functions`]: the functions below the models, by name;
//! - [`bits`]: hashes of what they all return, which every target must reproduce.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(test)]
extern crate alloc;
#[cfg(test)]
extern crate std;

pub mod bits;
pub mod functions;
mod inputs;
pub mod models;
mod parameters;

use etendue_math::{Real, Spectrum};

pub use inputs::Inputs;
pub use models::{Each, Specimen, Visitor, for_each};
pub use parameters::{Hostile, Parameters, Typical};

/// `f32` or `f64`, used both as a real number and as a colour of one channel.
pub trait Scalar: Real + Spectrum<Real = Self> {
    /// `"f32"` or `"f64"`.
    const NAME: &'static str = if Self::SIGNIFICAND_BITS == 24 { "f32" } else { "f64" };
}

impl<T: Real + Spectrum<Real = T>> Scalar for T {}
