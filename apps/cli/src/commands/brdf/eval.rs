//! `etendue brdf eval`: rows in, answers out.

use std::io::{BufRead, Read, Write};

use clap::ValueEnum;
use etendue_brdf::named::{Answer, Output, Row};
use etendue_math::{Real, Spectrum, Vector3};
use serde_json::{Value, json};

use super::written;
use crate::failure::{Exit, Failure};

/// Evaluates models and functions: one JSON object per line on standard input, one per line on standard output.
///
/// {"model","params","wi","wo"} gives {"f","pdf"}; {"fn","params",…} gives {"value"}; {"fn":"albedo","model","params","wo"}
/// gives {"value","reflected","transmitted"}. Whatever is wrong with a line gives {"error"}, and the next line follows.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Number type in which everything is evaluated.
    #[arg(long, value_enum, default_value_t = Precision::F64)]
    precision: Precision,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Precision {
    /// Single precision.
    F32,
    /// Double precision.
    F64,
}

/// Longer lines are no rows: an input without line ends must not fill the memory.
const LONGEST_LINE: u64 = 1 << 20;

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let mut input = std::io::stdin().lock();
    let mut output = std::io::stdout().lock();
    let mut line = Vec::new();
    while next_line(&mut input, &mut line)
        .map_err(|error| Failure::new(Exit::InputOutput, format!("standard input: {error}")))?
    {
        if line.trim_ascii().is_empty() {
            continue;
        }
        let answer = match arguments.precision {
            Precision::F32 => answer::<f32>(&line),
            Precision::F64 => answer::<f64>(&line),
        };
        let answer = answer.unwrap_or_else(|error| json!({ "error": error }));
        if let Err(error) = writeln!(output, "{answer}") {
            return written(Err(error));
        }
    }
    Ok(Exit::Done)
}

/// Reads a line, of a longer one the beginning; false at the end.
fn next_line(input: &mut impl BufRead, line: &mut Vec<u8>) -> std::io::Result<bool> {
    line.clear();
    let read = input.by_ref().take(LONGEST_LINE).read_until(b'\n', line)?;
    if read as u64 == LONGEST_LINE && line.last() != Some(&b'\n') {
        input.skip_until(b'\n')?;
    }
    Ok(read > 0)
}

fn answer<T: Real + Spectrum<Real = T>>(line: &[u8]) -> Result<Value, String> {
    if line.len() as u64 == LONGEST_LINE {
        return Err(format!("a line of {LONGEST_LINE} bytes or more"));
    }
    let row: Row = serde_json::from_slice(line).map_err(|error| error.to_string())?;
    Ok(match row.answer::<T>().map_err(|error| error.to_string())? {
        Answer::Bsdf { f, pdf } => json!({ "f": number(f)?, "pdf": number(pdf)? }),
        Answer::Function(Output::Number(x)) => json!({ "value": number(x)? }),
        Answer::Function(Output::Direction(None)) => json!({ "value": null }),
        Answer::Function(Output::Direction(Some(w))) => json!({ "value": vector::<T>(w)? }),
        Answer::Function(Output::Sample { direction, pdf }) => {
            json!({ "value": vector::<T>(direction)?, "pdf": number(pdf)? })
        }
        Answer::Albedo { value, sides } => json!({
            "value": number(value)?,
            "reflected": number(sides.reflected)?,
            "transmitted": number(sides.transmitted)?,
        }),
    })
}

/// A number with all its digits; what is not finite never leaves as if it were a value.
fn number<T: Real>(x: T) -> Result<f64, String> {
    if x.is_finite() { Ok(x.to_f64()) } else { Err(format!("the result is {x}")) }
}

fn vector<T: Real>(w: T::Vec3) -> Result<[f64; 3], String> {
    Ok([number(w.x())?, number(w.y())?, number(w.z())?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_without_end_is_one_refusal() {
        let mut text = vec![b' '; 3 << 20];
        text.extend(b"\n{}\n");
        let (mut input, mut line) = (text.as_slice(), Vec::new());
        assert!(next_line(&mut input, &mut line).unwrap());
        assert!(answer::<f32>(&line).unwrap_err().contains("bytes or more"));
        assert!(next_line(&mut input, &mut line).unwrap());
        assert_eq!(line, b"{}\n");
        assert!(!next_line(&mut input, &mut line).unwrap());
    }

    #[test]
    fn what_is_not_finite_is_an_error() {
        assert_eq!(number(f32::NAN).unwrap_err(), "the result is NaN");
        assert!(number(f64::INFINITY).is_err());
        assert_eq!(number(0.1_f32).unwrap(), f64::from(0.1_f32));
    }
}
