//! Renders that can be stopped, stored, continued, divided and joined without a trace in the picture.
//!
//! An [`Accumulation`] is what a plain render knows while it is under way: of each pixel the exact sum of its samples
//! ([`etendue_math::ExactSum`]), the sum of their squares and their number, and how many samples of the one global sequence have been
//! drawn. [`Renderer::accumulate`](crate::Renderer::accumulate) continues one until it is whole.
//!
//! # The same bits
//! Samples have addresses and sums no order. A render that was stopped and continued, or divided into ranges of
//! samples on several machines and [joined](Accumulation::joined) in any order, has the bits of
//! [`Renderer::render`](crate::Renderer::render).
//!
//! # Passes
//! All pixels advance together: the first passes double the samples, later ones add 64 each. A picture that is stopped early
//! has samples everywhere, and no tile takes long.
//!
//! # Memory
//! Tiles at rest are immutable and packed: 40 to 60 bytes per pixel. To copy an accumulation is to copy references to its tiles,
//! which takes a millisecond for the largest pictures; rendering goes on meanwhile.

mod column;
mod draw;
mod packed;
mod pixel;
mod sums;

pub use sums::Accumulation;

pub(crate) use packed::PackedTile;
pub(crate) use pixel::PixelMoments;
