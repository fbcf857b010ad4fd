//! A model as the command line names it.

use std::fmt;
use std::str::FromStr;

use etendue_brdf::Bsdf;
use etendue_brdf::named::{Description, Parameters, Value, build};

use crate::failure::Failure;

/// `MODEL` or `MODEL:key=value,key=value`.
#[derive(Clone, Debug)]
pub(super) struct Specification {
    text: String,
    description: Description,
}

impl FromStr for Specification {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (model, list) = text.split_once(':').unwrap_or((text, ""));
        let mut parameters = Parameters::new();
        for item in list.split(',').filter(|item| !item.is_empty()) {
            let (name, value) = item
                .split_once('=')
                .ok_or_else(|| format!("{item:?} is not of the form key=value"))?;
            if parameters.get(name).is_some() {
                return Err(format!("{name:?} is given twice"));
            }
            let value = value.parse().map_or_else(|_| Value::Word(value.into()), Value::Number);
            parameters.set(name, value);
        }
        let description = Description { model: model.into(), parameters };
        Ok(Self { text: text.into(), description })
    }
}

impl fmt::Display for Specification {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl Specification {
    /// The model, of one channel.
    pub(super) fn build(&self) -> Result<Box<dyn Bsdf<Color = f64>>, Failure> {
        build(&self.description.model, &self.description.parameters)
            .map_err(|error| Failure::usage(error.to_string()))
    }

    /// Name, and the parameters as they were typed.
    pub(super) fn parts(&self) -> (&str, &str) {
        self.text.split_once(':').unwrap_or((&self.text, ""))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_numbers_and_words_are_told_apart() {
        let ggx: Specification =
            "rough-dielectric:alpha=0.1,eta=1.5,distribution=ggx".parse().unwrap();
        assert!(ggx.build().is_ok());
        assert_eq!(ggx.parts(), ("rough-dielectric", "alpha=0.1,eta=1.5,distribution=ggx"));
        assert!("null".parse::<Specification>().unwrap().build().is_ok());
        assert!("lambert".parse::<Specification>().unwrap().build().is_err());
        assert!("lambert:0.5".parse::<Specification>().is_err());
        assert!("lambert:albedo=1,albedo=1".parse::<Specification>().is_err());
    }
}
