//! Values read from a self-describing format, with the feature `serde`.

use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Visitor};

use super::{Description, Parameters, Value};

/// The numbers that JSON cannot write, as strings.
fn non_finite(text: &str) -> Option<f64> {
    match text {
        "NaN" => Some(f64::NAN),
        "Infinity" => Some(f64::INFINITY),
        "-Infinity" => Some(f64::NEG_INFINITY),
        _ => None,
    }
}

impl<'de> Deserialize<'de> for Value {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ValueVisitor)
    }
}

struct ValueVisitor;

impl<'de> Visitor<'de> for ValueVisitor {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, an array of numbers, a word or a model")
    }

    fn visit_f64<E: Error>(self, x: f64) -> Result<Value, E> {
        Ok(Value::Number(x))
    }

    fn visit_i64<E: Error>(self, x: i64) -> Result<Value, E> {
        Ok(Value::Number(x as f64))
    }

    fn visit_u64<E: Error>(self, x: u64) -> Result<Value, E> {
        Ok(Value::Number(x as f64))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Value, E> {
        Ok(non_finite(text).map_or_else(|| Value::Word(text.into()), Value::Number))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
        let mut numbers = Vec::new();
        while let Some(item) = items.next_element()? {
            let Value::Number(x) = item else { return Err(A::Error::custom("not a number")) };
            numbers.push(x);
        }
        Ok(Value::Numbers(numbers))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Value, A::Error> {
        Description::deserialize(MapAccessDeserializer::new(map))
            .map(|inner| Value::Model(Box::new(inner)))
    }
}

impl<'de> Deserialize<'de> for Parameters {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(ParametersVisitor)
    }
}

struct ParametersVisitor;

impl<'de> Visitor<'de> for ParametersVisitor {
    type Value = Parameters;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("parameters by name")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Parameters, A::Error> {
        let mut parameters = Parameters::new();
        while let Some((name, value)) = map.next_entry::<String, Value>()? {
            if parameters.get(&name).is_some() {
                return Err(A::Error::custom(format_args!("{name:?} is given twice")));
            }
            parameters.set(name, value);
        }
        Ok(parameters)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Row;
    use super::*;

    #[test]
    fn json_holds_numbers_words_colours_and_models() {
        let text = r#"{"model": "mask", "id": 7, "wi": [0, "Infinity", 0.5], "params": {"opacity": 1,
            "inner": {"model": "lambert", "params": {"albedo": [0.1, 0.2, 0.3]}}, "word": "ggx", "k": "NaN"}}"#;
        let row: Row = serde_json::from_str(text).unwrap();
        assert_eq!(row.model.as_deref(), Some("mask"));
        assert_eq!(row.wi, Some(Value::Numbers([0.0, f64::INFINITY, 0.5].into())));
        let lambert = Description {
            model: "lambert".into(),
            parameters: Parameters::new().with_numbers("albedo", &[0.1, 0.2, 0.3]),
        };
        assert_eq!(row.params.get("inner"), Some(&Value::Model(Box::new(lambert))));
        assert_eq!(row.params.get("word"), Some(&Value::Word("ggx".into())));
        assert!(matches!(row.params.get("k"), Some(Value::Number(x)) if x.is_nan()));
    }

    #[test]
    fn what_is_not_a_value_or_is_given_twice_is_refused() {
        for text in [
            r#"{"params": {"a": null}}"#,
            r#"{"params": {"a": [1, "x"]}}"#,
            r#"{"params": {"a": 1, "a": 2}}"#,
            r#"{"wi": true}"#,
            r#"{"params": 3}"#,
        ] {
            assert!(serde_json::from_str::<Row>(text).is_err(), "{text}");
        }
    }
}
