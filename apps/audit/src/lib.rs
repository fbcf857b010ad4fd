//! Audits the reflection models of `etendue-brdf`: the very code that renders, no copy of it.
//!
//! A model states its laws in `etendue_brdf::registry::MODELS`; [`cases`] adds parameters to it;
//! every check in [`checks`] is run on every case in `f32` and in `f64`, with uniforms from
//! fixed hashes, so that two runs print the same report whatever the number of threads.
//!
//! | module | holds |
//! | --- | --- |
//! | [`cases`] | which parameters of which model are audited |
//! | [`generators`] | directions and uniforms, hostile ones included |
//! | [`checks`] | one law per file, with its tolerance and the reason for it |
//! | [`sweep`] | `f32` against `f64` over the hostile domain |
//! | [`furnace`] | laws of microfacets by themselves |
//! | [`closed_forms`] | functions and random walks that are no models, against what is known of them |
//! | [`hard_cases`] | single functions where naive forms break, each with that naive form |
//! | [`partition`], [`cubature`], [`statistics`] | the numerics under the checks |
//! | [`run`], [`report`] | everything on all cores, printed, as JSON and as Markdown |
//! | [`mutations`] | bugs that the audit must find |
//! | [`model_table`] | what programs write in documents, by `etendue_report::document` |
//!
//! # Non-goals
//! No speed is measured, and no picture is looked at.

#[cfg(test)]
mod broken;
pub mod budget;
pub mod cases;
pub mod checks;
pub mod closed_forms;
pub mod cubature;
pub mod filter;
pub mod furnace;
pub mod generators;
pub mod hard_cases;
pub mod measure;
pub mod model_table;
pub mod mutations;
pub mod partition;
pub mod progress;
pub mod report;
pub mod run;
pub mod scalar;
pub mod statistics;
pub mod subject;
pub mod sweep;
