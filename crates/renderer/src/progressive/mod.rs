//! Progressive rendering: an error estimate while the picture forms, an end at a given error, and samples
//! where the error is.
//!
//! # Two halves
//! Every pixel has two halves with random numbers of their own, and the picture is the mean of the two:
//! half *a* draws the samples 0, 1, 2, … of the pixel, half *b* the samples 2³², 2³² + 1, …, for which
//! samplers have other keys. Their difference says how large the error is; [`ImageError`] has the formulas.
//! Since a pixel owns its samples (no splatting), the errors of pixels are independent.
//!
//! # Rounds
//! A half is doubled or left as it is, because Sobol' points are stratified in aligned powers of two. The
//! first rounds double every pixel, to eight samples in each half; later ones add a fifth to the
//! samples each, and the pixels to be doubled are those with the largest variance (Neyman's allocation) in
//! the 7 × 7 pixels around. No pixel has less than a 16th of the mean.
//!
//! # Without bias
//! How many samples half *a* gets depends on nothing but the samples of half *b*, and the other way round
//! (the dual buffers of Rousselle, Knaus and Zwicker, 2012). To keep it so over many rounds, what decides
//! are not all samples of the other half, whose number depends on the first one's, but those that every
//! pixel has by then. A half is thus the mean of a number of samples that is independent of them, and
//! its expectation is that of a single sample.
//!
//! Ending at an error is a choice made by looking at the samples, and not free of bias: pictures
//! that have missed something rare look finished. Therefore the upper end of the interval has to
//! satisfy the bound, and no picture ends before it has 16 samples per pixel.
//!
//! # Invariants
//! A render that is not halted has the same bits for any number of threads. A halted one stops at any
//! pixel, each of which is a mean of whole doublings.
//!
//! # Stopping and going on
//! What a render knows is a [`ProgressiveState`], which can be copied at any time, stored and continued.
//!
//! # Memory
//! About 110 bytes per pixel while rendering.

mod allocation;
mod convergence;
mod goal;
mod half;
mod halves;
mod image_error;
mod rounds;
mod schedule;
mod state;

pub use convergence::{Round, exponent, factor_for_half};
pub use goal::{Allocation, Goal, Halt};
pub use image_error::{CONFIDENCE, ImageError};
pub use rounds::{Advance, ProgressiveRendering};
pub use state::ProgressiveState;
