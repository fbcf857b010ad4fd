//! Draws a chart: `chart < CHART.json > CHART.svg`, for programs in other languages.
//!
//! ```json
//! {"title": "…", "x": {"label": "…", "log": true}, "y": {"label": "…", "log": false},
//!  "series": [{"name": "…", "points": [[1, 2], [10, 3]]}],
//!  "powers": [{"exponent": 1, "through": [1, 2], "label": "∝ n"}], "levels": [{"y": 1, "label": "…"}]}
//! ```
#![allow(missing_docs, reason = "a program")]

use core::error::Error;
use std::io::{Read, Write};

use etendue_report::{Axis, Chart, Guide, Point, Series, Style};
use serde_json::Value;

fn main() -> Result<(), Box<dyn Error>> {
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text)?;
    let svg = chart(&serde_json::from_str(&text)?).ok_or("not a chart; see the source")?.svg();
    Ok(std::io::stdout().write_all(svg.as_bytes())?)
}

fn chart(value: &Value) -> Option<Chart> {
    let list = |name: &str| value[name].as_array().cloned().unwrap_or_default();
    let powers = list("powers").into_iter().map(|guide| {
        Some(Guide::Power {
            exponent: guide["exponent"].as_f64()?,
            through: pair(&guide["through"])?,
            label: string(&guide["label"])?,
        })
    });
    let levels = list("levels").into_iter().map(|guide| {
        Some(Guide::Level { y: guide["y"].as_f64()?, label: string(&guide["label"])? })
    });
    Some(Chart {
        title: string(&value["title"])?,
        x: axis(&value["x"])?,
        y: axis(&value["y"])?,
        series: list("series").iter().map(series).collect::<Option<_>>()?,
        guides: powers.chain(levels).collect::<Option<_>>()?,
    })
}

fn axis(value: &Value) -> Option<Axis> {
    let label = string(&value["label"])?;
    Some(if value["log"].as_bool()? { Axis::log(label) } else { Axis::linear(label) })
}

fn series(value: &Value) -> Option<Series> {
    let point = |at: &Value| Some(Point { at: pair(at)?, filled: true, ..Point::default() });
    Some(Series {
        name: string(&value["name"])?,
        style: Style::Line,
        points: value["points"].as_array()?.iter().map(point).collect::<Option<_>>()?,
    })
}

fn pair(value: &Value) -> Option<[f64; 2]> {
    Some([value[0].as_f64()?, value[1].as_f64()?])
}

fn string(value: &Value) -> Option<String> {
    Some(value.as_str()?.to_owned())
}
