//! Parameters as a text file or a command line gives them: by name.

use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;

/// What a parameter can be.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// Several numbers: a colour, a direction, a pair of uniforms.
    Numbers(Vec<f64>),
    /// A choice, such as the name of a distribution; also the name of a model that needs no parameters.
    Word(String),
    /// A model inside a model.
    Model(Box<Description>),
}

/// A model by name.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(deny_unknown_fields))]
pub struct Description {
    /// Its name in the [registry](crate::registry).
    pub model: String,
    /// What it is built from.
    #[cfg_attr(feature = "serde", serde(default, rename = "params"))]
    pub parameters: Parameters,
}

/// Values by name.
///
/// # Examples
/// ```
/// use etendue_brdf::named::Parameters;
/// let glass = Parameters::new().with_number("eta", 1.5).with_word("distribution", "ggx");
/// assert!(glass.get("eta").is_some() && glass.get("alpha").is_none());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parameters(Vec<(String, Value)>);

impl Parameters {
    /// None.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a value, or replaces the one of this name.
    pub fn set(&mut self, name: impl Into<String>, value: Value) {
        let name = name.into();
        match self.0.iter_mut().find(|(known, _)| *known == name) {
            Some(entry) => entry.1 = value,
            None => self.0.push((name, value)),
        }
    }

    /// These and a number.
    pub fn with_number(mut self, name: &str, x: f64) -> Self {
        self.set(name, Value::Number(x));
        self
    }

    /// These and several numbers.
    pub fn with_numbers(mut self, name: &str, x: &[f64]) -> Self {
        self.set(name, Value::Numbers(x.to_vec()));
        self
    }

    /// These and a choice.
    pub fn with_word(mut self, name: &str, word: &str) -> Self {
        self.set(name, Value::Word(word.into()));
        self
    }

    /// The value of this name.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.0.iter().find(|(known, _)| known == name).map(|(_, value)| value)
    }

    /// All names, in the order they were given.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|(name, _)| name.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_value_of_a_name_counts() {
        let twice = Parameters::new().with_number("k", 1.0).with_number("k", 2.0);
        assert_eq!(twice, Parameters::new().with_number("k", 2.0));
        assert_eq!(twice.names().count(), 1);
    }
}
