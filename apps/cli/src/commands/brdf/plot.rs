//! `etendue brdf plot`: lobes and albedos of models side by side.

use std::path::PathBuf;

use super::figure::{Curves, figure};
use super::lobe::{albedo, lobe, retro_reflection};
use super::specification::Specification;
use crate::failure::{Exit, Failure};
use crate::output::Destination;
use etendue_report::svg::{COLOURS, PATTERNS};

/// Draws models as an SVG: polar lobes in the plane of incidence, directional albedo and retro-reflection.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// MODEL or MODEL:key=value,key=value; see `etendue brdf list` for names.
    #[arg(required = true, num_args = 1..=COLOURS)]
    models: Vec<Specification>,
    /// Angles of the viewer to the normal, in degrees, for which lobes are drawn.
    #[arg(long, value_delimiter = ',', default_values_t = [10.0, 45.0, 75.0], value_parser = angle)]
    angles: Vec<f64>,
    /// The file to write.
    #[arg(short, long, value_name = "FILE.svg")]
    output: PathBuf,
}

/// An angle above the horizon.
fn angle(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(degrees) if (0.0..90.0).contains(&degrees) => Ok(degrees),
        _ => Err("an angle in degrees, at least 0 and less than 90, is needed".into()),
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    if arguments.angles.len() > PATTERNS {
        return Err(Failure::usage(format!("at most {PATTERNS} angles can be told apart")));
    }
    if arguments.output.extension().is_none_or(|e| !e.eq_ignore_ascii_case("svg")) {
        let path = arguments.output.display();
        return Err(Failure::usage(format!("{path}: plots are written as *.svg")));
    }
    let destination = Destination::check(&arguments.output)?;
    let curves = arguments
        .models
        .iter()
        .map(|specification| {
            let model = specification.build()?;
            Ok(Curves {
                name: specification.parts().0.into(),
                parameters: specification.parts().1.replace(',', ", "),
                transmits: model.lobes().transmission,
                lobes: arguments.angles.iter().map(|&angle| lobe(&*model, angle)).collect(),
                albedo: albedo(&*model),
                retro_reflection: retro_reflection(&*model),
            })
        })
        .collect::<Result<Vec<_>, Failure>>()?;
    destination.write(figure(&curves, &arguments.angles).as_bytes())?;
    Ok(Exit::Done)
}
