//! Rows of measurements.

use std::collections::HashSet;

use serde_json::{Map, Value, json};

use crate::document::row;
use crate::number::significant;

/// One column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its name for programs: the key in JSON, the heading in CSV; unique in its table.
    pub name: &'static str,
    /// Its heading for people, with the unit.
    pub heading: String,
}

/// One entry.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A text.
    Text(String),
    /// A number, and how many significant digits of it people see; files for programs have all.
    Number {
        /// The number; one that is not finite is null in JSON.
        value: f64,
        /// How many digits are known.
        digits: usize,
    },
    /// Yes (a dot for people) or no (nothing).
    Flag(bool),
    /// Not measured, or without meaning in this row.
    Missing,
}

/// A table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    columns: Vec<Column>,
    rows: Vec<Vec<Cell>>,
}

impl Cell {
    /// A text.
    pub fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    /// A number of which three digits are shown.
    pub fn number(value: f64) -> Self {
        Self::Number { value, digits: 3 }
    }

    /// As people read it.
    pub(crate) fn shown(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            &Self::Number { value, digits } => significant(value, digits),
            Self::Flag(true) => "●".to_owned(),
            Self::Flag(false) => String::new(),
            Self::Missing => "–".to_owned(),
        }
    }

    fn json(&self) -> Value {
        match self {
            Self::Text(text) => json!(text),
            Self::Number { value, .. } => json!(value),
            Self::Flag(flag) => json!(flag),
            Self::Missing => Value::Null,
        }
    }

    fn csv(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number { value, .. } => value.to_string(),
            Self::Flag(flag) => flag.to_string(),
            Self::Missing => String::new(),
        }
    }
}

impl Table {
    /// A table without rows; `(name, heading)` of every column.
    ///
    /// # Panics
    /// Two columns of one name: a mistake in the program that makes the table.
    pub fn new<H: Into<String>>(columns: impl IntoIterator<Item = (&'static str, H)>) -> Self {
        let columns: Vec<Column> = columns
            .into_iter()
            .map(|(name, heading)| Column { name, heading: heading.into() })
            .collect();
        let distinct: HashSet<_> = columns.iter().map(|c| c.name).collect();
        assert_eq!(distinct.len(), columns.len(), "columns with the same name");
        Self { columns, rows: Vec::new() }
    }

    /// Adds a row.
    ///
    /// # Panics
    /// More or fewer cells than columns: a mistake in the program that makes the table.
    pub fn push(&mut self, cells: impl IntoIterator<Item = Cell>) {
        let cells: Vec<Cell> = cells.into_iter().collect();
        assert_eq!(cells.len(), self.columns.len(), "cells of a row");
        self.rows.push(cells);
    }

    /// The columns.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The rows, from the top.
    pub fn rows(&self) -> &[Vec<Cell>] {
        &self.rows
    }

    /// Whether a column holds numbers, which are set to the right.
    pub(crate) fn is_numeric(&self, column: usize) -> bool {
        self.rows.iter().any(|row| matches!(row[column], Cell::Number { .. }))
    }

    /// As Markdown.
    pub fn markdown(&self) -> String {
        let mut text = row(self.columns.iter().map(|c| c.heading.as_str()));
        text +=
            &row((0..self.columns.len()).map(|i| if self.is_numeric(i) { "--:" } else { "---" }));
        for cells in &self.rows {
            let shown: Vec<String> = cells.iter().map(Cell::shown).collect();
            text += &row(shown.iter().map(String::as_str));
        }
        text
    }

    /// As an array of objects, a row each.
    pub fn json(&self) -> Value {
        let object = |cells: &Vec<Cell>| {
            let members =
                self.columns.iter().zip(cells).map(|(c, cell)| (c.name.to_owned(), cell.json()));
            Value::Object(members.collect::<Map<_, _>>())
        };
        Value::Array(self.rows.iter().map(object).collect())
    }

    /// As lines of a CSV file with their headings, each preceded by `prefix`: columns that several tables of one
    /// file have in common.
    pub fn csv(&self, prefix: &[(&str, &str)]) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let headings = prefix.iter().map(|p| p.0).chain(self.columns.iter().map(|c| c.name));
        // Writing to memory cannot fail, and every row has as many cells as the first.
        let _ = writer.write_record(headings);
        for cells in &self.rows {
            let fixed = prefix.iter().map(|p| p.1.to_owned());
            let _ = writer.write_record(fixed.chain(cells.iter().map(Cell::csv)));
        }
        String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let mut table =
            Table::new([("variant", "variant"), ("error", "error, of 1"), ("front", "")]);
        table.push([Cell::text("a|b, \"c\""), Cell::number(0.012_345), Cell::Flag(true)]);
        table.push([Cell::text("d"), Cell::Missing, Cell::Flag(false)]);
        table
    }

    #[test]
    fn every_form_has_every_cell() {
        let markdown = "| variant | error, of 1 |  |\n| --- | --: | --- |\n\
                        | a\\|b, \"c\" | 0.0123 | ● |\n| d | – |  |\n";
        assert_eq!(table().markdown(), markdown);
        let csv = "family,variant,error,front\nf,\"a|b, \"\"c\"\"\",0.012345,true\nf,d,,false\n";
        assert_eq!(table().csv(&[("family", "f")]), csv);
        assert_eq!(
            table().json(),
            json!([{"variant": "a|b, \"c\"", "error": 0.012_345, "front": true},
                   {"variant": "d", "error": null, "front": false}])
        );
    }

    #[test]
    #[should_panic(expected = "cells of a row")]
    fn a_row_has_a_cell_for_every_column() {
        table().push([Cell::Missing]);
    }
}
