//! The table of all models, from the registry.

use etendue_brdf::registry::{Albedo, Energy, MODELS, ModelInfo, Reciprocity};

use etendue_report::document::row;

/// How the table names the types.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Links {
    /// As code.
    None,
    /// As links within the documentation of the crate.
    Rustdoc,
}

/// One row per registered model: type, parameters, laws, density of its samples, source.
pub fn model_table(links: Links) -> String {
    let mut text = row(["model", "parameters", "laws", "sampled by", "source"]);
    text += &row(["---"; 5]);
    for info in MODELS {
        let name = match links {
            Links::None => format!("`{}`", info.type_name),
            Links::Rustdoc => format!("[`{}`]", info.type_name),
        };
        let names: Vec<&str> = info.parameters.iter().map(|p| p.name).collect();
        text += &row([&name, &names.join(", "), &laws(info), info.density, info.source]);
    }
    text
}

fn laws(info: &ModelInfo) -> String {
    let reciprocity = match info.reciprocity {
        Reciprocity::Reciprocal => "reciprocal",
        Reciprocity::UpToSquaredIndex => "reciprocal up to η²",
        Reciprocity::ReflectionOnly => "reciprocal in reflection only",
        Reciprocity::NonReciprocal { .. } => "**not reciprocal**",
    };
    let energy = match info.energy {
        Energy::Conserves => "albedo ≤ 1".to_owned(),
        Energy::Gains { maximum, .. } => format!("albedo ≤ {maximum}"),
        Energy::OfData => "albedo as measured".to_owned(),
    };
    let albedo = match info.albedo {
        Albedo::ClosedForm => " in closed form",
        Albedo::Quadrature | Albedo::Inner => "",
    };
    format!("{reciprocity}; {energy}{albedo}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_model_has_a_row() {
        let (plain, linked) = (model_table(Links::None), model_table(Links::Rustdoc));
        for info in MODELS {
            assert!(plain.contains(&format!("| `{}` |", info.type_name)));
            assert!(linked.contains(&format!("| [`{}`] |", info.type_name)));
        }
        assert_eq!(plain.lines().count(), MODELS.len() + 2);
    }
}
