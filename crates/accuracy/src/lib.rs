//! What accuracy costs in time.
//!
//! Wherever there is an exact and a cheaper way, an experiment here runs both: the error of each against a reference,
//! the time of each in the same run, and which of them are on the Pareto front of the two. The outcome is a
//! [`Report`](etendue_report::Report).
//!
//! Errors are the same in every run. Times are not, so they are taken interleaved and given as ratios
//! ([`timing`]).
//!
//! - [`functions`]: formulas that can be evaluated in more than one way.
#![forbid(unsafe_code)]
#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "`!(x > 0)` is how NaN is refused along with what is not positive"
)]
#![allow(
    clippy::std_instead_of_alloc,
    clippy::std_instead_of_core,
    reason = "for programs on hosts with an operating system"
)]

pub mod functions;
pub mod samplers;
pub mod scene;
pub mod timing;
