//! Values of a document, with where they stand.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::Display;
use core::ops::RangeInclusive;
use std::path::Path;

use serde_json::Value;

use crate::{Location, SceneError, Warning};

/// A value of a JSON document that knows its place, such as `nodes[3].mesh`: every question is either answered or an error that
/// names it.
#[derive(Clone, Debug)]
pub(super) struct Json<'a> {
    value: &'a Value,
    file: &'a Path,
    place: String,
}

impl<'a> Json<'a> {
    /// The outermost value of a file.
    pub(super) fn root(value: &'a Value, file: &'a Path) -> Self {
        Self { value, file, place: String::new() }
    }

    /// The place of a value.
    pub(super) fn place(&self) -> &str {
        &self.place
    }

    /// An error about this value.
    pub(super) fn error(&self, message: impl Display) -> SceneError {
        SceneError::scene(Location::file(self.file), self.told(message))
    }

    /// The same for one that asks for too much.
    pub(super) fn too_much(&self, message: impl Display) -> SceneError {
        SceneError::resource(Location::file(self.file), self.told(message))
    }

    /// A warning about this value.
    pub(super) fn warning(&self, message: impl Display) -> Warning {
        Warning::new(Location::file(self.file), self.told(message))
    }

    /// The error of a file that this value names, with its place.
    pub(super) fn told_of(&self, mut error: SceneError) -> SceneError {
        error.message = format!("{} (named at {})", error.message, self.place);
        error
    }

    fn told(&self, message: impl Display) -> String {
        if self.place.is_empty() {
            format!("{message}")
        } else {
            format!("{}: {message}", self.place)
        }
    }

    /// The error of a value of the wrong type.
    fn instead(&self, expected: &str) -> SceneError {
        let found = match self.value {
            Value::Null => "null".into(),
            Value::Bool(value) => format!("{value}"),
            Value::Number(value) => format!("{value}"),
            Value::String(_) => "a string".into(),
            Value::Array(list) => format!("a list of {}", list.len()),
            Value::Object(_) => String::from("an object"),
        };
        self.error(format!("must be {expected}, not {found}"))
    }

    /// A property, if it is there.
    pub(super) fn get(&self, name: &str) -> Result<Option<Self>, SceneError> {
        let Value::Object(properties) = self.value else { return Err(self.instead("an object")) };
        Ok(properties.get(name).map(|value| {
            let dot = if self.place.is_empty() { "" } else { "." };
            Self { value, file: self.file, place: format!("{}{dot}{name}", self.place) }
        }))
    }

    /// A property that must be there.
    pub(super) fn need(&self, name: &str) -> Result<Self, SceneError> {
        self.get(name)?.ok_or_else(|| self.error(format!("has no “{name}”")))
    }

    /// An extension of this object, if it has it.
    pub(super) fn extension(&self, name: &str) -> Result<Option<Self>, SceneError> {
        match self.get("extensions")? {
            Some(extensions) => extensions.get(name),
            None => Ok(None),
        }
    }

    /// The names and values of an object's properties, in the order of the names.
    pub(super) fn properties(&self) -> Result<Vec<(&'a str, Self)>, SceneError> {
        let Value::Object(properties) = self.value else { return Err(self.instead("an object")) };
        let property = |(name, value): (&'a String, &'a Value)| {
            let place = format!("{}.{name}", self.place);
            (name.as_str(), Self { value, file: self.file, place })
        };
        Ok(properties.iter().map(property).collect())
    }

    /// How many items a list has.
    pub(super) fn len(&self) -> Result<usize, SceneError> {
        match self.value {
            Value::Array(list) => Ok(list.len()),
            _ => Err(self.instead("a list")),
        }
    }

    /// An item of a list, if it is there.
    pub(super) fn item(&self, index: usize) -> Result<Option<Self>, SceneError> {
        let Value::Array(list) = self.value else { return Err(self.instead("a list")) };
        Ok(list.get(index).map(|value| Self {
            value,
            file: self.file,
            place: format!("{}[{index}]", self.place),
        }))
    }

