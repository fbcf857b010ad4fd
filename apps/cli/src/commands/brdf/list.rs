//! `etendue brdf list`: what there is.

use std::io::Write;

use etendue_brdf::Lobes;
use etendue_brdf::named;
use etendue_brdf::registry::{Albedo, Energy, MODELS, ModelInfo, Reciprocity};
use serde_json::{Value, json};

use super::written;
use crate::failure::{Exit, Failure};

/// Lists all models with parameters, laws, sampling density and source, and all functions.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let text = if arguments.json { format!("{}\n", as_json()) } else { table() };
    written(std::io::stdout().lock().write_all(text.as_bytes()))
}

fn table() -> String {
    let mut text = String::new();
    for model in MODELS {
        text += &entry(model);
        text.push('\n');
    }
    text += "functions\n";
    for function in named::functions() {
        text += &format!("  {:<26} {}\n", function.name, function.inputs.join(", "));
    }
    text + "  albedo                     model, params, wo\n"
}

/// One model: its name, then a line per property.
fn entry(model: &ModelInfo) -> String {
    let mut text = format!("{}\n", model.name);
    let mut line = |label: &str, content: &str| text += &format!("  {label:<11} {content}\n");
    let width = model.parameters.iter().map(|p| p.name.len()).max().unwrap_or(0);
    let mut label = "parameters";
    for parameter in model.parameters {
        line(label, &format!("{:<width$}  {}", parameter.name, parameter.domain));
        label = "";
    }
    if model.parameters.is_empty() {
        line(label, "none");
    }
    line("laws", &format!("{}; {}", reciprocity(model.reciprocity), energy(&model.energy)));
    line("lobes", &lobes(model.lobes).join(", "));
    line("albedo", albedo(model.albedo));
    line("sampling", model.density);
    line("source", model.source);
    text
}

fn reciprocity(reciprocity: Reciprocity) -> String {
    match reciprocity {
        Reciprocity::Reciprocal => "reciprocal".into(),
        Reciprocity::UpToSquaredIndex => "reciprocal up to the squared index".into(),
        Reciprocity::ReflectionOnly => "reciprocal in reflection only".into(),
        Reciprocity::NonReciprocal { .. } => "not reciprocal".into(),
    }
}

fn energy(energy: &Energy) -> String {
    match energy {
        Energy::Conserves => "conserves energy".into(),
        Energy::OfData => "energy as measured".into(),
        Energy::Gains { maximum, at } => format!("reflects up to {maximum:.4} of the light ({at})"),
    }
}

fn lobes(lobes: Lobes) -> Vec<&'static str> {
    [(lobes.continuous, "continuous"), (lobes.delta, "delta"), (lobes.transmission, "transmission")]
        .into_iter()
        .filter_map(|(has, name)| has.then_some(name))
        .collect()
}

fn albedo(albedo: Albedo) -> &'static str {
    match albedo {
        Albedo::ClosedForm => "closed form",
        Albedo::Quadrature => "by integration",
        Albedo::Inner => "that of the model inside",
    }
}

fn as_json() -> Value {
    let models: Vec<Value> = MODELS
        .iter()
        .map(|model| {
            let parameters = model.parameters.iter();
            let maximum = match model.energy {
                Energy::Gains { maximum, .. } => Some(maximum),
                Energy::Conserves => Some(1.0),
                Energy::OfData => None,
            };
            json!({
                "name": model.name,
                "type": model.type_name,
                "parameters": parameters
                    .map(|p| json!({ "name": p.name, "domain": p.domain }))
                    .collect::<Vec<_>>(),
                "reciprocity": reciprocity(model.reciprocity),
                "energy": energy(&model.energy),
                "largest_albedo": maximum,
                "lobes": lobes(model.lobes),
                "albedo": albedo(model.albedo),
                "sampling": model.density,
                "source": model.source,
            })
        })
        .collect();
    let functions: Vec<Value> = named::functions()
        .iter()
        .map(|function| json!({ "name": function.name, "inputs": function.inputs }))
        .collect();
    json!({ "models": models, "functions": functions })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_model_is_listed_with_every_parameter() {
        let (text, json) = (table(), as_json().to_string());
        for model in MODELS {
            for word in [model.name, model.source, model.density] {
                assert!(text.contains(word) && json.contains(word), "{word}");
            }
            for parameter in model.parameters {
                let block = entry(model);
                assert!(block.contains(parameter.name) && block.contains(parameter.domain));
            }
        }
    }
}
