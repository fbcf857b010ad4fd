//! Reflection models.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(any(feature = "std", test))]
extern crate std;

mod bsdf;

pub use bsdf::{Bsdf, BsdfReal, BsdfVec, Density, Lobes, Sample};
