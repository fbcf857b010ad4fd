//! Real numbers in two precisions and two backends, vectors, spectra and numerics for rendering.
//!
//! Everything above this crate is written once, over [`Real`], and works in `f32` and `f64`. Float
//! functions come from one table with two backends, chosen by features:
//!
//! | feature | functions | bits |
//! | --- | --- | --- |
//! | `std` (default) | the platform's C library | may change with processor and library version |
//! | `libm` | the `libm` crate | the same on every IEEE 754 target; wins when both are on |
//! | `arch` | assembly square root and fma inside `libm` | unchanged, only faster without `std` |
//!
//! The crate never allocates, never panics on any input and holds no `unsafe` code.
//!
//! # Non-goals
//! No matrices, quaternions or SIMD types of its own: [`glam`] is re-exported for those.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(any(feature = "std", test))]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("etendue-math needs a float backend: enable the feature `std` or `libm`");

mod backend;
mod eighth_turn;
mod exact_sum;
mod frame;
mod hash;
pub mod quadrature;
mod real;
mod rgb;
mod sampled;
pub mod special;
mod spectrum;
mod sum;
mod vector;

pub use exact_sum::ExactSum;
pub use frame::Frame;
pub use glam;
pub use hash::{hash_u32, hash_u64, mix_u64};
pub use real::Real;
pub use rgb::Rgb;
pub use sampled::Sampled;
pub use spectrum::Spectrum;
pub use sum::CompensatedSum;
pub use vector::{Vec3, Vector3};
