//! Random numbers with addresses, low-discrepancy points, warps and tabulated distributions.
//!
//! # Addresses
//! A random number is a pure function of (seed, pixel, sample index, [`Dimension`]), where a
//! dimension *names* a decision: "the direction at vertex 3". Nothing is drawn in sequence. Hence a
//! picture has the same bits for any number of threads, any order of tiles and any split of the
//! samples among machines, and a path that skips a decision (a mirror needs no direction) leaves
//! all later ones as they were.
//!
//! | [`Sampler`] | points | error of smooth integrals |
//! | --- | --- | --- |
//! | [`Independent`] | hashes of the address | N^-½ |
//! | [`Sobol`] | Owen-scrambled (0,2)-sequence, shuffled per dimension and pixel | down to N^-³ᐟ² |
//!
//! [`Pcg32`] also implements [`rand_core`]'s traits, for everything that is not a path.
//!
//! # What to do with them
//! - [`warp`]: from the unit square to disks, spheres, cones, triangles, rectangles and back, each
//!   with its density; the table is on its page.
//! - [`Tabulated1d`], [`Tabulated2d`]: choice among lights, environment maps.
//! - [`mis`]: weights that combine strategies.
//!
//! # Conventions
//! Uniforms lie in `[0, 1)` and reach the functions as arguments. Everything is written once over
//! [`etendue_math::Real`]. The crate never allocates (tables borrow their storage), never panics on
//! any input and holds no `unsafe` code. Shapes validate at construction and are infallible
//! afterwards.
//!
//! # Features
//! `std` (default) and `libm` choose the float functions, see [`etendue_math`]; `libm` wins and
//! gives the same bits on every target. `arch` makes `libm` faster without `std`.
//!
//! # Non-goals
//! No blue-noise error distribution over pixels, no Sobol' dimensions beyond the second (points are
//! padded), no alias tables (they break stratification), no sampling of reflection models: those
//! are in `etendue-brdf`.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(any(feature = "std", test))]
extern crate std;

mod dimension;
mod independent;
pub mod mis;
mod owen;
mod pcg32;
mod sampler;
mod sobol;
mod table;
mod tabulated1d;
mod tabulated2d;
#[cfg(test)]
mod testing;
pub mod warp;

pub use dimension::{Decision, Dimension};
pub use independent::Independent;
pub use pcg32::{Pcg32, uniform};
pub use rand_core;
pub use sampler::Sampler;
pub use sobol::Sobol;
pub use table::TableError;
pub use tabulated1d::{Choice, Tabulated1d};
pub use tabulated2d::Tabulated2d;

/// Runs the README's example.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