    /// The items of a property that is a list; none where it is not there.
    pub(super) fn items(&self, name: &str) -> Result<Vec<Self>, SceneError> {
        let Some(list) = self.get(name)? else { return Ok(Vec::new()) };
        (0..list.len()?).filter_map(|index| list.item(index).transpose()).collect()
    }

    /// A finite number in the range of `f32`.
    pub(super) fn as_number(&self) -> Result<f64, SceneError> {
        let number = self.value.as_f64().ok_or_else(|| self.instead("a number"))?;
        if (number as f32).is_finite() {
            Ok(number)
        } else {
            Err(self.error(format!("{number} is beyond single precision")))
        }
    }

    /// A whole number that is not negative; `3.0` is one too.
    pub(super) fn as_index(&self) -> Result<usize, SceneError> {
        // Up to here every whole number of a double is itself.
        let whole = |x: &f64| *x >= 0.0 && *x <= 9e15 && *x == (*x as u64) as f64;
        let number = self
            .value
            .as_u64()
            .or_else(|| self.value.as_f64().filter(whole).map(|number| number as u64));
        let number = number.and_then(|number| usize::try_from(number).ok());
        number.ok_or_else(|| self.instead("a whole number that is not negative"))
    }

    /// A string.
    pub(super) fn as_text(&self) -> Result<&'a str, SceneError> {
        self.value.as_str().ok_or_else(|| self.instead("a string"))
    }

    /// A list of as many numbers.
    pub(super) fn as_numbers<const N: usize>(&self) -> Result<[f64; N], SceneError> {
        if !matches!(self.value, Value::Array(list) if list.len() == N) {
            return Err(self.instead(&format!("a list of {N} numbers")));
        }
        let mut numbers = [0.0; N];
        for (index, number) in numbers.iter_mut().enumerate() {
            if let Some(item) = self.item(index)? {
                *number = item.as_number()?;
            }
        }
        Ok(numbers)
    }

    /// A property that is a number.
    pub(super) fn number(&self, name: &str) -> Result<Option<f64>, SceneError> {
        self.get(name)?.map(|value| value.as_number()).transpose()
    }

    /// The same within a range.
    pub(super) fn number_in(
        &self,
        name: &str,
        default: f64,
        range: RangeInclusive<f64>,
    ) -> Result<f64, SceneError> {
        let Some(value) = self.get(name)? else { return Ok(default) };
        let number = value.as_number()?;
        if range.contains(&number) {
            return Ok(number);
        }
        let (start, end) = (range.start(), range.end());
        let range = if *end == f64::MAX {
            format!("at least {start}")
        } else {
            format!("from {start} to {end}")
        };
        Err(value.error(format!("must be {range}, not {number}")))
    }

    /// A property that is a list of numbers.
    pub(super) fn numbers<const N: usize>(
        &self,
        name: &str,
    ) -> Result<Option<[f64; N]>, SceneError> {
        self.get(name)?.map(|value| value.as_numbers()).transpose()
    }

    /// A property that is a whole number.
    pub(super) fn index(&self, name: &str) -> Result<Option<usize>, SceneError> {
        self.get(name)?.map(|value| value.as_index()).transpose()
    }

    /// A property that is a string.
    pub(super) fn text(&self, name: &str) -> Result<Option<&'a str>, SceneError> {
        self.get(name)?.map(|value| value.as_text()).transpose()
    }

    /// A property that is true or false; false where it is not there.
    pub(super) fn flag(&self, name: &str) -> Result<bool, SceneError> {
        let Some(value) = self.get(name)? else { return Ok(false) };
        value.value.as_bool().ok_or_else(|| value.instead("true or false"))
    }

    /// What a person calls it: its name, or else its place.
    pub(super) fn title(&self) -> Result<String, SceneError> {
        Ok(match self.text("name")? {
            Some(name) if !name.is_empty() => name.into(),
            _ => self.place.clone(),
        })
    }
}
