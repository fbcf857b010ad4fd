//! Measurements as tables and charts, written as Markdown, CSV, JSON, SVG and as one HTML page that needs no network.
//!
//! ```text
//! Report ── Section ── Table   rows of cells under named columns
//!                  └── Chart   points over two axes, linear or logarithmic
//! ```
//!
//! - [`Report`]: what an experiment says of itself: sections of prose, one table and its charts;
//! - [`Table`], [`Column`], [`Cell`]: numbers with a name for programs and a heading for people;
//! - [`Chart`], [`Series`], [`Guide`]: error against cost and the like;
//! - [`pareto_front`]: which of many are not beaten in both of two costs;
//! - [`svg`]: the elements that charts, and other figures, are drawn with;
//! - [`document`]: files of which a program writes a part.
//!
//! A report holds numbers only: it reads no clock and prints nothing.
#![forbid(unsafe_code)]
#![allow(
    clippy::std_instead_of_alloc,
    clippy::std_instead_of_core,
    reason = "for programs on hosts with an operating system"
)]

mod axis;
mod chart;
pub mod document;
mod html;
mod labels;
mod number;
mod pareto;
mod report;
pub mod svg;
mod table;

pub use axis::{Axis, AxisRange, Scale};
pub use chart::{Chart, Guide, Point, Series, Style};
pub use number::significant;
pub use pareto::pareto_front;
pub use report::{Report, Section};
pub use table::{Cell, Column, Table};
